#include "contact_path/path/trace.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <new>
#include <utility>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/linear/blas.h"
#include "contact_path/linear/linear_solver_error.h"
#include "contact_path/path/branch_method.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/path/earlier_trace.h"
#include "contact_path/path/machine_limit.h"
#include "contact_path/path/preload.h"
#include "contact_path/path/recorder.h"
#include "contact_path/path/sentences.h"
#include "contact_path/path/stop.h"
#include "contact_path/path/trace_end.h"
#include "contact_path/path/watched_quantities.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/validate.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

// A request on its way: one stage after another.
class Tracer {
 public:
  // request: sound and expanded.
  Tracer(const TraceRequest& request, const TraceControl& control)
      : request_(request),
        control_(control),
        index_(request.scene),
        scales_(ProgramScales(request, index_)),
        recorder_(request.options.method, ListsOf(request, control),
                  request.options.at_limit == AtLimit::kFollow && DrivesForward(request.scene), Receiver()),
        stop_(request, index_) {}

  // An increment of an earlier trace that is kept.
  void Repeat(const Increment& increment) {
    recorder_.Repeat(increment);
    if (!increment.positions.empty()) stop_.Note(increment);
  }

  // resumption: where to go on after the increments of an earlier trace, which were repeated; nothing: from the start.
  TraceResult Run(const std::optional<Resumption>& resumption) {
    const OneBlasThread one_thread;
    const auto last = [this] { return recorder_.increments() - 1; };
    try {
      TraceStages(resumption);
    } catch (const std::bad_alloc&) {
      if (handing_out_) throw;  // of the caller
      EndBy(EndReason::kMemoryLimit, {last() < 0 ? sentences::kNoMemoryAtStart : sentences::kNoMemory, {}, last()});
    } catch (const LinearSolverError& error) {
      EndBy(EndReason::kNumericalFailure,
            {last() < 0 ? sentences::kNoSolutionAtStart : sentences::kNoSolution, error.what(), last()});
    }
    if (model_ != nullptr) NameInvertedElement(*model_, point_, &end_);
    Append(RemarksAtEnd({request_, index_, model_.get(), point_, end_.reason, recorder_, remarks_,
                         largest_reaction_.of_trace, largest_load_, events_}),
           &end_.causes);
    return {end_.reason, EndText(end_.causes), recorder_.increments(), IsReached(end_.reason, request_)};
  }

 private:
  LongLists ListsOf(const TraceRequest& request, const TraceControl& control) const {
    LongLists lists = LongLists::Of(request, index_);
    lists.Add(control.lists);
    return lists;
  }

  // What takes the increments, so that its failures can be told from those of the trace.
  std::function<void(const Increment&)> Receiver() {
    if (!control_.on_increment) return nullptr;
    return [this](const Increment& increment) {
      handing_out_ = true;
      control_.on_increment(increment);
      handing_out_ = false;
    };
  }

  void TraceStages(const std::optional<Resumption>& resumption) {
    const std::size_t first = resumption ? static_cast<std::size_t>(std::max(resumption->from->stage, 1) - 1) : 0;
    for (stage_ = first; stage_ < NumStages(request_); ++stage_) {
      const Clock::time_point start = Clock::now();
      auto next = std::make_unique<const Model>(StageScene(request_, index_, stage_),
                                                StageConfiguration(request_, index_, stage_),
                                                StageScales(request_, index_, stage_, scales_));
      const bool resumes = resumption && stage_ == first;
      if (stage_ > first && request_.options.max_increments > 0 && HasAllIncrements()) {
        EndBy(EndReason::kMaxIncrements, {sentences::kMaxIncrements});
        return;
      }
      if (stage_ > first) {
        point_ = next->Transfer(*model_, point_);
      } else if (resumes) {
        point_ = next->FromIncrement(*resumption->from);
      } else {
        Preload preload = TraceStart(*next, request_.options.accuracy, control_.cancelled);
        if (!preload.done) {
          EndWith(std::move(preload.end));
          return;
        }
        point_ = std::move(preload.point);
      }
      model_ = std::move(next);
      setting_.emplace(*model_, request_.options.machine_stiffness);
      setting_->Begin(point_, resumes ? resumption->from->setting : 0.0);
      target_.reset();
      if (!request_.program.empty()) target_ = request_.program[stage_].Target() / model_->scaling.load_factor;
      largest_reaction_.of_stage = 0.0;
      returns_.emplace(*model_, std::max(request_.options.full_state_every, 1), largest_reaction_);
      if (!(resumes ? ResumeStage(*resumption) : TraceStage(start))) return;
    }
  }

  // Sets what ends the trace; false, for the callers to return.
  bool EndWith(End end) {
    end_ = std::move(end);
    return false;
  }
  bool EndBy(EndReason reason, Cause cause) { return EndWith({reason, {std::move(cause)}}); }

  // scene: of a stage.
  bool DrivesForward(const Scene& scene) const {
    return request_.options.DrivesForward(IsDriven(scene) || !request_.program.empty());
  }

  // increment: index of the one to set out from.
  std::unique_ptr<PathMethod> MakeMethod(int increment) {
    TraceOptions options = request_.options;
    if (target_) options.direction = *target_ < 0.0 ? -1.0 : 1.0;
    if (options.method == Method::kMpec) return control_.mpec({*model_, options, target_, &*returns_, control_});
    BranchOptions branch = BranchOptions::For(options, AutomaticStepGrowth(*model_));
    branch.load_factor = target_;
    branch.watch = [this](const FixedModeSystem& system) {
      return WatchedQuantities(*model_, request_, stage_, *setting_, system);
    };
    branch.increments = increment;
    branch.events = events_;
    branch.on_trial = control_.on_trial;
    branch.returns = &*returns_;
    branch.largest_reaction = &largest_reaction_;
    branch.forward = DrivesForward(model_->scene);
    return std::make_unique<BranchMethod>(*model_, branch, control_.cancelled);
  }

  // From its first increment until its target. False: the trace has ended.
  bool TraceStage(Clock::time_point start) {
    const Residuals residuals = model_->Check(point_, point_);
    if (!(residuals.Largest() <= tolerances::kAccepted))
      return EndBy(EndReason::kNumericalFailure, {sentences::kStartNoEquilibrium});
    // Where events are located, reactions are measured by the force unit of the contact; where loads drive the path,
    // the load factor is as small as the reactions, though.
    const bool measured = request_.options.LocatesEvents() && model_->structure.Loads().Reference().isZero(0.0);
    const double softest = measured ? tolerances::kDependentColumn : tolerances::kRootOfRounding;
    if (Causes soft = ContactTooSoft(*model_, point_, softest); !soft.empty())
      return EndWith({EndReason::kNotDetermined, std::move(soft)});
    const std::unique_ptr<PathMethod> method = MakeMethod(recorder_.increments());
    AcceptedPoint first;
    first.point = point_;
    first.residuals = residuals;
    std::optional<End> not_started = method->Start(point_, &first);
    recorder_.Start(*model_, request_.program.empty() ? 0 : static_cast<int>(stage_) + 1, std::move(first),
                    Seconds(Clock::now() - start));
    stop_.Note(recorder_.increment());
    return not_started ? EndWith(*std::move(not_started)) : FollowStage(method.get());
  }

  // The same from an increment inside.
  bool ResumeStage(const Resumption& resumption) {
    const Residuals residuals = model_->Check(point_, point_);
    if (!(residuals.Largest() <=
          (resumption.from->solve.exact ? tolerances::kAccepted : tolerances::kAcceptedRegularised)))
      return EndBy(EndReason::kNumericalFailure, {sentences::kResumeNoEquilibrium});
    events_ = resumption.events;
    Remember(resumption);
    const PathPoint before = model_->FromIncrement(*resumption.before);
    may_snap_ = MaySnap(resumption.from->stability, request_.options.method == Method::kBranch);
    if (const std::optional<bool> ended = EndHere(before, {})) return *ended && EndStage();
    const std::unique_ptr<PathMethod> method = MakeMethod(recorder_.increments() - 1);
    if (!method->Resume({before, point_, resumption.from->solve}))
      return EndBy(EndReason::kNumericalFailure, {sentences::kResumeLost});
    return FollowStage(method.get());
  }

  // The increments up to the one to go on from.
  void Remember(const Resumption& resumption) {
    std::optional<PathPoint> before;
    for (const Increment& increment : *resumption.increments) {
      if (increment.index > resumption.from->index) break;
      if (increment.positions.empty()) continue;
      PathPoint point = model_->FromIncrement(increment);
      if (increment.stage != resumption.from->stage) {
        largest_reaction_.of_trace = std::max(largest_reaction_.of_trace, model_->laws.LargestForce(point));
        continue;
      }
      NotePoint(point);
      if (before) returns_->Add(increment.index, *before, point);
      before = std::move(point);
    }
  }

  void NotePoint(const PathPoint& point) {
    largest_load_ = std::max(largest_load_, std::abs(point.s));
    largest_reaction_.Note(model_->laws, point);
  }

  bool FollowStage(PathMethod* method) {
    NotePoint(point_);
    const bool goes_on = Follow(method);
    events_ = method->NumEvents();
    Append(method->Remarks(), &remarks_);
    return goes_on && EndStage();
  }

  // otherwise: where the number of unstable directions is not known.
  static bool MaySnap(const StabilityRecord& stability, bool otherwise) {
    return stability.unstable_directions < 0 ? otherwise : stability.unstable_directions > 0;
  }

  bool HasAllIncrements() const {
    return recorder_.increment().index >= request_.options.LastIncrement(recorder_.first_of_stage());
  }

  // At its target. False: it was the last one.
  bool EndStage() {
    if (stage_ + 1 < NumStages(request_)) return true;
    return EndBy(EndReason::kStopCriterion, {sentences::kProgramDone});
  }

  // Until the target, or something ends the trace: then false.
  bool Follow(PathMethod* method) {
    for (;;) {
      if (control_.cancelled && control_.cancelled()) return EndBy(EndReason::kCancelled, {sentences::kCancelled});
      if (HasAllIncrements()) return EndBy(EndReason::kMaxIncrements, {sentences::kMaxIncrements});
      const Clock::time_point start = Clock::now();
      Advance advance = method->Next(point_);
      const double time = Seconds(Clock::now() - start);
      if (advance.increment)
        if (const std::optional<bool> goes_on = Take(&*advance.increment, time)) return *goes_on;
      if (advance.end && !HasAllIncrements()) return EndWith(*std::move(advance.end));
    }
  }

  // Records the increment. Nothing: the path goes on; otherwise whether the stage was followed to its target.
  std::optional<bool> Take(AcceptedPoint* increment, double time) {
    NotePoint(increment->point);
    if (std::optional<End> pulls = PullingContact(*model_, increment->point, largest_reaction_.of_trace))
      return EndWith(*std::move(pulls));
    const bool jumped = increment->kind == IncrementKind::kJump;
    if (Causes overrun = jumped ? Causes() : OverrunContact(*model_, point_, increment->point); !overrun.empty())
      return EndWith({EndReason::kNumericalFailure, std::move(overrun)});
    increment->setting = setting_->At(increment->point.u, increment->point.s);
    recorder_.Append(*model_, *increment, time);
    may_snap_ = MaySnap(increment->stability, increment->stiffness_sign < 0);
    if (!jumped) returns_->Add(recorder_.increment().index, point_, increment->point);
    const PathPoint before = std::exchange(point_, std::move(increment->point));
    return EndHere(before, increment->at_criteria);
  }

  // Whether the path ends in the last increment, or its stage does: nothing, or as Take(). at_criteria: as of the
  // increment.
  std::optional<bool> EndHere(const PathPoint& before, const std::vector<int>& at_criteria) {
    if (const StopCriterion* criterion = stop_.FirstThatHolds(recorder_.increment(), at_criteria))
      return EndBy(EndReason::kStopCriterion, {sentences::kStopCriterion, ToText(*criterion)});
    stop_.Note(recorder_.increment());
    if (target_ && IsAtTarget(point_.s, *target_)) return true;
    std::optional<Cause> end = EndOfScene(*model_, point_);
    // A stop criterion may yet be met.
    if (!end && request_.options.stop.empty() && largest_reaction_.of_trace > 0.0)
      end = Escape(*model_, before, point_, target_, largest_load_, may_snap_);
    if (end) return EndBy(EndReason::kPathEnd, *end);
    return std::nullopt;
  }

  const TraceRequest& request_;
  const TraceControl& control_;
  const SceneIndex index_;  // of all stages
  const Scaling scales_;    // of the program
  Recorder recorder_;
  StopTest stop_;
  PathPoint point_;
  bool may_snap_ = false;  // the last increment has, or may have, an unstable direction under dead loads
  int events_ = 0;
  std::size_t stage_ = 0;                  // from 0
  std::unique_ptr<const Model> model_;     // of the stage
  std::optional<double> target_;           // scaled load factor at which the stage ends; nothing without a program
  std::optional<MachineSetting> setting_;  // of the stage
  std::optional<ReturnDetector> returns_;  // of the stage
  bool handing_out_ = false;               // an increment, to the caller
  LargestReactionSoFar largest_reaction_;
  double largest_load_ = 0.0;  // so far, scaled
  End end_;
  Causes remarks_;
};

void RequireSound(const TraceRequest& request, const TraceControl& control) {
  std::vector<Violation> violations = Validate(request);
  if (request.options.method == Method::kMpec && !control.mpec)
    violations.push_back(
        {"options.method", "mpec", "needs the library contact_path_mpec, which this program lacks", "", 0});
  if (!violations.empty()) throw InvalidRequest(std::move(violations));
}

}  // namespace

TraceResult Trace(const TraceRequest& request, const TraceControl& control) {
  RequireSound(request, control);
  const ExpandedRequest expanded(request);
  return Tracer(expanded.Get(), control).Run(std::nullopt);
}

TraceResult ResumeTrace(const TraceRequest& request_as_given, const std::vector<Increment>& increments,
                        const TraceControl& control) {
  RequireSound(request_as_given, control);
  const ExpandedRequest expanded(request_as_given);
  const TraceRequest& request = expanded.Get();
  RequireIncrementsOf(request, increments);
  const std::optional<Resumption> resumption = FindResumption(increments);
  Tracer tracer(request, control);
  if (resumption)
    for (int i = 0; i <= resumption->from->index; ++i) tracer.Repeat(increments[static_cast<std::size_t>(i)]);
  return tracer.Run(resumption);
}

}  // namespace contact_path
