// Traces the equilibrium path of a request: the one entry to the core.
#ifndef CONTACT_PATH_PATH_TRACE_H_
#define CONTACT_PATH_PATH_TRACE_H_

#include <functional>
#include <string>
#include <string_view>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Why a trace ended.
enum class EndReason {
  kNumericalFailure,  // no trustworthy increment could be computed
  kStopCriterion,     // a stop criterion of the request holds in the last row
  kMaxIncrements,     // the wanted number of increments was accepted
  kPathEnd,           // no admissible way on: only a dynamic jump leads further
  kStepTooSmall,      // increments had to be shortened below the smallest allowed
  kCancelled,         // the caller asked for it
};

// "stop_criterion", "max_increments", "path_end", "step_too_small", "cancelled", "numerical_failure".
std::string_view ToString(EndReason reason);

struct TraceResult {
  EndReason reason = EndReason::kNumericalFailure;
  std::string message;  // one line for a person: why and where
  int increments = 0;   // rows accepted, row 0 included
};

// How the caller takes part. Both functions are called on the thread of Trace().
struct TraceControl {
  // Takes each accepted row, in order, as soon as it is accepted; row 0 first. What it throws leaves Trace().
  std::function<void(const Increment&)> on_increment;
  // Asked often, also inside an increment; true ends the trace with kCancelled. May be left empty.
  std::function<bool()> cancelled;
};

// Traces until a stop criterion holds or another end. Row 0 is the equilibrium at load factor 0 with all constant
// loads. Everything accepted has been given to `control.on_increment` when this returns, whatever the reason. Throws
// InvalidRequest (scene/validate.h) for a request that breaks a rule; numerical trouble is a reason, never thrown.
TraceResult Trace(const TraceRequest& request, const TraceControl& control);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_TRACE_H_
