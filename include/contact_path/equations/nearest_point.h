// Newton's method on the equations of fixed contact states, to the solution nearest to a wanted point.
#ifndef CONTACT_PATH_EQUATIONS_NEAREST_POINT_H_
#define CONTACT_PATH_EQUATIONS_NEAREST_POINT_H_

#include <Eigen/Core>

#include "contact_path/equations/fixed_mode_system.h"

namespace contact_path {

struct NearestPoint {
  bool converged = false;
  Eigen::VectorXd x;      // unknowns of the system
  double residual = 0.0;  // largest equation residual at x
  Eigen::Index rank = 0;  // of the Jacobian at the last iteration
};

// The solution x of `system` whose (u, s) is nearest to `wanted` (NumDofs() + 1 entries), from `start`: Gauss-Newton
// steps of minimum norm, so redundant equations and rigid modes are no obstacle. Converged: steps at rounding level,
// equations solved.
NearestPoint FindNearestPoint(FixedModeSystem* system, const Eigen::VectorXd& start, const Eigen::VectorXd& wanted);

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_NEAREST_POINT_H_
