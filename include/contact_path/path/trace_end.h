// Why a trace ends that could go on, and what is remarked at the end of one.
#ifndef CONTACT_PATH_PATH_TRACE_END_H_
#define CONTACT_PATH_PATH_TRACE_END_H_

#include <optional>

#include "contact_path/path/end.h"
#include "contact_path/path/model.h"
#include "contact_path/path/recorder.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// Why no further increment is of use, though all goes on from one point of the path to the next: no contact is left,
// and the load moves away from its target, or nothing holds the structure. Nothing: it may be. target, largest_load:
// load factors, scaled. may_snap: there is, or may be, an unstable direction under dead loads.
std::optional<Cause> Escape(const Model& model, const PathPoint& before, const PathPoint& now,
                            std::optional<double> target, double largest_load, bool may_snap);

struct EndedTrace {
  const TraceRequest& request;
  const SceneIndex& index;
  const Model* model;  // of the last stage; null: there is none
  const PathPoint& point;
  EndReason reason;
  const Recorder& recorder;
  const Causes& of_methods;               // remarks
  double largest_reaction, largest_load;  // scaled
  int events;
};

Causes RemarksAtEnd(const EndedTrace& trace);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_TRACE_END_H_
