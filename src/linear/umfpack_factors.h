// Sparse LU factors of large matrices.
#ifndef CONTACT_PATH_SRC_LINEAR_UMFPACK_FACTORS_H_
#define CONTACT_PATH_SRC_LINEAR_UMFPACK_FACTORS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace contact_path {

// A = L U by UMFPACK, with dense kernels of the BLAS and the fill-reducing ordering of METIS. All functions throw
// std::bad_alloc where there is not enough memory.
class UmfpackFactors {
 public:
  UmfpackFactors();
  ~UmfpackFactors() { Free(); }
  UmfpackFactors(const UmfpackFactors&) = delete;
  UmfpackFactors& operator=(const UmfpackFactors&) = delete;

  void Free();
  // matrix: square, compressed, finite; it is not kept. same_pattern: as of the last call. False if it is singular.
  // Throws LinearSolverError where the factorisation fails otherwise.
  bool Factorize(const Eigen::SparseMatrix<double>& matrix, bool same_pattern);
  bool HasFactors() const { return numeric_ != nullptr; }

  // Of the pivots, smallest over largest.
  double PivotRatio() const { return pivot_ratio_; }
  int DeterminantSign() const;
  // Solves A' x = b.
  void SolveTransposed(const double* b, double* x);

 private:
  void FreeNumeric();

  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  double pivot_ratio_ = 0.0;
  Eigen::VectorXd control_;
  Eigen::VectorXi integers_;  // workspace of solutions
  Eigen::VectorXd numbers_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_UMFPACK_FACTORS_H_
