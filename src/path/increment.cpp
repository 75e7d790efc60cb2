#include "contact_path/path/increment.h"

namespace contact_path {
namespace {

template <typename Record>
CheckedState CheckedStateOf(const Record& record) {
  CheckedState state;
  state.load_factor = record.load_factor;
  state.positions = record.positions;
  state.rotations = record.rotations;
  for (const ContactRecord& contact : record.contacts) {
    state.rn.push_back(contact.rn);
    state.rt.push_back(contact.rt);
  }
  for (const Resultant& pin : record.pins) state.pins.insert(state.pins.end(), {pin.rx, pin.ry});
  return state;
}

}  // namespace

CheckedState StateOf(const Increment& increment) { return CheckedStateOf(increment); }
CheckedState StateOf(const InnerState& inner) { return CheckedStateOf(inner); }

std::string_view ToString(IncrementKind kind) {
  switch (kind) {
    case IncrementKind::kStart: return "start";
    case IncrementKind::kRegular: return "regular";
    case IncrementKind::kSmoothLimit: return "smooth_limit";
    case IncrementKind::kCornerLimit: return "corner_limit";
    case IncrementKind::kContactEvent: return "contact_event";
    case IncrementKind::kBifurcation: return "bifurcation";
    case IncrementKind::kSample: return "sample";
    case IncrementKind::kOnset: return "onset";
    case IncrementKind::kJump: return "jump";
  }
  return "unknown";
}

}  // namespace contact_path
