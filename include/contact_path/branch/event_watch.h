// Watches a step of a smooth piece for what ends it: a broken inequality, a limit point, a bifurcation.
#ifndef CONTACT_PATH_BRANCH_EVENT_WATCH_H_
#define CONTACT_PATH_BRANCH_EVENT_WATCH_H_

#include <optional>

#include "contact_path/branch/smooth_piece.h"
#include "contact_path/contact/fixed_state_system.h"

namespace contact_path {

enum class Happening {
  kNone,         // the whole step is good
  kNearTouch,    // an inequality comes so near to zero inside that only a row there can tell
  kEvent,        // an inequality reaches zero and would be broken
  kTarget,       // the load factor comes to where the path is to end
  kLimitPoint,   // ds = 0
  kBifurcation,  // the bordered determinant changes its sign
};

struct Watched {
  Happening happening = Happening::kNone;
  double t = 0.0;  // parameter of the segment, of the first happening
  Limit limit;     // kEvent: the inequality that fails first
  // The equations are singular there: another path crosses at the very point. Then the interpolation is more exact than
  // Newton's method.
  bool singular = false;
};

// The first happening on the segment, from its interpolation: all inequalities as quintics on the whole step, so roots
// inside it count too. A pair of roots could only be missed where the curve differs from its quintic interpolation by
// more than a twentieth of the difference between the quintic and the cubic interpolation at the middle of the step:
// minima that come nearer to zero than that are reported as kNearTouch. A bifurcation shows by the sign of the
// determinant at the ends, and is then found by bisection; two of them within one step are not seen.
// target: load factor to end at, other than that of the start; nothing = none.
Watched Watch(SmoothPiece* piece, const Segment& segment, std::optional<double> target = std::nullopt);

// The exact point of a happening near t, by Newton's method, with its parameter within the segment. Nothing if it is
// not found.
std::optional<CurvePoint> Locate(SmoothPiece* piece, const Segment& segment, const Watched& watched,
                                 std::optional<double> target = std::nullopt);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_EVENT_WATCH_H_
