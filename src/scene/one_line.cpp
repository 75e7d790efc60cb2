#include "contact_path/scene/one_line.h"

#include <cstddef>
#include <string_view>

#include "contact_path/scene/utf8.h"

namespace contact_path {
namespace {

constexpr std::size_t kLongestLine = 160;

// Bytes of the character that begins `text`; 0 if it is no UTF-8, or nothing to print on a line.
std::size_t PrintableSize(std::string_view text) {
  const std::size_t size = Utf8Size(text);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (size == 1) return byte(0) >= 0x20 && byte(0) != 0x7F ? 1 : 0;
  if (size == 2 && byte(0) == 0xC2 && byte(1) < 0xA0) return 0;  // control characters
  if (size == 3 && byte(0) == 0xE2 && byte(1) == 0x80 && (byte(2) == 0xA8 || byte(2) == 0xA9))
    return 0;  // line separators
  return size;
}

}  // namespace

std::string OneLine(const std::string& text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string line;
  for (std::size_t i = 0; i < text.size();) {
    if (line.size() >= kLongestLine) return line + "...";
    const std::size_t size = PrintableSize(std::string_view(text).substr(i));
    if (size > 0) {
      line.append(text, i, size);
    } else {
      const auto code = static_cast<unsigned char>(text[i]);
      line += {'\\', 'x', kHex[code >> 4U], kHex[code & 15U]};
    }
    i += size > 0 ? size : 1;
  }
  return line;
}

}  // namespace contact_path
