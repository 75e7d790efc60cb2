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

std::vector<ContactState> ContactStatesOf(const Modes& modes, std::size_t contacts) {
  std::vector<ContactState> states;
  for (std::size_t i = 0; i < contacts; ++i) states.push_back(StateOf(modes[i]));
  return states;
}

}  // namespace contact_path
