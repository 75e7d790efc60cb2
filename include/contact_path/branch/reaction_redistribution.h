// Other reactions that hold the same configuration under the same load.
#ifndef CONTACT_PATH_BRANCH_REACTION_REDISTRIBUTION_H_
#define CONTACT_PATH_BRANCH_REACTION_REDISTRIBUTION_H_

#include <vector>

#include "contact_path/branch/active_set_tolerance.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"

namespace contact_path {

struct ReactionRedistributions {
  std::vector<PathPoint> points;  // the given point with other rn and rt; without the given point itself
  bool complete = true;           // false: there are more
};

// Equation (1), phi(u, s) = T r, tells only the sum of the reactions at each node. Where more contacts touch a node, or
// their cones have more to give, than its free components need, the reactions that it can have within all cones are a
// convex polygon (or more): they can change while nothing moves. Each face of the polygon belongs to states of the
// contacts there (a contact without reaction may open, a contact at the edge of its cone may slip). The points have the
// mean of the vertices of each face that the reactions of `point` are not in; of several such nodes, all combinations.
// By the total law of friction, a contact that has slipped has one edge of its cone only; a friction coefficient of
// rounding counts as none.
// point: scaled, an equilibrium. tolerance: a contact with no larger gap touches, and no larger reaction counts as
// zero.
ReactionRedistributions FindReactionRedistributions(const ContactPairs& contacts, const PathPoint& point,
                                                    const ActiveSetTolerance& tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_REACTION_REDISTRIBUTION_H_
