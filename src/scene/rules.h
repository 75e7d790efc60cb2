// The rules of a request: of nodes, elements and materials; of what stands for several nodes; of obstacles, contact
// candidates and the surfaces that these touch; of loads, motions and the program.
#ifndef CONTACT_PATH_SRC_SCENE_RULES_H_
#define CONTACT_PATH_SRC_SCENE_RULES_H_

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "contact_path/geometry/surface.h"
#include "scene/checker.h"

namespace contact_path {

// All that Expand() (scene/expand.h) asks of the beams and bodies of a request.
void CheckParts(Checker* checker);

// All that Expand() asks of groups, loads and contacts. The request of the checker has expanded beams, the loads and
// contacts of the user, and num_nodes nodes that are listed.
void CheckGroups(Checker* checker);

void CheckStructure(Checker* checker);

// Whether these are the names of two nodes that are not at the same point.
void CheckTwoNodes(Checker* checker, const KeyPath& key, const std::vector<std::string>& nodes);

void CheckMaterials(Checker* checker);

// What the description of the fields does not tell. sound: the fields are. path: of the solid.
void CheckSolid(const KeyPath& path, const Solid& solid, bool sound, Checker* checker);

// The obstacles with a shape that can be computed with, and their surfaces.
using UsableObstacles = std::unordered_map<const Obstacle*, std::unique_ptr<const Surface>>;
UsableObstacles CheckObstacles(Checker* checker);

// length: the characteristic length, 0 where it is not known.
void CheckContacts(const UsableObstacles& usable, double length, Checker* checker);

// The loads of the scene, and whether anything changes with the load factor. False: the loads are not sound.
bool CheckSceneLoads(Checker* checker);

// The motions of the scene, and the program. loads_are_sound: those of the scene.
void CheckProgram(bool loads_are_sound, Checker* checker);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_RULES_H_
