#include "contact_path/branch/bifurcation_branches.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Whether every contact that slides goes on in its sense.
bool SlidesOn(const FixedStateSystem& system, const Eigen::VectorXd& x, const Eigen::VectorXd& first) {
  const std::vector<Constraint> constraints = system.Inequalities();
  return std::all_of(constraints.begin(), constraints.end(), [&](const Constraint& constraint) {
    return constraint.inequality != Inequality::kSlip || system.Rate(constraint, x, first) >= -tolerances::kLevel;
  });
}

}  // namespace

std::vector<Branch> BifurcationBranches(SmoothArc* arc, const ContactPairs& contacts, const Eigen::VectorXd& before,
                                        const CurvePoint& at) {
  const FixedStateSystem& system = arc->system();
  const Eigen::Index motion = arc->NumMotion();
  const PathPoint point = system.Unpack(at.x);
  const auto branch_along = [&](const Eigen::VectorXd& first, const Eigen::VectorXd& second) {
    Branch branch;
    branch.states = system.states();
    branch.patches = point.patches;
    branch.direction = first.head(motion);
    branch.first = first;
    branch.second = second;
    branch.load_rate = first[motion - 1];
    branch.dissipation_rate = DissipationRate(contacts, branch.states, point, branch.direction);
    branch.turn = std::acos(std::clamp(branch.direction.dot(at.first.head(motion)), -1.0, 1.0));
    return branch;
  };
  std::vector<Branch> branches = {branch_along(at.first, at.second)};
  branches.front().turn = 0.0;  // the arc cosine of 1 less rounding is not
  if (const std::optional<Crossing> crossing = arc->FindCrossing(before, at.x, at.first))
    for (const double sense : {1.0, -1.0})
      if (const Eigen::VectorXd first = sense * crossing->first; SlidesOn(system, at.x, first))
        branches.push_back(branch_along(first, crossing->second));
  return branches;
}

}  // namespace contact_path
