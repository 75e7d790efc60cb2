#include "contact_path/path/stop.h"

#include <sstream>
#include <unordered_map>

#include "contact_path/scene/scaling.h"

namespace contact_path {
namespace {

constexpr double kRounding = 1e-14;  // scaled

}  // namespace

StopTest::StopTest(const TraceRequest& request) {
  std::unordered_map<std::string, int> components = {{"load_factor", kLoadFactor}};
  for (std::size_t i = 0; i < request.scene.nodes.size(); ++i) {
    components.emplace(request.scene.nodes[i].name + ".x", static_cast<int>(2 * i));
    components.emplace(request.scene.nodes[i].name + ".y", static_cast<int>(2 * i + 1));
  }
  const Scaling scaling = CharacteristicScales(request.scene);
  for (const StopCriterion& criterion : request.options.stop) {
    const int component = components.at(criterion.quantity);
    const double scale = component == kLoadFactor ? scaling.load_factor : scaling.length;
    items_.push_back({&criterion, component, kRounding * scale});
  }
}

const StopCriterion* StopTest::FirstThatHolds(const Increment& row) const {
  if (row.index == 0) return nullptr;
  for (const Item& item : items_) {
    const double value =
        item.component == kLoadFactor ? row.load_factor : row.positions[static_cast<std::size_t>(item.component)];
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
