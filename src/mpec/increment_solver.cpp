#include "contact_path/mpec/increment_solver.h"

#include <algorithm>
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

constexpr int kMaxActiveSetChanges = 8;

// Whether the limit is of what slides, which is held beyond it.
bool IsOfSliding(const LimitRule& rule, const StateRule& state) {
  return state.slides && !rule.OfForces() && !rule.OfPiece();
}

// Barrier parameter of a start that is nearly the solution: it counts as solved.
constexpr double kBarrierAtOnce = 0.5 * tolerances::kAccepted;

}  // namespace

IncrementSolver::IncrementSolver(const Structure& structure, const ContactPairs& contacts, const Laws& laws,
                                 NonlinearSolver* solver)
    : structure_(structure),
      contacts_(contacts),
      laws_(laws),
      solver_(solver),
      system_(structure, laws),
      tracker_(laws) {}

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
  included.erase(std::remove_if(included.begin(), included.end(),
                                [&](std::size_t i) {
                                  return i < contacts_.size() && !contacts_[i]->HasPatch(contacts_[i]->KnownPatch(
                                                                     from.u, from.s, from.modes[i].piece));
                                }),
                 included.end());
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (!laws_[i].CanBeIdle()) included.insert(std::lower_bound(included.begin(), included.end(), i), i);
  for (;;) {
    const std::vector<int> working_set(included.begin(), included.end());
    IncrementTrial trial = SolveWith(from, working_set, goal, schedule, nullptr);
    trial.iterations += iterations;
    if (trial.status != SolveStatus::kSolved) return trial;
    const std::size_t before = included.size();
    for (const std::size_t i : tracker_.InReach(trial.point.u, trial.point.s, 0.0)) {
      const auto place = std::lower_bound(included.begin(), included.end(), i);
      const double gap = i < contacts_.size() ? contacts_[i]->Gap(trial.point.u, trial.point.s,
                                                                  contacts_[i]->PatchAt(trial.point.u, trial.point.s))
                                              : laws_[i].Reach(trial.point.u, trial.point.s);
      if ((place == included.end() || *place != i) && gap < 0.0) included.insert(place, i);
    }
    if (included.size() == before) return trial;
    iterations = trial.iterations;
  }
}

IncrementTrial IncrementSolver::SolveWith(const PathPoint& from, const std::vector<int>& working_set,
                                          const IncrementGoal& goal, RegularisationSchedule schedule,
                                          const PathPoint* predicted) {
  IncrementProblem problem(structure_, contacts_, laws_, from, working_set, goal);
  IncrementTrial trial;
  trial.variables = static_cast<int>(problem.NumVariables());
  trial.constraints = static_cast<int>(problem.NumConstraints());
  trial.predicted = predicted != nullptr;
  if (trial.predicted) schedule.initial = schedule.minimum;
  if (working_set.empty()) schedule.initial = schedule.minimum = 0.0;
  trial.regularisation = schedule.minimum * goal.length * goal.length;
  std::optional<PrimalDual> point = PrimalDual{problem.StartingPoint(goal.direction), {}, {}};
  if (trial.predicted) {
    problem.SetRegularisation(schedule.minimum);
    point = problem.CentralPoint(*predicted, kBarrierAtOnce);
  }
  if (point && Follow(&problem, schedule, &*point, &trial)) MakeExact(from, problem, goal, &trial);
  return trial;
}

IncrementTrial IncrementSolver::SolvePredicted(const PathPoint& from, const IncrementGoal& goal,
                                               const RegularisationSchedule& schedule) {
  IncrementTrial trial;
  std::vector<int> working_set;
  const auto touches = [this](const PathPoint& point, std::size_t i) { return !laws_[i].In(point.modes[i]).idle; };
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (touches(from, i)) working_set.push_back(static_cast<int>(i));
  const Eigen::VectorXd wanted =
      IncrementProblem(structure_, contacts_, laws_, from, working_set, goal).UnconstrainedMinimiser();
  const std::optional<PathPoint> predicted = Exact(from, wanted, from, kLongestIncrement * goal.length, false);
  if (!predicted) return trial;
  working_set.clear();
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (touches(from, i) || touches(*predicted, i)) working_set.push_back(static_cast<int>(i));
  trial = SolveWith(from, working_set, goal, schedule, &*predicted);
  if (trial.status == SolveStatus::kSolved && !trial.exact) trial.status = SolveStatus::kFailed;
  return trial;
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
    if (eps > schedule.minimum * (1.0 + tolerances::kEqual)) continue;
    trial->point = problem->Point(point->x);
    return true;
  }
}

void IncrementSolver::MakeExact(const PathPoint& from, const IncrementProblem& problem, const IncrementGoal& goal,
                                IncrementTrial* trial) {
  // Redundant reactions, of which an interior point is as large as it may be, change as little as they can.
  PathPoint least = trial->point;
  least.forces = from.forces;
  const Eigen::VectorXd wanted = problem.UnconstrainedMinimiser();
  std::optional<PathPoint> exact = Exact(from, wanted, least, kSamePoint * goal.length, true);
  if (!exact) exact = Exact(from, wanted, trial->point, kSamePoint * goal.length, true);
  // Next to a corner the nonlinear solver may stop where the minimiser is not reached: the equilibrium there is what it
  // found.
  Eigen::VectorXd here(wanted.size());
  here << trial->point.u, trial->point.s;
  if (!exact) exact = Exact(from, here, trial->point, kSamePoint * goal.length, true);
  if (!exact) return;
  trial->point = *std::move(exact);
  trial->exact = true;
}

std::optional<PathPoint> IncrementSolver::Exact(const PathPoint& from, const Eigen::VectorXd& wanted, PathPoint point,
                                                double reach, bool corners) {
  const Eigen::VectorXd reference = laws_.ReferencesAt(from);
  const PathPoint guess = point;
  Modes modes = guess.modes;
  std::vector<bool> changed(modes.size(), false);
  std::vector<Limit> active;
  for (int change = 0; change <= kMaxActiveSetChanges; ++change) {
    system_.SetModes(modes, reference);
    system_.SetActive(active);
    const NearestPoint nearest = FindNearestPoint(&system_, system_.Pack(point), wanted);
    if (!nearest.converged) return std::nullopt;
    point = system_.Unpack(nearest.x);
    if (Distance(guess, point) > reach) return std::nullopt;
    // Of what has not moved, rounding alone would tell whether it has stuck or slipped.
    const double slow = tolerances::kRootOfRounding * Distance(from, point);
    bool kept = true;
    int last = -1;  // law that has changed
    for (const Limit& limit : system_.mode_limits().All()) {
      if (limit.law == last) continue;
      const auto i = static_cast<std::size_t>(limit.law);
      const LimitRule& rule = system_.mode_limits().RuleOf(limit);
      const bool rests = IsOfSliding(rule, laws_[i].In(modes[i])) && !changed[i];
      const double least = rests ? slow : -tolerances::kResidual * rule.unit;
      if (system_.Value(limit, nearest.x) >= least) continue;
      const bool held = std::find(active.begin(), active.end(), limit) != active.end();
      if (held) continue;
      kept = false;
      last = limit.law;
      if (rule.OfPiece()) {
        modes[i] = laws_[i].Next(modes[i], limit.id);
        if (!laws_[i].Exists(modes[i])) return std::nullopt;
        continue;
      }
      modes[i] = laws_[i].Known(point.u, point.s, modes[i]);
      // The state beyond it; where the law comes back from there, the corner between both.
      if (corners && changed[i])
        active.push_back(limit);
      else
        modes[i].state = rule.next;
      changed[i] = true;
    }
    if (!kept) continue;
    for (const Limit& limit : active)
      if (const auto i = static_cast<std::size_t>(limit.law);
          IsOfSliding(system_.mode_limits().RuleOf(limit), laws_[i].In(modes[i])))
        point.modes[i].state = laws_[i].In(modes[i]).held;
    return point;
  }
  return std::nullopt;
}

}  // namespace contact_path
