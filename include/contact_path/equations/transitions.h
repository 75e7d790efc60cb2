// Which state of a contact is next where an inequality of the one that it has fails.
#ifndef CONTACT_PATH_EQUATIONS_TRANSITIONS_H_
#define CONTACT_PATH_EQUATIONS_TRANSITIONS_H_

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// The mode beyond the inequality that fails in the mode `now`. By the total law of friction a contact that touches may
// have slipped already: its place tells. The patch of a contact that opens or closes is for the caller to find; a patch
// beyond the end of the surface does not exist (ContactPair::HasPatch).
inline ContactMode NextMode(const ContactPair& contact, Inequality failed, ContactMode now) {
  switch (failed) {
    case Inequality::kGap: now.state = contact.Frictional() ? ContactState::kStick : ContactState::kClosed; break;
    case Inequality::kNormalReaction: now.state = ContactState::kOpen; break;
    case Inequality::kConePlus: now.state = ContactState::kSlipPlus; break;
    case Inequality::kConeMinus: now.state = ContactState::kSlipMinus; break;
    case Inequality::kSlip:
    case Inequality::kTotalSlip: now.state = ContactState::kStick; break;
    case Inequality::kPatchBegin: --now.patch; break;
    case Inequality::kPatchEnd: ++now.patch; break;
  }
  return now;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_TRANSITIONS_H_
