// The rules for what stands for several nodes: beams, groups, and what acts on groups.
#ifndef CONTACT_PATH_SRC_SCENE_EXPANSION_RULES_H_
#define CONTACT_PATH_SRC_SCENE_EXPANSION_RULES_H_

#include "scene/checker.h"

namespace contact_path {

// All that Expand() (scene/expand.h) asks of the beams of a request.
void CheckBeams(Checker* checker);

// All that Expand() asks of groups, loads and contacts. The request of the checker has expanded beams, the loads and
// contacts of the user, and num_nodes nodes that are listed.
void CheckGroups(Checker* checker);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_EXPANSION_RULES_H_
