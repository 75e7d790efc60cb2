#include "contact_path/mpec/increment_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/equations/nearest_point.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Times eps: barrier parameter with which the solve for eps starts, so that the barrier never hides the relaxed
// products.
constexpr double kBarrierShare = 0.1;

// The exact point must lie within this part of the wanted length of the regularised one, or it is another solution.
constexpr double kSamePoint = 0.1;

constexpr int kMaxActiveSetChanges = 4;

// Barrier parameter of a start that is nearly the solution: it counts as solved.
constexpr double kBarrierAtOnce = 0.5 * tolerances::kAccepted;

constexpr int kMaxPredictedChanges = 8;

constexpr double kSameEps = 1.0 + tolerances::kEqual;

}  // namespace

IncrementSolver::IncrementSolver(const Structure& structure, const ContactPairs& contacts, NonlinearSolver* solver)
    : structure_(structure), contacts_(contacts), solver_(solver), system_(structure, contacts), tracker_(contacts) {}

IncrementTrial IncrementSolver::Solve(const PathPoint& from, const IncrementGoal& goal,
                                      const RegularisationSchedule& schedule) {
  int iterations = 0;
  if (schedule.predicted) {
    IncrementTrial trial = SolvePredicted(from, goal, schedule);
    if (trial.status != SolveStatus::kFailed) return trial;
    iterations = trial.iterations;
  }
  std::vector<std::size_t> included = tracker_.InReach(from.u, from.s, kLongestIncrement * goal.length);
  // Past the end of its surface a node would meet the prolongation of the last patch.
  included.erase(
      std::remove_if(included.begin(), included.end(),
                     [&](std::size_t i) {
                       return !contacts_[i]->HasPatch(contacts_[i]->KnownPatch(from.u, from.s, from.Patch(i)));
                     }),
      included.end());
  for (;;) {
    const std::vector<int> working_set(included.begin(), included.end());
    IncrementTrial trial = SolveWith(from, working_set, goal, schedule);
    trial.iterations += iterations;
    if (trial.status != SolveStatus::kSolved) return trial;
    const std::size_t before = included.size();
    for (const std::size_t i : tracker_.InReach(trial.point.u, trial.point.s, 0.0)) {
      const auto place = std::lower_bound(included.begin(), included.end(), i);
      const int patch = contacts_[i]->PatchAt(trial.point.u, trial.point.s);
      if ((place == included.end() || *place != i) && contacts_[i]->Gap(trial.point.u, trial.point.s, patch) < 0.0)
        included.insert(place, i);
    }
    if (included.size() == before) return trial;
    iterations = trial.iterations;
  }
}

IncrementTrial IncrementSolver::SolveWith(const PathPoint& from, const std::vector<int>& working_set,
                                          const IncrementGoal& goal, const RegularisationSchedule& schedule) {
  IncrementProblem problem(structure_, contacts_, from, working_set, goal);
  IncrementTrial trial;
  trial.variables = static_cast<int>(problem.NumVariables());
  trial.constraints = static_cast<int>(problem.NumConstraints());

  const bool regularised = !working_set.empty();
  trial.regularisation = regularised ? schedule.minimum * goal.length * goal.length : 0.0;
  PrimalDual point;
  point.x = problem.StartingPoint(goal.direction);
  RegularisationSchedule wanted = schedule;
  if (!regularised) wanted.initial = wanted.minimum = 0.0;
  if (Follow(&problem, wanted, &point, &trial)) PolishActiveSet(from, problem, goal, &trial);
  return trial;
}

std::optional<PathPoint> IncrementSolver::Predict(const PathPoint& from, const IncrementGoal& goal) {
  const Eigen::VectorXd wanted =
      IncrementProblem(structure_, contacts_, from, TouchingAt(from), goal).UnconstrainedMinimiser();
  const Eigen::VectorXd reference = SlipReferences(contacts_, from);
  PathPoint point = from;
  for (int change = 0; change <= kMaxPredictedChanges; ++change) {
    system_.SetStates(point.states, reference, point.patches);
    const NearestPoint nearest = FindNearestPoint(&system_, system_.Pack(point), wanted);
    if (!nearest.converged) return std::nullopt;
    const std::vector<int> patches = point.patches;
    point = system_.Unpack(nearest.x);
    if (Distance(from, point) > kLongestIncrement * goal.length) return std::nullopt;
    PathPoint next = point;
    next.patches = patches;
    bool kept = true;
    for (const Constraint& constraint : system_.Inequalities()) {
      if (system_.Value(constraint, nearest.x) >= -tolerances::kBroken * system_.UnitOf(constraint)) continue;
      kept = false;
      const auto i = static_cast<std::size_t>(constraint.contact);
      if (!ChangeState(constraint.inequality, point, i, &next)) return std::nullopt;
    }
    const double slow = tolerances::kRootOfRounding * Distance(from, point);
    if (kept && !StickWhereAtRest(nearest.x, slow, &next)) return point;
    point = std::move(next);
  }
  return std::nullopt;
}

bool IncrementSolver::ChangeState(Inequality failed, const PathPoint& point, std::size_t i, PathPoint* next) const {
  ContactState& state = next->states[i];
  switch (failed) {
    case Inequality::kGap:
      state = contacts_[i]->Frictional() ? ContactState::kStick : ContactState::kClosed;
      if (!next->patches.empty() && next->patches[i] == kNearestPatch)
        next->patches[i] = contacts_[i]->PatchAt(point.u, point.s);
      return true;
    case Inequality::kNormalReaction: state = ContactState::kOpen; return true;
    case Inequality::kConePlus:
      if (state != ContactState::kOpen) state = ContactState::kSlipPlus;
      return true;
    case Inequality::kConeMinus:
      if (state != ContactState::kOpen) state = ContactState::kSlipMinus;
      return true;
    case Inequality::kSlip:
    case Inequality::kTotalSlip:
      if (state != ContactState::kOpen) state = ContactState::kStick;
      return true;
    case Inequality::kPatchBegin:
    case Inequality::kPatchEnd: break;
  }
  next->patches[i] += failed == Inequality::kPatchEnd ? 1 : -1;
  return contacts_[i]->HasPatch(next->patches[i]);
}

IncrementTrial IncrementSolver::SolvePredicted(const PathPoint& from, const IncrementGoal& goal,
                                               const RegularisationSchedule& schedule) {
  IncrementTrial trial;
  const std::optional<PathPoint> predicted = Predict(from, goal);
  if (!predicted) return trial;
  std::vector<int> working_set = TouchingAt(from);
  const std::vector<int> touching = TouchingAt(*predicted);
  working_set.insert(working_set.end(), touching.begin(), touching.end());
  std::sort(working_set.begin(), working_set.end());
  working_set.erase(std::unique(working_set.begin(), working_set.end()), working_set.end());
  IncrementProblem problem(structure_, contacts_, from, working_set, goal);
  trial.variables = static_cast<int>(problem.NumVariables());
  trial.constraints = static_cast<int>(problem.NumConstraints());
  trial.predicted = true;
  RegularisationSchedule at_once = schedule;
  at_once.initial = schedule.minimum;
  if (working_set.empty()) at_once.initial = at_once.minimum = 0.0;
  trial.regularisation = at_once.minimum * goal.length * goal.length;
  problem.SetRegularisation(at_once.minimum);
  std::optional<PrimalDual> point = problem.CentralPoint(*predicted, kBarrierAtOnce);
  if (point && Follow(&problem, at_once, &*point, &trial)) PolishActiveSet(from, problem, goal, &trial);
  fprintf(stderr, "predicted: ws %zu touching %zu central %d status %d it %d exact %d dist %g\n", working_set.size(),
          touching.size(), point.has_value(), (int)trial.status, trial.iterations, trial.exact,
          trial.exact ? Distance(trial.point, *predicted) : -1.0);
  if (trial.status == SolveStatus::kSolved && !trial.exact) trial.status = SolveStatus::kFailed;
  return trial;
}

std::vector<int> IncrementSolver::TouchingAt(const PathPoint& point) const {
  std::vector<int> touching;
  for (std::size_t i = 0; i < point.states.size(); ++i)
    if (point.states[i] != ContactState::kOpen) touching.push_back(static_cast<int>(i));
  return touching;
}

bool IncrementSolver::Follow(IncrementProblem* problem, const RegularisationSchedule& schedule, PrimalDual* point,
                             IncrementTrial* trial) {
  for (double eps = schedule.initial;; eps = std::max(schedule.minimum, schedule.factor * eps)) {
    problem->SetRegularisation(eps);
    const SolveOutcome outcome =
        solver_->Solve(*problem, trial->predicted ? kBarrierAtOnce : kBarrierShare * eps, point);
    trial->iterations += outcome.iterations;
    trial->status = outcome.status;
    if (outcome.status != SolveStatus::kSolved) return false;
    if (eps > schedule.minimum * kSameEps) continue;
    trial->point = problem->Point(point->x);
    return true;
  }
}

void IncrementSolver::PolishActiveSet(const PathPoint& from, const IncrementProblem& problem, const IncrementGoal& goal,
                                      IncrementTrial* trial) {
  // Redundant reactions, of which an interior point is as large as it may be, change as little as they can.
  IncrementTrial least = *trial;
  least.point.rn = from.rn;
  least.point.rt = from.rt;
  if (PolishActiveSet(from, problem.UnconstrainedMinimiser(), goal.length, &least)) {
    *trial = std::move(least);
    return;
  }
  if (PolishActiveSet(from, problem.UnconstrainedMinimiser(), goal.length, trial)) return;
  // Next to a corner the nonlinear solver may stop where the minimiser is not reached: the equilibrium there is what it
  // found.
  Eigen::VectorXd here(trial->point.u.size() + 1);
  here << trial->point.u, trial->point.s;
  PolishActiveSet(from, here, goal.length, trial);
}

bool IncrementSolver::PolishActiveSet(const PathPoint& from, const Eigen::VectorXd& wanted, double length,
                                      IncrementTrial* trial) {
  const Eigen::VectorXd reference = SlipReferences(contacts_, from);
  std::vector<int> patches = trial->point.patches;
  system_.SetStates(trial->point.states, reference, patches);
  std::vector<Constraint> active;
  Eigen::VectorXd start = system_.Pack(trial->point);
  for (int change = 0; change <= kMaxActiveSetChanges; ++change) {
    const NearestPoint nearest = FindNearestPoint(&system_, start, wanted);
    if (!nearest.converged) return false;
    PathPoint exact = system_.Unpack(nearest.x);
    if (Distance(exact, trial->point) > kSamePoint * length) return false;
    // An inequality that fails is active at the minimum: it becomes an equation. The end of a patch is no inequality:
    // the contact goes on on the next one.
    const std::size_t before = active.size();
    bool passed = false;
    for (const Constraint& constraint : system_.Inequalities()) {
      if (system_.Value(constraint, nearest.x) >= -tolerances::kBroken * system_.UnitOf(constraint)) continue;
      const auto i = static_cast<std::size_t>(constraint.contact);
      if (!KeepsPatch(constraint.inequality)) {
        active.push_back(constraint);
        // The equation is by the unknowns of one patch.
        if (contacts_[i]->Deformable() && patches[i] == kNearestPatch) {
          patches[i] = contacts_[i]->PatchAt(exact.u, exact.s);
          passed = true;
        }
        continue;
      }
      patches[i] += constraint.inequality == Inequality::kPatchEnd ? 1 : -1;
      if (!contacts_[i]->HasPatch(patches[i])) return false;
      passed = true;
    }
    if (passed) {
      system_.SetStates(trial->point.states, reference, patches);
    } else if (active.size() == before) {
      // Slip held at zero motion: the contact stuck, and is about to slip.
      for (const Constraint& constraint : active)
        if (IsOfSlip(constraint.inequality))
          exact.states[static_cast<std::size_t>(constraint.contact)] = ContactState::kStick;
      trial->point = std::move(exact);
      trial->exact = true;
      IncrementTrial stuck = *trial;
      const double slow = tolerances::kRootOfRounding * Distance(from, trial->point);
      StickWhereAtRest(nearest.x, tolerances::kRounding, &trial->point);
      if (StickWhereAtRest(nearest.x, slow, &stuck.point) && PolishActiveSet(from, wanted, length, &stuck))
        *trial = std::move(stuck);
      return true;
    }
    system_.SetActive(active);
    start = nearest.x;
  }
  return false;
}

// An increment may end right at a corner, and rounding alone would tell whether a contact there has stuck or slipped.
// Whether some contact slips by name and has moved by no more than `slip`: its state in *point becomes stick.
bool IncrementSolver::StickWhereAtRest(const Eigen::VectorXd& x, double slip, PathPoint* point) const {
  bool some = false;
  for (const Constraint& constraint : system_.Inequalities()) {
    ContactState& state = point->states[static_cast<std::size_t>(constraint.contact)];
    if (!IsOfSlip(constraint.inequality) || !Slips(state)) continue;
    if (system_.Value(constraint, x) > slip) continue;
    state = ContactState::kStick;
    some = true;
  }
  return some;
}

}  // namespace contact_path
