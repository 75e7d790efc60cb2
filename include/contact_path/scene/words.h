// The words of the enumerations of the scene format.
#ifndef CONTACT_PATH_SCENE_WORDS_H_
#define CONTACT_PATH_SCENE_WORDS_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "contact_path/scene/text.h"

namespace contact_path {

// Words of an enumeration has kAll, pairs of a word and its value, and kDefault, the value of "". In scene.h.
template <typename Enum>
struct Words;

// Nothing for a word that is not known.
template <typename Enum>
std::optional<Enum> ParseWord(std::string_view text) {
  if (text.empty()) return Words<Enum>::kDefault;
  for (const auto& [word, value] : Words<Enum>::kAll)
    if (word == text) return value;
  return std::nullopt;
}

template <typename Enum, typename = decltype(Words<Enum>::kDefault)>
std::string_view ToString(Enum value) {
  for (const auto& [word, known] : Words<Enum>::kAll)
    if (known == value) return word;
  return "unknown";  // not an enumerator
}

// "must be fast, balanced or accurate", with the nearest word to what was written instead.
template <typename Enum>
std::string WordRule(std::string_view written) {
  const auto& words = Words<Enum>::kAll;
  std::string rule = "must be ";
  NearestName nearest(written);
  for (std::size_t i = 0; i < std::size(words); ++i) {
    const std::string_view word = words[i].first;
    if (i > 0) rule += i + 1 < std::size(words) ? ", " : " or ";
    rule += word;
    nearest.Offer(word);
  }
  return rule + nearest.Question();
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_WORDS_H_
