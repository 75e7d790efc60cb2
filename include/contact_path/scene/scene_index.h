// The names of a scene, each resolved once: of nodes, materials, surfaces, obstacles, contacts, of supports and
// boundaries, whose forces an increment tells, and of the sections and elements that quantities are of.
#ifndef CONTACT_PATH_SCENE_SCENE_INDEX_H_
#define CONTACT_PATH_SCENE_SCENE_INDEX_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// The places of parts in their list, from 0, by name; of several with one name, that of the first. The parts must
// outlive the result.
template <typename Part>
std::unordered_map<std::string_view, std::size_t> PlacesByName(const std::vector<Part>& parts) {
  std::unordered_map<std::string_view, std::size_t> places;
  places.reserve(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) places.emplace(parts[i].name, i);
  return places;
}

// Sections are numbered through all bars, all segments of beams, then all pieces of tendons; elements through all
// solids; both from 0. A section is called "bar<place of the bar, from 1>" or "<beam>.<segment, from 1>", an element
// "<solid>.<element, from 1>". A solid without a name, or with one that is not fit for a column or is that of a solid
// before it, is called "solid<place>".
class ElementNames {
 public:
  // scene: expanded (scene/expand.h).
  explicit ElementNames(const Scene& scene);

  std::size_t NumSections() const { return num_sections_; }
  std::size_t NumElements() const { return num_elements_; }
  // Of a bar or a tendon, which has N alone.
  bool HasOnlyN(std::size_t section) const { return section < num_bars_ || section >= first_tendon_; }
  std::string SectionName(std::size_t section) const;
  std::string ElementName(std::size_t element) const;
  // Nothing for a name that the scene does not have.
  std::optional<std::size_t> FindSection(std::string_view name) const;
  std::optional<std::size_t> FindElement(std::string_view name) const;

 private:
  struct Part {
    std::string name;
    std::size_t first = 0;
    std::size_t count = 0;
  };
  static std::string NameIn(const std::vector<Part>& parts, std::size_t number);
  static std::optional<std::size_t> FindIn(const std::vector<Part>& parts, std::string_view name);

  std::size_t num_bars_, num_sections_, first_tendon_ = 0, num_elements_ = 0;
  std::vector<Part> chains_, solids_;  // chains_: beams and tendons
};

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
// Of an eye of a tendon: their number.
std::vector<std::size_t> BoundaryOfContacts(const Scene& scene, const std::vector<TouchedBoundary>& boundaries);

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
  std::optional<std::size_t> FindPin(const std::string& name) const { return Find(pins_, name); }
  bool HasSpring(std::size_t pin) const { return has_spring_[pin]; }
  const SupportedNode& Support(std::size_t place) const { return supported_[place]; }
  const ElementNames& Elements() const { return elements_; }

 private:
  template <typename Map, typename Name>
  static std::optional<std::size_t> Find(const Map& map, const Name& name) {
    const auto found = map.find(name);
    return found == map.end() ? std::nullopt : std::optional(found->second);
  }

  std::unordered_map<std::string_view, std::size_t> nodes_, materials_, surfaces_, obstacles_, supports_;
  std::unordered_map<std::string, std::size_t> contacts_, boundaries_, pins_;  // by name
  std::vector<SupportedNode> supported_;
  std::vector<bool> has_spring_;  // by pin
  ElementNames elements_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SCENE_INDEX_H_
