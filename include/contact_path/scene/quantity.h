// The quantities of a path that a person can name: in stop criteria, and in the same words in plots and tables.
#ifndef CONTACT_PATH_SCENE_QUANTITY_H_
#define CONTACT_PATH_SCENE_QUANTITY_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "contact_path/scene/field.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/text.h"

namespace contact_path {

// A number of each increment of a path.
struct Quantity {
  enum class Kind {
    kLoadFactor,  // load_factor
    kSetting,     // setting: of the machine that loads the structure
    kX,           // <node>.x, or x_<node>: current position
    kY,           // <node>.y, or y_<node>
    // <obstacle>.x, or x_<obstacle>: of its point p, where it is now. Of a node and an obstacle with one name the node
    // is meant.
    kObstacleX,
    kObstacleY,  // .y
    kTurn,       // <obstacle>.turn, or turn_<obstacle>: since the start [rad]
    kRotation,   // <node>.rotation, or rotation_<node>: of a node that a beam turns, since the start [rad]
    kGap,        // <contact>.gap, or gap_<contact>; a contact has the name of its candidate
    kRn,         // <contact>.rn, or rn_<contact>: normal reaction
    kRt,         // <contact>.rt, or rt_<contact>: tangential reaction
    kPressure,   // <contact>.pressure: rn over the length of the boundary there (response/contact_pressure.h)
    kTraction,   // <contact>.traction: rt over that length
    kWidth,      // <obstacle>.width, <surface>.width: length of the contacts that touch it
    // <node>.rx, or rx_<node>: of the support, on the structure; <obstacle>.rx, <surface>.rx: of all contacts with it;
    // <pin>.rx: on the first node by the second. Of several with one name the first of these is meant.
    kForceX,
    kForceY,  // .ry
    kMoment,  // .rm
    // <beam>.<segment>.N or bar<place>.N, or N_<beam>.<segment>: of a section (response/element_response.h)
    kN,
    kQ,   // .Q
    kM,   // .M
    kM1,  // .M1
    kM2,  // .M2
    // <solid>.<element>.sxx, or sxx_<solid>.<element>: of an element of a solid (structure/element.h)
    kSxx,
    kSyy,     // .syy
    kSxy,     // .sxy
    kSzz,     // .szz
    kMises,   // .mises
    kEnergy,  // .energy
  };

  bool IsOfNode() const { return kind == Kind::kX || kind == Kind::kY || kind == Kind::kRotation; }
  bool IsOfObstacle() const { return kind >= Kind::kObstacleX && kind <= Kind::kTurn; }
  bool IsOfContact() const { return kind >= Kind::kGap && kind <= Kind::kTraction; }
  bool IsOfPressure() const { return kind >= Kind::kPressure && kind <= Kind::kWidth; }

  bool IsReaction() const { return kind == Kind::kForceX || kind == Kind::kForceY || kind == Kind::kMoment; }

  bool IsOfSection() const { return kind >= Kind::kN && kind <= Kind::kM2; }
  bool IsOfElement() const { return kind >= Kind::kSxx; }

  Kind kind = Kind::kLoadFactor;
  // What a reaction is of.
  enum class Of { kSupport, kBoundary, kPin };

  // Place of the node, obstacle, contact or pin in its list of the scene; of a reaction otherwise, in SupportedNodes()
  // or TouchedBoundaries(); number of the section or element (scene/scene_index.h).
  std::size_t part = 0;
  Of of = Of::kSupport;
};

Unit UnitOf(Quantity::Kind kind);

// A quantity as its spelling tells it, before the name of its part is looked up.
struct SpelledQuantity {
  Quantity::Kind kind = Quantity::Kind::kLoadFactor;
  std::string_view name;   // of the part; a piece of the text
  bool is_column = false;  // in the spelling of a column of the CSV
};

// The spellings above; nothing for another one. `text` must outlive the result.
std::optional<SpelledQuantity> ReadQuantity(std::string_view text);

// Nothing for another spelling, a part that the scene does not have, and a component that no support holds, or the
// moment of a pin without a spring.
std::optional<Quantity> FindQuantity(std::string_view text, const SceneIndex& index);

// The quantity of the scene that another spelling may mean.
NearestName NearestQuantity(std::string_view text, const Scene& scene);

// The part of the scene that a spelled quantity may mean.
NearestName NearestPart(const SpelledQuantity& quantity, const Scene& scene);

// What such a quantity is of, as "a node of the scene".
std::string PartOf(Quantity::Kind kind);

// The spelling of a quantity of `name`: "<name>.rn", or "rn_<name>" as a column.
std::string QuantityText(Quantity::Kind kind, std::string_view name, bool is_column);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_QUANTITY_H_
