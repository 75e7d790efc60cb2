// Parts with a description of their fields (scene/field.h) as JSON.
#ifndef CONTACT_PATH_SRC_CLI_JSON_FIELDS_H_
#define CONTACT_PATH_SRC_CLI_JSON_FIELDS_H_

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "contact_path/contact/contact_state.h"
#include "contact_path/scene/field.h"

namespace contact_path {

// Keys are sorted: objects that keep their order came to the library later than Ubuntu 20.04.
using Json = nlohmann::json;

// A value of a field: a number, a word, or a list of these.
template <typename Value>
Json JsonOf(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(ToString(value));
  else
    return value;
}
inline Json JsonOf(const std::vector<ContactState>& states) {
  Json list = Json::array();
  for (const ContactState state : states) list.push_back(JsonOf(state));
  return list;
}

// Described parts become objects, lists of them lists of objects.
template <typename Part>
void SetFields(const Part& part, Json* object);
template <typename Value>
Json FieldOf(const Value& value);
template <typename Value>
Json FieldOf(const std::vector<Value>& values) {
  if constexpr (field_internal::IsDescribed<Value>::value) {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(FieldOf(value));
    return list;
  } else {
    return JsonOf(values);
  }
}
template <typename Value>
Json FieldOf(const Value& value) {
  if constexpr (field_internal::IsDescribed<Value>::value) {
    Json object;
    SetFields(value, &object);
    return object;
  } else {
    return JsonOf(value);
  }
}
template <typename Part>
void SetFields(const Part& part, Json* object) {
  ForEachField<Part>([&](const auto& field) { (*object)[std::string(field.name)] = FieldOf(part.*field.member); });
}

inline void WriteLine(const Json& object, std::ostream* out) {
  // Text that is not UTF-8 does not come through the reader of scenes.
  *out << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_CLI_JSON_FIELDS_H_
