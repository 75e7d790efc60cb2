// Other forces of the laws that hold the same configuration under the same load.
#ifndef CONTACT_PATH_BRANCH_FORCE_REDISTRIBUTION_H_
#define CONTACT_PATH_BRANCH_FORCE_REDISTRIBUTION_H_

#include <vector>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/law/laws.h"

namespace contact_path {

struct ForceRedistributions {
  std::vector<PathPoint> points;  // the given point with other forces; without the given point itself
  bool complete = true;           // false: there are more
};

// Equation (1), phi(u, s) = T r, tells only the sum of the forces on the dofs of a node. Where more laws act there, or
// their cones have more rays, than it has free components, the forces that it can have within all cones are a convex
// polygon (or more): they can change while nothing moves. Each face of the polygon belongs to states of the laws there
// (a contact without reaction may open, a contact at the edge of its cone may slip). The points have the mean of the
// vertices of each face that the forces of `point` are not in; of several such nodes, all combinations.
// point: scaled, an equilibrium. tolerance: what has moved no farther from its limit acts, and no larger force counts
// as zero.
ForceRedistributions FindForceRedistributions(const Laws& laws, const PathPoint& point,
                                              const ActiveSetTolerance& tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_FORCE_REDISTRIBUTION_H_
