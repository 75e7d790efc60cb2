// A YAML text as a tree of values that know their lines, and its values without parts: truth values, numbers, text,
// words of enumerations.
#ifndef CONTACT_PATH_SRC_SCENE_YAML_TREE_H_
#define CONTACT_PATH_SRC_SCENE_YAML_TREE_H_

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
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
  if (control != text.end()) {
    const auto line = static_cast<int>(std::count(text.begin(), control, '\n')) + 1;
    Refuse(file, line, "must be YAML, without control characters");
  }
  // Others, of UTF-16 or ISO 8859, would be replaced, and names become equal.
  if (const std::size_t at = FindNoUtf8(text); at != std::string_view::npos) {
    const auto line =
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
    Refuse(file, line, "must be UTF-8");
  }
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

#endif  // CONTACT_PATH_SRC_SCENE_YAML_TREE_H_
