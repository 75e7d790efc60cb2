// The rules of materials and of the meshes of solids.
#ifndef CONTACT_PATH_SRC_SCENE_SOLID_RULES_H_
#define CONTACT_PATH_SRC_SCENE_SOLID_RULES_H_

#include "scene/checker.h"

namespace contact_path {

void CheckMaterials(Checker* checker);

// What the description of the fields does not tell. sound: the fields are. path: of the solid.
void CheckSolid(const KeyPath& path, const Solid& solid, bool sound, Checker* checker);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_SOLID_RULES_H_
