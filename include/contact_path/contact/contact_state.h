// State of a contact candidate on an arc of path.
#ifndef CONTACT_PATH_CONTACT_CONTACT_STATE_H_
#define CONTACT_PATH_CONTACT_CONTACT_STATE_H_

#include <string_view>

namespace contact_path {

// Signs: the reaction acts on the node, r_n along the normal n, r_t along t = (n_y, -n_x).
enum class ContactState {
  kOpen,       // gap >= 0, r = 0
  kStick,      // gap = 0, no tangential motion, |r_t| <= mu r_n
  kSlipPlus,   // gap = 0, motion towards +t, r_t = -mu r_n
  kSlipMinus,  // gap = 0, motion towards -t, r_t = +mu r_n
  kClosed,     // frictionless: gap = 0, r_t = 0
};

// "open", "stick", "slip+", "slip-", "closed".
std::string_view ToString(ContactState state);

// slip+ or slip-.
inline bool Slips(ContactState state) { return state == ContactState::kSlipPlus || state == ContactState::kSlipMinus; }

// r_t = ratio * r_n of a slipping contact; 0 in the other states.
double SlipRatio(ContactState state, double friction);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_STATE_H_
