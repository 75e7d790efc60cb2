// The names of a scene, each resolved once: nodes, materials, surfaces, obstacles, contacts, supports and boundaries by
// their places.
#ifndef CONTACT_PATH_SCENE_SCENE_INDEX_H_
#define CONTACT_PATH_SCENE_SCENE_INDEX_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contact_path/scene/element_names.h"
#include "contact_path/scene/reacting_parts.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Places in the lists of a scene, from 0. The stages of a program, which have the same lists, share an index. Of
// several parts with one name, the first is known. `scene` must outlive the index, which refers to its names.
class SceneIndex {
 public:
  explicit SceneIndex(const Scene& scene);

  // Throw std::out_of_range for a name that the scene does not have: a sound request (validate.h) has none.
  std::size_t Node(std::string_view name) const { return nodes_.at(name); }
  std::size_t Material(std::string_view name) const { return materials_.at(name); }
  std::size_t Surface(std::string_view name) const { return surfaces_.at(name); }
  std::size_t Obstacle(std::string_view name) const { return obstacles_.at(name); }

  // Nothing for a name that the scene does not have.
  std::optional<std::size_t> FindNode(std::string_view name) const { return Find(nodes_, name); }
  std::optional<std::size_t> FindMaterial(std::string_view name) const { return Find(materials_, name); }
  std::optional<std::size_t> FindSurface(std::string_view name) const { return Find(surfaces_, name); }
  std::optional<std::size_t> FindObstacle(std::string_view name) const { return Find(obstacles_, name); }
  std::optional<std::size_t> FindContact(const std::string& name) const { return Find(contacts_, name); }
  // Places in SupportedNodes() and TouchedBoundaries().
  std::optional<std::size_t> FindSupport(std::string_view node) const { return Find(supports_, node); }
  std::optional<std::size_t> FindBoundary(std::string_view name) const { return Find(boundaries_, std::string(name)); }
  const SupportedNode& Support(std::size_t place) const { return supported_[place]; }
  const ElementNames& Elements() const { return elements_; }

 private:
  template <typename Map, typename Name>
  static std::optional<std::size_t> Find(const Map& map, const Name& name) {
    const auto found = map.find(name);
    return found == map.end() ? std::nullopt : std::optional(found->second);
  }

  std::unordered_map<std::string_view, std::size_t> nodes_, materials_, surfaces_, obstacles_, supports_;
  std::unordered_map<std::string, std::size_t> contacts_, boundaries_;  // by name
  std::vector<SupportedNode> supported_;
  ElementNames elements_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SCENE_INDEX_H_
