// What rounding leaves of solutions of the linearised equations.
#ifndef CONTACT_PATH_LINEAR_LINEARISED_EQUATIONS_H_
#define CONTACT_PATH_LINEAR_LINEARISED_EQUATIONS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact_path/linear/bordered_solver.h"

namespace contact_path {

// J t = 0 for a tangent t of the curve of solutions. Each product of the sum J t is rounded: an equation i holds to
// eps sum_j |J_ij t_j|, its rounding (Oettli & Prager 1964: t is exact for a matrix with entries changed that much).
class LinearisedEquations {
 public:
  // transposed: J', unknowns x equations; must outlive the object.
  explicit LinearisedEquations(const Eigen::SparseMatrix<double>& transposed) : transposed_(transposed) {}

  // Whether each equation holds at the tangent, to this share of its largest entry times the tangent.
  bool Hold(const Eigen::VectorXd& tangent, double share) const;

  // Iterative refinement of a tangent by the factors of M = [J; row]: until the equations hold to their rounding, twice
  // at most. row . t stays.
  void Refine(const BorderedSolver& solver, Eigen::VectorXd* tangent) const;

  // A bound of the error of the component i of such a tangent, to first order: sum_k |y_k| rounding_k, M' y = e_i.
  double ErrorOf(Eigen::Index i, const BorderedSolver& solver, const Eigen::VectorXd& tangent) const;

 private:
  // J t and the rounding of each equation.
  void Evaluate(const Eigen::VectorXd& tangent, Eigen::VectorXd* residual, Eigen::VectorXd* rounding) const;

  const Eigen::SparseMatrix<double>& transposed_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_LINEARISED_EQUATIONS_H_
