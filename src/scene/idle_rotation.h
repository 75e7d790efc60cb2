// Bodies whose rotation nothing depends on.
#ifndef CONTACT_PATH_SRC_SCENE_IDLE_ROTATION_H_
#define CONTACT_PATH_SRC_SCENE_IDLE_ROTATION_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// Fixes the rotation of each body on which no moment can act: a smooth disc, of circles about its reference point
// without friction alone, in a scene where no friction changes. Nothing would determine it. The bodies of the request
// are nodes; contacts are expanded.
void FixIdleRotations(TraceRequest* request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_IDLE_ROTATION_H_
