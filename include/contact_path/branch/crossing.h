// A point at which two curves of solutions cross, as a regular equation.
#ifndef CONTACT_PATH_BRANCH_CROSSING_H_
#define CONTACT_PATH_BRANCH_CROSSING_H_

#include <Eigen/Core>
#include <optional>

#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// Derivatives of all unknowns by arc length |(du, ds)|. The other direction has -first and the same second.
struct CurveDerivatives {
  Eigen::VectorXd first;   // |(u, s) part| = 1
  Eigen::VectorXd second;  // orthogonal to first in (u, s)
};

// Where the Jacobian J of the equations F has two null vectors t and v, and one left null vector psi. Tangents are the
// zeros z of the form psi . F''(z, z); second derivatives follow from psi . (F'''(z, z, z) + 3 F''(z, x'')) = 0.
struct Crossing {
  Eigen::VectorXd x;
  // psi . F(x), |psi| = 1: 0 where the curves cross. Otherwise an imperfection has broken the crossing into two curves,
  // and x is between them.
  double unfolding = 0.0;
  double error = 0.0;       // of the unfolding, by the rounding of F
  CurveDerivatives along;   // with the tangent nearest to the one wanted, in its sense
  CurveDerivatives across;  // the other one: ds > 0, or where the load rests, the largest component of u > 0
  int factorisations = 0;

  bool IsPerfect() const;  // whether the curves cross, as far as rounding tells
  // Names the curve nearest to this tangent in (u, s) `along`, in its sense.
  void NameCurves(const Eigen::VectorXd& tangent);
};

// Newton's method on F(x) + l b = 0, g(x) = 0 (Griewank & Reddien 1984; Govaerts 2000, 3.6) with the unknowns x and l,
// where the pair g is what [J b; v' 0; t' 0] (z, g_t) = (0; 0, 1), and (0; 1, 0) for g_v, leaves: J loses a rank where
// both are 0. The equations are regular where the curves cross at an angle, and x has the digits of a regular point.
// guess: near x; tangent: of (u, s), of the curve there. Nothing where no such point is found.
std::optional<Crossing> FindCrossing(FixedStateSystem* system, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& tangent);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_CROSSING_H_
