// The tangents of the arcs through a point of the path, with the states of all contacts fixed.
#ifndef CONTACT_PATH_BRANCH_TANGENTS_H_
#define CONTACT_PATH_BRANCH_TANGENTS_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/branch/factorised.h"
#include "contact_path/equations/arc_equations.h"
#include "contact_path/linear/minimum_norm.h"

namespace contact_path {

// Derivatives of all unknowns by arc length |(du, ds)|. Each tangent stands for both senses.
struct Tangents {
  std::vector<Eigen::VectorXd> first;   // |(u, s) part| = 1
  std::vector<Eigen::VectorXd> second;  // of each, up to a multiple of first
  // Of the rate of the load in each tangent: what the rounding of the equations may make of it; where the equations are
  // too singular to tell, the tolerance of rates.
  std::vector<double> load_error;
  // The equations leave several motions without any change of load and reactions: first is the one nearest to the
  // direction of arrival.
  bool mechanism = false;
  // A part of the structure is at a limit point of its own: the equations are singular all along the arcs.
  bool rests = false;
  bool rigid = false;   // parts move as rigid bodies: neither load nor reactions change all along the arcs
  int rigid_modes = 0;  // motions without any change of load and reactions, where nothing else moves
};

// Factors that FindTangents() leaves for its next call: equations of one pattern are factorised faster.
struct TangentSolvers {
  Factorised factors;
  MinimumNormSolver singular;  // where it is singular
};

// At the point x; none where the equations leave no arc through x. arrival: (du, ds), unit
// vector; of several directions the one nearest to it counts. crossed: another path crosses at x, so that nearly
// singular counts as singular.
Tangents FindTangents(const Eigen::VectorXd& x, const Eigen::VectorXd& arrival, bool crossed, ArcEquations* equations,
                      TangentSolvers* solvers);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_TANGENTS_H_
