// Sparse LU factors of small matrices.
#ifndef CONTACT_PATH_SRC_LINEAR_KLU_FACTORS_H_
#define CONTACT_PATH_SRC_LINEAR_KLU_FACTORS_H_

#include <klu.h>

#include <Eigen/SparseCore>
#include <vector>

namespace contact_path {

// A = L U by KLU. The ordering is kept for as long as the pattern is the same, the pivots for as long as they are good
// as well. Factorize() throws std::bad_alloc where there is not enough memory.
class KluFactors {
 public:
  KluFactors();
  ~KluFactors() { Free(); }
  KluFactors(const KluFactors&) = delete;
  KluFactors& operator=(const KluFactors&) = delete;

  void Free();
  // matrix: square, compressed, finite. same_pattern: as of the last call. False if it is singular: a pivot below
  // tolerances::kSingularPivot of the largest.
  bool Factorize(Eigen::SparseMatrix<double>* matrix, bool same_pattern);

  // Of the pivots, smallest over largest.
  double PivotRatio() const { return pivot_ratio_; }
  int DeterminantSign() const;
  // Solves A' X = B in place, X: unknowns x columns.
  void SolveTransposed(double* x, int columns);
  void Solve(double* x);  // A x = b in place

 private:
  void Analyze(Eigen::SparseMatrix<double>* matrix);
  bool Refactorize(Eigen::SparseMatrix<double>* matrix);
  bool Regular();

  klu_common common_{};
  int size_ = 0, moved_ = 0;  // moved_: the row that stands last
  std::vector<int> rows_;     // of the entries, as they stand
  double pivot_ratio_ = 0.0;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_KLU_FACTORS_H_
