#include "contact_path/branch/bordered_solver.h"

#include <klu.h>

#include <cmath>
#include <vector>

#include "contact_path/contact/minimum_norm.h"

namespace contact_path {
namespace {

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
  Factors() { klu_defaults(&common); }
  ~Factors() { Free(); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  void Free() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  // LU of the transpose of `matrix`; false if it is singular.
  bool FactorizeLu() {
    Free();
    auto* outer = matrix.outerIndexPtr();
    auto* inner = matrix.innerIndexPtr();
    symbolic = klu_analyze(static_cast<int>(matrix.rows()), outer, inner, &common);
    if (symbolic == nullptr) return false;
    numeric = klu_factor(outer, inner, matrix.valuePtr(), symbolic, &common);
    if (numeric == nullptr || common.status != KLU_OK) return false;
    return klu_rcond(symbolic, numeric, &common) == 1 && common.rcond > kSingular;
  }

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
  Eigen::SparseMatrix<double>& matrix = factors_->matrix;
  const Eigen::Index rows = transposed.rows(), columns = transposed.cols();
  matrix.resize(rows, columns + 1);
  matrix.resizeNonZeros(transposed.nonZeros() + rows);
  std::copy_n(transposed.outerIndexPtr(), columns + 1, matrix.outerIndexPtr());
  std::copy_n(transposed.innerIndexPtr(), transposed.nonZeros(), matrix.innerIndexPtr());
  std::copy_n(transposed.valuePtr(), transposed.nonZeros(), matrix.valuePtr());
  int end = matrix.outerIndexPtr()[columns];
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (row[i] == 0.0) continue;
    matrix.innerIndexPtr()[end] = static_cast<int>(i);
    matrix.valuePtr()[end++] = row[i];
  }
  matrix.outerIndexPtr()[columns + 1] = end;
  matrix.resizeNonZeros(end);
  if (!matrix.coeffs().allFinite()) return false;
  factors_->Free();
  factors_->regular = rank_tolerance == 0.0 && rows == columns + 1 && factors_->FactorizeLu();
  if (factors_->regular) return true;
  return factors_->minimum_norm.Factorize(matrix,
                                          rank_tolerance > 0.0 ? rank_tolerance : MinimumNormSolver::kRankTolerance);
}

Eigen::VectorXd BorderedSolver::Solve(const Eigen::VectorXd& b, double last) const {
  Eigen::VectorXd x(b.size() + 1);
  x << b, last;
  if (!factors_->regular) return factors_->minimum_norm.Solve(x);
  klu_tsolve(factors_->symbolic, factors_->numeric, static_cast<int>(x.size()), 1, x.data(), &factors_->common);
  return x;
}

Eigen::Index BorderedSolver::Deficiency() const {
  return factors_->regular ? 0 : factors_->matrix.rows() - factors_->minimum_norm.Rank();
}

int BorderedSolver::DeterminantSign() const { return factors_->regular ? PivotSign() : 0; }

int BorderedSolver::PivotSign() const { return factors_->numeric != nullptr ? factors_->DeterminantSign() : 0; }

}  // namespace contact_path
