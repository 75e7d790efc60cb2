#include "contact_path/mpec/short_increment.h"

#include "contact_path/tolerances.h"

namespace contact_path {
std::vector<std::vector<ContactState>> StatesOfShortIncrements(const PathPoint& point, const Eigen::VectorXd& direction,
                                                               IncrementSolver* solver) {
  std::vector<std::vector<ContactState>> found;
  for (const double dissipation : {0.0, 0.5, 1.0}) {
    const IncrementTrial trial =
        solver->Solve(point, {tolerances::kShort, direction, dissipation, 1.0}, RegularisationSchedule());
    if (trial.status == SolveStatus::kSolved) found.push_back(trial.point.states);
  }
  return found;
}

}  // namespace contact_path
