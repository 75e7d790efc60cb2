// The lists of an increment: which it has, and how long they are.
#ifndef CONTACT_PATH_PATH_INCREMENT_LISTS_H_
#define CONTACT_PATH_PATH_INCREMENT_LISTS_H_

#include <array>
#include <cstddef>

#include "contact_path/path/increment.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// Which of the lists of Increment that are computed where they are wanted alone.
struct LongLists {
  bool sections = false;
  bool stresses = false;
  bool pressures = false;  // and widths

  // Of options.record, and what quantities of `stop` and `at` are of. `request` must be sound, index: of its scene.
  static LongLists Of(const TraceRequest& request, const SceneIndex& index);
  // The list that the quantity is of, too.
  void Add(const Quantity& quantity);
  void Add(const LongLists& others);
};

// How long the lists of the increments of a request are. What comes from a file need not fit.
class IncrementLists {
 public:
  // request: sound and expanded; index: of its scene.
  IncrementLists(const TraceRequest& request, const SceneIndex& index);

  // Whether the lists have these lengths. An increment without positions has no state, and no long lists.
  bool Fit(const Increment& increment) const;

 private:
  using Lengths = std::array<std::size_t, 4>;
  std::array<std::size_t, 3> always_;  // supports, boundaries, bars
  Lengths state_;                      // positions, rotations, contacts, and pins, which are always there
  Lengths long_;                       // sections, stresses, pressures, widths
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_INCREMENT_LISTS_H_
