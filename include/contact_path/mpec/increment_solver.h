// One increment of Algorithm 3.2: the sequence of regularised problems, then the exact equations of the states found.
#ifndef CONTACT_PATH_MPEC_INCREMENT_SOLVER_H_
#define CONTACT_PATH_MPEC_INCREMENT_SOLVER_H_

#include <optional>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/path_point.h"
#include "contact_path/law/reach_tracker.h"
#include "contact_path/mpec/increment_problem.h"
#include "contact_path/mpec/nonlinear_program.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Sequence of the regularisation parameter: initial, initial x factor, ... down to minimum. Products of a length over S
// and a force over S, both scaled, so one schedule serves all increment lengths.
struct RegularisationSchedule {
  double initial = 1e-3;
  double factor = 1e-5;   // rho, 0..1
  double minimum = 1e-8;  // > 0
  // Sets out, at `minimum` at once, from where the contact states of the last increment lead, with multipliers: a few
  // iterations confirm or refuse the point. Where they refuse it, the schedule from `initial`.
  bool predicted = false;
};

struct IncrementTrial {
  SolveStatus status = SolveStatus::kFailed;
  PathPoint point;
  double regularisation = 0.0;  // smallest eps that was solved for, on products of scaled quantities
  bool predicted = false;       // set out from where the states of the last increment lead
  bool exact = false;           // point solves the unregularised equations of its states and keeps their inequalities
  int iterations = 0;           // of the nonlinear solver
  int variables = 0;            // of the last problem solved
  int constraints = 0;
};

class IncrementSolver {
 public:
  // An increment is never longer than this times the wanted length: longer ones are jumps. It bounds which candidates
  // can be reached: |du_n| <= |(du, ds)|.
  static constexpr double kLongestIncrement = 2.5;

  // All must outlive the solver.
  IncrementSolver(const Structure& structure, const ContactPairs& contacts, const Laws& laws, NonlinearSolver* solver);

  // From `from`, an equilibrium. Candidates out of reach are left out of the problem; where the gap of such a
  // candidate turns negative, the increment is solved again with the candidate.
  IncrementTrial Solve(const PathPoint& from, const IncrementGoal& goal, const RegularisationSchedule& schedule);

 private:
  // predicted: the point to set out from, or null.
  IncrementTrial SolveWith(const PathPoint& from, const std::vector<int>& working_set, const IncrementGoal& goal,
                           RegularisationSchedule schedule, const PathPoint* predicted);
  // Solves for one eps after another; *trial: status, iterations, and where solved the point. False where one fails.
  bool Follow(IncrementProblem* problem, const RegularisationSchedule& schedule, PrimalDual* point,
              IncrementTrial* trial);
  // One increment from where the contact states of `from` lead.
  IncrementTrial SolvePredicted(const PathPoint& from, const IncrementGoal& goal,
                                const RegularisationSchedule& schedule);
  // Replaces trial->point by the minimum of the objective on the exact equations of its states; otherwise by the exact
  // point that is nearest to trial->point.
  void MakeExact(const PathPoint& from, const IncrementProblem& problem, const IncrementGoal& goal,
                 IncrementTrial* trial);
  // The solution, nearest to `wanted`, of the equations of the states of `point`, which change where their inequalities
  // fail; nothing where that comes to no end, or farther than `reach` from the point. corners: the solution may lie
  // where a contact changes its state.
  std::optional<PathPoint> Exact(const PathPoint& from, const Eigen::VectorXd& wanted, PathPoint point, double reach,
                                 bool corners);

  const Structure& structure_;
  const ContactPairs& contacts_;
  const Laws& laws_;
  NonlinearSolver* solver_;
  FixedModeSystem system_;
  ReachTracker tracker_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_INCREMENT_SOLVER_H_
