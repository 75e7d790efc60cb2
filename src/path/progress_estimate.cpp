#include "contact_path/path/progress_estimate.h"

#include <algorithm>

#include "contact_path/scene/expand.h"

namespace contact_path {

ProgressEstimate::ProgressEstimate(const TraceRequest& request) : max_increments_(request.options.max_increments) {
  const ExpandedRequest expanded(request);
  const std::vector<Quantity> quantities = StopQuantities(request, SceneIndex(expanded.Get().scene));
  for (std::size_t i = 0; i < quantities.size(); ++i)
    goals_.push_back({quantities[i], 0.0, request.options.stop[i].value});
  if (std::any_of(quantities.begin(), quantities.end(), [](const Quantity& of) { return of.IsOfObstacle(); }))
    request_ = request;
  for (const Stage& stage : request.program) targets_.push_back(stage.Target());
}

double ProgressEstimate::Add(const Increment& increment) {
  double done = max_increments_ > 0 ? static_cast<double>(increment.index) / max_increments_ : 0.0;
  if (increment.stage > 0) {
    const auto stage = static_cast<std::size_t>(increment.stage - 1);
    const double share = std::clamp(increment.load_factor / targets_[stage], 0.0, 1.0);
    done = std::max(done, (static_cast<double>(stage) + share) / static_cast<double>(targets_.size()));
  }
  for (Goal& goal : goals_) {
    // Increments that were recorded without their state have no positions.
    if (goal.quantity.kind != Quantity::Kind::kLoadFactor && increment.positions.empty()) continue;
    if (increment.index == 0) goal.start = ValueOf(goal.quantity, increment, request_);
    if (goal.end != goal.start)
      done = std::max(done, (ValueOf(goal.quantity, increment, request_) - goal.start) / (goal.end - goal.start));
  }
  return std::min(done, 1.0);
}

}  // namespace contact_path
