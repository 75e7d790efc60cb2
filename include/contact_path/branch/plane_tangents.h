// Tangents of the solutions where the Jacobian of the equations under an arc has a null plane.
#ifndef CONTACT_PATH_BRANCH_PLANE_TANGENTS_H_
#define CONTACT_PATH_BRANCH_PLANE_TANGENTS_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/equations/arc_equations.h"

namespace contact_path {

struct PlaneTangents {
  // False: the second derivatives do not choose, every direction of the plane is a tangent to first and second order.
  bool determined = false;
  std::vector<Eigen::VectorXd> directions;  // if determined: none, one or two, |(u, s) part| = 1, up to their sign
};

// With F = 0 the equations and J their Jacobian at x, a smooth curve of solutions through x has a tangent z
// with J z = 0 and psi . F''(z, z) = 0 for each left null vector psi of J: a homogeneous quadratic equation on the null
// plane. Two roots: two curves cross. A double root: one part of the structure is at a limit point of its own while the
// rest, or the load and the reactions alone, can go on.
// plane: two columns, a basis of null vectors of J, NumUnknowns() x 2. left: columns are left null vectors of J,
// NumEquations() x any.
PlaneTangents TangentsInPlane(ArcEquations* equations, const Eigen::VectorXd& x, const Eigen::MatrixXd& plane,
                              const Eigen::MatrixXd& left);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_PLANE_TANGENTS_H_
