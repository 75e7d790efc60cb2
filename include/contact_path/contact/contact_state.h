// State of a contact candidate on an arc of path.
#ifndef CONTACT_PATH_CONTACT_CONTACT_STATE_H_
#define CONTACT_PATH_CONTACT_CONTACT_STATE_H_

#include <algorithm>
#include <string_view>
#include <tuple>
#include <vector>

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

// The state, and the patch of the surface on which gap and xi are taken (geometry/surface.h).
struct ContactMode {
  ContactState state = ContactState::kOpen;
  int patch = 0;
};

inline bool operator==(const ContactMode& a, const ContactMode& b) { return a.state == b.state && a.patch == b.patch; }
inline bool operator<(const ContactMode& a, const ContactMode& b) {
  return std::tie(a.state, a.patch) < std::tie(b.state, b.patch);
}

using ContactModes = std::vector<ContactMode>;  // by candidate

inline bool HasState(const ContactModes& modes, ContactState state) {
  return std::any_of(modes.begin(), modes.end(), [state](const ContactMode& mode) { return mode.state == state; });
}

inline std::vector<ContactState> StatesOf(const ContactModes& modes) {
  std::vector<ContactState> states;
  states.reserve(modes.size());
  for (const ContactMode& mode : modes) states.push_back(mode.state);
  return states;
}

inline std::vector<int> PatchesOf(const ContactModes& modes) {
  std::vector<int> patches;
  patches.reserve(modes.size());
  for (const ContactMode& mode : modes) patches.push_back(mode.patch);
  return patches;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_STATE_H_
