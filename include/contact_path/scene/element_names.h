// The names of the sections of bars and beams, and of the elements of solids, as quantities have them.
#ifndef CONTACT_PATH_SCENE_ELEMENT_NAMES_H_
#define CONTACT_PATH_SCENE_ELEMENT_NAMES_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// Sections are numbered through all bars, then all segments of beams; elements through all solids; both from 0. A
// section is called "bar<place of the bar, from 1>" or "<beam>.<segment, from 1>", an element "<solid>.<element, from
// 1>". A solid without a name, or with one that is not fit for a column or is that of a solid before it, is called
// "solid<place>".
class ElementNames {
 public:
  // scene: expanded (scene/expand.h).
  explicit ElementNames(const Scene& scene);

  std::size_t NumSections() const { return num_sections_; }
  std::size_t NumElements() const { return num_elements_; }
  bool IsBar(std::size_t section) const { return section < num_bars_; }
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

  std::size_t num_bars_, num_sections_, num_elements_ = 0;
  std::vector<Part> beams_, solids_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_ELEMENT_NAMES_H_
