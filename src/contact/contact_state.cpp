#include "contact_path/contact/contact_state.h"

namespace contact_path {

std::string_view ToString(ContactState state) {
  switch (state) {
    case ContactState::kOpen: return "open";
    case ContactState::kStick: return "stick";
    case ContactState::kSlipPlus: return "slip+";
    case ContactState::kSlipMinus: return "slip-";
    case ContactState::kClosed: return "closed";
  }
  return "unknown";
}

double SlipRatio(ContactState state, double friction) {
  if (state == ContactState::kSlipPlus) return -friction;
  if (state == ContactState::kSlipMinus) return friction;
  return 0.0;
}

}  // namespace contact_path
