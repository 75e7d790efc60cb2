// The branches from a bifurcation of a smooth arc.
#ifndef CONTACT_PATH_BRANCH_BIFURCATION_BRANCHES_H_
#define CONTACT_PATH_BRANCH_BIFURCATION_BRANCHES_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/mode_arc.h"

namespace contact_path {

// The arc itself, which goes on, comes first. Then both directions of each path that crosses the arc, without those
// that let a law slide back.
std::vector<Branch> BifurcationBranches(const ModeArc& arc, const Crossing& crossing, const PathParameter& parameter);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_BIFURCATION_BRANCHES_H_
