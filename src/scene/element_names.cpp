#include "contact_path/scene/element_names.h"

#include <algorithm>
#include <charconv>
#include <unordered_set>

#include "contact_path/scene/expand.h"

namespace contact_path {
namespace {

constexpr std::string_view kBar = "bar";

// A number from 1, written without zeros in front; 0 for another text.
std::size_t NumberIn(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size() && text.front() != '0';
  return whole ? number : 0;
}

bool IsFitForColumn(std::string_view name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](char c) {
    return c == '@' || c == ',' || c == '"' || c == '.' || c == '/' || static_cast<unsigned char>(c) <= ' ' || c == 127;
  });
}

}  // namespace

ElementNames::ElementNames(const Scene& scene) : num_bars_(scene.bars.size()), num_sections_(scene.bars.size()) {
  for (std::size_t i = 0; i < scene.beams.size(); ++i) {
    const Beam& beam = scene.beams[i];
    const std::size_t segments = beam.nodes.empty() ? 0 : beam.nodes.size() - 1;
    beams_.push_back({BeamName(beam, i), num_sections_, segments});
    num_sections_ += segments;
  }
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const Solid& solid = scene.solids[i];
    const bool own = IsFitForColumn(solid.name) && names.insert(solid.name).second;
    const std::size_t elements = solid.nodes.size() / std::max<std::size_t>(solid.NodesPerElement(), 1);
    solids_.push_back({own ? solid.name : "solid" + std::to_string(i + 1), num_elements_, elements});
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
  return IsBar(section) ? std::string(kBar) + std::to_string(section + 1) : NameIn(beams_, section);
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
  return FindIn(beams_, name);
}

std::optional<std::size_t> ElementNames::FindElement(std::string_view name) const { return FindIn(solids_, name); }

}  // namespace contact_path
