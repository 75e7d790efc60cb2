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

// With a larger eps the relaxed products leave room to leave the branch for another one: arch19 fell off its ceilings.
constexpr double kLargestAtOnce = 1e-8;

constexpr double kSameEps = 1.0 + tolerances::kEqual;

}  // namespace

IncrementSolver::IncrementSolver(const Structure& structure, const ContactPairs& contacts, NonlinearSolver* solver)
    : structure_(structure), contacts_(contacts), solver_(solver), system_(structure, contacts), tracker_(contacts) {}

IncrementTrial IncrementSolver::Solve(const PathPoint& from, const IncrementGoal& goal,
                                      const RegularisationSchedule& schedule) {
  std::vector<std::size_t> included = tracker_.InReach(from.u, from.s, kLongestIncrement * goal.length);
  // Past the end of its surface a node would meet the prolongation of the last patch.
  included.erase(
      std::remove_if(included.begin(), included.end(),
                     [&](std::size_t i) {
                       return !contacts_[i]->HasPatch(contacts_[i]->KnownPatch(from.u, from.s, from.Patch(i)));
                     }),
      included.end());
  int iterations = 0;
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
  if (regularised && schedule.warm_start && schedule.minimum <= kLargestAtOnce && last_working_set_ == working_set &&
      last_.x.size() == trial.variables && last_.multipliers.size() == trial.constraints) {
    RegularisationSchedule at_once = schedule;
    at_once.initial = schedule.minimum;
    PrimalDual point = last_;
    trial.warm_start = true;
    if (Follow(&problem, at_once, &point, &trial)) {
      PolishActiveSet(from, problem, goal, &trial);
      if (trial.exact) return Keep(working_set, std::move(point), std::move(trial));
    }
    if (trial.status == SolveStatus::kCancelled) return trial;
    trial.warm_start = false;
  }

  PrimalDual point;
  point.x = problem.StartingPoint(goal.direction);
  RegularisationSchedule wanted = schedule;
  if (!regularised) wanted.initial = wanted.minimum = 0.0;
  if (!Follow(&problem, wanted, &point, &trial)) return trial;
  PolishActiveSet(from, problem, goal, &trial);
  return Keep(working_set, std::move(point), std::move(trial));
}

bool IncrementSolver::Follow(IncrementProblem* problem, const RegularisationSchedule& schedule, PrimalDual* point,
                             IncrementTrial* trial) {
  for (double eps = schedule.initial;; eps = std::max(schedule.minimum, schedule.factor * eps)) {
    problem->SetRegularisation(eps);
    const SolveOutcome outcome = solver_->Solve(*problem, kBarrierShare * eps, point);
    trial->iterations += outcome.iterations;
    trial->status = outcome.status;
    if (outcome.status != SolveStatus::kSolved) return false;
    if (eps > schedule.minimum * kSameEps) continue;
    trial->point = problem->Point(point->x);
    return true;
  }
}

IncrementTrial IncrementSolver::Keep(const std::vector<int>& working_set, PrimalDual point, IncrementTrial trial) {
  last_working_set_ = working_set;
  last_ = std::move(point);
  return trial;
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
