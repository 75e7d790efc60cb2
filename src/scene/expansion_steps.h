// Steps of Expand() (scene/expand.h).
#ifndef CONTACT_PATH_SRC_SCENE_EXPANSION_STEPS_H_
#define CONTACT_PATH_SRC_SCENE_EXPANSION_STEPS_H_

#include <cstddef>
#include <string>
#include <unordered_map>

#include "contact_path/scene/scene.h"

namespace contact_path {

// A tendon with friction becomes pieces from node to node, which share its length at rest as they share its length: the
// first in its place, the others behind all tendons. At each eye a node follows whose x grows by what slides through
// the eye to the next piece, and a contact of that node with the eye. A tendon that is not sound stays as it is.
void ExpandTendon(std::size_t place, const std::unordered_map<std::string, std::size_t>& nodes, Scene* scene);

// Fixes the rotation of each body on which no moment can act: a smooth disc, of circles about its reference point
// without friction alone, in a scene where no friction changes. Nothing would determine it. The bodies of the request
// are nodes; contacts are expanded.
void FixIdleRotations(TraceRequest* request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_EXPANSION_STEPS_H_
