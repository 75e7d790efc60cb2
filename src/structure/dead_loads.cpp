#include "contact_path/structure/dead_loads.h"

namespace contact_path {

DeadLoads::DeadLoads(const Scene& scene, const SceneIndex& index, const DofMap& dofs)
    : reference_(Eigen::VectorXd::Zero(dofs.NumDofs())), constant_(Eigen::VectorXd::Zero(dofs.NumDofs())) {
  for (const Load& load : scene.loads) {
    Eigen::VectorXd& total = load.constant ? constant_ : reference_;
    const auto node = static_cast<int>(index.Node(load.node));
    if (const int dof = dofs.Dof(node, Field::kPosition, 0); dof >= 0) total[dof] += load.fx;
    if (const int dof = dofs.Dof(node, Field::kPosition, 1); dof >= 0) total[dof] += load.fy;
    if (const int dof = dofs.Dof(node, Field::kRotation, 0); dof >= 0) total[dof] += load.moment;
  }
}

}  // namespace contact_path
