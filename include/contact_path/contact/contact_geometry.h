// Where each contact candidate stands relative to its obstacle, and how its reaction acts on the structure.
#ifndef CONTACT_PATH_CONTACT_CONTACT_GEOMETRY_H_
#define CONTACT_PATH_CONTACT_CONTACT_GEOMETRY_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact_path/contact/path_point.h"
#include "contact_path/scene/scene.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// A linear function of (u, s) with at most two terms in u: offset + sum coefficient_a u[dof_a] + load s.
struct SparseLinear {
  std::array<int, 2> dofs = {-1, -1};  // ascending where present; -1 = no term
  std::array<double, 2> coefficients = {0.0, 0.0};
  double offset = 0.0;  // share of fixed components
  double load = 0.0;    // of a moving obstacle

  // u, du: may have more entries than dofs.
  double Value(const Eigen::VectorXd& u, double s) const { return offset + Rate(u, s); }
  double Rate(const Eigen::VectorXd& du, double ds) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < 2; ++a)
      if (dofs[a] >= 0) sum += coefficients[a] * du[dofs[a]];
    return sum + load * ds;
  }
  // out += factor * gradient by u: how a force along the function acts on the structure.
  void AddGradient(double factor, Eigen::VectorXd* out) const {
    for (std::size_t a = 0; a < 2; ++a)
      if (dofs[a] >= 0) (*out)[dofs[a]] += factor * coefficients[a];
  }
};

// One candidate against a half plane: the matrix T of eq. (1) is constant, its columns are the two gradients by u.
struct ContactGeometry {
  SparseLinear gap;         // u_n = n . (x - p(s)) [length]
  SparseLinear tangential;  // u_t = t . (x - p(s) + p(0)) [length]: its changes are the motion along the obstacle
  double friction = 0.0;    // mu; 0 where the node cannot move along t, since friction cannot act there

  bool Frictional() const { return friction > 0.0; }
};

// All candidates in scene order. `scene` must be sound and `structure` built from it.
std::vector<ContactGeometry> BuildContacts(const Scene& scene, const Structure& structure);

// u_t of all candidates.
Eigen::VectorXd TangentialPositions(const std::vector<ContactGeometry>& contacts, const PathPoint& point);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_GEOMETRY_H_
