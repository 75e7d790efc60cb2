// An earlier trace: where it can be gone on from, and the states that it did not record (full_state_every).
#ifndef CONTACT_PATH_PATH_EARLIER_TRACE_H_
#define CONTACT_PATH_PATH_EARLIER_TRACE_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Fills in positions and contacts of the increments, which are the first ones of a trace of `request`, sound, and have
// their states where full_state_every wants it: each lies on the arc through the one before, at its recorded arc
// length, and must have its recorded load factor, to 1e-9. Returns how many of the first ones have their state now: one
// that is not found so, and what follows it, has to be traced anew.
std::size_t RestoreStates(const TraceRequest& request, std::vector<Increment>* increments);

struct Resumption {
  const std::vector<Increment>* increments = nullptr;  // of the earlier trace
  const Increment* before = nullptr;                   // of its stage, with its state on record
  const Increment* from = nullptr;
  int events = 0;  // passed up to there
};

// The last increment that a trace can go on from; nothing: none can. increments must outlive the answer.
std::optional<Resumption> FindResumption(const std::vector<Increment>& increments);

// Throws std::invalid_argument, which names the number, for an increment that cannot belong to the request, which is
// expanded.
void RequireIncrementsOf(const TraceRequest& request, const std::vector<Increment>& increments);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_EARLIER_TRACE_H_
