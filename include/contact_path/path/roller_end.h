// Where a tendon comes off a roller, and a path ends.
#ifndef CONTACT_PATH_PATH_ROLLER_END_H_
#define CONTACT_PATH_PATH_ROLLER_END_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/branch/arc_target.h"
#include "contact_path/geometry/rolled_span.h"
#include "contact_path/law/path_point.h"
#include "contact_path/law/slack_bar.h"
#include "contact_path/path/end.h"
#include "contact_path/path/model.h"

namespace contact_path {

// Paths end where the angle by which a tendon is wrapped round a roller has fallen to nothing, or that by which a drum
// is wound: beyond, the string would be pushed by the roller from inside; where a roller with friction that turns has
// carried along what was the middle of the arc at the start to an end of it; and before a piece of a tendon between
// unequal rollers has turned by half a turn since the start, where its angle is no longer known.
class RollerEnds {
 public:
  explicit RollerEnds(const Model& model);

  // One for each of them.
  void AddTo(ArcTargets* targets) const;
  // Nothing: the tendons lie on their rollers.
  std::optional<Cause> At(const PathPoint& point) const;

 private:
  // The sum of angles since the start, each times a factor: of spans and of a body.
  struct Turn {
    double factor;
    BarSpan span;
  };
  struct Limit {
    Cause cause;
    double start;  // what is left at the start [rad]; less its rounding
    std::vector<Turn> turns;
    double of_body = 0.0;
    Coordinate body = {};
    bool both_senses = false;  // the turn counts without its sign

    double Left(const Eigen::VectorXd& u, double s) const;  // < 0: beyond
  };
  Eigen::Index num_dofs_;
  std::vector<Limit> limits_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_ROLLER_END_H_
