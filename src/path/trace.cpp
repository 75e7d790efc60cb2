#include "contact_path/path/trace.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact_path/branch/active_set_tolerance.h"
#include "contact_path/linear/blas.h"
#include "contact_path/linear/linear_solver_error.h"
#include "contact_path/path/automatic_step.h"
#include "contact_path/path/branch_method.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/path/free_motion.h"
#include "contact_path/path/model.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/path_method.h"
#include "contact_path/path/preload.h"
#include "contact_path/path/recorder.h"
#include "contact_path/path/return_detector.h"
#include "contact_path/path/stop.h"
#include "contact_path/path/watched_quantities.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/validate.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostPreloadIncrements = 100000;  // to bring the constant loads on; not counted with the others

constexpr std::size_t kCriteriaListed = 3;  // in a message

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

// Where an earlier trace can be gone on from.
struct Resumption {
  const std::vector<Increment>* increments = nullptr;  // of the earlier trace
  const Increment* before = nullptr;
  const Increment* from = nullptr;
  int events = 0;  // passed up to there
};

// Whether another path crosses right there: the point and its tangent are then less exact than what an increment
// records. Nullity tells such a point from redundant contacts, which make the equations singular all along an arc.
bool IsSingularPoint(const Increment& increment) {
  return increment.solve.method == Method::kBranch && increment.solve.determinant_sign == 0 &&
         increment.solve.nullity == 0;
}

// mpec measures the direction and the bend of the path from the increment before.
bool CanGoOnFrom(const Increment& before, const Increment& increment) {
  if (before.stage != increment.stage || !(increment.arc_length > before.arc_length)) return false;
  if (increment.solve.method == Method::kMpec && before.index + 1 != increment.index) return false;
  if (IsSingularPoint(increment)) return false;
  return !increment.positions.empty() && increment.event.number == 0 && increment.event.branches.empty() &&
         increment.solve.next_step > 0.0 &&
         (increment.kind == IncrementKind::kRegular || increment.kind == IncrementKind::kSmoothLimit ||
          increment.kind == IncrementKind::kSample);
}

// The last increment that can be; nothing: none can.
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

// A request on its way: one stage after another.
class Tracer {
 public:
  // request: sound and expanded.
  Tracer(const TraceRequest& request, const TraceControl& control)
      : request_(request),
        control_(control),
        index_(request.scene),
        scales_(ProgramScales(request, index_)),
        recorder_(request.options.method, ListsOf(request, control), Receiver()),
        stop_(request, index_) {}

  // An increment of an earlier trace that is kept.
  void Repeat(const Increment& increment) {
    recorder_.Repeat(increment);
    if (!increment.positions.empty()) stop_.Note(increment);
  }

  // resumption: where to go on after the increments of an earlier trace, which were repeated; nothing: from the start.
  TraceResult Run(const std::optional<Resumption>& resumption) {
    const OneBlasThread one_thread;
    try {
      TraceStages(resumption);
    } catch (const std::bad_alloc&) {
      if (handing_out_) throw;  // of the caller
      End(EndReason::kMemoryLimit, "there is not enough memory " + Onwards());
    } catch (const LinearSolverError& error) {
      End(EndReason::kNumericalFailure, std::string(error.what()) + ", " + Onwards());
    }
    if (model_ != nullptr) NameInvertedElement(*model_, point_);
    result_.increments = recorder_.increments();
    if (result_.reason == EndReason::kStepTooSmall || result_.reason == EndReason::kNumericalFailure)
      if (const std::string slender = SlenderBeam(request_.scene, index_); !slender.empty()) remarks_ += "; " + slender;
    if (const std::string locking = LockingSolids(request_.scene, index_); !locking.empty()) remarks_ += "; " + locking;
    result_.message += MissedEnd() + WhatMovesFreely() + recorder_.Remark() + remarks_ + MissedChoices();
    return std::move(result_);
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
    for (std::size_t stage = first; stage < NumStages(request_); ++stage) {
      const Clock::time_point start = Clock::now();
      auto next = std::make_unique<const Model>(StageScene(request_, index_, stage),
                                                StageConfiguration(request_, index_, stage),
                                                StageScales(request_, index_, stage, scales_));
      if (stage > first && recorder_.increments() > request_.options.MaxIncrements()) {
        End(EndReason::kMaxIncrements, "the wanted number of increments was accepted");
        return;
      }
      if (stage > first)
        point_ = next->Transfer(*model_, point_);
      else if (resumption)
        point_ = next->FromIncrement(*resumption->from);
      else if (!Begin(*next))
        return;
      model_ = std::move(next);
      returns_.emplace(*model_, std::max(request_.options.full_state_every, 1));
      if (!(resumption && stage == first ? ResumeStage(*model_, stage, *resumption)
                                         : TraceStage(*model_, stage, start)))
        return;
    }
  }

  // Sets what ends the trace; false, for the callers to return.
  bool End(EndReason reason, std::string message) {
    result_.reason = reason;
    result_.message = std::move(message);
    return false;
  }

  // Where no increment leads on from a point at which an element of a solid has no area left: that is why.
  void NameInvertedElement(const Model& model, const PathPoint& point) {
    if (result_.reason != EndReason::kStepTooSmall && result_.reason != EndReason::kNumericalFailure) return;
    const std::string element = InvertedElement(model.scene, model.index, model.InSceneUnits(point).positions);
    if (element.empty()) return;
    result_.reason = EndReason::kElementInverted;
    result_.message = element + "; " + result_.message;
  }

  // Where the trace was.
  std::string Onwards() const {
    if (recorder_.increments() == 0) return "before increment 0";
    return "after increment " + std::to_string(recorder_.increments() - 1);
  }

  bool EndedBeforeItsEnd() const {
    return result_.reason == EndReason::kMaxIncrements || result_.reason == EndReason::kClosedPath;
  }

  // The end that the user had in mind and the path did not come to.
  std::string MissedEnd() const {
    if (!EndedBeforeItsEnd()) return {};
    if (!request_.program.empty())
      return "; the target of stage " + std::to_string(recorder_.increment().stage) + " of " +
             std::to_string(request_.program.size()) + " was not reached";
    const std::vector<StopCriterion>& stop = request_.options.stop;
    if (stop.empty()) return "; no stop criterion was given";
    std::string text = "; no stop criterion was met (";
    for (std::size_t i = 0; i < std::min(stop.size(), kCriteriaListed); ++i)
      text += (i == 0 ? "" : ", ") + ToText(stop[i]);
    return text + (stop.size() > kCriteriaListed ? ", ...)" : ")");
  }

  // Nodes that nothing holds: where no branch leads on, and where the path wanders about without a load.
  std::string WhatMovesFreely() const {
    if (model_ == nullptr) return {};
    const bool stuck = result_.reason == EndReason::kPathEnd || result_.reason == EndReason::kStepTooSmall;
    const bool wanders = EndedBeforeItsEnd() && std::abs(point_.s) <= tolerances::kUnloaded * largest_load_;
    if (!stuck && !wanders) return {};
    const double force = ActiveSetTolerance::For(largest_reaction_, point_.s).force;
    const std::string text = stuck && recorder_.increments() <= 1 ? FreeMotionQuestion(*model_, point_, force)
                                                                  : FreeMotionText(*model_, point_, force);
    if (text.empty()) return {};
    return (wanders ? "; without a load, " : "; ") + text;
  }

  bool Cancelled() const { return control_.cancelled && control_.cancelled(); }

  // The equilibrium at load factor 0 with the constant loads, before anything moves.
  bool Begin(const Model& model) {
    Scene resting = model.scene;
    resting.support_motions.clear();
    const bool moves = !model.structure.PrescribedDofs().empty();
    const std::unique_ptr<const Model> other =
        moves ? std::make_unique<const Model>(resting, model.configuration, model.scaling) : nullptr;
    const Model& start = moves ? *other : model;
    // The start does not depend on how the path from there is traced, but for the accuracy.
    const MethodFactory make_method = [&](const Model& of, double target) -> std::unique_ptr<PathMethod> {
      TraceOptions upwards;
      upwards.accuracy = request_.options.accuracy;
      BranchOptions options = BranchOptions::For(upwards, AutomaticStepGrowth(of));
      options.ends.load_factor = target;
      options.keep_loading = true;
      return std::make_unique<BranchMethod>(of, options, control_.cancelled);
    };
    Preload preload = TracePreload(start, kMostPreloadIncrements, make_method, control_.cancelled);
    if (!preload.done) {
      const bool stuck = preload.reason == EndReason::kPathEnd || preload.reason == EndReason::kStepTooSmall;
      const double force = ActiveSetTolerance::For(0.0, 0.0).force;
      const std::string free = stuck ? FreeMotionQuestion(start, preload.point, force) : "";
      End(preload.reason == EndReason::kMaxIncrements ? EndReason::kNumericalFailure : preload.reason,
          preload.message + (free.empty() ? "" : "; " + free));
      NameInvertedElement(start, preload.point);
      return false;
    }
    point_ = moves ? model.Transfer(start, preload.point) : std::move(preload.point);
    return true;
  }

  // increment: index of the one to set out from.
  std::unique_ptr<PathMethod> MakeMethod(const Model& model, std::optional<double> target, int increment) {
    TraceOptions options = request_.options;
    if (target) options.direction = *target < 0.0 ? -1.0 : 1.0;
    const double growth = AutomaticStepGrowth(model);
    if (options.LocatesEvents()) {
      BranchOptions branch = BranchOptions::For(options, growth);
      branch.ends = {target, WatchedQuantities(model, request_)};
      branch.increments = increment;
      branch.events = events_;
      branch.method = options.method;
      branch.on_trial = control_.on_trial;
      branch.returns = &*returns_;
      return std::make_unique<BranchMethod>(model, branch, control_.cancelled);
    }
    MpecOptions mpec = MpecOptions::For(options, growth);
    mpec.target = target;
    mpec.on_trial = control_.on_trial;
    mpec.returns = &*returns_;
    return std::make_unique<MpecMethod>(model, mpec, control_.cancelled);
  }

  // The scaled load factor at which a stage ends; nothing without a program.
  std::optional<double> TargetOf(const Model& model, std::size_t stage) const {
    if (request_.program.empty()) return std::nullopt;
    return request_.program[stage].Target() / model.scaling.load_factor;
  }

  // From its first increment until its target. False: the trace has ended.
  bool TraceStage(const Model& model, std::size_t stage, Clock::time_point start) {
    const Residuals residuals = model.Check(point_, point_);
    if (!(residuals.Largest() <= tolerances::kAcceptedExact))
      return End(EndReason::kNumericalFailure, "the start is not an equilibrium");
    // Where events are located, reactions are measured by the force unit of the contact; where loads drive the path,
    // the load factor is as small as the reactions, though.
    const bool measured = request_.options.LocatesEvents() && model.structure.ReferenceLoad().isZero(0.0);
    const double softest = measured ? tolerances::kSoftestMeasuredContact : tolerances::kSoftestContact;
    if (const std::string soft = ContactTooSoft(model, point_, softest); !soft.empty())
      return End(EndReason::kNumericalFailure, soft);
    const std::unique_ptr<PathMethod> method = MakeMethod(model, TargetOf(model, stage), recorder_.increments());
    EventRecord branches;
    std::string message;
    const std::optional<EndReason> not_started = method->Start(point_, &branches, &message);
    recorder_.Start(model, request_.program.empty() ? 0 : static_cast<int>(stage) + 1, point_, residuals, branches,
                    Seconds(Clock::now() - start));
    stop_.Note(recorder_.increment());
    return not_started ? End(*not_started, message) : FollowStage(model, stage, method.get());
  }

  // The same from an increment inside.
  bool ResumeStage(const Model& model, std::size_t stage, const Resumption& resumption) {
    const Residuals residuals = model.Check(point_, point_);
    if (!(residuals.Largest() <=
          (resumption.from->solve.exact ? tolerances::kAcceptedExact : tolerances::kAcceptedRegularised)))
      return End(EndReason::kNumericalFailure, "the increment to go on from is not an equilibrium");
    events_ = resumption.events;
    const double largest_reaction = Remember(model, resumption);
    const std::optional<double> target = TargetOf(model, stage);
    if (const StopCriterion* criterion = stop_.FirstThatHolds(recorder_.increment()))
      return End(EndReason::kStopCriterion, ToText(*criterion));
    if (IsAt(target)) return EndStage(stage);
    if (const std::string escape = Escape(model, target, model.FromIncrement(*resumption.before)); !escape.empty())
      return End(EndReason::kPathEnd, escape);
    const std::unique_ptr<PathMethod> method = MakeMethod(model, target, recorder_.increments() - 1);
    if (!method->Resume({model.FromIncrement(*resumption.before), point_, resumption.from->solve, largest_reaction}))
      return End(EndReason::kNumericalFailure, "the path cannot be followed from the increment to go on from");
    return FollowStage(model, stage, method.get());
  }

  // The increments up to the one to go on from. Returns the largest reaction of those of the stage, in force units.
  double Remember(const Model& model, const Resumption& resumption) {
    std::optional<PathPoint> before;
    double largest_reaction = 0.0;
    for (const Increment& increment : *resumption.increments) {
      if (increment.index > resumption.from->index) break;
      if (increment.positions.empty()) continue;
      PathPoint point = model.FromIncrement(increment);
      NoteReactions(point);
      if (increment.stage != resumption.from->stage) continue;
      largest_load_ = std::max(largest_load_, std::abs(point.s));
      largest_reaction = std::max(largest_reaction, LargestReaction(model.contacts, point));
      if (before) returns_->Add(increment.index, *before, point);
      before = std::move(point);
    }
    return largest_reaction;
  }

  void NoteReactions(const PathPoint& point) {
    for (std::size_t i = 0; i < model_->contacts.size(); ++i)
      largest_reaction_ =
          std::max(largest_reaction_, point.rn[static_cast<Eigen::Index>(i)] / model_->contacts[i]->ForceUnit());
  }

  void NotePoint(const PathPoint& point) {
    largest_load_ = std::max(largest_load_, std::abs(point.s));
    NoteReactions(point);
  }

  bool FollowStage(const Model& model, std::size_t stage, PathMethod* method) {
    NotePoint(point_);
    const bool goes_on = Follow(model, TargetOf(model, stage), method);
    events_ = method->NumEvents();
    if (const std::string remark = method->Remark(); !remark.empty()) remarks_ += "; " + remark;
    return goes_on && EndStage(stage);
  }

  // Why no further increment is of use, from `before` to the last one: no contact is left, and the load moves away from
  // its target, or nothing holds the structure. Empty: it may be; a stop criterion may yet be met.
  std::string Escape(const Model& model, std::optional<double> target, const PathPoint& before) const {
    const auto is_open = [](ContactState state) { return state == ContactState::kOpen; };
    const bool opened = largest_reaction_ > 0.0 && std::all_of(point_.states.begin(), point_.states.end(), is_open);
    if (!opened || !request_.options.stop.empty()) return {};
    // Where the stiffness has an unstable direction, as of a structure that snaps, the load may come back.
    const bool away = target && point_.s * *target < 0.0 && std::abs(point_.s) > std::abs(*target) &&
                      std::abs(point_.s) > std::abs(before.s) && recorder_.increment().solve.stiffness_sign >= 0;
    if (away)
      return "every contact is open, and the load factor has gone beyond minus its target and moves away from it; with "
             "a stop criterion the path goes on";
    const double unloaded = tolerances::kUnloaded * largest_load_;
    const bool drifts =
        std::abs(before.s) <= unloaded && std::abs(point_.s) <= unloaded && IsShifted(model, before, point_);
    if (!drifts || Approaches(model, before, point_)) return {};
    return "every contact is open, and the structure as a whole drifts away without a load; with a stop criterion the "
           "path goes on";
  }

  bool IsAt(std::optional<double> target) const { return target && IsAtTarget(point_.s, *target); }

  // At its target. False: it was the last one.
  bool EndStage(std::size_t stage) {
    if (stage + 1 < NumStages(request_)) return true;
    return End(EndReason::kStopCriterion, "the program was traced to its end");
  }

  // Until the target, or something ends the trace: then false.
  bool Follow(const Model& model, std::optional<double> target, PathMethod* method) {
    const int most_increments = request_.options.MaxIncrements();
    for (;;) {
      if (Cancelled()) return End(EndReason::kCancelled, "the caller asked for it");
      if (recorder_.increments() > most_increments)
        return End(EndReason::kMaxIncrements, "the wanted number of increments was accepted");
      const Clock::time_point start = Clock::now();
      Advance advance = method->Next(point_);
      const auto increments = static_cast<double>(std::max<std::size_t>(1, advance.increments.size()));
      const double time = Seconds(Clock::now() - start) / increments;
      for (AcceptedPoint& increment : advance.increments) {
        NotePoint(increment.point);
        const std::string pulls = PullingContact(model, increment.point, increment.force_rounding, largest_reaction_);
        if (!pulls.empty()) return End(EndReason::kNumericalFailure, pulls);
        const std::string overrun = OverrunContact(model, point_, increment.point);
        if (!overrun.empty()) return End(EndReason::kNumericalFailure, overrun);
        recorder_.Append(model, increment, time);
        returns_->Add(recorder_.increment().index, point_, increment.point);
        const PathPoint before = std::exchange(point_, std::move(increment.point));
        if (const StopCriterion* criterion = stop_.FirstThatHolds(recorder_.increment(), increment.at_criteria))
          return End(EndReason::kStopCriterion, ToText(*criterion));
        stop_.Note(recorder_.increment());
        if (IsAt(target)) return true;
        if (const std::string escape = Escape(model, target, before); !escape.empty())
          return End(EndReason::kPathEnd, escape);
        if (recorder_.increments() > most_increments) break;
      }
      if (advance.ended && recorder_.increments() <= most_increments) return End(advance.reason, advance.message);
    }
  }

  // What the user wanted and never was asked for.
  std::string MissedChoices() const {
    std::string text;
    if (!request_.options.LocatesEvents()) return text;
    for (const BranchChoice& choice : request_.options.branch_choices)
      if (choice.event > events_ || (choice.event == 0 && choice.increment >= recorder_.increments()))
        text += (text.empty() ? "; branch_choices: never came to " : ", ") + PlaceOf(choice);
    return text;
  }

  const TraceRequest& request_;
  const TraceControl& control_;
  const SceneIndex index_;  // of all stages
  const Scaling scales_;    // of the program
  Recorder recorder_;
  StopTest stop_;
  PathPoint point_;
  int events_ = 0;
  std::unique_ptr<const Model> model_;     // of the stage
  std::optional<ReturnDetector> returns_;  // of the stage
  bool handing_out_ = false;               // an increment, to the caller
  double largest_reaction_ = 0.0;          // r_n so far, scaled, in the force unit of its contact
  double largest_load_ = 0.0;              // so far, scaled
  std::string remarks_;                    // for the end of the message
  TraceResult result_;
};

void RequireSound(const TraceRequest& request) {
  std::vector<Violation> violations = Validate(request);
  if (!violations.empty()) throw InvalidRequest(std::move(violations));
}

}  // namespace

TraceResult Trace(const TraceRequest& request, const TraceControl& control) {
  RequireSound(request);
  const ExpandedRequest expanded(request);
  return Tracer(expanded.Get(), control).Run(std::nullopt);
}

TraceResult ResumeTrace(const TraceRequest& request_as_given, const std::vector<Increment>& increments,
                        const TraceControl& control) {
  RequireSound(request_as_given);
  const ExpandedRequest expanded(request_as_given);
  const TraceRequest& request = expanded.Get();
  const IncrementLists lists(request, SceneIndex(request.scene));
  for (std::size_t i = 0; i < increments.size(); ++i) {
    const Increment& increment = increments[i];
    if (increment.index != static_cast<int>(i))
      throw std::invalid_argument("increment " + std::to_string(i) + " has the index " +
                                  std::to_string(increment.index));
    if (!lists.Fit(increment)) throw std::invalid_argument("increment " + std::to_string(i) + " is not of this scene");
    if (increment.stage < 0 || increment.stage > static_cast<int>(request.program.size()) ||
        (increment.stage == 0) != request.program.empty())
      throw std::invalid_argument("increment " + std::to_string(i) + " is not of this program");
  }
  const std::optional<Resumption> resumption = FindResumption(increments);
  Tracer tracer(request, control);
  if (resumption)
    for (int i = 0; i <= resumption->from->index; ++i) tracer.Repeat(increments[static_cast<std::size_t>(i)]);
  return tracer.Run(resumption);
}

}  // namespace contact_path
