#include "contact_path/path/stop.h"

#include <algorithm>
#include <sstream>

#include "contact_path/scene/scaling.h"

namespace contact_path {
namespace {

constexpr double kRounding = 1e-14;  // scaled

}  // namespace

StopQuantity::StopQuantity(const Scene& scene, const std::string& name) {
  if (name == "load_factor") return;
  const std::size_t dot = name.rfind('.');
  const auto node = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const Node& other) { return name.compare(0, dot, other.name) == 0; });
  component_ = 2 * static_cast<int>(node - scene.nodes.begin()) + (name.back() == 'y' ? 1 : 0);
}

double StopQuantity::Value(const Increment& row) const {
  return IsLoadFactor() ? row.load_factor : row.positions[static_cast<std::size_t>(component_)];
}

StopTest::StopTest(const TraceRequest& request) {
  const Scaling scaling = CharacteristicScales(request.scene);
  for (const StopCriterion& criterion : request.options.stop) {
    const StopQuantity quantity(request.scene, criterion.quantity);
    items_.push_back(
        {&criterion, quantity, kRounding * (quantity.IsLoadFactor() ? scaling.load_factor : scaling.length)});
  }
}

const StopCriterion* StopTest::FirstThatHolds(const Increment& row) const {
  if (row.index == 0) return nullptr;
  for (const Item& item : items_) {
    const double value = item.quantity.Value(row);
    const StopCriterion& criterion = *item.criterion;
    const double beyond = criterion.when == ">" ? value - criterion.value : criterion.value - value;
    if (beyond > item.rounding) return &criterion;
  }
  return nullptr;
}

std::string ToText(const StopCriterion& criterion) {
  std::ostringstream text;
  text << criterion.quantity << " " << criterion.when << " " << criterion.value;
  return text.str();
}

}  // namespace contact_path
