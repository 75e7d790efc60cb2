// The words of the enumerations of the scene format.
#ifndef CONTACT_PATH_SCENE_WORDS_H_
#define CONTACT_PATH_SCENE_WORDS_H_

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "contact_path/scene/text.h"

namespace contact_path {

// An enumeration with words, as those of scene.h, has an overload of WordsOf, which gives them in the order of its
// values. The first value is that of "", unless an overload of DefaultOf tells another one.
template <typename... Word>
constexpr std::array<std::string_view, sizeof...(Word)> WordList(Word... words) {
  return {words...};
}
template <typename Enum>
constexpr Enum DefaultOf(Enum) {
  return Enum();
}

// Calls visit(word, value) for each word of an enumeration.
template <typename Enum, typename Visit>
void ForEachWord(Visit&& visit) {
  int value = 0;
  for (const std::string_view word : WordsOf(Enum())) visit(word, static_cast<Enum>(value++));
}

// Nothing for a word that is not known.
template <typename Enum>
std::optional<Enum> ParseWord(std::string_view text) {
  if (text.empty()) return DefaultOf(Enum());
  std::optional<Enum> parsed;
  ForEachWord<Enum>([&](std::string_view word, Enum value) {
    if (word == text) parsed = value;
  });
  return parsed;
}

template <typename Enum, typename = decltype(WordsOf(Enum()))>
std::string_view ToString(Enum value) {
  const auto words = WordsOf(value);
  const auto place = static_cast<std::size_t>(value);
  return place < words.size() ? words[place] : "unknown";  // not an enumerator
}

// "must be fast, balanced or accurate", with the nearest word to what was written instead.
template <typename Enum>
std::string WordRule(std::string_view written) {
  const auto words = WordsOf(Enum());
  NearestName nearest(written);
  for (const std::string_view word : words) nearest.Offer(word);
  return "must be " + Either({words.begin(), words.end()}) + nearest.Question();
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_WORDS_H_
