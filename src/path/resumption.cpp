#include "contact_path/path/resumption.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "contact_path/path/increment_lists.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {
namespace {

// mpec measures the direction and the bend of the path from the increment before.
bool CanGoOnFrom(const Increment& before, const Increment& increment) {
  if (before.stage != increment.stage || !(increment.arc_length > before.arc_length)) return false;
  if (increment.solve.method == Method::kMpec && before.index + 1 != increment.index) return false;
  // Which of the curves that cross there the path goes on along is not what an increment records.
  if (increment.solve.AtSingularPoint()) return false;
  return !increment.positions.empty() && increment.event.number == 0 && increment.event.branches.empty() &&
         increment.solve.next_step > 0.0 &&
         (increment.kind == IncrementKind::kRegular || increment.kind == IncrementKind::kSmoothLimit ||
          increment.kind == IncrementKind::kSample);
}

}  // namespace

std::optional<Resumption> FindResumption(const std::vector<Increment>& increments) {
  std::optional<Resumption> last;
  const Increment* before = nullptr;
  int events = 0;
  // Null directions of the arc before the last event. An arc with more of them, or on which no node moves, may rest,
  // and the direction in which the path moved before such an arc is not on record.
  int nullity = std::numeric_limits<int>::max();
  for (const Increment& increment : increments) {
    events = std::max(events, increment.event.number);
    if (increment.kind == IncrementKind::kStart)
      nullity = std::numeric_limits<int>::max();
    else if (!increment.event.branches.empty())
      nullity = increment.solve.nullity;
    const bool rests =
        before != nullptr && (increment.solve.nullity > nullity ||
                              (increment.positions == before->positions && increment.rotations == before->rotations));
    if (before != nullptr && !rests && CanGoOnFrom(*before, increment))
      last = Resumption{&increments, before, &increment, events};
    if (!increment.positions.empty()) before = &increment;
  }
  return last;
}

void RequireIncrementsOf(const TraceRequest& request, const std::vector<Increment>& increments) {
  const IncrementLists lists(request, SceneIndex(request.scene));
  for (std::size_t i = 0; i < increments.size(); ++i) {
    const Increment& increment = increments[i];
    const auto refuse = [&](const std::string& what) {
      throw std::invalid_argument("increment " + std::to_string(i) + what);
    };
    if (increment.index != static_cast<int>(i)) refuse(" has the index " + std::to_string(increment.index));
    if (!lists.Fit(increment)) refuse(" is not of this scene");
    if (increment.stage < 0 || increment.stage > static_cast<int>(request.program.size()) ||
        (increment.stage == 0) != request.program.empty())
      refuse(" is not of this program");
  }
}

}  // namespace contact_path
