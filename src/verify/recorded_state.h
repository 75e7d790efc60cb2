// Whether the recorded state of a contact is the one that its numbers show.
#ifndef CONTACT_PATH_SRC_VERIFY_RECORDED_STATE_H_
#define CONTACT_PATH_SRC_VERIFY_RECORDED_STATE_H_

#include "contact_path/contact/contact_state.h"
#include "verify/verified_contacts.h"

namespace contact_path {

// All scaled: lengths over L, forces over F.
struct ContactNumbers {
  double gap = 0.0;
  double slip = 0.0;  // what the law of friction is about: since the increment before, or since the start
  double rn = 0.0, rt = 0.0;
};

struct StateTolerances {
  double value = 0.0;  // of gaps and forces
  double slip = 0.0;
};

// For a person: "slipping forwards".
const char* NameOf(ContactState state);

bool StateHolds(ContactState state, const VerifiedContact& contact, const ContactNumbers& numbers,
                const StateTolerances& tolerances);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_RECORDED_STATE_H_
