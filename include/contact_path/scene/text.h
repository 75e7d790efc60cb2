// Text in messages for a person, and the encoding of all text.
#ifndef CONTACT_PATH_SCENE_TEXT_H_
#define CONTACT_PATH_SCENE_TEXT_H_

#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>

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

// UTF-8 is that of RFC 3629, which all names and scene files are in.

// Bytes of the character that `text` begins with, 1 to 4; 0 if it is empty or begins with none: cut off, longer than
// need be, a surrogate, or beyond Unicode.
std::size_t Utf8Size(std::string_view text);

// The first byte of `text` that belongs to no character, or npos.
std::size_t FindNoUtf8(std::string_view text);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_TEXT_H_
