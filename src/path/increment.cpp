#include "contact_path/path/increment.h"

namespace contact_path {

CheckedState StateOf(const Increment& row) {
  CheckedState state;
  state.load_factor = row.load_factor;
  state.positions = row.positions;
  for (const ContactRecord& contact : row.contacts) {
    state.rn.push_back(contact.rn);
    state.rt.push_back(contact.rt);
  }
  return state;
}

std::string_view ToString(RowKind kind) {
  switch (kind) {
    case RowKind::kStart: return "start";
    case RowKind::kRegular: return "regular";
    case RowKind::kSmoothLimit: return "smooth_limit";
    case RowKind::kCornerLimit: return "corner_limit";
    case RowKind::kContactEvent: return "contact_event";
    case RowKind::kBifurcation: return "bifurcation";
  }
  return "unknown";
}

}  // namespace contact_path
