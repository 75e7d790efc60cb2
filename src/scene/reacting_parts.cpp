#include "contact_path/scene/reacting_parts.h"

#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "contact_path/scene/expand.h"

namespace contact_path {

std::vector<SupportedNode> SupportedNodes(const Scene& scene) {
  const std::vector<bool> turns = NodesThatTurn(scene);
  std::vector<SupportedNode> supports;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const SupportedNode support{i, node.fixed_x, node.fixed_y, node.fixed_rotation && turns[i]};
    if (support.x || support.y || support.rotation) supports.push_back(support);
  }
  return supports;
}

std::vector<TouchedBoundary> TouchedBoundaries(const Scene& scene) {
  std::unordered_set<std::string_view> obstacles, surfaces;
  for (const ContactCandidate& contact : scene.contacts) {
    if (contact.OnSurface())
      surfaces.insert(contact.surface);
    else
      obstacles.insert(contact.obstacle);
  }
  std::vector<TouchedBoundary> touched;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i)
    if (obstacles.count(scene.obstacles[i].name) > 0) touched.push_back({scene.obstacles[i].name, false, i});
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    if (surfaces.count(scene.surfaces[i].name) > 0) touched.push_back({scene.surfaces[i].name, true, i});
  return touched;
}

std::vector<std::size_t> BoundaryOfContacts(const Scene& scene, const std::vector<TouchedBoundary>& boundaries) {
  std::unordered_map<std::string_view, std::size_t> obstacles, surfaces;
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    (boundaries[i].is_surface ? surfaces : obstacles).emplace(boundaries[i].name, i);
  std::vector<std::size_t> touched;
  for (const ContactCandidate& contact : scene.contacts)
    touched.push_back(contact.OnSurface() ? surfaces.at(contact.surface) : obstacles.at(contact.obstacle));
  return touched;
}

}  // namespace contact_path
