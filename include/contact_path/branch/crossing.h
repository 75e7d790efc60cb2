// The path that crosses at a bifurcation of an arc.
#ifndef CONTACT_PATH_BRANCH_CROSSING_H_
#define CONTACT_PATH_BRANCH_CROSSING_H_

#include <Eigen/Core>
#include <optional>

#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// Derivatives of all unknowns by arc length |(du, ds)|. The other direction has -first and the same second.
struct Crossing {
  Eigen::VectorXd first;   // |(u, s) part| = 1; ds > 0, or where the load rests, the largest component of u > 0
  Eigen::VectorXd second;  // orthogonal to first in (u, s)
};

// x: a bifurcation, where the Jacobian of the equations F has two null vectors, the tangent t of the path with
// |(u, s) part| = 1 and another one, v, and one left null vector psi. Tangents are zeros of the form psi . F''(z, z),
// of which t is one, and the other is z = c t - 2 b v with b = psi . F''(t, v), c = psi . F''(v, v). The second
// derivative follows from psi . (F'''(z, z, z) + 3 F''(z, x'')) = 0. Nothing where the null space is another one, as
// with redundant contacts, or both tangents coincide.
// before: another point of the path, to know how large the equations are that vanish at x.
std::optional<Crossing> FindCrossing(FixedStateSystem* system, const Eigen::VectorXd& before, const Eigen::VectorXd& x,
                                     const Eigen::VectorXd& tangent);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_CROSSING_H_
