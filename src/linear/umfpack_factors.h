// Sparse LU factors of large matrices.
#ifndef CONTACT_PATH_SRC_LINEAR_UMFPACK_FACTORS_H_
#define CONTACT_PATH_SRC_LINEAR_UMFPACK_FACTORS_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace contact_path {

// Analysis of a square pattern by UMFPACK, with the fill-reducing ordering of METIS, but the last row and column last:
// all factors of matrices with this pattern share it. Throws std::bad_alloc where there is not enough memory, and
// LinearSolverError where it fails.
class UmfpackAnalysis {
 public:
  // By column: entries[starts[k]] up to entries[starts[k + 1]], ascending.
  UmfpackAnalysis(std::vector<int> starts, std::vector<int> entries);
  ~UmfpackAnalysis();
  UmfpackAnalysis(const UmfpackAnalysis&) = delete;
  UmfpackAnalysis& operator=(const UmfpackAnalysis&) = delete;

  int Size() const { return static_cast<int>(starts_.size()) - 1; }
  const std::vector<int>& Starts() const { return starts_; }
  const std::vector<int>& Entries() const { return entries_; }
  void* Symbolic() const { return symbolic_; }

 private:
  std::vector<int> starts_, entries_;
  void* symbolic_ = nullptr;
};

// A = L U by UMFPACK, with dense kernels of the BLAS. All functions throw std::bad_alloc where there is not enough
// memory.
class UmfpackFactors {
 public:
  UmfpackFactors();
  ~UmfpackFactors();
  UmfpackFactors(const UmfpackFactors&) = delete;
  UmfpackFactors& operator=(const UmfpackFactors&) = delete;

  // A single call for each object. values: of the entries of the pattern, finite. False if the matrix is singular.
  // Throws LinearSolverError where the factorisation fails otherwise.
  bool Factorize(const UmfpackAnalysis& analysis, const Eigen::VectorXd& values);

  // Of the pivots, smallest over largest.
  double PivotRatio() const { return pivot_ratio_; }
  int DeterminantSign() const;
  // How many eigenvalues of the matrix without its last row and column are negative, where turning the signs of these
  // columns makes it symmetric: by the pivots, where they come from the diagonal, alone or in pairs. Nothing: they do
  // not.
  std::optional<Eigen::Index> NegativeEigenvalues(const std::vector<bool>& turned) const;
  // Solves A' x = b, and A x = b.
  void SolveTransposed(const double* b, double* x);
  void Solve(const double* b, double* x);

 private:
  void Solve(int system, const double* b, double* x);

  void* numeric_ = nullptr;
  double pivot_ratio_ = 0.0;
  Eigen::VectorXd control_;
  Eigen::VectorXi integers_;  // workspace of solutions
  Eigen::VectorXd numbers_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_UMFPACK_FACTORS_H_
