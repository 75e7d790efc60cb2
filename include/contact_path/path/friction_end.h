// Where friction that changes with the load factor has fallen to nothing, and a path ends.
#ifndef CONTACT_PATH_PATH_FRICTION_END_H_
#define CONTACT_PATH_PATH_FRICTION_END_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/branch/arc_target.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/end.h"
#include "contact_path/path/model.h"

namespace contact_path {

// Paths end where a coefficient of friction has fallen to 1e-6 of that at the load factor 0 of the stage: where nothing
// is left, contacts that stick have no equations of their own. For these load factors, the nearest one on either side
// of 0.
class FrictionEnds {
 public:
  explicit FrictionEnds(const Model& model);

  // One for each of them.
  void AddTo(ArcTargets* targets) const;
  // Scaled.
  std::vector<double> LoadFactors() const;
  // The obstacle, and the load factor where its friction is 0. Nothing: the point is between these load factors.
  std::optional<Cause> At(const PathPoint& point) const;

 private:
  struct FrictionEnd {
    std::string obstacle;
    double load_factor;  // where friction is 0
    double s;            // scaled, where the path ends
  };
  Eigen::Index unknown_;
  std::vector<FrictionEnd> ends_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_FRICTION_END_H_
