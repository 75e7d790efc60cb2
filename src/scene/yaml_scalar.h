// Values of YAML without parts: truth values, numbers, text, words of enumerations.
#ifndef CONTACT_PATH_SRC_SCENE_YAML_SCALAR_H_
#define CONTACT_PATH_SRC_SCENE_YAML_SCALAR_H_

#include <optional>
#include <string>

#include "contact_path/scene/words.h"
#include "scene/yaml_tree.h"

namespace contact_path {

// Nothing for a value of another type.

// The truth values of YAML 1.1, as ROS reads them too, and 0 and 1.
std::optional<bool> ParseFlag(const YamlValue& value);
std::optional<int> ParseInteger(const YamlValue& value);
// Decimal numbers with or without point and exponent, .inf and .nan. Those too large for a double are infinite.
std::optional<double> ParseNumber(const YamlValue& value);
// Plain words that YAML takes for numbers or truth values are no text; the service of ROS refuses them too.
std::optional<std::string> ParseText(const YamlValue& value);

// What stands in the file, for a message.
std::string Show(const YamlValue& value);

// How a value without parts is read, and what to say where it cannot be.
template <typename T>
struct Scalar;
template <>
struct Scalar<bool> {
  static std::optional<bool> Parse(const YamlValue& value) { return ParseFlag(value); }
  static std::string Rule(const YamlValue&) { return "must be true or false"; }
};
template <>
struct Scalar<int> {
  static std::optional<int> Parse(const YamlValue& value) { return ParseInteger(value); }
  static std::string Rule(const YamlValue&) { return "must be an integer"; }
};
template <>
struct Scalar<double> {
  static std::optional<double> Parse(const YamlValue& value) { return ParseNumber(value); }
  static std::string Rule(const YamlValue&) { return "must be a number"; }
};
template <>
struct Scalar<std::string> {
  static std::optional<std::string> Parse(const YamlValue& value) { return ParseText(value); }
  static std::string Rule(const YamlValue&) {
    return "must be text (in quotes if it could be a number or a truth value)";
  }
};
// A word of an enumeration.
template <typename Enum>
struct Scalar {
  static std::optional<Enum> Parse(const YamlValue& value) {
    return value.kind == YamlValue::Kind::kText ? ParseWord<Enum>(value.text) : std::nullopt;
  }
  static std::string Rule(const YamlValue& value) { return WordRule<Enum>(value.text); }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_YAML_SCALAR_H_
