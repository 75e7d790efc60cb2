#include "verify/recorded_state.h"

#include <algorithm>
#include <cmath>

namespace contact_path {

const char* NameOf(ContactState state) {
  switch (state) {
    case ContactState::kOpen: return "open";
    case ContactState::kClosed: return "closed";
    case ContactState::kStick: return "sticking";
    case ContactState::kSlipPlus: return "slipping forwards";
    case ContactState::kSlipMinus: return "slipping backwards";
  }
  return "";
}

bool StateHolds(ContactState state, const VerifiedContact& contact, const ContactNumbers& numbers,
                const StateTolerances& tolerances) {
  if (state == ContactState::kOpen) return std::max(std::abs(numbers.rn), std::abs(numbers.rt)) <= tolerances.value;
  if (!(std::abs(numbers.gap) <= tolerances.value)) return false;
  if (state == ContactState::kClosed) return std::abs(numbers.rt) <= tolerances.value && contact.friction == 0.0;
  if (state == ContactState::kStick) return std::abs(numbers.slip) <= tolerances.slip;
  const double sense = state == ContactState::kSlipPlus ? 1.0 : -1.0, bound = contact.friction * numbers.rn;
  // A friction force that is rounding tells no sense of the slip.
  const bool rubs = bound > contact.closing * contact.unit;
  return (!rubs || sense * numbers.slip >= -tolerances.slip) &&
         std::abs(numbers.rt + sense * bound) <= tolerances.value;
}

}  // namespace contact_path
