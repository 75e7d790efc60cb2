// The Jacobian with borders that make it regular where it loses ranks.
#ifndef CONTACT_PATH_BRANCH_BORDERED_JACOBIAN_H_
#define CONTACT_PATH_BRANCH_BORDERED_JACOBIAN_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact_path/equations/arc_equations.h"
#include "contact_path/linear/bordered_solver.h"

namespace contact_path {

// M = [J B; V' 0; t' 0] with k borders B and V, orthonormal columns: with M (v_j, sigma_j) = (0, e_j, 0) and the rows
// psi_i of the inverse, J loses k ranks where the k x k matrix sigma is zero (Govaerts 2000, 3.6), and
// det [J; t'] = det(-sigma) det M.
class BorderedJacobian {
 public:
  // t: (u, s), NumMotion().
  BorderedJacobian(ArcEquations* equations, const Eigen::VectorXd& t);

  // k borders by one inverse iteration of a block with the factors of [J; t'] at x; false: it is too singular there.
  bool ChooseBorders(const Eigen::VectorXd& x, Eigen::Index k);
  // Fills in what follows; false: M is singular.
  bool Factorize(const Eigen::VectorXd& x);
  // J z + B l = right, across the borders.
  Eigen::VectorXd Solve(const Eigen::VectorXd& right, Eigen::VectorXd* l) const;
  // The null vectors found last become the borders.
  void UpdateBorders() { SetBorders(across, psi); }

  Eigen::VectorXd along;   // J along + B left_along = 0, V' along = 0, t' along = 1
  Eigen::MatrixXd across;  // columns v_j, unknowns x k
  Eigen::VectorXd left_along;
  Eigen::MatrixXd sigma;     // J v_j + B sigma_j = 0
  Eigen::MatrixXd psi;       // columns, equations x k: psi' B = 1
  int determinant_sign = 0;  // of M

 private:
  void SetBorders(const Eigen::MatrixXd& v, const Eigen::MatrixXd& psi_found);

  ArcEquations& equations_;
  const Eigen::Index motion_, unknowns_;
  const Eigen::VectorXd t_;
  Eigen::MatrixXd v_, b_;
  Eigen::SparseMatrix<double> bordered_;  // transposed
  BorderedSolver solver_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_BORDERED_JACOBIAN_H_
