#include "contact_path/path/increment.h"

namespace contact_path {

CheckedState StateOf(const Increment& increment) {
  CheckedState state;
  state.load_factor = increment.load_factor;
  state.positions = increment.positions;
  state.rotations = increment.rotations;
  for (const ContactRecord& contact : increment.contacts) {
    state.rn.push_back(contact.rn);
    state.rt.push_back(contact.rt);
  }
  return state;
}

std::string_view ToString(IncrementKind kind) {
  switch (kind) {
    case IncrementKind::kStart: return "start";
    case IncrementKind::kRegular: return "regular";
    case IncrementKind::kSmoothLimit: return "smooth_limit";
    case IncrementKind::kCornerLimit: return "corner_limit";
    case IncrementKind::kContactEvent: return "contact_event";
    case IncrementKind::kBifurcation: return "bifurcation";
    case IncrementKind::kSample: return "sample";
  }
  return "unknown";
}

}  // namespace contact_path
