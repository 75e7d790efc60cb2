// The quantities of a path that a person can name: in stop criteria, and in the same words in plots and tables.
#ifndef CONTACT_PATH_SCENE_QUANTITY_H_
#define CONTACT_PATH_SCENE_QUANTITY_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "contact_path/scene/field.h"
#include "contact_path/scene/nearest_name.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// A number of each increment of a path.
struct Quantity {
  enum class Kind {
    kLoadFactor,  // load_factor
    kX,           // <node>.x, or x_<node>: current position
    kY,           // <node>.y, or y_<node>
    kRotation,    // <node>.rotation, or rotation_<node>: of a node that a beam turns, since the start [rad]
    kGap,         // <contact>.gap, or gap_<contact>; a contact has the name of its candidate
    kRn,          // <contact>.rn, or rn_<contact>: normal reaction
    kRt,          // <contact>.rt, or rt_<contact>: tangential reaction
  };

  bool IsOfNode() const { return kind == Kind::kX || kind == Kind::kY || kind == Kind::kRotation; }
  bool IsOfContact() const { return kind == Kind::kGap || kind == Kind::kRn || kind == Kind::kRt; }

  Kind kind = Kind::kLoadFactor;
  std::size_t part = 0;  // place of the node or contact in its list of the scene
};

Unit UnitOf(Quantity::Kind kind);

// A quantity as its spelling tells it, before the name of its node or contact is looked up.
struct SpelledQuantity {
  Quantity::Kind kind = Quantity::Kind::kLoadFactor;
  std::string_view name;   // of the node or contact; a part of the text
  bool is_column = false;  // in the spelling of a column of the CSV
};

// The spellings above; nothing for another one. `text` must outlive the result.
std::optional<SpelledQuantity> ReadQuantity(std::string_view text);

// Nothing for another spelling, or a node or contact that the scene does not have.
std::optional<Quantity> FindQuantity(std::string_view text, const SceneIndex& index);

// The quantity of the scene that another spelling may mean.
NearestName NearestQuantity(std::string_view text, const Scene& scene);

// The node or contact of the scene that a spelled quantity may mean.
NearestName NearestPart(const SpelledQuantity& quantity, const Scene& scene);

// The spelling of a quantity of `name`: "<name>.rn", or "rn_<name>" as a column.
std::string QuantityText(Quantity::Kind kind, std::string_view name, bool is_column);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_QUANTITY_H_
