// Watches a step of a smooth arc for what ends it: a broken inequality, a limit point, a bifurcation.
#ifndef CONTACT_PATH_BRANCH_EVENT_FUNCTIONS_H_
#define CONTACT_PATH_BRANCH_EVENT_FUNCTIONS_H_

#include <optional>

#include "contact_path/branch/arc_target.h"
#include "contact_path/branch/smooth_arc.h"

namespace contact_path {

enum class EventKind {
  kNone,       // the whole step is good
  kNearTouch,  // an inequality comes so near to zero inside that only an increment there can tell; or an open contact
               // comes to the next patch of its surface
  kContactEvent,  // an inequality reaches zero and would be broken
  kTarget,        // the load factor comes to where the path is to end
  kSample,        // a function of the unknowns comes to a value at which a step is to end
  kLimitPoint,    // ds = 0
  kBifurcation,   // the bordered determinant changes its sign
  kTooLong,       // a shorter step is needed: it leapt to another curve, or what coincides cannot be told
};

struct StepEvent {
  EventKind kind = EventKind::kNone;
  double t = 0.0;                         // parameter of the step, of the first kind
  Constraint constraint;                  // kContactEvent: the inequality that fails first
  std::optional<Crossing> crossing = {};  // another curve crosses at the very point, whatever happens there
  std::size_t target = 0;                 // kSample: which of the functions
  double value = 0.0;                     // kSample: of that function
  bool singular = false;  // kLimitPoint: more than one other curve crosses there, as at two dead centres at once
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

// The exact point of a kind near t, by Newton's method, with its parameter within the step. Nothing if it is
// not found.
std::optional<CurvePoint> Locate(SmoothArc* arc, const Step& step, const StepEvent& event, const StepEnds& ends = {});

// What rounding leaves of the place of a limit point along its arc (scaled).
// load: the load factor's place among the unknowns.
double ErrorOfPlace(const CurvePoint& limit_point, Eigen::Index load);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_EVENT_FUNCTIONS_H_
