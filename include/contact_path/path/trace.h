// Traces the equilibrium path of a request: the one entry to the core.
#ifndef CONTACT_PATH_PATH_TRACE_H_
#define CONTACT_PATH_PATH_TRACE_H_

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/branch/trial_step.h"
#include "contact_path/path/end.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/increment_lists.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"
#include "contact_path/path/return_detector.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct TraceResult {
  EndReason reason = EndReason::kNumericalFailure;
  std::string message;   // one line for a person: why and where
  int increments = 0;    // increments accepted, increment 0 included
  bool reached = false;  // what the request asks for: IsReached()
};

struct MethodTask;

// How the caller takes part. The functions are called on the thread of Trace().
struct TraceControl {
  // Takes each accepted increment, in order, as soon as it is accepted; increment 0 first. What it throws leaves
  // Trace().
  std::function<void(const Increment&)> on_increment;
  // Asked often, also inside an increment; true ends the trace with kCancelled. May be left empty.
  std::function<bool()> cancelled;
  // Takes each step that the method has tried along the path, accepted or not, before the increment that it leads to;
  // of the path on which constant loads are brought on, none. May be left empty: then no trial is described.
  TrialObserver on_trial = {};
  LongLists lists = {};  // that increments are to have besides those that the request wants
  // Makes method mpec: MakeMpecMethod (path/mpec_method.h), which the library contact_path_mpec brings with Ipopt.
  // Empty: a request for mpec is refused.
  std::function<std::unique_ptr<PathMethod>(const MethodTask&)> mpec = {};
};

// The stage that a method is made for.
struct MethodTask {
  const Model& model;  // outlives the method, as all of this
  TraceOptions options;
  std::optional<double> target;  // load factor at which the path is to end, scaled
  ReturnDetector* returns;       // tells whether the path has come back to where it was
  const TraceControl& control;
};

// Traces until a stop criterion holds or another end. Increment 0 is the equilibrium at load factor 0 with all constant
// loads. Each stage of a program begins with an increment at load factor 0 and ends with one at its target. Everything
// accepted has been given to `control.on_increment` when this returns, whatever the reason. Throws InvalidRequest
// (scene/validate.h) for a request that breaks a rule, or wants mpec without control.mpec; numerical trouble is a
// reason, never thrown.
TraceResult Trace(const TraceRequest& request, const TraceControl& control);

// Goes on with a trace of `request` that was cut short. increments: the first increments of that trace, from increment
// 0. Gives the increments up to the last one that a trace can go on from to `control.on_increment` again, unchanged,
// then new increments. The path is equal, to rounding, to the path of a trace without interruption. A trace can go on
// from an increment that is no event, has positions and contacts, and follows another increment of its stage with
// positions and contacts; without such an increment, everything is traced anew. Throws std::invalid_argument, which
// names the number, for an increment that cannot belong to `request`.
TraceResult ResumeTrace(const TraceRequest& request, const std::vector<Increment>& increments,
                        const TraceControl& control);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_TRACE_H_
