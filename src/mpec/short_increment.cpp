#include "contact_path/mpec/short_increment.h"

namespace contact_path {
namespace {

constexpr double kRateLength = 1e-5;  // scaled length of an increment that stands for a rate

}  // namespace

std::vector<std::vector<ContactState>> StatesOfShortIncrements(const PathPoint& point, const Eigen::VectorXd& direction,
                                                               IncrementSolver* solver) {
  std::vector<std::vector<ContactState>> found;
  for (const double dissipation : {0.0, 0.5, 1.0}) {
    const IncrementTrial trial =
        solver->Solve(point, {kRateLength, direction, dissipation, 1.0}, RegularisationSchedule());
    if (trial.status == SolveStatus::kSolved) found.push_back(trial.point.states);
  }
  return found;
}

}  // namespace contact_path
