#include "contact_path/path/stop.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contact_path/scene/change_units.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/text.h"
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
  switch (quantity.of) {
    case Quantity::Of::kSupport: return increment.supports[quantity.part];
    case Quantity::Of::kBoundary: return increment.boundaries[quantity.part];
    case Quantity::Of::kPin: break;
  }
  return increment.pins[quantity.part];
}

}  // namespace

double ValueOf(const Quantity& quantity, const Increment& increment) {
  switch (quantity.kind) {
    case Quantity::Kind::kLoadFactor: return increment.load_factor;
    case Quantity::Kind::kSetting: return increment.setting;
    case Quantity::Kind::kObstacleX:
    case Quantity::Kind::kObstacleY:
    case Quantity::Kind::kTurn: break;
    case Quantity::Kind::kX: return increment.positions[2 * quantity.part];
    case Quantity::Kind::kY: return increment.positions[2 * quantity.part + 1];
    case Quantity::Kind::kRotation: return increment.rotations[quantity.part];
    case Quantity::Kind::kGap: return increment.contacts[quantity.part].gap;
    case Quantity::Kind::kRn: return increment.contacts[quantity.part].rn;
    case Quantity::Kind::kRt: return increment.contacts[quantity.part].rt;
    case Quantity::Kind::kPressure: return increment.pressures[quantity.part].pressure;
    case Quantity::Kind::kTraction: return increment.pressures[quantity.part].traction;
    case Quantity::Kind::kWidth: return increment.widths[quantity.part];
    case Quantity::Kind::kForceX: return ResultantOf(quantity, increment).rx;
    case Quantity::Kind::kForceY: return ResultantOf(quantity, increment).ry;
    case Quantity::Kind::kMoment: return ResultantOf(quantity, increment).rm;
    case Quantity::Kind::kN: return increment.sections[quantity.part].N;
    case Quantity::Kind::kQ: return increment.sections[quantity.part].Q;
    case Quantity::Kind::kM: return increment.sections[quantity.part].M;
    case Quantity::Kind::kM1: return increment.sections[quantity.part].M1;
    case Quantity::Kind::kM2: return increment.sections[quantity.part].M2;
    case Quantity::Kind::kSxx: return increment.stresses[quantity.part].sxx;
    case Quantity::Kind::kSyy: return increment.stresses[quantity.part].syy;
    case Quantity::Kind::kSxy: return increment.stresses[quantity.part].sxy;
    case Quantity::Kind::kSzz: return increment.stresses[quantity.part].szz;
    case Quantity::Kind::kMises: return increment.stresses[quantity.part].mises;
    case Quantity::Kind::kEnergy: return increment.stresses[quantity.part].energy;
  }
  return 0.0;
}

double ValueOf(const Quantity& quantity, const Increment& increment, const TraceRequest& request) {
  if (!quantity.IsOfObstacle()) return ValueOf(quantity, increment);
  const ObstaclePlace place =
      PlaceOf(request, request.scene.obstacles[quantity.part],
              static_cast<std::size_t>(std::max(increment.stage, 1) - 1), increment.load_factor);
  if (quantity.kind == Quantity::Kind::kTurn) return place.turn;
  return quantity.kind == Quantity::Kind::kObstacleX ? place.x : place.y;
}

StopTest::StopTest(const TraceRequest& request, const SceneIndex& index) : request_(request) {
  const Scaling scaling = ProgramScales(request, index);
  const std::vector<Quantity> quantities = StopQuantities(request, index);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const double unit = SizeOf(UnitOf(quantities[i].kind), {scaling.length, scaling.force, scaling.load_factor});
    const StopCriterion& criterion = request.options.stop[i];
    const bool located = request.options.LocatesEvents() && criterion.exact == DefaultTrue::kTrue;
    items_.push_back(
        {&criterion, quantities[i], unit, (located ? tolerances::kEqual : tolerances::kRounding) * unit, located});
  }
}

StopTest::Item::Beyond StopTest::Item::BeyondIn(const Increment& increment, const TraceRequest& request) const {
  const double value = ValueOf(quantity, increment, request);
  // Where a coordinate is large, its last digit is larger than rounding of the scaled one.
  const double digits =
      (located ? tolerances::kEqual : tolerances::kLastDigits) * std::max(std::abs(value), std::abs(criterion->value));
  return {criterion->when == ">" ? value - criterion->value : criterion->value - value, std::max(rounding, digits)};
}

void StopTest::Note(const Increment& increment) {
  for (Item& item : items_) {
    const Item::Beyond beyond = item.BeyondIn(increment, request_);
    item.short_of_it = item.short_of_it || beyond.by < -beyond.rounding;
  }
}

const StopCriterion* StopTest::FirstThatHolds(const Increment& increment, const std::vector<int>& at_criteria) const {
  if (increment.index == 0) return nullptr;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const Item::Beyond beyond = item.BeyondIn(increment, request_);
    const bool is_at = std::find(at_criteria.begin(), at_criteria.end(), static_cast<int>(i)) != at_criteria.end();
    if (beyond.by > beyond.rounding || (item.located && item.short_of_it && (is_at || beyond.by >= -beyond.rounding)))
      return item.criterion;
  }
  return nullptr;
}

bool StopTest::MayHold(const Increment& increment, double force_rounding) const {
  return std::any_of(items_.begin(), items_.end(), [&](const Item& item) {
    const Item::Beyond beyond = item.BeyondIn(increment, request_);
    const double error = std::max(beyond.rounding, force_rounding * item.unit);
    return beyond.by > beyond.rounding || (item.located && beyond.by >= -error);
  });
}

std::string ToText(const StopCriterion& criterion) {
  return criterion.quantity + " " + criterion.when + " " +
         RoundedText(criterion.value, std::numeric_limits<double>::digits10);
}

}  // namespace contact_path
