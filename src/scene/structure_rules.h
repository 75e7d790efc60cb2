// The rules of nodes and elements.
#ifndef CONTACT_PATH_SRC_SCENE_STRUCTURE_RULES_H_
#define CONTACT_PATH_SRC_SCENE_STRUCTURE_RULES_H_

#include "scene/checker.h"

namespace contact_path {

void CheckStructure(Checker* checker);

// Whether these are the names of two nodes that are not at the same point.
void CheckTwoNodes(Checker* checker, const KeyPath& key, const std::vector<std::string>& nodes);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_STRUCTURE_RULES_H_
