#include "contact_path/branch/bifurcation_branches.h"

#include <algorithm>

#include "branch/branch_finder.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Whether everything that slides goes on in its sense.
bool SlidesOn(const FixedModeSystem& system, const Eigen::VectorXd& x, const Eigen::VectorXd& first) {
  const std::vector<Limit> limits = system.mode_limits().All();
  return std::all_of(limits.begin(), limits.end(), [&](const Limit& limit) {
    return !system.IsOfRate(limit) || system.mode_limits().Rate(limit, x, first) >= -tolerances::kRate;
  });
}

}  // namespace

std::vector<Branch> BifurcationBranches(const ModeArc& arc, const Crossing& crossing, const PathParameter& parameter) {
  const FixedModeSystem& system = arc.system();
  const PathPoint point = system.Unpack(crossing.x);
  const Eigen::VectorXd arrival = crossing.along.first.head(arc.NumMotion());
  const auto branch_along = [&](const Eigen::VectorXd& first, const Eigen::VectorXd& second) {
    return BranchAlong(first, second, system.laws(), point.modes, point, parameter, arrival);
  };
  std::vector<Branch> branches = {branch_along(crossing.along.first, crossing.along.second)};
  branches.front().turn = 0.0;  // the arc cosine of 1 less rounding is not
  for (const CurveDerivatives& across : crossing.across)
    for (const double sense : {1.0, -1.0})
      if (const Eigen::VectorXd first = sense * across.first; SlidesOn(system, crossing.x, first))
        branches.push_back(branch_along(first, across.second));
  return branches;
}

}  // namespace contact_path
