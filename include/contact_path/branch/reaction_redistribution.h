// Other reactions that hold the same configuration under the same load.
#ifndef CONTACT_PATH_BRANCH_REACTION_REDISTRIBUTION_H_
#define CONTACT_PATH_BRANCH_REACTION_REDISTRIBUTION_H_

#include <vector>

#include "contact_path/branch/active_set_tolerance.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"

namespace contact_path {

struct ReactionRedistributions {
  std::vector<PathPoint> points;  // as the given one, but for rn and rt; that itself is not among them
  bool complete = true;           // false: there are more
};

// Equation (1), phi(u, s) = T r, tells only the sum of the reactions at each node. Where more contacts touch a node, or
// their cones have more to give, than its free components need, the reactions that it can have within all cones are a
// convex polygon (or more): they can change while nothing moves. Each face of it belongs to states of the contacts
// there (a contact without reaction may open, one at the edge of its cone may slip). For each face that the reactions
// of `point` are not in: the mean of its vertices; of several such nodes, all combinations. point: scaled, an
// equilibrium; tolerance: scaled gap of what touches, and scaled force that counts as none.
ReactionRedistributions FindReactionRedistributions(const ContactPairs& contacts, const PathPoint& point,
                                                    const ActiveSetTolerance& tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_REACTION_REDISTRIBUTION_H_
