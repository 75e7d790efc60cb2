// The rules of nodes and elements.
#ifndef CONTACT_PATH_SRC_SCENE_STRUCTURE_RULES_H_
#define CONTACT_PATH_SRC_SCENE_STRUCTURE_RULES_H_

#include "scene/checker.h"

namespace contact_path {

void CheckStructure(Checker* checker);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_STRUCTURE_RULES_H_
