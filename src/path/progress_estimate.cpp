#include "contact_path/path/progress_estimate.h"

#include <algorithm>
#include <string>

namespace contact_path {

ProgressEstimate::ProgressEstimate(const TraceRequest& request) : max_increments_(request.options.max_increments) {
  for (const StopCriterion& stop : request.options.stop) {
    Goal goal;
    goal.end = stop.value;
    goal.of_load_factor = stop.quantity == "load_factor";
    if (!goal.of_load_factor) {
      const std::size_t dot = stop.quantity.rfind('.');
      const auto& nodes = request.scene.nodes;
      const auto node = std::find_if(nodes.begin(), nodes.end(), [&](const Node& candidate) {
        return stop.quantity.compare(0, dot, candidate.name) == 0;
      });
      goal.component = 2 * static_cast<std::size_t>(node - nodes.begin()) + (stop.quantity.back() == 'y' ? 1 : 0);
    }
    goals_.push_back(goal);
  }
}

double ProgressEstimate::Goal::Value(const Increment& row) const {
  return of_load_factor ? row.load_factor : row.positions[component];
}

double ProgressEstimate::Add(const Increment& row) {
  double done = max_increments_ > 0 ? static_cast<double>(row.index) / max_increments_ : 0.0;
  for (Goal& goal : goals_) {
    if (row.index == 0) goal.start = goal.Value(row);
    if (goal.end != goal.start) done = std::max(done, (goal.Value(row) - goal.start) / (goal.end - goal.start));
  }
  return std::min(done, 1.0);
}

}  // namespace contact_path
