// States of increments that were recorded without them (TraceOptions.full_state_every), computed anew.
#ifndef CONTACT_PATH_PATH_RESTORED_STATES_H_
#define CONTACT_PATH_PATH_RESTORED_STATES_H_

#include <cstddef>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Fills in positions and contacts of the increments, which are the first ones of a trace of `request`, sound, and have
// their states where full_state_every wants it: each lies on the arc through the one before, at its recorded arc
// length, and must have its recorded load factor, to 1e-9. Returns how many of the first ones have their state now: one
// that is not found so, and what follows it, has to be traced anew.
std::size_t RestoreStates(const TraceRequest& request, std::vector<Increment>* increments);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_RESTORED_STATES_H_
