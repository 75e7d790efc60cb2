// State of a contact candidate on an arc of path, and its share of a point.
#ifndef CONTACT_PATH_CONTACT_CONTACT_STATE_H_
#define CONTACT_PATH_CONTACT_CONTACT_STATE_H_

#include <cstddef>
#include <string_view>
#include <vector>

#include "contact_path/law/path_point.h"

namespace contact_path {

// Signs: the reaction acts on the node, r_n along the normal n, r_t along t = (n_y, -n_x). The numbers are those of
// Mode::state.
enum class ContactState {
  kStick,      // gap = 0, no tangential motion, |r_t| <= mu r_n
  kSlipPlus,   // gap = 0, motion towards +t, r_t = -mu r_n
  kSlipMinus,  // gap = 0, motion towards -t, r_t = +mu r_n
  kClosed,     // frictionless: gap = 0, r_t = 0
  kOpen,       // gap >= 0, r = 0
};

// "open", "stick", "slip+", "slip-", "closed".
std::string_view ToString(ContactState state);

// slip+ or slip-.
inline bool Slips(ContactState state) { return state == ContactState::kSlipPlus || state == ContactState::kSlipMinus; }

inline int NumberOf(ContactState state) { return static_cast<int>(state); }
inline ContactState StateOf(const Mode& mode) { return static_cast<ContactState>(mode.state); }

// Contacts are the first laws of a structure, in scene order, with two ports each: their shares of a point.
inline ContactState StateOf(const PathPoint& point, std::size_t contact) { return StateOf(point.modes[contact]); }
inline double NormalReaction(const PathPoint& point, std::size_t contact) {
  return point.forces[2 * static_cast<Eigen::Index>(contact)];
}
inline double TangentialReaction(const PathPoint& point, std::size_t contact) {
  return point.forces[2 * static_cast<Eigen::Index>(contact) + 1];
}
inline void SetReaction(std::size_t contact, double rn, double rt, PathPoint* point) {
  point->forces.segment<2>(2 * static_cast<Eigen::Index>(contact)) << rn, rt;
}
std::vector<ContactState> ContactStatesOf(const Modes& modes, std::size_t contacts);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_STATE_H_
