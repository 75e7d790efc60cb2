// The words in which scene.h describes the fields of a request: the name of a field, the member that holds it, its
// unit, the numbers that it admits, and what a text of it names.
//
// A description is written once, for any struct with these members: the struct of the core and the generated message.
// Reader, writer, checks, change of units, comparison and conversion go through the descriptions.
#ifndef CONTACT_PATH_SCENE_FIELD_H_
#define CONTACT_PATH_SCENE_FIELD_H_

#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace contact_path {

// Exponents of a unit: EA is a force, {0, 1, 0}; a stiffness is a force per length, {-1, 1, 0}; the velocity of a
// support is a length per unit of the load factor, {1, 0, -1}.
struct Unit {
  int length = 0;
  int force = 0;
  int load_factor = 0;
};

constexpr bool operator==(const Unit& a, const Unit& b) {
  return a.length == b.length && a.force == b.force && a.load_factor == b.load_factor;
}

namespace units {
constexpr Unit kNone = {0, 0, 0};
constexpr Unit kLength = {1, 0, 0};
constexpr Unit kForce = {0, 1, 0};
constexpr Unit kStiffness = {-1, 1, 0};
constexpr Unit kStress = {-2, 1, 0};
constexpr Unit kLoadFactor = {0, 0, 1};
constexpr Unit kLengthRate = {1, 0, -1};
constexpr Unit kForceRate = {0, 1, -1};
constexpr Unit kBending = {2, 1, 0};  // EI
constexpr Unit kMoment = {1, 1, 0};
constexpr Unit kMomentRate = {1, 1, -1};
constexpr Unit kTractionRate = {-1, 1, -1};  // force per length
constexpr Unit kRotationRate = {0, 0, -1};   // [rad] per unit of the load factor
constexpr Unit kRate = {0, 0, -1};           // of a number without unit
}  // namespace units

// The numbers that a field admits. All but the last must be finite and at most 1e100 in magnitude.
enum class Range {
  kAny,
  kNotNegative,            // >= 0
  kPositive,               // >= 1e-100
  kZeroOrPositive,         // 0, or >= 1e-100
  kNotNegativeOrInfinite,  // >= 0, or infinite
};

// What a text, or each text of a list, is.
enum class TextKind {
  kAny,       // for people; UTF-8
  kNewName,   // the name of the part: unique in its list, and fit for the columns of a table
  kNode,      // the name of a node of the scene
  kObstacle,  // the name of an obstacle of the scene
  kMaterial,  // the name of a material of the scene
  kQuantity,  // a quantity of a path (quantity.h)
};

// One field of Part, which is a struct of scene.h or a message with the same members.
template <typename PartType, typename ValueType>
struct Member {
  using Part = PartType;
  using Value = ValueType;

  constexpr Member(std::string_view field_name, Value Part::*field_member) : name(field_name), member(field_member) {}

  constexpr Member In(Unit of_number) const { return With(&Member::unit, of_number); }
  constexpr Member Within(Range admitted) const { return With(&Member::range, admitted); }
  constexpr Member Naming(TextKind kind) const { return With(&Member::text, kind); }
  // The text may be left out.
  constexpr Member OrNone() const { return With(&Member::optional, true); }
  // The name of the field in earlier versions, for a message that tells the new one.
  constexpr Member Formerly(std::string_view old_name) const { return With(&Member::formerly, old_name); }

  template <typename T>
  constexpr Member With(T Member::*what, T value) const {
    Member changed = *this;
    changed.*what = value;
    return changed;
  }

  std::string_view name;  // the same in scene files and messages
  Value Part::*member;
  Unit unit = {};
  Range range = Range::kAny;
  TextKind text = TextKind::kAny;
  bool optional = false;  // whether the text may be empty, whatever its kind
  std::string_view formerly = {};
};

// The description of a part: an overload of Fields with the argument Of<Part>, which gives a tuple of Member of Struct,
// where Struct is Part or a message with the same members. A member that Struct lacks is an error of compilation. The
// default of a field is the initialiser of its member.
template <typename Part>
struct Of {};
template <typename Struct>
void Fields();

// Calls visit(field) for each field of Part, in the order of the description.
template <typename Part, typename Visit>
constexpr void ForEachField(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Fields<Part>(Of<Part>()));
}

// "name, x, y": for a message.
template <typename Part>
std::string FieldNames() {
  std::string names;
  ForEachField<Part>([&](const auto& field) { names.append(names.empty() ? "" : ", ").append(field.name); });
  return names;
}

namespace field_internal {

template <typename T, typename = void>
struct IsDescribed : std::false_type {};
template <typename T>
struct IsDescribed<T, std::void_t<decltype(Fields<T>(Of<T>()))>> : std::true_type {};

}  // namespace field_internal

// Calls visit(field of Part, field of Other) for each field of Part. Other has the same members.
template <typename Part, typename Other, typename Visit>
constexpr void ForEachFieldPair(Visit&& visit) {
  const auto with_others = [&](const auto&... field) {
    std::apply([&](const auto&... other) { (visit(field, other), ...); }, Fields<Other>(Of<Part>()));
  };
  std::apply(with_others, Fields<Part>(Of<Part>()));
}

// Whether T is a part: a struct with a description.
template <typename T>
constexpr bool kIsPart = field_internal::IsDescribed<T>::value;

// Whether T is a list, and whether its elements are parts.
template <typename T>
constexpr bool kIsList = false;
template <typename T>
constexpr bool kIsList<std::vector<T>> = true;
template <typename T>
constexpr bool kIsPartList = false;
template <typename T>
constexpr bool kIsPartList<std::vector<T>> = kIsPart<T>;

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_FIELD_H_
