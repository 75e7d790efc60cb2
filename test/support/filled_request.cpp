#include "support/filled_request.h"

#include <string>
#include <type_traits>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/words.h"

namespace contact_path {
namespace {

// count: of the values given so far.
template <typename T>
void Fill(int* count, T* value) {
  ++*count;
  if constexpr (kIsPart<T>) {
    ForEachField<T>([&](const auto& field) { Fill(count, &(value->*field.member)); });
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    *value = {true, false};
  } else if constexpr (kIsList<T>) {
    value->resize(2);
    for (auto& element : *value) Fill(count, &element);
  } else if constexpr (std::is_same_v<T, std::string>) {
    *value = "text " + std::to_string(*count);
  } else if constexpr (std::is_same_v<T, bool>) {
    *value = !*value;
  } else if constexpr (std::is_enum_v<T>) {
    ForEachWord<T>([&](std::string_view, T meaning) { *value = meaning; });
  } else {
    *value = static_cast<T>(*count);
  }
}

}  // namespace

TraceRequest FilledRequest() {
  TraceRequest request;
  int count = 0;
  Fill(&count, &request);
  return request;
}

}  // namespace contact_path
