// The motion between two states of one scene.
#ifndef CONTACT_PATH_SRC_VERIFY_SCALED_MOTION_H_
#define CONTACT_PATH_SRC_VERIFY_SCALED_MOTION_H_

#include <cstddef>
#include <vector>

#include "contact_path/path/increment.h"

namespace contact_path {

// Whether both have the same numbers of positions, rotations and contacts.
inline bool SameSizes(const Increment& a, const Increment& b) {
  return a.positions.size() == b.positions.size() && a.rotations.size() == b.rotations.size() &&
         a.contacts.size() == b.contacts.size();
}

// Of all positions, over the characteristic length, and of all rotations. State: Increment or CheckedState, both of the
// same sizes.
template <typename State>
std::vector<double> ScaledMotion(const State& from, const State& to, double length) {
  std::vector<double> motion;
  motion.reserve(to.positions.size() + to.rotations.size());
  for (std::size_t i = 0; i < to.positions.size(); ++i)
    motion.push_back((to.positions[i] - from.positions[i]) / length);
  for (std::size_t i = 0; i < to.rotations.size(); ++i) motion.push_back(to.rotations[i] - from.rotations[i]);
  return motion;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_SCALED_MOTION_H_
