// Traces the equilibrium path of a request: the one entry to the core.
#ifndef CONTACT_PATH_PATH_TRACE_H_
#define CONTACT_PATH_PATH_TRACE_H_

#include <functional>
#include <string>
#include <vector>

#include "contact_path/path/end_reason.h"
#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct TraceResult {
  EndReason reason = EndReason::kNumericalFailure;
  std::string message;  // one line for a person: why and where
  int increments = 0;   // increments accepted, increment 0 included
};

// How the caller takes part. Both functions are called on the thread of Trace().
struct TraceControl {
  // Takes each accepted increment, in order, as soon as it is accepted; increment 0 first. What it throws leaves
  // Trace().
  std::function<void(const Increment&)> on_increment;
  // Asked often, also inside an increment; true ends the trace with kCancelled. May be left empty.
  std::function<bool()> cancelled;
};

// Traces until a stop criterion holds or another end. Increment 0 is the equilibrium at load factor 0 with all constant
// loads. Each stage of a program begins with an increment at load factor 0 and ends with one at its target. Everything
// accepted has been given to `control.on_increment` when this returns, whatever the reason. Throws InvalidRequest
// (scene/validate.h) for a request that breaks a rule; numerical trouble is a reason, never thrown.
TraceResult Trace(const TraceRequest& request, const TraceControl& control);

// Goes on with a trace of `request` that was cut short: increments are its first ones, from increment 0. As many of
// them as can be gone on from are given to `control.on_increment` again, unchanged, then the new ones: a path that is
// the one of a trace without interruption but for rounding. The last increment kept is no event and has its state, and
// so has one before it in its stage; without such an increment, all is traced anew. Throws std::invalid_argument for
// increments that are not those of `request`, by number.
TraceResult ResumeTrace(const TraceRequest& request, const std::vector<Increment>& increments,
                        const TraceControl& control);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_TRACE_H_
