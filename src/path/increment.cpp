#include "contact_path/path/increment.h"

namespace contact_path {

CheckedState StateOf(const PathState& recorded) {
  CheckedState state;
  state.load_factor = recorded.load_factor;
  state.positions = recorded.positions;
  state.rotations = recorded.rotations;
  for (const ContactRecord& contact : recorded.contacts) {
    state.rn.push_back(contact.rn);
    state.rt.push_back(contact.rt);
  }
  for (const Resultant& pin : recorded.pins) state.pins.insert(state.pins.end(), {pin.rx, pin.ry});
  return state;
}

}  // namespace contact_path
