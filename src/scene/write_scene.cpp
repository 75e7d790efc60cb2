#include "contact_path/scene/write_scene.h"

#include <yaml-cpp/yaml.h>

#include <limits>
#include <type_traits>

#include "contact_path/scene/field.h"
#include "contact_path/scene/words.h"

namespace contact_path {
namespace {

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

// Writes parts by their descriptions: one without parts of its own as a map on one line.
class Writer {
 public:
  explicit Writer(YAML::Emitter* out) : out_(*out) {}

  template <typename T>
  void Write(const T& value) {
    if constexpr (kIsPart<T>) {
      WritePart(value);
    } else if constexpr (kIsList<T>) {
      out_ << (kIsPartList<T> ? YAML::Block : YAML::Flow) << YAML::BeginSeq;
      for (const auto& item : value) Write(item);
      out_ << YAML::EndSeq;
    } else if constexpr (std::is_enum_v<T>) {
      out_ << std::string(ToString(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      // Only a text that could be something else, e.g. "1" or "yes", needs the quotes.
      out_ << YAML::DoubleQuoted << value << YAML::Auto;
    } else {
      out_ << value;
    }
  }

 private:
  template <typename Part>
  void WritePart(const Part& part) {
    const Part by_default;
    out_ << (HasParts<Part>() ? YAML::Block : YAML::Flow) << YAML::BeginMap;
    ForEachField<Part>([&](const auto& field) {
      if (IsDefault(part.*field.member, by_default.*field.member)) return;
      out_ << YAML::Key << std::string(field.name) << YAML::Value;
      Write(part.*field.member);
    });
    out_ << YAML::EndMap;
  }

  YAML::Emitter& out_;
};

}  // namespace

std::string WriteTraceRequest(const TraceRequest& request) {
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  Writer(&out).Write(request);
  out << YAML::Newline;
  return out.c_str();
}

}  // namespace contact_path
