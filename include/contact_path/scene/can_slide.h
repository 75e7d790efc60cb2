// Whether friction can act on a contact candidate.
#ifndef CONTACT_PATH_SCENE_CAN_SLIDE_H_
#define CONTACT_PATH_SCENE_CAN_SLIDE_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// Whether a node can move along an obstacle: one of its components that move, being free or moved as a support, has a
// share in the tangent by more than rounding. A contact that cannot slide is frictionless, whatever its coefficient.
// turns: the obstacle does, and its tangent with it.
bool CanSlide(bool x_moves, bool y_moves, const Obstacle& obstacle, bool turns = false);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_CAN_SLIDE_H_
