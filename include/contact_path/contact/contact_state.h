// State of a contact candidate on an arc of path, its limits, and its share of a point.
#ifndef CONTACT_PATH_CONTACT_CONTACT_STATE_H_
#define CONTACT_PATH_CONTACT_CONTACT_STATE_H_

#include <cstddef>
#include <string_view>
#include <vector>

#include "contact_path/law/path_point.h"
#include "contact_path/scene/words.h"

namespace contact_path {

// The ports of a contact: gap u_n with the normal reaction r_n, and xi, the surface coordinate, with the tangential
// reaction r_t. Slip is the factor of the port times dxi. Of a circle that rolls over patches, xi has the turn of the
// circle in it; where its foot is on the patches is a motion without a force, behind the ports.
inline constexpr unsigned kNormal = 0, kTangent = 1, kFoot = 2;

// Limit::id of a contact.
enum class ContactLimit {
  kGap,             // open: u_n
  kNormalReaction,  // touching: r_n
  kConePlus,        // stick: mu r_n + r_t (at zero, slip+ is next)
  kConeMinus,       // stick: mu r_n - r_t (at zero, slip- is next)
  kSlip,            // slip+-: +-(xi - xi_ref), the motion since the reference; what must be >= 0 is its rate
  kTotalSlip,       // slip+- by the total law: +-(xi - xi_ref) itself
  kPatchBegin,      // not sticking, on a surface with patches: xi - begin (at zero, the patch before is next)
  kPatchEnd,        // not sticking, on a surface with patches: end - xi (at zero, the patch after is next)
};

inline int NumberOf(ContactLimit limit) { return static_cast<int>(limit); }

// Signs: the reaction acts on the node, r_n along the normal n, r_t along t = (n_y, -n_x). The numbers are those of
// Mode::state.
enum class ContactState {
  kStick,      // gap = 0, no tangential motion, |r_t| <= mu r_n
  kSlipPlus,   // gap = 0, motion towards +t, r_t = -mu r_n
  kSlipMinus,  // gap = 0, motion towards -t, r_t = +mu r_n
  kClosed,     // frictionless: gap = 0, r_t = 0
  kOpen,       // gap >= 0, r = 0
};

constexpr auto WordsOf(ContactState) { return WordList("stick", "slip+", "slip-", "closed", "open"); }

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
inline std::vector<ContactState> ContactStatesOf(const Modes& modes, std::size_t contacts) {
  std::vector<ContactState> states;
  for (std::size_t i = 0; i < contacts; ++i) states.push_back(StateOf(modes[i]));
  return states;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_STATE_H_
