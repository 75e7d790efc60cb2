// Watches a step of a smooth arc for what ends it: a broken inequality, a limit point, a bifurcation.
#ifndef CONTACT_PATH_BRANCH_EVENT_FUNCTIONS_H_
#define CONTACT_PATH_BRANCH_EVENT_FUNCTIONS_H_

#include <optional>

#include "contact_path/branch/arc_target.h"
#include "contact_path/branch/smooth_arc.h"

namespace contact_path {

// In the order in which facts at one place are acted on, the last one first.
enum class EventKind {
  kNone,          // the whole step is good
  kNearTouch,     // a limit comes so near to zero inside that only an increment there can tell; or an idle law comes
                  // to the next piece of its curves
  kBifurcation,   // other curves cross
  kLimitPoint,    // ds = 0
  kContactEvent,  // a limit reaches zero and would be broken
  kSample,        // a function of the unknowns comes to a value at which a step is to end
  kTarget,        // the load factor comes to where the path is to end
  kTooLong,       // a shorter step is needed: it leapt to another curve, or what coincides cannot be told
};

// What is the case at one place of a step: a set of facts.
struct StepEvent {
  struct Sample {
    std::size_t target = 0;  // which of the functions
    double value = 0.0;      // of that function
  };

  double t = 0.0;                         // parameter of the step
  std::optional<Limit> fails = {};        // the limit that reaches zero and would be broken
  bool turns = false;                     // ds = 0
  std::optional<Crossing> crossing = {};  // other curves cross
  std::optional<Sample> sample = {};      // a function comes to one of its values
  bool target = false;                    // the load factor comes to where the path is to end
  bool near = false;                      // an increment is wanted, and nothing fails
  bool too_long = false;

  // The fact to act on.
  EventKind Kind() const;
};

// What else ends a step.
struct StepEnds {
  std::optional<double> load_factor = {};  // other than that of the start; nothing = none
  ArcTargets functions = {};
};

// The first kind on the step, from its interpolation: all inequalities as quintics on the whole step, so roots
// inside it count too. A pair of roots could only be missed where the curve differs from its quintic interpolation by
// more than a twentieth of the difference between the quintic and the cubic interpolation at the middle of the step:
// minima that come nearer to zero than that are reported as kNearTouch. A bifurcation shows by the sign of the
// determinant at the ends, and is located as a crossing; two of them within one step are not seen. Where no crossing
// lies on the step, or an imperfection has broken the crossing, the step has leapt to another curve, whatever other
// event lies there. Functions of `ends` are interpolated by quintics, too.
StepEvent FirstEvent(SmoothArc* arc, const Step& step, const StepEnds& ends = {});

// The exact point of an event near its t, by Newton's method, with its parameter within the step. Nothing if it is
// not found.
std::optional<CurvePoint> Locate(SmoothArc* arc, const Step& step, const StepEvent& event, const StepEnds& ends = {});

// The point of the curve of the step where row . x turns, by Newton's method on its rate; row: unknowns. Nothing: it
// does not.
std::optional<CurvePoint> LocateTurn(SmoothArc* arc, const Step& step, const Eigen::VectorXd& row);

// The point on the curve of the step at which k other curves cross, and its parameter, between two parameters; k = 0:
// as many as there are. *broken: becomes true where a crossing was found that an imperfection has broken.
struct LocatedCrossing {
  double t = 0.0;
  Crossing at;
};
std::optional<LocatedCrossing> CrossingOn(SmoothArc* arc, const Step& step, double from, double to, Eigen::Index k,
                                          bool* broken);
// The point itself.
CurvePoint PointOf(const Crossing& crossing, const SmoothArc& arc);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_EVENT_FUNCTIONS_H_
