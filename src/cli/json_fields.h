// Parts with a description of their fields (scene/field.h) as JSON.
#ifndef CONTACT_PATH_SRC_CLI_JSON_FIELDS_H_
#define CONTACT_PATH_SRC_CLI_JSON_FIELDS_H_

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <type_traits>

#include "contact_path/scene/field.h"

namespace contact_path {

// Keys are sorted: objects that keep their order came to the library later than Ubuntu 20.04.
using Json = nlohmann::json;

// Described parts become objects, words strings, lists lists of these.
template <typename Value>
Json JsonOf(const Value& value) {
  Json json;
  if constexpr (kIsPart<Value>) {
    ForEachField<Value>([&](const auto& field) { json[std::string(field.name)] = JsonOf(value.*field.member); });
  } else if constexpr (kIsList<Value>) {
    json = Json::array();
    for (const auto& item : value) json.push_back(JsonOf(item));
  } else if constexpr (std::is_enum_v<Value>) {
    json = std::string(ToString(value));
  } else {
    json = value;
  }
  return json;
}

inline void WriteLine(const Json& object, std::ostream* out) {
  // Text that is not UTF-8 does not come through the reader of scenes.
  *out << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_CLI_JSON_FIELDS_H_
