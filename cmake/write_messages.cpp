// Gives the messages of the parts of a scene what scene.h, slender_parts.h, solid_parts.h, trace_options.h describe and
// they lack: a field, or a whole message for a new kind of part. What a message has stays as it is. Usage:
// write_messages DIRECTORY
//
// write_messages --fields: prints the fields instead, for write_signatures.py. In a line: the field of a request that
// holds the part, the field, its type and its comment as in messages, with tabs between them.
//
// The messages must be there before CMake runs, so scripts/messages compiles this from the headers alone.
#include <cxxabi.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <regex>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {
namespace {

template <typename Part>
std::string MessageOf() {
  if (std::is_same_v<Part, ContactCandidate>) return "Contact";
  const std::unique_ptr<char, decltype(&std::free)> name(
      abi::__cxa_demangle(typeid(Part).name(), nullptr, nullptr, nullptr), &std::free);
  return std::string(name.get()).substr(sizeof("contact_path::") - 1);
}

template <typename Value>
std::string TypeOf() {
  if constexpr (kIsPart<Value>) {
    return MessageOf<Value>();
  } else if constexpr (kIsList<Value>) {
    return TypeOf<typename Value::value_type>() + "[]";
  } else if constexpr (std::is_same_v<Value, double>) {
    return "float64";
  } else if constexpr (std::is_same_v<Value, bool>) {
    return "bool";
  } else if constexpr (std::is_same_v<Value, int>) {
    return "int32";
  } else {
    static_assert(std::is_same_v<Value, std::string> || std::is_enum_v<Value>);
    return "string";
  }
}

std::string Power(const char* unit, int exponent) {
  if (exponent == 0) return "";
  return std::string(" ") + unit + (exponent == 1 ? "" : "^" + std::to_string(exponent));
}

template <typename Field>
std::string CommentOf(const Field& field) {
  std::string comment;
  if constexpr (std::is_enum_v<typename Field::Value>) {
    ForEachWord<typename Field::Value>([&](std::string_view word, auto value) {
      comment += (comment.empty() ? "\"" : ", \"") + std::string(word) + "\"" +
                 (value == DefaultOf(value) ? " (also \"\")" : "");
    });
  }
  const std::string unit = Power("length", field.unit.length) + Power("force", field.unit.force) +
                           Power("load factor", field.unit.load_factor);
  if (!unit.empty()) comment = "[" + unit.substr(1) + "]";
  const auto append = [&comment](const char* rule) { comment += (comment.empty() ? "" : ", ") + std::string(rule); };
  if (field.range == Range::kNotNegative) append(">= 0");
  if (field.range == Range::kPositive) append("> 0");
  if (field.range == Range::kZeroOrPositive) append("0 or > 0");
  return comment.empty() ? "" : "  # " + comment;
}

template <typename Part>
void Complete(const std::string& directory) {
  const std::string path = directory + "/" + MessageOf<Part>() + ".msg";
  std::string text;
  if (std::ifstream in(path); in) text.assign(std::istreambuf_iterator<char>(in), {});
  std::string added;
  ForEachField<Part>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    const std::string type = TypeOf<Value>(), name(field.name);
    if (!std::regex_search(text, std::regex("(^|\n)[A-Za-z0-9]+(\\[\\])? +" + name + "( |\n|$)")))
      added += type + " " + name + CommentOf(field) + "\n";
    if constexpr (kIsPart<Value>) Complete<Value>(directory);
    if constexpr (kIsPartList<Value>) Complete<typename Value::value_type>(directory);
  });
  if (added.empty()) return;
  std::cout << path << ":\n" << added;
  if (!(std::ofstream(path, std::ios::app) << added)) {
    std::cerr << path << ": cannot be written\n";
    std::exit(1);
  }
}

// holder: the field that holds the part.
template <typename Part>
void Print(const std::string& holder) {
  ForEachField<Part>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    const std::string comment = CommentOf(field), name(field.name);
    std::cout << holder << '\t' << name << '\t' << TypeOf<Value>() << '\t' << (comment.empty() ? "" : comment.substr(4))
              << '\n';
    if constexpr (kIsPart<Value>) Print<Value>(name);
    if constexpr (kIsPartList<Value>) Print<typename Value::value_type>(name);
  });
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_messages DIRECTORY, or write_messages --fields\n";
    return 2;
  }
  if (std::string(argv[1]) == "--fields")
    contact_path::Print<contact_path::TraceRequest>("request");
  else
    contact_path::Complete<contact_path::TraceRequest>(argv[1]);
  return 0;
}
