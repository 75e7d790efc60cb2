// The elements of a scene.
#ifndef CONTACT_PATH_STRUCTURE_SCENE_ELEMENTS_H_
#define CONTACT_PATH_STRUCTURE_SCENE_ELEMENTS_H_

#include <memory>
#include <vector>

#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/element.h"

namespace contact_path {

struct PlacedElement {
  std::unique_ptr<const Element> element;
  std::vector<int> nodes;  // of the scene, for the nodes 0, 1, ... of the element
};

// Bars that bear in one sense alone: elements, for what elements bear at a point, or none, since they are laws.
enum class OneSided { kElements, kLaws };

// In the order of the scene. `scene` must be sound, index its own. reference: x0, y0, x1, ... (scene/configuration.h).
std::vector<PlacedElement> MakeElements(const Scene& scene, const SceneIndex& index,
                                        const std::vector<double>& reference, OneSided bars = OneSided::kLaws);

// Of one solid of the scene, in the order of its nodes.
std::vector<PlacedElement> MakeSolidElements(const Solid& solid, const Scene& scene, const SceneIndex& index,
                                             const std::vector<double>& reference);

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_SCENE_ELEMENTS_H_
