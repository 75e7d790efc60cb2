// A point at which curves of solutions cross, as a regular equation.
#ifndef CONTACT_PATH_BRANCH_CROSSING_H_
#define CONTACT_PATH_BRANCH_CROSSING_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/equations/arc_equations.h"

namespace contact_path {

// Derivatives of all unknowns by arc length |(du, ds)|. The other direction has -first and the same second.
struct CurveDerivatives {
  Eigen::VectorXd first;   // |(u, s) part| = 1
  Eigen::VectorXd second;  // orthogonal to first in (u, s)
};

// Where the Jacobian J of the equations F has the null vectors t and v_1, ..., v_k, and as many left null vectors psi_i
// as there are v. k = 1: two curves cross. Tangents are the zeros z of the form psi . F''(z, z); second derivatives
// follow from psi . (F'''(z, z, z) + 3 F''(z, x'')) = 0. k > 1: k equal parts of the structure come to such a point at
// once; the null vectors are then those of the parts, one by one.
struct Crossing {
  Eigen::VectorXd x;
  // psi . F(x), |psi| = 1, the largest: 0 where the curves cross. Otherwise an imperfection has broken the crossing
  // into two curves, and x is between them.
  double unfolding = 0.0;
  double error = 0.0;      // of the unfolding, by the rounding of F
  CurveDerivatives along;  // with the tangent nearest to the one wanted, in its sense
  // The others: ds > 0, or where the load rests, the largest component of u > 0. k = 1: one; otherwise those in which
  // one part alone leaves the curve, and that in which all do, with second = 0: further ones are not looked for.
  std::vector<CurveDerivatives> across;
  int factorisations = 0;

  bool IsPerfect() const;  // whether the curves cross, as far as rounding tells
  // Names the curve nearest to this tangent in (u, s) `along`, in its sense.
  void NameCurves(const Eigen::VectorXd& tangent);
};

// Newton's method on F(x) + B l = 0, g(x) = 0 (Griewank & Reddien 1984; Govaerts 2000, 3.6) with the unknowns x and l,
// where the k + 1 functions g are what J with borders leaves of its tangent, and the mean of the diagonal of sigma
// (branch/bordered_jacobian.h): J loses k ranks where all of sigma is 0. The equations are regular where the curves
// cross at an angle, and x has the digits of a regular point. guess: near x; tangent: of (u, s), of the curve there. k:
// as many null vectors; 0: as many singular values of one size as there are at the guess. Nothing where no such point
// is found.
std::optional<Crossing> FindCrossing(ArcEquations* equations, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& tangent, Eigen::Index k = 1);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_CROSSING_H_
