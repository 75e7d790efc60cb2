// L D L' factors of symmetric matrices under constraints, which tell how many eigenvalues are negative.
#ifndef CONTACT_PATH_LINEAR_SYMMETRIC_FACTORS_H_
#define CONTACT_PATH_LINEAR_SYMMETRIC_FACTORS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace contact_path {

// Of [K C'; C -D], K unknowns x unknowns, C constraints x unknowns, D >= 0 a diagonal, mostly zero. By Sylvester's law
// of inertia D has as many negative eigenvalues as the matrix. Below kLargeSystem without the BLAS, so that counts do
// not depend on the processor; beyond, and where a small pivot takes digits, by MUMPS.
class SymmetricFactors {
 public:
  SymmetricFactors();
  ~SymmetricFactors();
  SymmetricFactors(const SymmetricFactors&) = delete;
  SymmetricFactors& operator=(const SymmetricFactors&) = delete;

  // matrix: both triangles, compressed; its last rows are the constraints. redundant: they may depend on each other,
  // and have a compliance far below that of K, which counts them nevertheless. False if it is singular: its smallest
  // pivot is below tolerances::kSingularPivot, with rows and columns divided so that entries are 1 at most. Throws
  // std::bad_alloc where there is not enough memory, and LinearSolverError where MUMPS fails otherwise.
  bool Factorize(const Eigen::SparseMatrix<double>& matrix, Eigen::Index constraints, bool redundant = false);
  Eigen::Index NegativeEigenvalues() const;
  // Solves A x = b in place for each column.
  void Solve(Eigen::MatrixXd* columns) const;

 private:
  struct Small;
  struct Large;
  Eigen::VectorXd scale_;
  std::unique_ptr<Small> small_;
  std::unique_ptr<Large> large_;
  bool is_large_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_SYMMETRIC_FACTORS_H_
