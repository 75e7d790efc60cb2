#include "contact_path/path/earlier_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "contact_path/branch/mode_arc.h"
#include "contact_path/iterations.h"
#include "contact_path/path/increment_lists.h"
#include "contact_path/path/model.h"
#include "contact_path/path/recorder.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// The increments of one stage.
class Restorer {
 public:
  // along_arc: arc lengths are those of arcs, and not of chords. lists: that increments are to have.
  Restorer(const Model& model, bool along_arc, const LongLists& lists)
      : model_(model), along_arc_(along_arc), lists_(lists), arc_(model.structure, model.laws) {}

  // Finds the state of the increment at `at`, the one before having its own; false: it is not found.
  bool Restore(std::vector<Increment>* increments, std::size_t at) {
    Increment& wanted = (*increments)[at];
    const Increment& before = (*increments)[at - 1];
    if (before.stage != wanted.stage || before.positions.empty() || !wanted.solve.exact) return false;
    const PathPoint from = model_.FromIncrement(before);
    const std::optional<Eigen::VectorXd> towards = Towards(*increments, at, from);
    if (!towards) return false;
    const bool parts = before.event.taken >= 1 && before.event.taken <= static_cast<int>(before.event.branches.size());
    PathPoint begin = from;
    if (parts) {
      const std::vector<ContactState>& states =
          before.event.branches[static_cast<std::size_t>(before.event.taken) - 1].states;
      for (std::size_t i = 0; i < states.size(); ++i) begin.modes[i].state = NumberOf(states[i]);
    }
    // Increments by Ipopt do not say with which states they set out.
    if (!parts && before.kind == IncrementKind::kStart) {
      const Increment* const next = NextWithState(*increments, at);
      if (next == nullptr) return false;
      TakeStates(model_.FromIncrement(*next).modes, &begin);
    }
    // The states of bars are on record in every increment.
    for (std::size_t k = 0; k < wanted.bars.size(); ++k)
      begin.modes[model_.LawOfBar(k)].state = NumberOf(wanted.bars[k]);
    arc_.SetModes(begin);
    CurvePoint start;
    if (!arc_.Derivatives(arc_.system().Pack(from), *towards, &start)) return false;
    const std::optional<PathPoint> point = PointAfter(start, from, wanted.arc_length - before.arc_length);
    const double load = wanted.load_factor / model_.scaling.load_factor;
    if (!point || !(std::abs(point->s - load) <= tolerances::kSamePoint * (1.0 + std::abs(load)))) return false;
    const double recorded = wanted.load_factor;
    FillState(model_, *point, &wanted);
    wanted.load_factor = recorded;
    FillLists(model_, *point, lists_, &wanted);
    return true;
  }

 private:
  // A direction on the side to which the path goes: as it came, or from an event, where it may turn, the sense of the
  // load, or, where that rests, to the next increment that has its state.
  std::optional<Eigen::VectorXd> Towards(const std::vector<Increment>& increments, std::size_t at,
                                         const PathPoint& from) const {
    const Increment& before = increments[at - 1];
    if (before.event.branches.empty() && at >= 2 && increments[at - 2].stage == before.stage)
      return Chord(model_.FromIncrement(increments[at - 2]), from);
    const double change = (increments[at].load_factor - before.load_factor) / model_.scaling.load_factor;
    if (std::abs(change) > tolerances::kSmallShare * (increments[at].arc_length - before.arc_length))
      return Eigen::VectorXd(change * Eigen::VectorXd::Unit(from.u.size() + 1, from.u.size()));
    const Increment* const next = NextWithState(increments, at);
    if (next == nullptr) return std::nullopt;
    return Chord(from, model_.FromIncrement(*next));
  }

  // Of the same stage, from `at` on; null: there is none.
  static const Increment* NextWithState(const std::vector<Increment>& increments, std::size_t at) {
    for (std::size_t i = at; i < increments.size() && increments[i].stage == increments[at].stage; ++i)
      if (!increments[i].positions.empty()) return &increments[i];
    return nullptr;
  }

  // At this length of the arc, or of the chord.
  std::optional<PathPoint> PointAfter(const CurvePoint& start, const PathPoint& from, double length) {
    if (!(length > 0.0)) return std::nullopt;
    const Eigen::VectorXd normal = start.first.head(arc_.NumMotion());
    arc_.SetOut(start);
    double t = length, last_error = std::numeric_limits<double>::infinity();
    std::optional<PathPoint> point;
    for (int i = 0; i < kMostIterations; ++i) {
      const Correction correction = arc_.CorrectOnPlane(start.x + t * start.first + 0.5 * t * t * start.second, normal);
      CurvePoint end;
      if (!correction.converged || !arc_.Derivatives(correction.x, normal, &end)) return std::nullopt;
      point = arc_.system().Unpack(end.x);
      const double reached = along_arc_ ? MakeStep(start, end, arc_.NumMotion()).ArcLength() : Distance(from, *point);
      const double error = std::abs(reached - length);
      if (error <= tolerances::kEqual * length || error >= last_error) return point;
      last_error = error;
      t += length - reached;
    }
    return point;
  }

  const Model& model_;
  const bool along_arc_;
  const LongLists lists_;
  ModeArc arc_;
};

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

std::size_t RestoreStates(const TraceRequest& request, std::vector<Increment>* increments) {
  const SceneIndex index(request.scene);
  const Scaling of_program = ProgramScales(request, index);
  std::unique_ptr<const Model> model;
  std::unique_ptr<Restorer> restorer;
  int stage = -1;
  for (std::size_t i = 0; i < increments->size(); ++i) {
    const Increment& increment = (*increments)[i];
    if (!increment.positions.empty()) continue;
    if (i == 0) return 0;
    if (increment.stage != stage) {
      stage = increment.stage;
      const auto number = static_cast<std::size_t>(std::max(stage, 1) - 1);
      restorer.reset();
      model = std::make_unique<const Model>(StageScene(request, number), StageConfiguration(request, number),
                                            StageScales(request, index, number, of_program));
      restorer = std::make_unique<Restorer>(*model, request.options.LocatesEvents(), LongLists::Of(request, index));
    }
    if (!restorer->Restore(increments, i)) return i;
  }
  return increments->size();
}

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
