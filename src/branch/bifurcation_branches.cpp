#include "contact_path/branch/bifurcation_branches.h"

#include <algorithm>
#include <cmath>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Whether everything that slides goes on in its sense.
bool SlidesOn(const FixedModeSystem& system, const Eigen::VectorXd& x, const Eigen::VectorXd& first) {
  const std::vector<Limit> limits = system.OfModes().All();
  return std::all_of(limits.begin(), limits.end(), [&](const Limit& limit) {
    return !system.IsOfRate(limit) || system.OfModes().Rate(limit, x, first) >= -tolerances::kRate;
  });
}

}  // namespace

std::vector<Branch> BifurcationBranches(const ModeArc& arc, const Crossing& crossing, const PathParameter& parameter) {
  const FixedModeSystem& system = arc.system();
  const Eigen::Index motion = arc.NumMotion();
  const PathPoint point = system.Unpack(crossing.x);
  const auto branch_along = [&](const Eigen::VectorXd& first, const Eigen::VectorXd& second) {
    Branch branch;
    branch.modes = point.modes;
    branch.direction = first.head(motion);
    branch.first = first;
    branch.second = second;
    branch.load_rate = first[motion - 1];
    branch.parameter_rate = parameter.Rate(first, motion);
    branch.dissipation_rate = DissipationRate(system.laws(), branch.modes, point, branch.direction);
    branch.turn = std::acos(std::clamp(branch.direction.dot(crossing.along.first.head(motion)), -1.0, 1.0));
    return branch;
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
