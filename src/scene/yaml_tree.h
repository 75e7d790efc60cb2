// A YAML text as a tree of values that know their lines, and its values without parts: truth values, numbers, text,
// words of enumerations.
#ifndef CONTACT_PATH_SRC_SCENE_YAML_TREE_H_
#define CONTACT_PATH_SRC_SCENE_YAML_TREE_H_

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include <yaml-cpp/emitterstyle.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"
#include "contact_path/scene/words.h"

namespace contact_path {

// Bounds that keep memory, time and stack small whatever the text is.
constexpr std::size_t kLargestYaml = std::size_t{64} << 20U;  // [bytes]
constexpr std::size_t kMostYamlValues = 2'000'000;            // what stands behind an alias counts each time
constexpr std::size_t kDeepestYaml = 64;                      // lists and maps around a value

// Refuses a file as a whole or from `line` on (0 = unknown).
[[noreturn]] inline void Refuse(const std::string& file, int line, std::string rule) {
  throw InvalidRequest({{"", "", std::move(rule), file, line}});
}

inline std::string TooManyValues() { return "must have at most " + std::to_string(kMostYamlValues) + " values"; }

struct YamlValue {
  enum class Kind { kNull, kText, kList, kMap };

  Kind kind = Kind::kNull;
  bool quoted = false;           // kText: can be nothing but text
  int line = 0;                  // from 1
  std::string text;              // kText
  std::vector<YamlValue> items;  // kList: elements; kMap: key, value, key, value, ... as they stand, repeated or not
};

// Builds the tree of one document from the events of the parser. Aliases become copies, at the line of the alias.
class YamlTreeBuilder : public YAML::EventHandler {
 public:
  explicit YamlTreeBuilder(const std::string& file) : file_(file) {}
  YamlValue& root() { return root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Begin(YamlValue::Kind::kNull, mark, anchor);
    End();
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    YamlValue& value = Begin(YamlValue::Kind::kText, mark, anchor);
    value.text = text;
    value.quoted = tag == "!" || tag == "tag:yaml.org,2002:str";
    End();
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const int line = mark.line + 1;
    const auto anchored = anchored_.find(anchor);
    if (anchored == anchored_.end()) Refuse(file_, line, "an alias must not stand within what it refers to");
    Count(anchored->second, open_.size(), line);
    open_.push_back({anchored->second, 0});
    open_.back().value.line = line;
    End();
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Begin(YamlValue::Kind::kList, mark, anchor);
  }
  void OnSequenceEnd() override { End(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Begin(YamlValue::Kind::kMap, mark, anchor);
  }
  void OnMapEnd() override { End(); }

 private:
  struct Open {
    YamlValue value;
    YAML::anchor_t anchor;  // 0 = none
  };

  YamlValue& Begin(YamlValue::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.push_back({YamlValue(), anchor});
    YamlValue& value = open_.back().value;
    value.kind = kind;
    value.line = mark.line + 1;
    Count(value, open_.size() - 1, value.line);
    return value;
  }

  void End() {
    Open done = std::move(open_.back());
    open_.pop_back();
    if (done.anchor != YAML::NullAnchor) {
      Count(done.value, open_.size(), done.value.line);
      anchored_.emplace(done.anchor, done.value);
    }
    if (open_.empty()) {
      root_ = std::move(done.value);
    } else {
      open_.back().value.items.push_back(std::move(done.value));
    }
  }

  // Counts `value`, with `depth` lists and maps around it, and all that is in it; `line` is where too much is refused.
  void Count(const YamlValue& value, std::size_t depth, int line) {
    if (depth > kDeepestYaml) {
      Refuse(file_, line, "lists and maps must be at most " + std::to_string(kDeepestYaml) + " deep");
    }
    if (++count_ > kMostYamlValues) Refuse(file_, line, TooManyValues());
    for (const YamlValue& item : value.items) Count(item, depth + 1, line);
  }

  const std::string& file_;
  YamlValue root_;
  std::vector<Open> open_;  // what is begun and not ended, outermost first
  std::unordered_map<YAML::anchor_t, YamlValue> anchored_;
  std::size_t count_ = 0;
};

// The line, from 1, of a place in a text.
inline int LineAt(const std::string& text, std::size_t place) {
  return static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n')) + 1;
}

// The tree of `text`. `file` is used in messages only.
// Throws InvalidRequest: larger than the bounds above, not YAML, empty, or more than one document.
inline YamlValue ParseYaml(const std::string& text, const std::string& file) {
  if (text.size() > kLargestYaml) Refuse(file, 0, "must be at most 64 MiB long");
  // Each of these comes with a value. The parser holds a whole bracket in memory before it gives any event of it.
  const auto values = std::count_if(text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == '{'; });
  if (static_cast<std::size_t>(values) > kMostYamlValues) Refuse(file, 0, TooManyValues());
  // The parser would take some of these for the end of the text, silently.
  const auto control = std::find_if(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
  if (control != text.end())
    Refuse(file, LineAt(text, static_cast<std::size_t>(control - text.begin())),
           "must be YAML, without control characters");
  // Others, of UTF-16 or ISO 8859, would be replaced, and names become equal.
  if (const std::size_t at = FindNoUtf8(text); at != text.npos) Refuse(file, LineAt(text, at), "must be UTF-8");
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    YamlTreeBuilder first(file);
    if (!parser.HandleNextDocument(first)) Refuse(file, 1, "must be a request in YAML, but is empty");
    YamlTreeBuilder second(file);
    if (parser.HandleNextDocument(second)) Refuse(file, second.root().line, "must end after one YAML document");
    return std::move(first.root());
  } catch (const YAML::Exception& error) {
    Refuse(file, error.mark.line + 1, "must be YAML: " + error.msg);
  }
}

// A value without parts, as here a word of an enumeration. Nothing for a value of another type.
template <typename T>
std::optional<T> ParseScalar(const YamlValue& value) {
  return value.kind == YamlValue::Kind::kText ? ParseWord<T>(value.text) : std::nullopt;
}
// The truth values of YAML 1.1, as ROS reads them too, and 0 and 1.
template <>
std::optional<bool> ParseScalar(const YamlValue& value);
template <>
std::optional<int> ParseScalar(const YamlValue& value);
// Decimal numbers with or without point and exponent, .inf and .nan. Those too large for a double are infinite.
template <>
std::optional<double> ParseScalar(const YamlValue& value);
// Plain words that YAML takes for numbers or truth values are no text; the service of ROS refuses them too.
template <>
std::optional<std::string> ParseScalar(const YamlValue& value);

// What to say where such a value cannot be read.
template <typename T>
std::string ScalarRule(const YamlValue& value) {
  if constexpr (std::is_enum_v<T>) return WordRule<T>(value.text);
  if constexpr (std::is_same_v<T, bool>) return "must be true or false";
  if constexpr (std::is_same_v<T, int>) return "must be an integer";
  if constexpr (std::is_same_v<T, double>) return "must be a number";
  return "must be text (in quotes if it could be a number or a truth value)";
}

// What stands in the file, for a message.
std::string Show(const YamlValue& value);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_YAML_TREE_H_
