#include "contact_path/path/stop.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

#include "contact_path/scene/change_units.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/tolerances.h"

namespace contact_path {

std::vector<Quantity> StopQuantities(const TraceRequest& request, const SceneIndex& index) {
  std::vector<Quantity> quantities;
  quantities.reserve(request.options.stop.size());
  for (const StopCriterion& criterion : request.options.stop)
    quantities.push_back(FindQuantity(criterion.quantity, index).value());
  return quantities;
}

namespace {

const Resultant& ResultantOf(const Quantity& quantity, const Increment& increment) {
  return (quantity.of_boundary ? increment.boundaries : increment.supports)[quantity.part];
}

}  // namespace

double ValueOf(const Quantity& quantity, const Increment& increment) {
  switch (quantity.kind) {
    case Quantity::Kind::kLoadFactor: return increment.load_factor;
    case Quantity::Kind::kX: return increment.positions[2 * quantity.part];
    case Quantity::Kind::kY: return increment.positions[2 * quantity.part + 1];
    case Quantity::Kind::kRotation: return increment.rotations[quantity.part];
    case Quantity::Kind::kGap: return increment.contacts[quantity.part].gap;
    case Quantity::Kind::kRn: return increment.contacts[quantity.part].rn;
    case Quantity::Kind::kRt: return increment.contacts[quantity.part].rt;
    case Quantity::Kind::kForceX: return ResultantOf(quantity, increment).rx;
    case Quantity::Kind::kForceY: return ResultantOf(quantity, increment).ry;
    case Quantity::Kind::kMoment: return ResultantOf(quantity, increment).rm;
  }
  return 0.0;
}

StopTest::StopTest(const TraceRequest& request, const SceneIndex& index) {
  const Scaling scaling = ProgramScales(request, index);
  const std::vector<Quantity> quantities = StopQuantities(request, index);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const double unit = SizeOf(UnitOf(quantities[i].kind), {scaling.length, scaling.force, scaling.load_factor});
    items_.push_back({&request.options.stop[i], quantities[i], tolerances::kStopMargin * unit});
  }
}

const StopCriterion* StopTest::FirstThatHolds(const Increment& increment) const {
  if (increment.index == 0) return nullptr;
  for (const Item& item : items_) {
    const double value = ValueOf(item.quantity, increment);
    const StopCriterion& criterion = *item.criterion;
    const double beyond = criterion.when == ">" ? value - criterion.value : criterion.value - value;
    // Where a coordinate is large, its last digit is larger than rounding of the scaled one.
    const double digit = tolerances::kLastDigits * std::max(std::abs(value), std::abs(criterion.value));
    if (beyond > std::max(item.rounding, digit)) return &criterion;
  }
  return nullptr;
}

std::string ToText(const StopCriterion& criterion) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::digits10);
  text << criterion.quantity << " " << criterion.when << " " << criterion.value;
  return text.str();
}

}  // namespace contact_path
