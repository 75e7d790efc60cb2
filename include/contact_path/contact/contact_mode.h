// What is fixed of a contact candidate on a smooth arc of path.
#ifndef CONTACT_PATH_CONTACT_CONTACT_MODE_H_
#define CONTACT_PATH_CONTACT_CONTACT_MODE_H_

#include <algorithm>
#include <tuple>
#include <vector>

#include "contact_path/contact/contact_state.h"

namespace contact_path {

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

#endif  // CONTACT_PATH_CONTACT_CONTACT_MODE_H_
