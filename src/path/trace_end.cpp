#include "contact_path/path/trace_end.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/path/free_motion.h"
#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

bool EndedBeforeItsEnd(EndReason reason) {
  return reason == EndReason::kMaxIncrements || reason == EndReason::kClosedPath;
}

// Nodes that nothing holds: where no branch leads on, and where the path wanders about without a load.
Causes WhatMovesFreely(const EndedTrace& trace) {
  if (trace.model == nullptr) return {};
  const bool stuck = IsStuck(trace.reason);
  const bool wanders =
      EndedBeforeItsEnd(trace.reason) && std::abs(trace.point.s) <= tolerances::kSamePoint * trace.largest_load;
  if (!stuck && !wanders) return {};
  const double force = ActiveSetTolerance::For(trace.largest_reaction, trace.point.s).force;
  const std::string text = stuck && trace.recorder.increments() <= 1
                               ? FreeMotionQuestion(*trace.model, trace.point, force)
                               : FreeMotionText(*trace.model, trace.point, force);
  if (text.empty()) return {};
  return {{wanders ? sentences::kFreeWithoutLoad : sentences::kFreeNodes, text}};
}

Causes InsideObstacles(const EndedTrace& trace) {
  if (trace.model == nullptr || trace.reason == EndReason::kMemoryLimit) return {};
  return NodesInObstacles(trace.request.scene, *trace.model, trace.point);
}

// Parts that are too stiff for the path to be trusted, or to be found.
Causes StiffParts(const EndedTrace& trace) {
  Causes stiff = IsNumerical(trace.reason) ? SlenderBeam(trace.request.scene, trace.index) : Causes();
  Append(LockingSolids(trace.request.scene, trace.index), &stiff);
  if (trace.model != nullptr) Append(LightLoads(*trace.model), &stiff);
  return stiff;
}

}  // namespace

std::optional<Cause> Escape(const Escaping& trace) {
  const Model& model = trace.model;
  const PathPoint &now = trace.now, &before = trace.before;
  bool opened = !model.contacts.empty() && trace.largest_reaction > 0.0;
  for (std::size_t i = 0; i < model.laws.size(); ++i)
    opened = opened && (model.laws[i].In(now.modes[i]).idle || !model.laws[i].CanBeIdle());
  if (!opened || !trace.request.options.stop.empty()) return std::nullopt;
  // The load of a structure that snaps may come back.
  const bool away = trace.target && now.s * *trace.target < 0.0 && std::abs(now.s) > std::abs(*trace.target) &&
                    std::abs(now.s) > std::abs(before.s) && !trace.may_snap;
  if (away) return Cause{sentences::kOpenBeyondTarget};
  const double unloaded = tolerances::kSamePoint * trace.largest_load;
  const bool drifts = std::abs(before.s) <= unloaded && std::abs(now.s) <= unloaded && IsShifted(model, before, now);
  if (!drifts || Approaches(model, before, now)) return std::nullopt;
  return Cause{sentences::kOpenAndDrifts};
}

Causes RemarksAtEnd(const EndedTrace& trace) {
  Causes all = EndedBeforeItsEnd(trace.reason) ? MissedEnd(trace.request, trace.recorder.increment().stage) : Causes();
  for (const Causes& remarks :
       {WhatMovesFreely(trace), trace.recorder.Remarks(), trace.of_methods, StiffParts(trace),
        MissedChoices(trace.request, trace.recorder.increments(), trace.events), InsideObstacles(trace)})
    Append(remarks, &all);
  return all;
}

}  // namespace contact_path
