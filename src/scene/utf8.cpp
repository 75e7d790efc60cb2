#include "contact_path/scene/utf8.h"

namespace contact_path {

std::size_t Utf8Size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i) { return byte(i) >= 0x80 && byte(i) <= 0xBF; };
  const unsigned first = byte(0), second = byte(1);
  if (text.empty()) return 0;
  if (first < 0x80) return 1;
  if (!follows(1)) return 0;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (!follows(2)) return 0;
  if (first == 0xE0 && second < 0xA0) return 0;  // longer than need be
  if (first == 0xED && second > 0x9F) return 0;  // surrogates
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (!follows(3)) return 0;
  if (first == 0xF0 && second < 0x90) return 0;  // longer than need be
  if (first == 0xF4 && second > 0x8F) return 0;  // beyond Unicode
  return first >= 0xF0 && first <= 0xF4 ? 4 : 0;
}

std::size_t FindNoUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = Utf8Size(text.substr(i));
    if (size == 0) return i;
    i += size;
  }
  return std::string_view::npos;
}

}  // namespace contact_path
