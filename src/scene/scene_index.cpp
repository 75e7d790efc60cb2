#include "contact_path/scene/scene_index.h"

namespace contact_path {

SceneIndex::SceneIndex(const Scene& scene) : elements_(scene) {
  nodes_.reserve(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) nodes_.emplace(scene.nodes[i].name, i);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) materials_.emplace(scene.materials[i].name, i);
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) surfaces_.emplace(scene.surfaces[i].name, i);
  obstacles_.reserve(scene.obstacles.size());
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) obstacles_.emplace(scene.obstacles[i].name, i);
  contacts_.reserve(scene.contacts.size());
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) contacts_.emplace(scene.contacts[i].Name(), i);
  supported_ = SupportedNodes(scene);
  for (std::size_t i = 0; i < supported_.size(); ++i) supports_.emplace(scene.nodes[supported_[i].node].name, i);
  for (const TouchedBoundary& boundary : TouchedBoundaries(scene))
    boundaries_.emplace(boundary.name, boundaries_.size());
}

}  // namespace contact_path
