// UTF-8 (RFC 3629), which all names and scene files are in.
#ifndef CONTACT_PATH_SCENE_UTF8_H_
#define CONTACT_PATH_SCENE_UTF8_H_

#include <cstddef>
#include <string_view>

namespace contact_path {

// Bytes of the character that `text` begins with, 1 to 4; 0 if it is empty or begins with none: cut off, longer than
// need be, a surrogate, or beyond Unicode.
std::size_t Utf8Size(std::string_view text);

// The first byte of `text` that belongs to no character, or npos.
std::size_t FindNoUtf8(std::string_view text);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_UTF8_H_
