// The next step on a smooth arc: as long as it may be, and no further than the first event on it.
#ifndef CONTACT_PATH_BRANCH_ARC_STEP_H_
#define CONTACT_PATH_BRANCH_ARC_STEP_H_

#include <optional>

#include "contact_path/branch/event_functions.h"
#include "contact_path/branch/smooth_arc.h"
#include "contact_path/branch/trial_step.h"

namespace contact_path {

struct StepLimits {
  double smallest = 0.0;    // scaled length below which a step is given up
  double largest = 0.0;     // scaled length that none exceeds
  double prediction = 0.0;  // largest error of the predictor, relative to the step
  double cosine = 0.0;      // smallest, between the tangents at both ends
  TrialObserver on_trial = {};
};

struct ArcStep {
  Step step;               // up to the event; of length 0 where the event happens in place
  StepEvent event;         // at the end of the step; kNone: none on it
  double tried = 0.0;      // length of the step before an event cut it short
  int rejected = 0;        // longer steps that were not accepted
  int iterations = 0;      // of Newton's method, for the step that was tried
  double contraction = 0;  // its second Newton step over the first
};

// The step from `start`, a point of the arc, along its tangent: of this length, or of the first half, quarter, ... of
// it that Newton's method, the limits and the location of the first event accept.
// Where no step meets the limits, the predictor may be further off: at a point where another path crosses, or nearly,
// rounding of the forces across both paths hides how good it is. How far rounding moves points there is seen by the
// last step of Newton's method; an error of the predictor of ten times its length asks for no shorter step.
// Nothing: no step is accepted, however short.
std::optional<ArcStep> NextStep(SmoothArc* arc, const CurvePoint& start, double length, const StepLimits& limits,
                                const StepEnds& ends);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_ARC_STEP_H_
