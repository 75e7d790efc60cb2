// Increments (9) where the active set is known: along an arc of path on which every contact keeps its state.
#ifndef CONTACT_PATH_MPEC_ARC_INCREMENT_H_
#define CONTACT_PATH_MPEC_ARC_INCREMENT_H_

#include <optional>

#include "contact_path/branch/smooth_arc.h"
#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// What ends an increment before its wanted length.
enum class ArcEnd {
  kNone,
  kConstraint,  // an inequality of the states is zero: here is a corner, or a contact passes to another patch
  kLimitPoint,  // the rate of the load factor is zero
  kTarget,      // the load factor is at its target
};

// Why there is no increment of a wanted length.
enum class ArcFailure {
  kNone,
  kNotSolved,    // Newton's method does not converge
  kOther,        // it converges to a point too far from where the curve leads: another curve
  kTurns,        // the path turns too much
  kFailsAtOnce,  // an inequality fails from the start on
  kNotLocated,   // no root of the inequality that fails is found
};

// How far the curve of an increment may be from what its start tells.
struct ArcLimits {
  double prediction = 1e-3;  // largest error of the predictor of second order, of the length: another curve is farther
  double cosine = 0.98;      // smallest between the tangents at both ends, and between each and the chord
};

struct ArcIncrement {
  CurvePoint end;
  ArcEnd kind = ArcEnd::kNone;
  Constraint constraint;  // kConstraint
  // Component of (du, ds) - S d on the tangent at the end, over S: 0 where the increment is a stationary point of (9)
  // on the equations of its states. With all inequalities of the states positive it is strongly stationary for (9).
  double stationarity = 0.0;
  int corrections = 0;  // Newton iterations
};

// The minimiser of (9) on the arc: the point of the curve that is nearest to start + length x tangent, or the first end
// before it. Of (9) the dissipation
// is left out: on one arc it has one sense, and only says how far to go. start: on *arc, whose states are set. failure:
// set where there is none.
std::optional<ArcIncrement> IncrementOnArc(SmoothArc* arc, const CurvePoint& start, double length,
                                           const ArcLimits& limits, std::optional<double> target, ArcFailure* failure);

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_ARC_INCREMENT_H_
