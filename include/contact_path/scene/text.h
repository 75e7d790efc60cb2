// Text in messages for a person, with the name that the person may have meant, and the encoding of all text.
#ifndef CONTACT_PATH_SCENE_TEXT_H_
#define CONTACT_PATH_SCENE_TEXT_H_

#include <cstddef>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace contact_path {

// `text` on one line and not much longer than a line: what is no UTF-8, control characters and line separators are
// shown as \xNN, byte by byte; beyond 160 bytes "..." stands for the rest.
std::string OneLine(const std::string& text);

// The shortest text that reads back as `value`, in YAML's spelling: ".inf", ".nan". The same whatever the locale.
std::string NumberText(double value);

// A text in the making, which is the same whatever the locale: numbers have so many digits.
std::ostringstream ClassicStream(int digits = 6);

// `value` in so many digits, as in 1.2e-12: for a person. The same whatever the locale.
std::string RoundedText(double value, int digits = 2);

// "a, b or c".
std::string Either(const std::vector<std::string_view>& words);

// A whole number from 0, in digits alone; nothing for another text.
std::optional<std::size_t> ParseWhole(std::string_view text);

// Whether a name can be that of a column of a table, and part of "<node>@<obstacle>" and "<node>.x": there is neither
// white space in it, nor a control character, nor any of @ , " . /.
bool IsFitForColumn(std::string_view name);

// UTF-8 is that of RFC 3629, which all names and scene files are in.

// Bytes of the character that `text` begins with, 1 to 4; 0 if it is empty or begins with none: cut off, longer than
// need be, a surrogate, or beyond Unicode.
std::size_t Utf8Size(std::string_view text);

// The first byte of `text` that belongs to no character, or npos.
std::size_t FindNoUtf8(std::string_view text);

// Keeps the nearest of the names that are offered to it, by the number of letters that are left out, put in, wrong, or
// exchanged with their neighbour; letters of the other case count as half an error. Of equally near names the first.
class NearestName {
 public:
  explicit NearestName(std::string_view wanted);

  // Names of more than 48 bytes, and names after the first 4,000, are left aside.
  void Offer(std::string_view name);
  // The nearest name; empty where none is near: more than a third of the letters differ.
  const std::string& Get() const { return nearest_; }
  // "; did you mean NAME?", or nothing.
  std::string Question() const { return nearest_.empty() ? "" : "; did you mean " + nearest_ + "?"; }

 private:
  const std::string wanted_;
  std::size_t offered_ = 0;
  double distance_;  // of names from here on no longer near
  std::string nearest_;
};

// Offered the names of all parts of a list. name_of: of a part its name; a function, or a member of the part.
template <typename Part, typename NameOf>
NearestName NearestOf(std::string_view wanted, const std::vector<Part>& parts, NameOf name_of) {
  NearestName nearest(wanted);
  for (const Part& part : parts) nearest.Offer(std::invoke(name_of, part));
  return nearest;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_TEXT_H_
