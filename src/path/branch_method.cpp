#include "contact_path/path/branch_method.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/path/diagnosis.h"
#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// A step on which the energies agree.
struct BalancedStep {
  ArcStep at;
  Work work;
  double stored = 0.0;  // strain energy at its end [force length]
};

namespace {

constexpr int kMostEventsInPlace = 8;  // then the contacts chatter, and no branch is trusted
constexpr int kMostShorter = 6;        // times half as long, until the energies agree

End Failure(std::string_view sentence) { return {EndReason::kNumericalFailure, {{sentence}}}; }

// Fills in the energies. Whether the work of the loads is what the strain energy gains and friction takes, up to a
// share that a step may be off by. stored: strain energy at its start, if known.
bool Balance(const Model& model, const FixedModeSystem& system, std::optional<double> stored, BalancedStep* step) {
  const Step& of = step->at.step;
  const double unit = model.scaling.force * model.scaling.length;
  const auto stored_at = [&](const Eigen::VectorXd& x) { return system.Energy(x) * unit; };
  const double before = stored ? *stored : stored_at(of.start.x);
  step->stored = before;
  if (!(of.length > 0.0)) return true;
  step->work = WorkOfStep(model, system, of);
  step->stored = stored_at(of.end.x);
  const double change = step->stored - before;
  const double taken = step->work.friction - step->work.given_back;
  const double exchanged =
      std::abs(step->work.loads) + step->work.given_back + std::abs(step->work.friction) + std::abs(change);
  return std::abs(step->work.loads - taken - change) <=
         tolerances::kEnergyOfStep * exchanged + tolerances::kEqual * (before + unit);
}

// The next step, of up to this length, short enough for the energies to tell, too: where only soft parts move, the load
// may change along the step by far more than what its predictor shows. Nothing: no step is accepted.
std::optional<BalancedStep> NextBalancedStep(const Model& model, const BranchOptions& options, ModeArc* arc,
                                             const CurvePoint& from, double length, const StepEnds& ends,
                                             std::optional<double> stored) {
  const StepLimits limits = {options.smallest_step, options.step, options.prediction, options.smallest_cosine,
                             options.on_trial};
  std::optional<BalancedStep> best;
  for (int shorter = 0; shorter <= kMostShorter; ++shorter) {
    std::optional<ArcStep> at = NextStep(arc, from, length, limits, ends);
    if (!at) break;
    if (best) at->rejected += best->at.rejected + 1;
    best.emplace();
    best->at = *std::move(at);
    if (Balance(model, arc->system(), stored, &*best)) break;
    if (options.on_trial)
      options.on_trial(
          {best->at.step.length, kEnergiesOff, {}, {{"work", best->work.loads}, {"friction", best->work.friction}}});
    length = 0.5 * std::min(best->at.tried, best->at.step.length);
    if (length < options.smallest_step) break;
  }
  return best;
}

}  // namespace

BranchMethod::BranchMethod(const Model& model, const BranchOptions& options, std::function<bool()> cancelled)
    : model_(model),
      options_(options),
      cancelled_(std::move(cancelled)),
      limit_(model, options, cancelled_),
      departure_(model, options_, limit_.parameter(), cancelled_),
      arc_(model.structure, model.laws),
      events_(model, options_, &limit_, &departure_, &arc_),
      onsets_(model, &limit_, &arc_),
      step_length_(options.step),
      increments_(options.increments) {
  ends_.load_factor = options.load_factor;
  if (options.watch) ends_.functions = options.watch(arc_.system());
}

int BranchMethod::StiffnessSign(const CurvePoint& point) const {
  // By Cramer's rule from the rate of the load factor; the parity is that of the rows and columns of the reactions.
  if (point.is_limit) return 0;
  const double rate = point.first[arc_.NumMotion() - 1];
  const Eigen::Index reactions = arc_.system().NumUnknowns() - arc_.NumMotion();
  return (rate > 0.0 ? 1 : -1) * point.determinant_sign * (reactions % 2 == 0 ? 1 : -1);
}

std::optional<End> BranchMethod::Start(const PathPoint& from, IncrementFindings* found) {
  departure_.NoteReactions(from);
  if (Causes hidden = HiddenSlip(model_, from); !hidden.empty()) return End{EndReason::kNotDetermined, hidden};
  std::optional<End> end = SetOut(from, found);
  limit_.NoteStart(from, departure_.ToleranceAt(from), &end);
  return end;
}

std::optional<End> BranchMethod::SetOut(const PathPoint& from, IncrementFindings* found) {
  at_start_ = true;
  events_in_place_ = 0;
  stored_.reset();
  step_length_ = options_.step;
  departure_.Restart();
  std::optional<End> end = departure_.Leave(from, departure_.StartArrival(), options_.ChoiceAt(increments_, 0), &arc_,
                                            &current_, &found->event);
  if (limit_.monitor() != nullptr) {
    PathPoint leaves = from;
    if (!end) leaves.modes = arc_.system().modes();
    const PathPoint next = end ? leaves : arc_.system().Unpack(Ahead(current_));
    limit_.monitor()->Start(leaves, end ? nullptr : &current_, &next);
    found->stability = limit_.monitor()->record();
  }
  return end;
}

Advance BranchMethod::TakeJump(const PathPoint& from) {
  using Kind = MachineLimit::Outcome::Kind;
  MachineLimit::Outcome jump = limit_.TakeJump(from, increments_);
  if (jump.kind == Kind::kEnds) return Ended(*std::move(jump.end));
  if (jump.kind == Kind::kGoesOn) {
    step_length_ = std::max(options_.smallest_step, tolerances::kNextToStart * options_.step);
    return {};
  }
  ++increments_;
  const bool lands = jump.kind == Kind::kLands;
  PathPoint point = lands ? jump.landing.point : from;
  if (!lands) TakeStates(arc_.system().modes(), &point);
  IncrementFindings found;
  Advance advance;
  advance.end = SetOut(point, &found);
  if (!lands && advance.end) return Ended(*std::move(jump.end));
  AcceptedPoint increment = lands ? std::move(jump.landing) : IncrementAt(std::move(point), from);
  increment.event = std::move(found.event);
  increment.stability = std::move(found.stability);
  if (lands) {
    limit_.NoteLanding(from, increment.point, departure_.ToleranceAt(increment.point), &advance.end);
  } else {
    increment.kind = IncrementKind::kContactEvent;
    increment.event.number = events_.Count();
  }
  advance.increment = std::move(increment);
  return advance;
}

bool BranchMethod::Resume(const ResumePoint& at) {
  if (!(at.solve.next_step > 0.0)) return false;
  arc_.SetModes(at.point);
  Eigen::VectorXd towards = Chord(at.before, at.point);
  // The next increment sets out with the factors of this one's end, which are those of the tangent at its start: with
  // another tangent Newton's method takes other steps, and the predictor is judged by the first of them.
  CurvePoint start;
  if (arc_.Derivatives(arc_.system().Pack(at.before), towards, &start)) towards = start.first.head(towards.size());
  if (!arc_.Derivatives(arc_.system().Pack(at.point), towards, &current_)) return false;
  step_length_ = at.solve.next_step;
  at_start_ = false;
  return true;
}

Advance BranchMethod::ChangeReactions(const PathPoint& from) {
  PathPoint point = departure_.TakeBegin();
  TakeStates(arc_.system().modes(), &point);
  if (options_.ChoiceAt(increments_ + 1, 0) != nullptr)
    return Ended({EndReason::kNoSuchBranch, {{sentences::kOnlyReactionsChange, {}, increments_ + 1}}});
  AcceptedPoint increment = IncrementAt(std::move(point), from);
  increment.solve.next_step = step_length_;
  if (!(increment.residuals.Largest() <= tolerances::kAccepted)) return Ended(Failure(sentences::kReactionsAtRest));
  ++increments_;
  return {std::move(increment), std::nullopt};
}

AcceptedPoint BranchMethod::IncrementAt(PathPoint point, const PathPoint& from) const {
  AcceptedPoint increment;
  increment.point = std::move(point);
  increment.residuals = model_.Check(from, increment.point);
  increment.solve.method = Method::kBranch;
  increment.solve.exact = true;
  increment.solve.variables = static_cast<int>(arc_.system().NumUnknowns());
  increment.solve.constraints = static_cast<int>(arc_.system().NumEquations());
  return increment;
}

AcceptedPoint BranchMethod::IncrementOf(const ArcStep& step, const PathPoint& from) const {
  const CurvePoint& end = step.step.end;
  AcceptedPoint increment = IncrementAt(arc_.system().Unpack(end.x), from);
  increment.solve.rejected = step.rejected;
  increment.solve.nullity = static_cast<int>(end.nullity);
  increment.solve.determinant_sign = end.determinant_sign;
  increment.stiffness_sign = StiffnessSign(end);
  increment.solve.iterations = step.iterations;
  increment.solve.contraction = step.contraction;
  if (step.event.Kind() != EventKind::kNone)
    for (const ArcTarget& target : ends_.functions)
      if (target.criterion >= 0 && std::abs(target.of(end.x) - target.values.front()) <= target.rounding)
        increment.at_criteria.push_back(target.criterion);
  return increment;
}

std::optional<PathPoint> BranchMethod::InnerPoint(const Step& step, const PathPoint& from) const {
  if (!options_.inner || !(step.length > 0.0)) return std::nullopt;
  std::optional<PathPoint> point = PointApart(model_, arc_, step, 0.5 * step.length);
  if (point && !(model_.Check(from, *point).Largest() <= tolerances::kAccepted)) point.reset();
  return point;
}

std::optional<int> BranchMethod::EndAtReturn(const PathPoint& from, ArcStep* at) {
  Step& step = at->step;
  if (options_.returns == nullptr || !(step.length > 0.0) || options_.HasChoiceAfter(increments_, events_.number()))
    return std::nullopt;
  const FixedModeSystem& system = arc_.system();
  const std::optional<ReturnDetector::Return> found = options_.returns->Find(from, system.Unpack(step.end.x));
  if (!found) return std::nullopt;
  const Eigen::VectorXd x = system.Pack(found->point);
  // The increment come back to is at the limit point where this one ends, to what rounding leaves of its place.
  const bool at_limit = at->event.Kind() == EventKind::kLimitPoint && !at->event.crossing &&
                        (x - step.end.x).head(arc_.NumMotion()).norm() <=
                            step.end.load_error / std::abs(step.end.second[arc_.LoadFactor()]);
  if (at_limit) return found->increment;
  CurvePoint end;
  if (!arc_.Derivatives(x, step.normal, &end)) return std::nullopt;
  step = MakeStep(step.start, end, arc_.NumMotion());
  at->event = StepEvent();
  return found->increment;
}

bool BranchMethod::EndAtOnset(const PathPoint& from, BalancedStep* next, AcceptedPoint* increment) {
  const std::optional<Onset> onset = onsets_.Find(next->at, increment->point);
  if (!onset) return false;
  next->at.step = MakeStep(next->at.step.start, onset->place, arc_.NumMotion());
  next->at.event = StepEvent();
  next->at.event.crossing = onset->crossing;
  Balance(model_, arc_.system(), stored_, next);
  *increment = IncrementOf(next->at, from);
  onsets_.Note(onset->place, increment->point, onsets_.NullDirections(next->at));
  return true;
}

Advance BranchMethod::Next(const PathPoint& from) {
  if (limit_.Leaves()) return TakeJump(from);
  if (departure_.ChangesReactions()) return ChangeReactions(from);
  const int factorisations_before = arc_.factorisations();
  std::optional<BalancedStep> next = NextBalancedStep(model_, options_, &arc_, current_, step_length_, ends_, stored_);
  if (!next) return Ended(NoStep(from));
  ArcStep* const at = &next->at;
  std::optional<int> returned = EndAtReturn(from, at);
  if (returned) Balance(model_, arc_.system(), stored_, &*next);  // of the shorter step

  AcceptedPoint increment = IncrementOf(*at, from);
  const bool onset = EndAtOnset(from, &*next, &increment);
  if (onset) returned.reset();
  if (!(increment.residuals.Largest() <= tolerances::kAccepted)) {
    End end = Failure(sentences::kResiduals);
    Append(WhyRefused(model_, increment.point, increment.residuals), &end.causes);
    return Ended(end);
  }
  departure_.NoteReactions(increment.point);
  const bool moved = at->step.length > 0.0;
  events_in_place_ = moved ? 0 : events_in_place_ + 1;
  if (events_in_place_ > kMostEventsInPlace) return Ended(Failure(sentences::kEventsInPlace));
  if (moved) {
    increment.arc_length = at->step.ArcLength();
    increment.work = next->work;
    increment.inner = InnerPoint(at->step, from);
    at_start_ = false;
  }
  current_ = at->step.end;
  stored_ = next->stored;
  ++increments_;

  Advance advance;
  EventFacts facts;
  facts.onset = onset;
  if (returned) {
    facts.smooth_limit = at->event.Kind() == EventKind::kLimitPoint;
    advance.end = ClosedPath(*returned);
  } else if (Causes hidden = HiddenSlip(model_, increment.point); !hidden.empty()) {
    advance.end = {EndReason::kNotDetermined, hidden};
  } else {
    const Modes before = arc_.system().modes();
    advance.end = events_.Pass(*at, {increments_, at_start_}, &increment, &current_, &facts);
    // What gives way in one mode need not in the next.
    if (!SameStates(arc_.system().modes(), before)) stored_.reset();
  }
  increment.kind = facts.Kind();
  if (limit_.monitor() != nullptr) {
    if (increment.kind == IncrementKind::kContactEvent || increment.kind == IncrementKind::kCornerLimit)
      onsets_.NoteBehind(*at, increment.point, current_);
    increment.stability = limit_.monitor()->record();
  }
  // As long as wanted unless this step had to be shortened.
  step_length_ = std::min(options_.step, at->rejected > 0 ? 1.5 * at->tried : 2.0 * step_length_);
  const bool decides_behind = limit_.Note({increment.point, at->step.end, current_, onsets_.NullDirections(*at),
                                           at->event.Kind() == EventKind::kContactEvent, at->event.crossing.has_value(),
                                           facts.stable_ahead, departure_.ToleranceAt(increment.point)},
                                          &increment.stability, &advance.end);
  if (decides_behind) step_length_ = std::max(options_.smallest_step, tolerances::kNextToStart * step_length_);
  increment.solve.next_step = limit_.Leaves() ? 0.0 : step_length_;
  increment.solve.factorisations = arc_.factorisations() - factorisations_before;
  advance.increment = std::move(increment);
  return advance;
}

Causes BranchMethod::Remarks() const {
  Causes remarks = departure_.AtEnds();
  if (departure_.other_reactions()) remarks.push_back({sentences::kOtherReactions});
  return remarks;
}

End BranchMethod::NoStep(const PathPoint& from) {
  const double moved = arc_.MovedByRounding(current_.x, current_.first.head(arc_.NumMotion()));
  const double length = model_.scaling.length;
  const Causes collapsed = CollapsedPart(model_.scene, model_.index, model_.InSceneUnits(from).positions);
  End end = {EndReason::kStepTooSmall, {{sentences::kNoIncrement}, {sentences::kNewtonLeavesBranch}}};
  if (collapsed.empty() && moved > options_.smallest_step)
    end = {EndReason::kNotDetermined, {{sentences::kMotionSign, {}, options_.smallest_step * length, moved * length}}};
  Append(collapsed, &end.causes);
  Append(CurveTooSharp(model_, from), &end.causes);
  return end;
}

}  // namespace contact_path
