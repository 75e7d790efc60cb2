// Minimum-norm solution of sparse systems that may be underdetermined, redundant or both.
#ifndef CONTACT_PATH_LINEAR_MINIMUM_NORM_H_
#define CONTACT_PATH_LINEAR_MINIMUM_NORM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "contact_path/linear/large_system.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// Solves A x = b by a rank-revealing sparse QR factorisation of A': Eigen's of small systems, which calls no BLAS, and
// SuiteSparseQR of large ones (kLargeSystem). Of all x the shortest is returned;
// where rows of A depend on each other, the dependent ones are left out, which is right if b is consistent.
class MinimumNormSolver {
 public:
  MinimumNormSolver();
  ~MinimumNormSolver();
  MinimumNormSolver(const MinimumNormSolver&) = delete;
  MinimumNormSolver& operator=(const MinimumNormSolver&) = delete;

  // Equations are divided by their norms, so that a soft one beside a stiff one counts as much. rank_tolerance: with a
  // larger one than the default, an equation far below those around it, as across bars that become straight without
  // stress, counts as dependent. transposed: A', unknowns x equations. False if it is not finite. Throws
  // std::bad_alloc where there is not enough memory, as all functions below do, and LinearSolverError where the
  // factorisation fails.
  bool Factorize(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance = tolerances::kDependentColumn);
  Eigen::Index Rank() const;
  // x for b of the number of equations; Factorize() must have returned true.
  Eigen::VectorXd Solve(const Eigen::VectorXd& b) const;
  // Orthonormal basis of {x: A x = 0}, unknowns x (unknowns - rank), and one column of it.
  Eigen::MatrixXd NullSpace() const;
  Eigen::VectorXd NullVector(Eigen::Index column) const;
  // Basis of {y: A' y = 0}, equations x (equations - rank): which combinations of equations say nothing.
  Eigen::MatrixXd LeftNullSpace() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_MINIMUM_NORM_H_
