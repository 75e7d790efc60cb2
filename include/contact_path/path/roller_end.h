// Where a tendon comes off a roller, and a path ends.
#ifndef CONTACT_PATH_PATH_ROLLER_END_H_
#define CONTACT_PATH_PATH_ROLLER_END_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/arc_target.h"
#include "contact_path/law/path_point.h"
#include "contact_path/law/slack_bar.h"
#include "contact_path/path/end.h"
#include "contact_path/path/model.h"
#include "contact_path/scene/tendon_route.h"

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
  struct Placed {
    WrapLimit limit;
    std::vector<BarSpan> spans;  // of the turns of the limit
    Coordinate turn = {};        // of its body

    double Left(const Eigen::VectorXd& u, double s) const;  // < 0: beyond
  };
  Eigen::Index num_dofs_;
  std::vector<Placed> limits_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_ROLLER_END_H_
