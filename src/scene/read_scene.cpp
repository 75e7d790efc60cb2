#include "contact_path/scene/read_scene.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact_path/scene/validate.h"
#include "scene/yaml_tree.h"

namespace contact_path {
namespace {

bool IsPlain(const YamlValue& value) { return value.kind == YamlValue::Kind::kText && !value.quoted; }

// Whole numbers with a leading zero are refused: octal to some readers of YAML, decimal to others.
bool HasLeadingZero(const std::string& word) {
  const std::size_t first = word.find_first_not_of("+-");
  return first != word.npos && first + 1 < word.size() && word[first] == '0' &&
         word.find_first_not_of("0123456789", first) == word.npos;
}

// The truth values of YAML 1.1, as ROS reads them too, and 0 and 1.
std::optional<bool> ParseFlag(const YamlValue& value) {
  if (!IsPlain(value)) return std::nullopt;
  for (const char* yes : {"true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON", "1"}) {
    if (value.text == yes) return true;
  }
  for (const char* no : {"false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF", "0"}) {
    if (value.text == no) return false;
  }
  return std::nullopt;
}

std::optional<int> ParseInteger(const YamlValue& value) {
  const std::string& word = value.text;
  if (!IsPlain(value) || HasLeadingZero(word)) return std::nullopt;
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  int integer = 0;
  const auto [end, error] = std::from_chars(word.data() + (has_plus ? 1 : 0), word.data() + word.size(), integer);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(integer) : std::nullopt;
}

// Decimal numbers with or without point and exponent, .inf and .nan. Those too large for a double are infinite.
std::optional<double> ParseNumber(const YamlValue& value) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string& word = value.text;
  if (!IsPlain(value) || HasLeadingZero(word)) return std::nullopt;
  for (const char* special : {".inf", ".Inf", ".INF"}) {
    if (word == special || word == std::string("+") + special) return kInfinity;
    if (word == std::string("-") + special) return -kInfinity;
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
    return number == 0.0 ? std::nullopt : std::optional(std::copysign(kInfinity, number));
  }
  return stream.peek() == std::istringstream::traits_type::eof() ? std::optional(number) : std::nullopt;
}

// Plain words that YAML takes for numbers or truth values are no text; the service of ROS refuses them too.
std::optional<std::string> ParseText(const YamlValue& value) {
  if (value.kind != YamlValue::Kind::kText) return std::nullopt;
  if (ParseFlag(value) || ParseInteger(value) || ParseNumber(value)) return std::nullopt;
  return value.text;
}

constexpr const char* kNumberRule = "must be a number";
constexpr const char* kTextRule = "must be text (in quotes if it could be a number or a truth value)";

// What stands in the file, for a message.
std::string Show(const YamlValue& value) {
  switch (value.kind) {
    case YamlValue::Kind::kNull: return "null";
    case YamlValue::Kind::kText: return value.quoted ? "\"" + value.text + "\"" : value.text;
    case YamlValue::Kind::kList: return "a list";
    case YamlValue::Kind::kMap: return "a map";
  }
  return "";
}

// Reads maps by tables of keys, each of which knows how to take its value, and collects what is wrong.
// Violations of line 0 stand where their key does.
class Reader {
 public:
  struct Key {
    std::string_view name;
    std::function<void(const YamlValue& value, const std::string& path)> take;
  };

  const std::vector<Violation>& violations() const { return violations_; }
  // False where a value could not be read and is missing from the result.
  bool complete() const { return complete_; }

  void ReadMap(const YamlValue& map, const std::string& path, const std::vector<Key>& keys) {
    if (map.kind == YamlValue::Kind::kNull) return;
    if (map.kind != YamlValue::Kind::kMap) return WrongType(map, path, "must be a map with keys of: " + Names(keys));
    std::unordered_map<std::string, int> lines;
    for (std::size_t i = 0; i + 1 < map.items.size(); i += 2) {
      const YamlValue& value = map.items[i + 1];
      const int line = map.items[i].line;
      const std::string name = map.items[i].kind == YamlValue::Kind::kText ? map.items[i].text : Show(map.items[i]);
      const std::string key_path = path.empty() ? name : path + "." + name;
      const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& known) { return known.name == name; });
      const auto [earlier, is_new] = lines.emplace(name, line);
      if (!is_new) {
        Add(line, key_path, Show(value), "repeated key, first in line " + std::to_string(earlier->second));
      } else if (key == keys.end()) {
        Add(line, key_path, Show(value), "unknown key, must be one of: " + Names(keys));
      } else if (value.kind != YamlValue::Kind::kNull) {
        key->take(value, key_path);
      }
    }
  }

  template <typename T>
  void Take(const YamlValue& value, const std::string& path, const std::optional<T>& parsed, const char* rule, T& out) {
    if (!parsed) return WrongType(value, path, rule);
    out = *parsed;
  }

  Key Text(const char* name, std::string& out) { return Scalar(name, ParseText, kTextRule, out); }
  Key Number(const char* name, double& out) { return Scalar(name, ParseNumber, kNumberRule, out); }
  Key Integer(const char* name, int& out) { return Scalar(name, ParseInteger, "must be an integer", out); }
  Key Flag(const char* name, bool& out) { return Scalar(name, ParseFlag, "must be true or false", out); }

  // A word that `parse` knows.
  template <typename Enum>
  Key Word(const char* name, std::optional<Enum> (*parse)(std::string_view), const char* rule, Enum& out) {
    return {name, [this, parse, rule, &out](const YamlValue& value, const std::string& path) {
              const bool is_text = value.kind == YamlValue::Kind::kText;
              Take(value, path, is_text ? parse(value.text) : std::nullopt, rule, out);
            }};
  }

  // A list of what Read() takes.
  template <typename T>
  Key List(const char* name, std::vector<T>& out) {
    return {name, [this, &out](const YamlValue& list, const std::string& path) {
              if (list.kind != YamlValue::Kind::kList) return WrongType(list, path, "must be a list");
              out.resize(list.items.size());
              for (std::size_t i = 0; i < out.size(); ++i) {
                Read(*this, list.items[i], path + "[" + std::to_string(i) + "]", out[i]);
              }
            }};
  }

  // A map or list of maps that Read() takes.
  template <typename T>
  Key Part(const char* name, T& out) {
    return {name, [this, &out](const YamlValue& value, const std::string& path) { Read(*this, value, path, out); }};
  }

 private:
  template <typename T>
  Key Scalar(const char* name, std::optional<T> (*parse)(const YamlValue&), const char* rule, T& out) {
    return {name, [this, parse, rule, &out](const YamlValue& value, const std::string& path) {
              Take(value, path, parse(value), rule, out);
            }};
  }

  static std::string Names(const std::vector<Key>& keys) {
    std::string names;
    for (const Key& key : keys) names.append(names.empty() ? "" : ", ").append(key.name);
    return names;
  }

  void Add(int line, std::string path, std::string value, std::string rule) {
    Violation violation;
    violation.key = std::move(path);
    violation.value = std::move(value);
    violation.rule = std::move(rule);
    violation.line = line;
    violations_.push_back(std::move(violation));
  }

  void WrongType(const YamlValue& value, const std::string& path, std::string rule) {
    Add(0, path, Show(value), std::move(rule));
    complete_ = false;
  }

  std::vector<Violation> violations_;
  bool complete_ = true;
};

void Read(Reader& in, const YamlValue& value, const std::string& path, std::string& out) {
  in.Take(value, path, ParseText(value), kTextRule, out);
}

void Read(Reader& in, const YamlValue& value, const std::string& path, double& out) {
  in.Take(value, path, ParseNumber(value), kNumberRule, out);
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Node& node) {
  in.ReadMap(value, path,
             {in.Text("name", node.name), in.Number("x", node.x), in.Number("y", node.y),
              in.Flag("fixed_x", node.fixed_x), in.Flag("fixed_y", node.fixed_y)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Bar& bar) {
  in.ReadMap(value, path,
             {in.List("nodes", bar.nodes), in.Number("EA", bar.EA), in.Number("rest_length", bar.rest_length),
              in.Word("strain", ParseStrainMeasure, "must be biot, green_lagrange or logarithmic", bar.strain)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Superelement& element) {
  in.ReadMap(value, path,
             {in.List("nodes", element.nodes), in.List("stiffness", element.stiffness),
              in.List("rest_positions", element.rest_positions)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Load& load) {
  in.ReadMap(value, path,
             {in.Text("node", load.node), in.Number("fx", load.fx), in.Number("fy", load.fy),
              in.Flag("constant", load.constant)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Obstacle& obstacle) {
  in.ReadMap(
      value, path,
      {in.Text("name", obstacle.name), in.Word("shape", ParseObstacleShape, "must be half_plane", obstacle.shape),
       in.Number("px", obstacle.px), in.Number("py", obstacle.py), in.Number("nx", obstacle.nx),
       in.Number("ny", obstacle.ny), in.Number("friction", obstacle.friction)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, ContactCandidate& contact) {
  in.ReadMap(value, path, {in.Text("node", contact.node), in.Text("obstacle", contact.obstacle)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, SupportMotion& motion) {
  in.ReadMap(value, path, {in.Text("node", motion.node), in.Number("dx", motion.dx), in.Number("dy", motion.dy)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, ObstacleMotion& motion) {
  in.ReadMap(value, path,
             {in.Text("obstacle", motion.obstacle), in.Number("dx", motion.dx), in.Number("dy", motion.dy)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, StopCriterion& stop) {
  in.ReadMap(value, path,
             {in.Text("quantity", stop.quantity), in.Text("when", stop.when), in.Number("value", stop.value)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, BranchChoice& choice) {
  in.ReadMap(value, path,
             {in.Integer("event", choice.event), in.Integer("increment", choice.increment),
              in.Integer("branch", choice.branch)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Scene& scene) {
  in.ReadMap(value, path,
             {in.Text("name", scene.name), in.List("nodes", scene.nodes), in.List("bars", scene.bars),
              in.List("superelements", scene.superelements), in.List("loads", scene.loads),
              in.List("obstacles", scene.obstacles), in.List("contacts", scene.contacts),
              in.List("support_motions", scene.support_motions), in.List("obstacle_motions", scene.obstacle_motions)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, TraceOptions& options) {
  in.ReadMap(
      value, path,
      {in.Word("method", ParseMethod, "must be branch or mpec", options.method),
       in.Word("accuracy", ParseAccuracy, "must be fast, balanced or accurate", options.accuracy),
       in.Number("direction", options.direction), in.Number("step", options.step),
       in.Integer("max_increments", options.max_increments), in.Integer("full_state_every", options.full_state_every),
       in.List("stop", options.stop), in.List("branch_choices", options.branch_choices)});
}

void Read(Reader& in, const YamlValue& value, const std::string& path, Stage& stage) {
  in.ReadMap(
      value, path,
      {in.Text("name", stage.name), in.List("loads", stage.loads), in.List("support_motions", stage.support_motions),
       in.List("obstacle_motions", stage.obstacle_motions), in.Number("target", stage.target)});
}

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
      std::size_t index = 0;
      std::from_chars(part.data() + 1, part.data() + part.size(), index);
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

}  // namespace

TraceRequest ReadTraceRequest(const std::string& text, const std::string& file_name) {
  const YamlValue root = ParseYaml(text, file_name);
  TraceRequest request;
  Reader in;
  in.ReadMap(
      root, "",
      {in.Part("scene", request.scene), in.Part("options", request.options), in.List("program", request.program)});
  std::vector<Violation> violations = in.violations();
  if (in.complete()) {  // otherwise the request would be judged by what is missing
    std::vector<Violation> broken_rules = Validate(request);
    std::move(broken_rules.begin(), broken_rules.end(), std::back_inserter(violations));
  }
  if (violations.empty()) return request;
  for (Violation& violation : violations) {
    violation.file = file_name;
    if (violation.line == 0) violation.line = LineOf(root, violation.key);
  }
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

}  // namespace contact_path
