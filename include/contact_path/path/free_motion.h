// Which nodes nothing holds: by a mistake in the scene, or since part of the structure came free.
#ifndef CONTACT_PATH_PATH_FREE_MOTION_H_
#define CONTACT_PATH_PATH_FREE_MOTION_H_

#include <string>
#include <vector>

#include "contact_path/law/path_point.h"
#include "contact_path/path/model.h"

namespace contact_path {

// Nodes, ascending, that take part in a motion without resistance: the null space of the tangent stiffness at a fixed
// load factor, with supports held and every contact that carries more than `force` (scaled) stuck, or closed where it
// cannot rub. Of a null space of more than 64 dimensions, 64 motions are looked at.
std::vector<int> FreeNodes(const Model& model, const PathPoint& point, double force);

// "node b moves freely; b@floor touches", or "nodes a, b and 7 more move freely"; empty where no node does. Lists
// contacts of the nodes that move, and at most five names of a kind.
std::string FreeMotionText(const Model& model, const PathPoint& point, double force);

// For a start from which no branch leads: FreeMotionText() and the questions to ask, ": does the normal of floor point
// to the side where the node may be? is a contact or a support missing? is the friction of floor (0.5) too small?". The
// first question is asked where nodes that move touch obstacles, the last one where such an obstacle has friction.
// Where all candidates of what moves are open, the nearest is told with its gap [length] in place of the first and the
// last question. Empty where no node moves freely.
std::string FreeMotionQuestion(const Model& model, const PathPoint& point, double force);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_FREE_MOTION_H_
