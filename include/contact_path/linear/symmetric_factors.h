// L D L' factors of symmetric indefinite matrices, which tell how many eigenvalues are negative.
#ifndef CONTACT_PATH_LINEAR_SYMMETRIC_FACTORS_H_
#define CONTACT_PATH_LINEAR_SYMMETRIC_FACTORS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace contact_path {

// By Bunch and Kaufman's pivots: LAPACK where the matrix is small, MUMPS where it is large. By Sylvester's law of
// inertia D has as many negative eigenvalues as the matrix.
class SymmetricFactors {
 public:
  SymmetricFactors();
  ~SymmetricFactors();
  SymmetricFactors(const SymmetricFactors&) = delete;
  SymmetricFactors& operator=(const SymmetricFactors&) = delete;

  // matrix: both triangles, compressed. False if the matrix is singular: its smallest pivot is below
  // tolerances::kSingularPivot of the largest, after each row and column was divided by the root of its largest entry.
  // Throws std::bad_alloc where there is not enough memory, and LinearSolverError where MUMPS fails otherwise.
  bool Factorize(const Eigen::SparseMatrix<double>& matrix);
  Eigen::Index NegativeEigenvalues() const;
  // Solves A x = b in place for each column.
  void Solve(Eigen::MatrixXd* columns) const;

 private:
  struct Dense;
  struct Sparse;
  Eigen::VectorXd scale_;
  std::unique_ptr<Dense> dense_;
  std::unique_ptr<Sparse> sparse_;
  bool is_dense_ = true;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_SYMMETRIC_FACTORS_H_
