#include "linear/klu_factors.h"

#include <Eigen/Core>
#include <algorithm>
#include <new>

#include "contact_path/linear/frame.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Sign of a permutation of 0..n-1.
int Parity(const int* permutation, int n) {
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  return static_cast<int>(Eigen::Map<Permutation>(permutation, n).determinant());
}

}  // namespace

KluFactors::KluFactors() {
  klu_defaults(&common_);
  common_.btf = 0;  // the matrix does not fall into blocks, and looking for them spoils its symmetric pattern
}

void KluFactors::Free() {
  klu_free_numeric(&numeric_, &common_);
  klu_free_symbolic(&symbolic_, &common_);
}

bool KluFactors::Factorize(Eigen::SparseMatrix<double>* matrix, bool same_pattern) {
  if (same_pattern && numeric_ != nullptr && Refactorize(matrix)) return true;
  if (!same_pattern || symbolic_ == nullptr) Analyze(matrix);
  // Pivots on the diagonal first, which keep the factors sparse, where they have KLU's share of the largest entry.
  // Along a chain of contacts each may be small beside the entries below, and their growth takes all digits: then the
  // largest entries are the pivots.
  klu_common by_default;
  klu_defaults(&by_default);
  for (const double share : {by_default.tol, 1.0}) {
    klu_free_numeric(&numeric_, &common_);
    common_.tol = share;
    if (symbolic_ != nullptr)
      numeric_ = klu_factor(matrix->outerIndexPtr(), rows_.data(), matrix->valuePtr(), symbolic_, &common_);
    // Not to be taken for a singular matrix.
    if (common_.status == KLU_OUT_OF_MEMORY || common_.status == KLU_TOO_LARGE) throw std::bad_alloc();
    if (numeric_ != nullptr && common_.status == KLU_OK && Regular() && pivot_ratio_ > tolerances::kRootOfRounding)
      return true;
  }
  return numeric_ != nullptr && common_.status == KLU_OK && Regular();
}

// The row that has no entry on the diagonal, as that of a load factor before the forces, comes last where that brings
// others onto it: the ordering is made for symmetric patterns.
void KluFactors::Analyze(Eigen::SparseMatrix<double>* matrix) {
  klu_free_symbolic(&symbolic_, &common_);
  size_ = static_cast<int>(matrix->rows());
  moved_ = static_cast<int>(FirstWithoutDiagonal(*matrix));
  int gained = 0;
  for (int column = moved_; column < size_; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(*matrix, column); it; ++it)
      gained += it.row() == (column < size_ - 1 ? column + 1 : moved_) ? 1 : it.row() == column ? -1 : 0;
  if (gained <= 0) moved_ = size_ - 1;
  rows_.assign(matrix->innerIndexPtr(), matrix->innerIndexPtr() + matrix->nonZeros());
  for (int& row : rows_) row = row < moved_ ? row : row == moved_ ? size_ - 1 : row - 1;
  symbolic_ = klu_analyze(size_, matrix->outerIndexPtr(), rows_.data(), &common_);
}

// With the pivots of the last factorisation; false where they are no longer good, or the matrix is singular.
bool KluFactors::Refactorize(Eigen::SparseMatrix<double>* matrix) {
  int* const outer = matrix->outerIndexPtr();
  double* const values = matrix->valuePtr();
  return klu_refactor(outer, rows_.data(), values, symbolic_, numeric_, &common_) == 1 && common_.status == KLU_OK &&
         klu_rgrowth(outer, rows_.data(), values, symbolic_, numeric_, &common_) == 1 &&
         common_.rgrowth > tolerances::kResidual / tolerances::kSameDirection && Regular();
}

bool KluFactors::Regular() {
  pivot_ratio_ = klu_rcond(symbolic_, numeric_, &common_) == 1 ? common_.rcond : 0.0;
  return pivot_ratio_ > tolerances::kSingularPivot;
}

int KluFactors::DeterminantSign() const {
  const int n = numeric_->n;
  int sign = Parity(numeric_->Pnum, n) * Parity(symbolic_->Q, n) * ((n - 1 - moved_) % 2 != 0 ? -1 : 1);
  const auto* diagonal = static_cast<const double*>(numeric_->Udiag);
  for (int i = 0; i < n; ++i)
    if (diagonal[i] < 0.0) sign = -sign;
  return sign;
}

void KluFactors::SolveTransposed(double* x, int columns) {
  klu_tsolve(symbolic_, numeric_, size_, columns, x, &common_);
  for (double* end = x + size_; columns > 0; --columns, end += size_) std::rotate(end - size_ + moved_, end - 1, end);
}

void KluFactors::Solve(double* x) {
  std::rotate(x + moved_, x + moved_ + 1, x + size_);
  klu_solve(symbolic_, numeric_, size_, 1, x, &common_);
}

}  // namespace contact_path
