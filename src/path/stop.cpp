#include "contact_path/path/stop.h"

#include <sstream>
#include <string_view>
#include <unordered_map>

#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"

namespace contact_path {
namespace {

constexpr double kRounding = 1e-14;  // scaled

}  // namespace

std::vector<StopQuantity> StopQuantity::Of(const TraceRequest& request) {
  std::vector<StopQuantity> quantities(request.options.stop.size());
  if (quantities.empty()) return quantities;
  std::unordered_map<std::string_view, int> nodes;
  for (const Node& node : request.scene.nodes) nodes.emplace(node.name, static_cast<int>(nodes.size()));
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const std::string_view name = request.options.stop[i].quantity;
    if (name == "load_factor") continue;
    quantities[i].component_ = 2 * nodes.at(name.substr(0, name.size() - 2)) + (name.back() == 'y' ? 1 : 0);
  }
  return quantities;
}

double StopQuantity::Value(const Increment& increment) const {
  return IsLoadFactor() ? increment.load_factor : increment.positions[static_cast<std::size_t>(component_)];
}

StopTest::StopTest(const TraceRequest& request) {
  const Scaling scaling = ProgramScales(request);
  const std::vector<StopQuantity> quantities = StopQuantity::Of(request);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const double unit = quantities[i].IsLoadFactor() ? scaling.load_factor : scaling.length;
    items_.push_back({&request.options.stop[i], quantities[i], kRounding * unit});
  }
}

const StopCriterion* StopTest::FirstThatHolds(const Increment& increment) const {
  if (increment.index == 0) return nullptr;
  for (const Item& item : items_) {
    const double value = item.quantity.Value(increment);
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
