// A part of a request in other units, by the description of its fields.
#ifndef CONTACT_PATH_SCENE_CHANGE_UNITS_H_
#define CONTACT_PATH_SCENE_CHANGE_UNITS_H_

#include <type_traits>
#include <utility>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// The new units in the old ones, all > 0.
struct UnitSizes {
  double length = 1.0;
  double force = 1.0;
  double load_factor = 1.0;
};

// The size of `unit` in the old units.
inline double SizeOf(const Unit& unit, const UnitSizes& sizes) {
  double size = 1.0;
  for (const auto& [base, exponent] : {std::pair(sizes.force, unit.force), std::pair(sizes.length, unit.length),
                                       std::pair(sizes.load_factor, unit.load_factor)}) {
    for (int i = 0; i < exponent; ++i) size *= base;
    for (int i = 0; i > exponent; --i) size /= base;
  }
  return size;
}

// Expresses all numbers of a part, and of the parts in it, in the new units. The value of a stop criterion, which has
// the unit of its quantity, stays as it is.
template <typename Part>
void ChangeUnits(Part* part, UnitSizes sizes) {
  if constexpr (std::is_same_v<Part, Load>)
    if (part->constant) sizes.load_factor = 1.0;  // a constant load is no load per unit of the load factor
  ForEachField<Part>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    [[maybe_unused]] Value& value = part->*field.member;
    [[maybe_unused]] const double size = SizeOf(field.unit, sizes);
    if constexpr (std::is_same_v<Value, double>) value /= size;
    if constexpr (std::is_same_v<Value, std::vector<double>>)
      for (double& entry : value) entry /= size;
    if constexpr (kIsPart<Value>) ChangeUnits(&value, sizes);
    if constexpr (kIsPartList<Value>)
      for (auto& item : value) ChangeUnits(&item, sizes);
  });
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_CHANGE_UNITS_H_
