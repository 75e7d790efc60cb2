#include "support/same_request.h"

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"

namespace contact_path {
namespace {

bool Same(double a, double b) { return a == b || (a != a && b != b); }

// The place of the first difference; empty if there is none.
template <typename T>
std::string Difference(const KeyPath& path, const T& a, const T& b) {
  if constexpr (kIsPart<T>) {
    std::string first;
    ForEachField<T>([&](const auto& field) {
      if (first.empty()) first = Difference(path.Key(field.name), a.*field.member, b.*field.member);
    });
    return first;
  } else if constexpr (kIsList<T>) {
    if (a.size() != b.size()) return "size of " + path.ToString();
    std::string first;
    for (std::size_t i = 0; i < a.size() && first.empty(); ++i) first = Difference(path[i], a[i], b[i]);
    return first;
  } else if constexpr (std::is_same_v<T, double>) {
    return Same(a, b) ? "" : path.ToString();
  } else {
    return a == b ? "" : path.ToString();
  }
}

}  // namespace

std::string FirstDifference(const TraceRequest& a, const TraceRequest& b) { return Difference(KeyPath(), a, b); }

}  // namespace contact_path
