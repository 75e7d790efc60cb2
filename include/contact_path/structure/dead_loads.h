// The loads of a scene: dead ones, with their force, its rate and their work.
#ifndef CONTACT_PATH_STRUCTURE_DEAD_LOADS_H_
#define CONTACT_PATH_STRUCTURE_DEAD_LOADS_H_

#include <Eigen/Core>
#include <cmath>

#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/dof_map.h"

namespace contact_path {

// s f + f_constant by unknown [force, or force length for a rotation]: wherever the structure is (Kanno & Martins 2005,
// section 2). The tangent is zero.
class DeadLoads {
 public:
  DeadLoads() = default;
  DeadLoads(const Scene& scene, const SceneIndex& index, const DofMap& dofs);

  const Eigen::VectorXd& Reference() const { return reference_; }  // f, the rate by the load factor s
  const Eigen::VectorXd& Constant() const { return constant_; }    // f_constant
  // residual -= s f + f_constant
  void TakeFrom(Eigen::Ref<Eigen::VectorXd> residual, double s) const { residual -= s * reference_ + constant_; }
  // |s f| + |f_constant|
  Eigen::VectorXd Sizes(double s) const { return std::abs(s) * reference_.cwiseAbs() + constant_.cwiseAbs(); }
  // Of a motion du on which s goes on in proportion [force length].
  double Work(double from, double to, const Eigen::VectorXd& du) const {
    return 0.5 * (from + to) * reference_.dot(du) + constant_.dot(du);
  }

 private:
  Eigen::VectorXd reference_, constant_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_DEAD_LOADS_H_
