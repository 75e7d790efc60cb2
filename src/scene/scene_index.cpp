#include "contact_path/scene/scene_index.h"

#include <algorithm>
#include <unordered_set>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/text.h"

namespace contact_path {
namespace {

constexpr std::string_view kBar = "bar";

// A number from 1, written without zeros in front; 0 for another text.
std::size_t NumberIn(std::string_view text) { return text.front() == '0' ? 0 : ParseWhole(text).value_or(0); }

}  // namespace

ElementNames::ElementNames(const Scene& scene) : num_bars_(scene.bars.size()), num_sections_(scene.bars.size()) {
  for (std::size_t i = 0; i < scene.beams.size(); ++i) {
    const Beam& beam = scene.beams[i];
    const std::size_t segments = beam.nodes.empty() ? 0 : beam.nodes.size() - 1;
    chains_.push_back({BeamName(beam, i), num_sections_, segments});
    num_sections_ += segments;
  }
  first_tendon_ = num_sections_;
  for (std::size_t i = 0; i < scene.tendons.size(); ++i) {
    const std::size_t pieces = std::max<std::size_t>(scene.tendons[i].nodes.size(), 1) - 1;
    chains_.push_back({TendonName(scene.tendons[i], i), num_sections_, pieces});
    num_sections_ += pieces;
  }
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const Solid& solid = scene.solids[i];
    const bool own = IsFitForColumn(solid.name) && names.insert(solid.name).second;
    const std::size_t elements = solid.nodes.size() / std::max<std::size_t>(solid.NodesPerElement(), 1);
    solids_.push_back({own ? solid.name : SolidName({}, i), num_elements_, elements});
    num_elements_ += elements;
  }
}

std::string ElementNames::NameIn(const std::vector<Part>& parts, std::size_t number) {
  const auto after = std::upper_bound(parts.begin(), parts.end(), number,
                                      [](std::size_t at, const Part& part) { return at < part.first; });
  const Part& part = *(after - 1);
  return part.name + "." + std::to_string(number - part.first + 1);
}

std::string ElementNames::SectionName(std::size_t section) const {
  return section < num_bars_ ? std::string(kBar) + std::to_string(section + 1) : NameIn(chains_, section);
}

std::string ElementNames::ElementName(std::size_t element) const { return NameIn(solids_, element); }

std::optional<std::size_t> ElementNames::FindIn(const std::vector<Part>& parts, std::string_view name) {
  const std::size_t point = name.rfind('.');
  if (point == name.npos || point + 1 == name.size()) return std::nullopt;
  const std::size_t number = NumberIn(name.substr(point + 1));
  for (const Part& part : parts)
    if (part.name == name.substr(0, point) && number >= 1 && number <= part.count) return part.first + number - 1;
  return std::nullopt;
}

std::optional<std::size_t> ElementNames::FindSection(std::string_view name) const {
  if (name.size() > kBar.size() && name.substr(0, kBar.size()) == kBar && name.find('.') == name.npos) {
    const std::size_t number = NumberIn(name.substr(kBar.size()));
    return number >= 1 && number <= num_bars_ ? std::optional(number - 1) : std::nullopt;
  }
  return FindIn(chains_, name);
}

std::optional<std::size_t> ElementNames::FindElement(std::string_view name) const { return FindIn(solids_, name); }

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
    else if (!contact.at_eye)
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
    touched.push_back(contact.at_eye        ? boundaries.size()
                      : contact.OnSurface() ? surfaces.at(contact.surface)
                                            : obstacles.at(contact.obstacle));
  return touched;
}

SceneIndex::SceneIndex(const Scene& scene)
    : nodes_(PlacesByName(scene.nodes)),
      materials_(PlacesByName(scene.materials)),
      surfaces_(PlacesByName(scene.surfaces)),
      obstacles_(PlacesByName(scene.obstacles)),
      supported_(SupportedNodes(scene)),
      elements_(scene) {
  contacts_.reserve(scene.contacts.size());
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) contacts_.emplace(scene.contacts[i].Name(), i);
  for (std::size_t i = 0; i < supported_.size(); ++i) supports_.emplace(scene.nodes[supported_[i].node].name, i);
  for (const TouchedBoundary& boundary : TouchedBoundaries(scene))
    boundaries_.emplace(boundary.name, boundaries_.size());
  for (std::size_t i = 0; i < scene.pins.size(); ++i) {
    pins_.emplace(PinName(scene.pins[i], i), i);
    has_spring_.push_back(scene.pins[i].stiffness > 0.0);
  }
}

}  // namespace contact_path
