#include "contact_path/scene/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <system_error>

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

// An error in a large scene, or in one with long names, must not take long.
constexpr std::size_t kLongestName = 48;
constexpr std::size_t kMostNames = 4000;

char LowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

double Substitution(char a, char b) {
  if (a == b) return 0.0;
  return LowerCase(a) == LowerCase(b) ? 0.5 : 1.0;
}

// The distance of Damerau and Levenshtein, where only neighbours are exchanged; some number from `most` on where it is
// not less than that.
double Distance(std::string_view a, std::string_view b, double most) {
  std::array<std::vector<double>, 3> rows;  // by letters of b: two letters of a before, one before, now
  for (auto& row : rows) row.resize(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) rows[1][j] = static_cast<double>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    double least = rows[2][0] = static_cast<double>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      double best = std::min(rows[1][j], rows[2][j - 1]) + 1.0;
      best = std::min(best, rows[1][j - 1] + Substitution(a[i - 1], b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) best = std::min(best, rows[0][j - 2] + 1.0);
      rows[2][j] = best;
      least = std::min(least, best);
    }
    if (least >= most + 1.0) return least;  // an exchange reaches two letters back, and costs an error
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1][b.size()];
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

std::string NumberText(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  std::string text;
  for (int digits = 15; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    text = RoundedText(value, digits);
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double back = 0.0;
    if (in >> back && back == value) break;
  }
  return text;
}

std::ostringstream ClassicStream(int digits) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  return out;
}

std::string RoundedText(double value, int digits) {
  std::ostringstream out = ClassicStream(digits);
  out << value;
  return out.str();
}

std::string Either(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < words.size() ? ", " : " or ").append(words[i]);
  return text;
}

std::optional<std::size_t> ParseWhole(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

bool IsFitForColumn(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code > 0x20 && code != 0x7F && std::string_view("@,\"./").find(c) == std::string_view::npos;
  });
}

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

NearestName::NearestName(std::string_view wanted)
    : wanted_(wanted), distance_(static_cast<double>(std::max<std::size_t>(1, wanted.size() / 3)) + 0.5) {}

void NearestName::Offer(std::string_view name) {
  if (++offered_ > kMostNames) return;
  if (wanted_.empty() || name.empty() || wanted_.size() > kLongestName || name.size() > kLongestName) return;
  const auto longer = static_cast<double>(std::max(name.size(), wanted_.size()));
  const auto shorter = static_cast<double>(std::min(name.size(), wanted_.size()));
  if (longer - shorter >= distance_) return;
  const double distance = Distance(wanted_, name, distance_);
  // A name of which nothing is left is another name.
  if (distance >= distance_ || distance >= longer) return;
  distance_ = distance;
  nearest_ = name;
}

}  // namespace contact_path
