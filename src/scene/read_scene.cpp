#include "contact_path/scene/read_scene.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"
#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"
#include "contact_path/scene/words.h"
#include "scene/yaml_tree.h"

namespace contact_path {
namespace {

// Reads a request by the descriptions of its parts, and collects what is wrong. Violations of line 0 stand where their
// key does.
class Reader {
 public:
  const std::vector<Violation>& violations() const { return violations_; }
  // False where a list, a map, a truth value or an integer could not be read: rules would judge what is missing.
  bool complete() const { return complete_; }
  // Whether a violation of a rule is there because of what could not be read.
  bool Explains(const Violation& violation) const {
    const std::string& key = violation.key;
    for (std::size_t end = key.size(); end != key.npos; end = end == 0 ? key.npos : key.find_last_of(".[", end - 1))
      if (not_read_.count(key.substr(0, end)) > 0) return true;
    return false;
  }

  template <typename T>
  void Read(const YamlValue& value, const KeyPath& path, T* out) {
    if constexpr (kIsPart<T>) {
      ReadPart(value, path, out);
    } else if constexpr (kIsList<T>) {
      ReadList(value, path, out);
    } else if (const auto parsed = ParseScalar<T>(value)) {
      *out = *parsed;
    } else {
      Add(0, path, value, ScalarRule<T>(value));
      if constexpr (std::is_same_v<T, double>) *out = std::numeric_limits<double>::quiet_NaN();  // no rule compares it
      if constexpr (std::is_same_v<T, std::string>) *out = value.text;  // other parts may refer to it
      const bool stands_in = std::is_same_v<T, double> || std::is_same_v<T, std::string>;
      complete_ = complete_ && (std::is_enum_v<T> || (stands_in && value.kind == YamlValue::Kind::kText));
      const std::string key = path.ToString();
      not_read_.insert(std::is_enum_v<T> ? key.substr(0, key.find_last_of('.')) : key);
    }
  }

 private:
  template <typename T>
  void ReadList(const YamlValue& list, const KeyPath& path, std::vector<T>* out) {
    if (list.kind != YamlValue::Kind::kList) return WrongType(list, path, "must be a list");
    out->resize(list.items.size());
    for (std::size_t i = 0; i < out->size(); ++i) {
      T item = {};
      Read(list.items[i], path[i], &item);
      (*out)[i] = std::move(item);
    }
  }

  template <typename Part>
  void ReadPart(const YamlValue& map, const KeyPath& path, Part* out) {
    if (map.kind == YamlValue::Kind::kNull) return;
    if (map.kind != YamlValue::Kind::kMap)
      return WrongType(map, path, "must be a map with keys of: " + FieldNames<Part>());
    std::unordered_map<std::string, int> lines;
    for (std::size_t i = 0; i + 1 < map.items.size(); i += 2) {
      const YamlValue &key = map.items[i], &value = map.items[i + 1];
      const std::string name = key.kind == YamlValue::Kind::kText ? key.text : Show(key);
      if (const auto [earlier, is_new] = lines.emplace(name, key.line); !is_new) {
        Add(key.line, path.Key(name), value, "repeated key, first in line " + std::to_string(earlier->second));
      } else if (!ReadField(name, value, path, out)) {
        std::string meant;
        Add(key.line, path.Key(name), value, UnknownKey<Part>(name, &meant));
        not_read_.insert(path.Key(meant).ToString());
      }
    }
  }

  // False where the part has no such field.
  template <typename Part>
  bool ReadField(std::string_view name, const YamlValue& value, const KeyPath& path, Part* out) {
    bool known = false;
    ForEachField<Part>([&](const auto& field) {
      if (field.name != name) return;
      known = true;
      if (value.kind != YamlValue::Kind::kNull) Read(value, path.Key(name), &(out->*field.member));
    });
    return known;
  }

  template <typename Part>
  static std::string UnknownKey(std::string_view name, std::string* meant) {
    std::string new_name;
    NearestName nearest(name);
    ForEachField<Part>([&](const auto& field) {
      if (field.formerly == name) new_name = field.name;
      nearest.Offer(field.name);
    });
    *meant = new_name.empty() ? nearest.Get() : new_name;
    if (!new_name.empty()) return "unknown key, is named " + new_name + " now";
    const std::string question = nearest.Get().empty() ? "" : " (did you mean " + nearest.Get() + "?)";
    return "unknown key" + question + ", must be one of: " + FieldNames<Part>();
  }

  void Add(int line, const KeyPath& path, const YamlValue& value, std::string rule) {
    violations_.push_back({path.ToString(), Show(value), std::move(rule), {}, line});
  }

  void WrongType(const YamlValue& value, const KeyPath& path, std::string rule) {
    Add(0, path, value, std::move(rule));
    complete_ = false;
    not_read_.insert(path.ToString());
  }

  std::vector<Violation> violations_;
  std::unordered_set<std::string> not_read_;  // keys
  bool complete_ = true;
};

// The line of the deepest key or list element on `path` that stands in the file.
int LineOf(const YamlValue& root, std::string_view path) {
  const YamlValue* at = &root;
  int line = root.line;
  while (!path.empty()) {
    const std::size_t end = path[0] == '[' ? path.find(']') + 1 : path.find_first_of(".[", 1);
    const std::string_view part = path.substr(0, end);
    path.remove_prefix(part.size());
    const YamlValue* next = nullptr;
    if (part[0] == '[' && at->kind == YamlValue::Kind::kList) {
      const std::size_t index = ParseWhole(part.substr(1, part.size() - 2)).value_or(0);
      if (index < at->items.size()) next = &at->items[index];
      if (next != nullptr) line = next->line;
    } else if (at->kind == YamlValue::Kind::kMap) {
      const std::string_view name = part[0] == '.' ? part.substr(1) : part;
      for (std::size_t i = 0; i + 1 < at->items.size() && next == nullptr; i += 2) {
        if (at->items[i].text != name) continue;
        next = &at->items[i + 1];
        line = at->items[i].line;
      }
    }
    if (next == nullptr) return line;
    at = next;
  }
  return line;
}

template <typename T>
bool IsDefault(const T& value, const T& by_default) {
  if constexpr (kIsPart<T>) {
    bool same = true;
    ForEachField<T>(
        [&](const auto& field) { same = same && IsDefault(value.*field.member, by_default.*field.member); });
    return same;
  } else if constexpr (kIsPartList<T>) {
    return value.empty();
  } else {
    return value == by_default;
  }
}

// Whether a part contains parts, and takes more than a line.
template <typename Part>
bool HasParts() {
  bool has_parts = false;
  ForEachField<Part>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    has_parts = has_parts || kIsPart<Value> || kIsPartList<Value>;
  });
  return has_parts;
}

// A part is written by its description: one without parts of its own as a map on one line.
template <typename T>
void Write(const T& value, YAML::Emitter* out) {
  if constexpr (kIsPart<T>) {
    const T by_default;
    *out << (HasParts<T>() ? YAML::Block : YAML::Flow) << YAML::BeginMap;
    ForEachField<T>([&](const auto& field) {
      if (IsDefault(value.*field.member, by_default.*field.member)) return;
      *out << YAML::Key << std::string(field.name) << YAML::Value;
      Write(value.*field.member, out);
    });
    *out << YAML::EndMap;
  } else if constexpr (kIsList<T>) {
    *out << (kIsPartList<T> ? YAML::Block : YAML::Flow) << YAML::BeginSeq;
    for (const auto& item : value) Write(item, out);
    *out << YAML::EndSeq;
  } else if constexpr (std::is_enum_v<T>) {
    *out << std::string(ToString(value));
  } else if constexpr (std::is_same_v<T, std::string>) {
    // Only a text that could be something else, e.g. "1" or "yes", needs the quotes.
    *out << YAML::DoubleQuoted << value << YAML::Auto;
  } else {
    *out << value;
  }
}

}  // namespace

TraceRequest ReadTraceRequest(const std::string& text, const std::string& file_name) {
  const YamlValue root = ParseYaml(text, file_name);
  TraceRequest request;
  Reader in;
  in.Read(root, KeyPath(), &request);
  std::vector<Violation> violations = in.violations();
  for (const Violation& broken : in.complete() ? Validate(request) : ValidateNumbers(request))
    if (!in.Explains(broken)) violations.push_back(broken);
  if (violations.empty()) return request;
  for (Violation& violation : violations) {
    violation.file = file_name;
    if (violation.line == 0) violation.line = LineOf(root, violation.key);
  }
  std::stable_sort(violations.begin(), violations.end(),
                   [](const Violation& a, const Violation& b) { return a.line < b.line; });
  throw InvalidRequest(std::move(violations));
}

TraceRequest ReadTraceRequestFile(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (stream && text.size() <= kLargestYaml) {  // ReadTraceRequest refuses what is longer
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad()) {
    Refuse(path, 0, "cannot be read" + (errno != 0 ? ": " + std::generic_category().message(errno) : ""));
  }
  return ReadTraceRequest(text, path);
}

std::string WriteTraceRequest(const TraceRequest& request) {
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  Write(request, &out);
  out << YAML::Newline;
  return out.c_str();
}

}  // namespace contact_path
