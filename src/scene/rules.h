// The rules of nodes, elements and materials, and of what stands for several nodes: beams, groups, what acts on groups.
#ifndef CONTACT_PATH_SRC_SCENE_RULES_H_
#define CONTACT_PATH_SRC_SCENE_RULES_H_

#include "scene/checker.h"

namespace contact_path {

// All that Expand() (scene/expand.h) asks of the beams of a request.
void CheckBeams(Checker* checker);

// All that Expand() asks of groups, loads and contacts. The request of the checker has expanded beams, the loads and
// contacts of the user, and num_nodes nodes that are listed.
void CheckGroups(Checker* checker);

void CheckStructure(Checker* checker);

// Whether these are the names of two nodes that are not at the same point.
void CheckTwoNodes(Checker* checker, const KeyPath& key, const std::vector<std::string>& nodes);

void CheckMaterials(Checker* checker);

// What the description of the fields does not tell. sound: the fields are. path: of the solid.
void CheckSolid(const KeyPath& path, const Solid& solid, bool sound, Checker* checker);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_RULES_H_
