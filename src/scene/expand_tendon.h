// A tendon with friction at its eyes, as it is traced.
#ifndef CONTACT_PATH_SRC_SCENE_EXPAND_TENDON_H_
#define CONTACT_PATH_SRC_SCENE_EXPAND_TENDON_H_

#include <cstddef>
#include <string>
#include <unordered_map>

#include "contact_path/scene/scene.h"

namespace contact_path {

// A tendon with friction becomes pieces from node to node, which share its length at rest as they share its length: the
// first in its place, the others behind all tendons. At each eye a node follows whose x grows by what slides through
// the eye to the next piece, and a contact of that node with the eye. A tendon that is not sound stays as it is.
void ExpandTendon(std::size_t place, const std::unordered_map<std::string, std::size_t>& nodes, Scene* scene);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_EXPAND_TENDON_H_
