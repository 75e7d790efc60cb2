// The parts of a scene whose forces an increment tells: supports, obstacles and surfaces.
#ifndef CONTACT_PATH_SCENE_REACTING_PARTS_H_
#define CONTACT_PATH_SCENE_REACTING_PARTS_H_

#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// A node with a fixed component.
struct SupportedNode {
  std::size_t node = 0;  // place in the list of the scene
  bool x = false;        // which components are fixed
  bool y = false;
  bool rotation = false;  // only of a node that a beam turns
};

// In the order of the nodes. scene: expanded (scene/expand.h).
std::vector<SupportedNode> SupportedNodes(const Scene& scene);

// What the candidates of a scene may touch.
struct TouchedBoundary {
  std::string name;
  bool is_surface = false;
  std::size_t place = 0;  // in the list of obstacles, or of surfaces
};

// Obstacles, then surfaces, that have contact candidates, in the order of the scene. scene: expanded.
std::vector<TouchedBoundary> TouchedBoundaries(const Scene& scene);

// By contact candidate, in scene order: which of these boundaries it may touch. boundaries: TouchedBoundaries(scene).
std::vector<std::size_t> BoundaryOfContacts(const Scene& scene, const std::vector<TouchedBoundary>& boundaries);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_REACTING_PARTS_H_
