#include "contact_path/path/mpec_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/equations/nearest_point.h"
#include "contact_path/path/model.h"
#include "contact_path/path/watched_quantities.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// A regularised point differs from its contact states by less than this share of the largest force and of the
// increment.
constexpr double kRegularisedState = 0.1;

// An increment shorter than this part of what was wanted has not moved: (0, 0) is always feasible.
constexpr double kProgress = 0.05;

// Without a change of state the path does not turn by more than 60 degrees in one increment.
constexpr double kSmallestCosine = 0.5;

// With one it may turn by more than a right angle, but not go back the way that it came.
constexpr double kWayBack = -0.9;

constexpr double kFarthestTarget = 2.0;  // of the increment that goes past the target: farther is another branch
constexpr double kLevelling =
    0.25;  // a rate at the end of an increment that may be none, relative to the one at its begin

constexpr int kMostDirections = 8;           // tried, each that of the motion found by the one before
constexpr double kShortPath = 20.0;          // of the corner tolerance
constexpr double kCornerShare = 0.04;        // of the wanted step: largest corner tolerance
constexpr double kSmallestStepRatio = 1e-7;  // of the wanted step

Eigen::VectorXd Direction(const PathPoint& from, const PathPoint& to) { return Chord(from, to).normalized(); }

// Whether this law is about to change its state, so that the path may bend here by any angle.
bool IsNearlyActive(const Laws& laws, const PathPoint& point, std::size_t i) {
  const Law& law = laws[i];
  if (!law.CanBeIdle()) return false;
  const PortReals forces = laws.Of(point.forces, i);
  const double unit = law.ForceUnit();
  if ((law.In(point.modes[i]).idle ? law.Motion(kNormal, point.u, point.s, point.modes[i].piece, {})
                                   : forces[kNormal] / unit) <= tolerances::kTouching)
    return true;
  return law.LargestRatio() > 0.0 && StateOf(point, i) == ContactState::kStick &&
         law.LargestRatio() * forces[kNormal] - std::abs(forces[kTangent]) <= tolerances::kTouching * unit;
}

bool SomeNearlyActive(const Laws& laws, const PathPoint& point) {
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (IsNearlyActive(laws, point, i)) return true;
  return false;
}

bool SomeSlides(const Laws& laws, const Modes& modes) {
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (laws[i].In(modes[i]).slides) return true;
  return false;
}

// Whether a law has another state than before, or has come to where it may change: the increment may have cut a
// corner. A contact that slides on without a reaction, say, has lost it somewhere on the way.
bool MayHaveCutCorner(const Laws& laws, const PathPoint& from, const PathPoint& to) {
  if (!SameStates(to.modes, from.modes)) return true;
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (IsNearlyActive(laws, to, i) && !IsNearlyActive(laws, from, i)) return true;
  return false;
}

// Whether what a regularised point says of each law is what its numbers say. They may all be small against the
// characteristic force, and then small residuals prove nothing.
bool StatesAgree(const ContactPairs& contacts, const Laws& laws, const PathPoint& from, const PathPoint& to) {
  const double largest = std::max(std::abs(to.s), laws.LargestForce(to));
  const double length = kRegularisedState * Distance(from, to);
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double force = kRegularisedState * largest * laws[i].ForceUnit();
    const PortReals forces = laws.Of(to.forces, i);
    const StateRule& rule = laws[i].In(to.modes[i]);
    if (rule.idle) {
      // Friction above 1 makes a force of a normal reaction that is none.
      if (std::max(forces[kNormal], std::abs(forces[kTangent])) > std::min(force, tolerances::kAcceptedRegularised))
        return false;
      continue;
    }
    if (laws[i].Motion(kNormal, to.u, to.s, to.modes[i].piece, {}) + rule.ports[kNormal].compliance * forces[kNormal] >
        length)
      return false;
    if (i >= contacts.size()) continue;
    const double slip = contacts[i]->Travel(kTangent, from.u, from.s, from.modes[i].piece, to.u - from.u, to.s - from.s,
                                            to.modes[i].piece);
    const double margin = contacts[i]->Friction() * forces[kNormal] - std::abs(forces[kTangent]);
    const ContactState state = StateOf(to, i);
    if (state == ContactState::kStick && std::abs(slip) > length) return false;
    if (Slips(state) && margin > force) return false;
  }
  return true;
}

}  // namespace

MpecOptions MpecOptions::For(const TraceOptions& options, double growth) {
  MpecOptions result;
  result.regularisation.predicted = true;
  const auto accuracy = static_cast<std::size_t>(options.accuracy);  // fast, balanced, accurate
  result.step = std::array{0.05, 0.02, 0.005}[accuracy];
  result.corner_tolerance = std::array{2e-3, 5e-4, 1e-4}[accuracy];
  if (options.accuracy == Accuracy::kAccurate) result.regularisation.minimum = 1e-10;
  result.step = options.step > 0.0 ? options.step : result.step * growth;
  // Shorter increments are to show more of the path.
  result.corner_tolerance = std::min(result.corner_tolerance, kCornerShare * result.step);
  result.smallest_step = kSmallestStepRatio * result.step;
  result.direction = options.Direction();
  return result;
}

MpecMethod::MpecMethod(const Model& model, const MpecOptions& options, std::function<bool()> cancelled)
    : model_(model),
      options_(options),
      cancelled_(std::move(cancelled)),
      ipopt_(cancelled_),
      solver_(model.structure, model.contacts, model.laws, &ipopt_),
      step_length_(options.step) {
  direction_ = Eigen::VectorXd::Zero(model.structure.NumDofs() + 1);
  direction_[model.structure.NumDofs()] = options.direction;
}

MpecMethod::Trial MpecMethod::Try(const PathPoint& from, const Eigen::VectorXd& direction, double length,
                                  double dissipation, bool predicted) {
  RegularisationSchedule schedule = options_.regularisation;
  schedule.predicted = schedule.predicted && predicted;
  Trial trial;
  trial.increment = solver_.Solve(from, {length, direction, dissipation, gamma2_factor_}, schedule);
  iterations_ += trial.increment.iterations;
  Judge(from, direction, length, &trial);
  if (trial.verdict == sentences::kAccepted || !trial.increment.predicted) return trial;
  // Another solution may lie nearer to the first guess.
  return Try(from, direction, length, dissipation, false);
}

void MpecMethod::Judge(const PathPoint& from, const Eigen::VectorXd& direction, double length, Trial* result) const {
  Trial& trial = *result;
  if (trial.increment.status != SolveStatus::kSolved) {
    trial.verdict = trial.increment.status == SolveStatus::kCancelled ? sentences::kCancelled : sentences::kNotSolved;
    return;
  }
  const PathPoint& to = trial.increment.point;
  trial.residuals = model_.Check(from, to);
  const double tolerance = trial.increment.exact ? tolerances::kAccepted : tolerances::kAcceptedRegularised;
  const double moved = Distance(from, to);
  const double turn = started_ ? Direction(from, to).dot(direction) : 1.0;
  const bool turns_back =
      turn < kSmallestCosine && !bent_ && SameStates(to.modes, from.modes) && !SomeNearlyActive(model_.laws, from);
  // A path that slides on and one that goes back with all contacts at rest are two solutions of the increment problem,
  // and the solver may find either. The second one dissipates nothing.
  const bool back_at_rest = started_ && (to.s - from.s) * direction_[direction_.size() - 1] < 0.0 &&
                            SomeSlides(model_.laws, from.modes) && !SomeSlides(model_.laws, to.modes);
  if (!(trial.residuals.Largest() <= tolerance))
    trial.verdict = sentences::kResidual;
  else if (!trial.increment.exact && !StatesAgree(model_.contacts, model_.laws, from, to))
    trial.verdict = sentences::kContradiction;
  else if (moved > IncrementSolver::kLongestIncrement * length)
    trial.verdict = sentences::kTooLong;
  else if (moved < kProgress * length)
    trial.verdict = sentences::kNoProgress;
  else if (!started_ && (to.s - from.s) * options_.direction <= tolerances::kUnitComponent * moved)
    trial.verdict = sentences::kWrongDirection;
  else if (turns_back || (started_ && Direction(from, to).dot(onward_) < kWayBack))
    trial.verdict = sentences::kTurnedBack;
  else if (back_at_rest)
    trial.verdict = sentences::kBackAtRest;
  else
    trial.verdict = sentences::kAccepted;
}

// The direction that step 0 of Algorithm 3.2 leaves to the user.
MpecMethod::Trial MpecMethod::TryFirst(const PathPoint& from, double length) {
  Eigen::VectorXd direction = direction_;
  Trial trial;
  for (int i = 0; i < kMostDirections; ++i) {
    trial = Try(from, direction, length, 0.0);
    const bool moved = trial.increment.status == SolveStatus::kSolved && Distance(from, trial.increment.point) > 0.0;
    if (!moved || Distance(from, trial.increment.point) >= 0.5 * length) break;
    direction = Direction(from, trial.increment.point);
  }
  return trial;
}

bool MpecMethod::ConfirmedByHalves(const PathPoint& from, const Eigen::VectorXd& direction, double length,
                                   const Trial& whole) {
  const PathPoint& to = whole.increment.point;
  const Trial first = Try(from, direction, 0.5 * length);
  if (first.verdict != sentences::kAccepted) return false;
  const PathPoint& middle = first.increment.point;
  const Trial second = Try(middle, Direction(from, middle), 0.5 * length);
  if (second.verdict != sentences::kAccepted) return false;
  // Distance of the middle from the chord of the whole increment.
  const Eigen::VectorXd chord = Direction(from, to);
  Eigen::VectorXd bend = Chord(from, middle);
  bend -= chord * chord.dot(bend);
  // A corner next to an end of the increment is twice as far from the chord as the middle.
  return 2.0 * bend.norm() <= options_.corner_tolerance &&
         Distance(second.increment.point, to) <= options_.corner_tolerance;
}

std::optional<double> MpecMethod::TargetBetween(const PathPoint& from, const PathPoint& to) const {
  std::optional<double> nearest;
  for (const double target : options_.targets)
    if ((from.s - target) * (to.s - target) < 0.0 &&
        (!nearest || std::abs(target - from.s) < std::abs(*nearest - from.s)))
      nearest = target;
  return nearest;
}

bool MpecMethod::MayMissTarget(const PathPoint& from, const PathPoint& to) const {
  if (options_.targets.empty() || !started_) return false;
  // Rates of the load factor over arc length: chords of the last increment and of this one, and from them at the ends.
  const double length = Distance(from, to), chord = (to.s - from.s) / length;
  const double last_chord = direction_[direction_.size() - 1];
  const double at_from = (last_chord * length + chord * last_length_) / (last_length_ + length);
  const double at_to = 2.0 * chord - at_from;
  const bool turns = chord * last_chord < 0.0 || at_to * last_chord < kLevelling * at_from * last_chord;
  // No load factor of a concave arc, or of two straight ones, is larger.
  const double reached = from.s + last_chord * length;
  return turns && std::any_of(options_.targets.begin(), options_.targets.end(), [&](double target) {
           return (from.s - target) * (to.s - target) > 0.0 && (from.s - target) * (reached - target) < 0.0;
         });
}

bool MpecMethod::EndAtTarget(const PathPoint& from, double target, Trial* trial) const {
  const PathPoint to = trial->increment.point;
  const double share = (target - from.s) / (to.s - from.s);
  // The contacts may change their states on either side of the target.
  for (const Modes& modes : {to.modes, from.modes}) {
    FixedModeSystem system(model_.structure, model_.laws);
    system.SetModes(modes, model_.laws.ReferencesAt(from));
    system.FixLoadFactor(target);
    const Eigen::VectorXd start = (1.0 - share) * system.Pack(from) + share * system.Pack(to);
    const NearestPoint nearest = FindNearestPoint(&system, start, start.head(from.u.size() + 1));
    if (!nearest.converged) continue;
    const std::vector<Limit> limits = system.mode_limits().All();
    if (std::any_of(limits.begin(), limits.end(), [&](const Limit& limit) {
          return system.Value(limit, nearest.x) < -tolerances::kResidual * system.UnitOf(limit);
        }))
      continue;
    PathPoint point = system.Unpack(nearest.x);
    if (Distance(from, point) > kFarthestTarget * Distance(from, to)) continue;
    trial->residuals = model_.Check(from, point);
    if (!(trial->residuals.Largest() <= tolerances::kAccepted)) continue;
    trial->increment.point = std::move(point);
    trial->increment.exact = true;
    return true;
  }
  return false;
}

std::optional<int> MpecMethod::EndAtReturn(const PathPoint& from, Trial* trial) const {
  const PathPoint& to = trial->increment.point;
  // Between two states the increment is no arc, and a regularised one is not exact enough.
  if (options_.returns == nullptr || !trial->increment.exact || !SameStates(to.modes, from.modes)) return std::nullopt;
  const std::optional<ReturnDetector::Return> found = options_.returns->Find(from, to);
  if (!found) return std::nullopt;
  const Residuals residuals = model_.Check(from, found->point);
  if (!(residuals.Largest() <= tolerances::kAccepted)) return std::nullopt;
  trial->increment.point = found->point;
  trial->residuals = residuals;
  return found->increment;
}

bool MpecMethod::Resume(const ResumePoint& at) {
  if (!(at.solve.next_step > 0.0) || !(Distance(at.before, at.point) > 0.0)) return false;
  direction_ = onward_ = Direction(at.before, at.point);
  last_length_ = Distance(at.before, at.point);
  bent_ = !SameStates(at.before.modes, at.point.modes);
  step_length_ = at.solve.next_step;
  gamma2_factor_ = at.solve.gamma2_factor;
  length_ = std::numeric_limits<double>::infinity();  // not known, and not short
  started_ = true;
  return true;
}

Causes MpecMethod::Remarks() const {
  if (!started_ || !(length_ < kShortPath * options_.corner_tolerance)) return {};
  return {{sentences::kShortPath}};
}

Advance MpecMethod::Next(const PathPoint& from) {
  Advance advance;
  iterations_ = 0;
  double length = step_length_;
  std::optional<sentences::Sentence> first;
  for (int rejected = 0;; ++rejected) {
    Trial trial = started_ ? Try(from, direction_, length) : TryFirst(from, length);
    const PathPoint& to = trial.increment.point;
    if (trial.verdict == sentences::kAccepted && MayHaveCutCorner(model_.laws, from, to) &&
        !ConfirmedByHalves(from, started_ ? direction_ : Direction(from, to), length, trial))
      trial.verdict = sentences::kNotConfirmed;
    if (trial.verdict == sentences::kAccepted)
      if (const std::optional<double> target = TargetBetween(from, to); target && !EndAtTarget(from, *target, &trial))
        trial.verdict = sentences::kBeyondTarget;
    if (trial.verdict == sentences::kAccepted && MayMissTarget(from, to)) trial.verdict = sentences::kBeyondTarget;
    if (trial.verdict == sentences::kCancelled || (cancelled_ && cancelled_())) {
      advance.end = {EndReason::kCancelled, {{sentences::kCancelled}}};
      return advance;
    }
    if (options_.on_trial)
      options_.on_trial({length,
                         trial.verdict,
                         {},
                         {{"reached", to.u.size() > 0 ? Distance(from, to) : 0.0},
                          {"regularisation", trial.increment.regularisation},
                          {"exact", trial.increment.exact ? 1.0 : 0.0},
                          {"ipopt_iterations", iterations_},
                          {"largest_residual", trial.residuals.Largest()}}});
    if (trial.verdict != sentences::kAccepted) {
      // Shorter increments fail for reasons that follow from the first one.
      if (!first) first = trial.verdict;
      length *= 0.5;
      if (length >= options_.smallest_step) continue;
      advance.end = {EndReason::kStepTooSmall, {{sentences::kNoIncrement}, {*first}}};
      return advance;
    }

    const std::optional<int> returned = EndAtReturn(from, &trial);
    AcceptedPoint increment;
    const bool changed = started_ && !SameStates(to.modes, from.modes);
    const Eigen::VectorXd direction = Direction(from, to);
    const Eigen::Index s = direction.size() - 1;
    if (started_ && direction[s] * direction_[s] < 0.0 &&
        std::min(std::abs(direction[s]), std::abs(direction_[s])) > tolerances::kRate)
      increment.kind = changed || bent_ ? IncrementKind::kCornerLimit : IncrementKind::kSmoothLimit;
    else if (changed)
      increment.kind = IncrementKind::kContactEvent;
    increment.arc_length = Distance(from, to);
    length_ += increment.arc_length;
    increment.work = WorkOfIncrement(model_, from, to);
    increment.residuals = trial.residuals;
    increment.solve.method = Method::kMpec;
    increment.solve.regularisation = trial.increment.regularisation;
    increment.solve.exact = trial.increment.exact;
    increment.solve.iterations = iterations_;
    increment.solve.variables = trial.increment.variables;
    increment.solve.constraints = trial.increment.constraints;
    increment.solve.rejected = rejected;

    // gamma_2 grows with the length of the increment relative to what was wanted (Algorithm 3.2, step 4).
    gamma2_factor_ = std::clamp(gamma2_factor_ * Distance(from, to) / length, 1.0, IncrementSolver::kLongestIncrement);
    if (!started_ || (!changed && !bent_)) onward_ = direction;
    direction_ = direction;
    last_length_ = increment.arc_length;
    bent_ = changed;
    started_ = true;
    step_length_ = std::min(options_.step, rejected == 0 ? 2.0 * std::max(length, step_length_) : 2.0 * length);
    increment.solve.next_step = step_length_;
    increment.solve.gamma2_factor = gamma2_factor_;
    increment.point = trial.increment.point;
    advance.increment = std::move(increment);
    if (returned) advance.end = ClosedPath(*returned);
    return advance;
  }
}

std::unique_ptr<PathMethod> MakeMpecMethod(const MethodTask& task) {
  MpecOptions options = MpecOptions::For(task.options, AutomaticStepGrowth(task.model));
  for (const SceneEnd& end : SceneEnds(task.model))
    if (end.target.unknown >= 0) options.targets.push_back(end.target.values.front());  // a load factor
  if (task.target) options.targets.push_back(*task.target);
  options.on_trial = task.control.on_trial;
  options.returns = task.returns;
  return std::make_unique<MpecMethod>(task.model, options, task.control.cancelled);
}

}  // namespace contact_path
