#include "contact_path/path/path_summary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contact_path/path/end.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/text.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr std::size_t kPointsListed = 10;

std::string Counted(int count, const char* what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

std::string PointsText(const std::vector<CriticalPoint>& points, double load_scale) {
  std::vector<std::string> texts;
  texts.reserve(points.size());
  for (const CriticalPoint& point : points)
    texts.push_back(std::string(ToString(point.kind)) + " at load factor " +
                    LoadFactorText(point.load_factor, load_scale) + " (increment " + std::to_string(point.index) + ')');
  return Listed(texts, kPointsListed);
}

}  // namespace

std::string LoadFactorText(double load_factor, double scale) {
  if (std::abs(load_factor) <= tolerances::kRounding * scale) return "0";
  return RoundedText(load_factor, 10);
}

void PathSummary::Add(const Increment& increment) {
  ++increments_;
  if (increment.event.number > 0 || increment.kind == IncrementKind::kContactEvent ||
      increment.kind == IncrementKind::kCornerLimit)
    ++events_;
  if (increment.kind == IncrementKind::kJump) ++jumps_;
  const CriticalPoint point = {increment.index, increment.stage, increment.kind, increment.load_factor};
  if (increment.kind == IncrementKind::kSmoothLimit || increment.kind == IncrementKind::kCornerLimit)
    limit_points_.push_back(point);
  if (increment.kind == IncrementKind::kBifurcation || !increment.event.null_vector.empty())
    crossings_.push_back(point);
}

std::string PathSummary::ToText() const {
  std::string text = Counted(increments_, "increment") + "; limit points: ";
  text += limit_points_.empty() ? "none" : PointsText(limit_points_, load_scale_);
  if (!crossings_.empty()) text += "; another path crosses: " + PointsText(crossings_, load_scale_);
  text += "; " + Counted(events_, "event");
  return jumps_ > 0 ? text + ", " + Counted(jumps_, "jump") : text;
}

std::string PathSummary::ToText(std::string_view reason, const std::string& message) const {
  return (reason.empty() ? "" : std::string(reason) + ": ") + message + "; " + ToText();
}

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
