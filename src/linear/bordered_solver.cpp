#include "contact_path/linear/bordered_solver.h"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

#include "contact_path/linear/minimum_norm.h"

namespace contact_path {
namespace {

constexpr double kGrowth = 1e-4;  // reciprocal growth of the pivots below which they are chosen anew

// Sign of a permutation of 0..n-1.
int Parity(const int* permutation, int n) {
  std::vector<bool> seen(static_cast<std::size_t>(n), false);
  int sign = 1;
  for (int i = 0; i < n; ++i) {
    if (seen[static_cast<std::size_t>(i)]) continue;
    int length = 0;
    for (int j = i; !seen[static_cast<std::size_t>(j)]; j = permutation[j], ++length)
      seen[static_cast<std::size_t>(j)] = true;
    if (length % 2 == 0) sign = -sign;
  }
  return sign;
}

}  // namespace

struct BorderedSolver::Factors {
  Factors() {
    klu_defaults(&common);
    common.btf = 0;  // the matrix does not fall into blocks, and looking for them spoils its symmetric pattern
  }
  ~Factors() { Free(); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  void Free() {
    FreeNumeric();
    klu_free_symbolic(&symbolic, &common);
  }
  void FreeNumeric() { klu_free_numeric(&numeric, &common); }

  // Puts `matrix` together; whether its pattern is the pattern of the last time.
  bool Assemble(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row) {
    const Eigen::Index rows = transposed.rows(), columns = transposed.cols(), entries = transposed.nonZeros();
    // A row of many entries has all of them in the pattern, so that one that happens to be zero does not change it.
    const Eigen::Index in_row = (row.array() != 0.0).count();
    const bool full = 2 * in_row > rows;
    const Eigen::Index all = entries + (full ? rows : in_row);
    bool same = matrix.rows() == rows && matrix.cols() == columns + 1 && matrix.nonZeros() == all &&
                std::equal(transposed.outerIndexPtr(), transposed.outerIndexPtr() + columns, matrix.outerIndexPtr()) &&
                std::equal(transposed.innerIndexPtr(), transposed.innerIndexPtr() + entries, matrix.innerIndexPtr());
    if (!same) {
      matrix.resize(rows, columns + 1);
      matrix.resizeNonZeros(all);
      std::copy_n(transposed.outerIndexPtr(), columns + 1, matrix.outerIndexPtr());
      std::copy_n(transposed.innerIndexPtr(), entries, matrix.innerIndexPtr());
      matrix.outerIndexPtr()[columns + 1] = static_cast<int>(all);
    }
    std::copy_n(transposed.valuePtr(), entries, matrix.valuePtr());
    Eigen::Index end = entries;
    for (Eigen::Index i = 0; i < rows; ++i) {
      if (!full && row[i] == 0.0) continue;
      same = same && matrix.innerIndexPtr()[end] == i;
      matrix.innerIndexPtr()[end] = static_cast<int>(i);
      matrix.valuePtr()[end++] = row[i];
    }
    return same;
  }

  // LU of the transpose of `matrix`; false if it is singular. same_pattern: as of the last call.
  bool FactorizeLu(bool same_pattern) {
    auto* outer = matrix.outerIndexPtr();
    auto* inner = matrix.innerIndexPtr();
    if (same_pattern && numeric != nullptr && Refactorize()) return true;
    FreeNumeric();
    if (!same_pattern || symbolic == nullptr) {
      klu_free_symbolic(&symbolic, &common);
      symbolic = klu_analyze(static_cast<int>(matrix.rows()), outer, inner, &common);
    }
    if (symbolic != nullptr) numeric = klu_factor(outer, inner, matrix.valuePtr(), symbolic, &common);
    // Not to be taken for a singular matrix.
    if (common.status == KLU_OUT_OF_MEMORY || common.status == KLU_TOO_LARGE) throw std::bad_alloc();
    return numeric != nullptr && common.status == KLU_OK && Regular();
  }

  // With the pivots of the last factorisation; false where they are no longer good, or the matrix is singular.
  bool Refactorize() {
    auto* outer = matrix.outerIndexPtr();
    auto* inner = matrix.innerIndexPtr();
    return klu_refactor(outer, inner, matrix.valuePtr(), symbolic, numeric, &common) == 1 && common.status == KLU_OK &&
           klu_rgrowth(outer, inner, matrix.valuePtr(), symbolic, numeric, &common) == 1 && common.rgrowth > kGrowth &&
           Regular();
  }

  bool Regular() { return klu_rcond(symbolic, numeric, &common) == 1 && common.rcond > tolerances::kSingularPivot; }

  // Needs the factors.
  int DeterminantSign() const {
    const auto n = static_cast<int>(matrix.rows());
    int sign = Parity(numeric->Pnum, n) * Parity(symbolic->Q, n);
    const auto* diagonal = static_cast<const double*>(numeric->Udiag);
    for (int i = 0; i < n; ++i)
      if (diagonal[i] < 0.0) sign = -sign;
    return sign;
  }

  Eigen::SparseMatrix<double> matrix;  // M', unknowns x rows
  bool regular = false;
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  MinimumNormSolver minimum_norm;  // where not regular
};

BorderedSolver::BorderedSolver() : factors_(std::make_unique<Factors>()) {}
BorderedSolver::~BorderedSolver() = default;

bool BorderedSolver::Factorize(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                               double rank_tolerance) {
  if (rank_tolerance == 0.0) {
    if (FactorizeRegular(transposed, row)) return true;
  } else {
    factors_->Assemble(transposed, row);
    factors_->Free();
    factors_->regular = false;
  }
  if (!factors_->matrix.coeffs().allFinite()) return false;
  return factors_->minimum_norm.Factorize(factors_->matrix,
                                          rank_tolerance > 0.0 ? rank_tolerance : tolerances::kDependentColumn);
}

bool BorderedSolver::FactorizeRegular(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                                      double regular) {
  const bool same_pattern = factors_->Assemble(transposed, row);
  const bool possible = factors_->matrix.rows() == factors_->matrix.cols() && factors_->matrix.coeffs().allFinite();
  if (!possible) factors_->Free();
  factors_->regular = possible && factors_->FactorizeLu(same_pattern) &&
                      factors_->common.rcond > std::max(regular, tolerances::kSingularPivot);
  return factors_->regular;
}

Eigen::VectorXd BorderedSolver::Solve(const Eigen::VectorXd& b, double last) const {
  Eigen::VectorXd x;
  Solve(b, last, &x);
  return x;
}

void BorderedSolver::Solve(const Eigen::VectorXd& b, double last, Eigen::VectorXd* x) const {
  x->resize(b.size() + 1);
  *x << b, last;
  if (!factors_->regular) {
    *x = factors_->minimum_norm.Solve(*x);
    return;
  }
  klu_tsolve(factors_->symbolic, factors_->numeric, static_cast<int>(x->size()), 1, x->data(), &factors_->common);
}

void BorderedSolver::SolveAll(const Eigen::MatrixXd& B, Eigen::MatrixXd* x) const {
  x->resize(factors_->matrix.rows(), B.cols());
  x->topRows(B.rows()) = B;
  x->bottomRows(1).setZero();
  klu_tsolve(factors_->symbolic, factors_->numeric, static_cast<int>(x->rows()), static_cast<int>(x->cols()), x->data(),
             &factors_->common);
}

Eigen::MatrixXd BorderedSolver::NullSpace() const { return factors_->minimum_norm.NullSpace(); }

Eigen::MatrixXd BorderedSolver::LeftNullSpace() const { return factors_->minimum_norm.LeftNullSpace(); }

Eigen::Index BorderedSolver::Nullity() const {
  return factors_->regular ? 0 : factors_->matrix.rows() - factors_->minimum_norm.Rank();
}

int BorderedSolver::DeterminantSign() const { return factors_->regular ? PivotSign() : 0; }

int BorderedSolver::PivotSign() const { return factors_->numeric != nullptr ? factors_->DeterminantSign() : 0; }

}  // namespace contact_path
