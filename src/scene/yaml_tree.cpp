#include "scene/yaml_tree.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <system_error>

namespace contact_path {
namespace {

bool IsPlain(const YamlValue& value) { return value.kind == YamlValue::Kind::kText && !value.quoted; }

// Whole numbers with a leading zero are refused: octal to some readers of YAML, decimal to others.
bool HasLeadingZero(const std::string& word) {
  const std::size_t first = word.find_first_not_of("+-");
  return first != word.npos && first + 1 < word.size() && word[first] == '0' &&
         word.find_first_not_of("0123456789", first) == word.npos;
}

}  // namespace

template <>
std::optional<bool> ParseScalar(const YamlValue& value) {
  if (!IsPlain(value)) return std::nullopt;
  for (const char* yes : {"true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON", "1"}) {
    if (value.text == yes) return true;
  }
  for (const char* no : {"false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF", "0"}) {
    if (value.text == no) return false;
  }
  return std::nullopt;
}

template <>
std::optional<int> ParseScalar(const YamlValue& value) {
  const std::string& word = value.text;
  if (!IsPlain(value) || HasLeadingZero(word)) return std::nullopt;
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  int integer = 0;
  const auto [end, error] = std::from_chars(word.data() + (has_plus ? 1 : 0), word.data() + word.size(), integer);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(integer) : std::nullopt;
}

template <>
std::optional<double> ParseScalar(const YamlValue& value) {
  const std::string& word = value.text;
  if (!IsPlain(value) || HasLeadingZero(word)) return std::nullopt;
  for (const char* special : {".inf", ".Inf", ".INF"}) {
    if (word == special || word == std::string("+") + special) return std::numeric_limits<double>::infinity();
    if (word == std::string("-") + special) return -std::numeric_limits<double>::infinity();
  }
  for (const char* special : {".nan", ".NaN", ".NAN"}) {
    if (word == special) return std::numeric_limits<double>::quiet_NaN();
  }
  if (word.find_first_not_of("+-.0123456789eE") != word.npos) return std::nullopt;
  std::istringstream stream(word);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;
  if (stream.fail()) {  // out of range: the largest number; otherwise 0
    return number == 0.0 ? std::nullopt : std::optional(std::copysign(std::numeric_limits<double>::infinity(), number));
  }
  return stream.peek() == std::istringstream::traits_type::eof() ? std::optional(number) : std::nullopt;
}

template <>
std::optional<std::string> ParseScalar(const YamlValue& value) {
  if (value.kind != YamlValue::Kind::kText) return std::nullopt;
  if (ParseScalar<bool>(value) || ParseScalar<int>(value) || ParseScalar<double>(value)) return std::nullopt;
  return value.text;
}

std::string Show(const YamlValue& value) {
  switch (value.kind) {
    case YamlValue::Kind::kNull: return "null";
    case YamlValue::Kind::kText: return value.quoted ? "\"" + value.text + "\"" : value.text;
    case YamlValue::Kind::kList: return "a list";
    case YamlValue::Kind::kMap: return "a map";
  }
  return "";
}

}  // namespace contact_path
