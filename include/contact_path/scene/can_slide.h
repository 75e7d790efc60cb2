// Whether friction can act on a contact candidate.
#ifndef CONTACT_PATH_SCENE_CAN_SLIDE_H_
#define CONTACT_PATH_SCENE_CAN_SLIDE_H_

#include <cmath>

#include "contact_path/scene/scene.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// Whether a node can move along an obstacle: one of its components that move, being free or moved as a support, has a
// share in the tangent by more than rounding. A contact that cannot slide is frictionless, whatever its coefficient.
// turns: the obstacle does, and its tangent with it.
inline bool CanSlide(bool x_moves, bool y_moves, const Obstacle& obstacle, bool turns = false) {
  if (turns || obstacle.shape != ObstacleShape::kHalfPlane) return x_moves || y_moves;        // its tangent turns
  const double share = std::hypot(x_moves ? obstacle.ny : 0.0, y_moves ? obstacle.nx : 0.0);  // t = (n_y, -n_x)
  return share > tolerances::kEqual * std::hypot(obstacle.nx, obstacle.ny);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_CAN_SLIDE_H_
