// Where each contact candidate stands relative to its obstacle, and how its reaction acts on the structure.
#ifndef CONTACT_PATH_CONTACT_CONTACT_GEOMETRY_H_
#define CONTACT_PATH_CONTACT_CONTACT_GEOMETRY_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact_path/scene/scene.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// A linear function of u with at most two terms: offset + sum coefficient_a u[dof_a].
struct SparseLinear {
  std::array<int, 2> dofs = {-1, -1};  // ascending where present; -1 = no term
  std::array<double, 2> coefficients = {0.0, 0.0};
  double offset = 0.0;  // share of fixed components

  double Value(const Eigen::VectorXd& u) const { return offset + Rate(u); }
  double Rate(const Eigen::VectorXd& du) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < 2; ++a)
      if (dofs[a] >= 0) sum += coefficients[a] * du[dofs[a]];
    return sum;
  }
  // out += factor * gradient.
  void AddGradient(double factor, Eigen::VectorXd* out) const {
    for (std::size_t a = 0; a < 2; ++a)
      if (dofs[a] >= 0) (*out)[dofs[a]] += factor * coefficients[a];
  }
};

// One candidate against a half plane: the matrix T of eq. (1) is constant, its columns are the two gradients.
struct ContactGeometry {
  SparseLinear gap;         // u_n = n . (x - p) [length]
  SparseLinear tangential;  // u_t = t . x [length]
  double friction = 0.0;    // mu; 0 where the node cannot move along t, since friction cannot act there

  bool Frictional() const { return friction > 0.0; }
};

// All candidates in scene order. `scene` must be sound and `structure` built from it.
std::vector<ContactGeometry> BuildContacts(const Scene& scene, const Structure& structure);

// u_t of all candidates at u.
Eigen::VectorXd TangentialPositions(const std::vector<ContactGeometry>& contacts, const Eigen::VectorXd& u);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_GEOMETRY_H_
