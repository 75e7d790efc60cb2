#include "contact_path/linear/bordered_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "contact_path/linear/minimum_norm.h"
#include "linear/klu_factors.h"
#include "linear/umfpack_factors.h"

namespace contact_path {
namespace {

// Unknowns from which on METIS and dense kernels are worth their overhead: KLU is as fast at 10^3, and takes three
// times as long at 10^4.
constexpr Eigen::Index kLargeSystem = 3000;
constexpr double kFewInRow = 1e-3;   // of the unknowns: a row with more entries is not put into a large matrix
constexpr std::size_t kPlaces = 64;  // entries of the row that stands for it
constexpr double kGoodPlaces = 0.5;  // of the largest entries together: places are kept from the matrix before

}  // namespace

// A large matrix has no row of many entries, which would fill its factors: N = [J; largest entries of row] stands for
// M = [J; row]. With N v = (0, 1), the solution of M x = (b, last) is x = y + a v where N y = (b, 0) and row . x =
// last, and det M = det N (row . v). The last row stands where it makes the pattern symmetric: beside the load factor.
struct BorderedSolver::Factors {
  // Puts `matrix` together; whether its pattern is the pattern of the last time.
  bool Assemble(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row) {
    const Eigen::Index rows = transposed.rows(), columns = transposed.cols();
    const Eigen::Index in_row = (row.array() != 0.0).count();
    large = rows >= kLargeSystem;
    replaced = large && static_cast<double>(in_row) > kFewInRow * static_cast<double>(rows);
    if (replaced) ChoosePlaces(row);
    last = large ? FirstWithoutDiagonal(transposed) : columns;
    // A row of many entries has all of them in the pattern, so that one that happens to be zero does not change it.
    const bool full = !replaced && 2 * in_row > rows;
    const Eigen::Index in_matrix = replaced ? Count(places)
                                   : full   ? rows
                                            : in_row,
                       all = transposed.nonZeros() + in_matrix;
    bool same = matrix.rows() == rows && matrix.cols() == columns + 1 && matrix.nonZeros() == all;
    if (!same) {
      matrix.resize(rows, columns + 1);
      matrix.resizeNonZeros(all);
    }
    const int *outer = transposed.outerIndexPtr(), *inner = transposed.innerIndexPtr();
    // Equations from `first` up to `beyond`, which come so many columns and entries later in the matrix.
    const auto copy = [&](Eigen::Index first, Eigen::Index beyond, Eigen::Index shift, int later) {
      int* const starts = matrix.outerIndexPtr() + first + shift;
      int* const unknowns = matrix.innerIndexPtr() + outer[first] + later;
      const int count = outer[beyond] - outer[first];
      same = same &&
             std::equal(outer + first, outer + beyond, starts, [later](int a, int b) { return a + later == b; }) &&
             std::equal(inner + outer[first], inner + outer[beyond], unknowns);
      std::copy_n(transposed.valuePtr() + outer[first], count, matrix.valuePtr() + outer[first] + later);
      if (same) return;
      std::transform(outer + first, outer + beyond, starts, [later](int entry) { return entry + later; });
      std::copy_n(inner + outer[first], count, unknowns);
    };
    copy(0, last, 0, 0);
    int end = outer[last];
    same = same && matrix.outerIndexPtr()[last] == end;
    matrix.outerIndexPtr()[last] = end;
    const auto append = [&](Eigen::Index unknown) {
      same = same && matrix.innerIndexPtr()[end] == unknown;
      matrix.innerIndexPtr()[end] = static_cast<int>(unknown);
      matrix.valuePtr()[end++] = row[unknown];
    };
    if (replaced) {
      for (const Eigen::Index i : places) append(i);
    } else {
      for (Eigen::Index i = 0; i < rows; ++i)
        if (full || row[i] != 0.0) append(i);
    }
    copy(last, columns, 1, static_cast<int>(in_matrix));
    matrix.outerIndexPtr()[columns + 1] = static_cast<int>(all);
    return same;
  }

  // The first equation that lacks the unknown of its number: equations of equilibrium come first, and have it.
  static Eigen::Index FirstWithoutDiagonal(const Eigen::SparseMatrix<double>& transposed) {
    for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
      const int* const begin = transposed.innerIndexPtr() + transposed.outerIndexPtr()[column];
      const int* const end = transposed.innerIndexPtr() + transposed.outerIndexPtr()[column + 1];
      if (!std::binary_search(begin, end, static_cast<int>(column))) return column;
    }
    return transposed.cols();
  }

  static Eigen::Index Count(const std::vector<Eigen::Index>& list) { return static_cast<Eigen::Index>(list.size()); }

  // Where the row, mostly a tangent, is large: for as long as it is so at the places of before, these, with the
  // pattern.
  void ChoosePlaces(const Eigen::VectorXd& row) {
    std::vector<Eigen::Index> largest(static_cast<std::size_t>(row.size()));
    std::iota(largest.begin(), largest.end(), Eigen::Index{0});
    const std::size_t count = std::min(kPlaces, largest.size());
    const auto before = [&row](Eigen::Index a, Eigen::Index b) {
      return std::abs(row[a]) != std::abs(row[b]) ? std::abs(row[a]) > std::abs(row[b]) : a < b;
    };
    std::nth_element(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(count) - 1, largest.end(), before);
    largest.resize(count);
    const auto sum = [&row](const std::vector<Eigen::Index>& at) {
      return std::accumulate(at.begin(), at.end(), 0.0,
                             [&row](double total, Eigen::Index i) { return total + std::abs(row[i]); });
    };
    const bool kept = !places.empty() && places.back() < row.size() && sum(places) >= kGoodPlaces * sum(largest);
    if (kept) return;
    places = std::move(largest);
    std::sort(places.begin(), places.end());
  }

  void Free() {
    klu.Free();
    umfpack.Free();
  }

  // LU of `matrix`; false if M is singular. same_pattern: as of the last call.
  bool FactorizeLu(bool same_pattern, const Eigen::VectorXd& row) {
    if (!large) {
      umfpack.Free();
      pivot_ratio = 0.0;
      if (!klu.Factorize(&matrix, same_pattern)) return false;
      pivot_ratio = klu.PivotRatio();
      return true;
    }
    klu.Free();
    along = 1.0;
    pivot_ratio = 0.0;
    if (!umfpack.Factorize(matrix, same_pattern)) return false;
    pivot_ratio = umfpack.PivotRatio();
    if (!(pivot_ratio > tolerances::kSingularPivot)) return false;
    if (!replaced) return true;
    border = row;
    direction.resize(matrix.rows());
    right_side = Eigen::VectorXd::Unit(matrix.rows(), last);
    umfpack.SolveTransposed(right_side.data(), direction.data());
    along = row.dot(direction);
    return std::abs(along) > tolerances::kSingularPivot * row.norm() * direction.norm();
  }

  // In place: M x = (b, value) for each column.
  void SolveLu(double* x, Eigen::Index columns) {
    const Eigen::Index n = matrix.rows();
    if (!large) {
      klu.SolveTransposed(x, static_cast<int>(columns));
      return;
    }
    right_side.resize(n);
    for (Eigen::Index k = 0; k < columns; ++k) {
      Eigen::Map<Eigen::VectorXd> column(x + k * n, n);
      const double value = column[n - 1];
      right_side << column.head(last), replaced ? 0.0 : value, column.segment(last, n - 1 - last);
      umfpack.SolveTransposed(right_side.data(), column.data());
      if (replaced) column += (value - border.dot(column)) / along * direction;
    }
  }

  // Needs the factors.
  int DeterminantSign() const {
    if (!large) return klu.DeterminantSign();
    const bool moved = (matrix.rows() - 1 - last) % 2 != 0;  // by so many places
    return moved == (along < 0.0) ? umfpack.DeterminantSign() : -umfpack.DeterminantSign();
  }
  bool HasFactors() const { return large ? umfpack.HasFactors() : klu.HasFactors(); }

  Eigen::SparseMatrix<double> matrix;  // M', or N', unknowns x rows
  bool large = false;
  bool regular = false;
  double pivot_ratio = 0.0;
  KluFactors klu;
  UmfpackFactors umfpack;
  bool replaced = false;              // N stands for M
  std::vector<Eigen::Index> places;   // of the entries of its row, ascending
  Eigen::Index last = 0;              // where the last row stands
  Eigen::VectorXd border, direction;  // row, v
  double along = 1.0;                 // row . v
  Eigen::VectorXd right_side;         // scratch
  MinimumNormSolver minimum_norm;     // where not regular
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
  if (!transposed.coeffs().allFinite() || !row.allFinite()) return false;
  if (rank_tolerance == 0.0) rank_tolerance = tolerances::kDependentColumn;
  if (!factors_->replaced) return factors_->minimum_norm.Factorize(factors_->matrix, rank_tolerance);
  Eigen::SparseMatrix<double> whole(transposed.rows(), transposed.cols() + 1);
  whole.leftCols(transposed.cols()) = transposed;
  whole.rightCols(1) = row.sparseView();
  return factors_->minimum_norm.Factorize(whole, rank_tolerance);
}

bool BorderedSolver::FactorizeRegular(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                                      double regular) {
  const bool same_pattern = factors_->Assemble(transposed, row);
  const bool possible = factors_->matrix.rows() == factors_->matrix.cols() && factors_->matrix.coeffs().allFinite();
  if (!possible) factors_->Free();
  factors_->regular = possible && factors_->FactorizeLu(same_pattern, row) &&
                      factors_->pivot_ratio > std::max(regular, tolerances::kSingularPivot);
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
  factors_->SolveLu(x->data(), 1);
}

void BorderedSolver::SolveAll(const Eigen::MatrixXd& B, Eigen::MatrixXd* x) const {
  x->resize(factors_->matrix.rows(), B.cols());
  x->topRows(B.rows()) = B;
  x->bottomRows(1).setZero();
  factors_->SolveLu(x->data(), x->cols());
}

Eigen::MatrixXd BorderedSolver::NullSpace() const { return factors_->minimum_norm.NullSpace(); }

Eigen::MatrixXd BorderedSolver::LeftNullSpace() const { return factors_->minimum_norm.LeftNullSpace(); }

Eigen::Index BorderedSolver::Nullity() const {
  return factors_->regular ? 0 : factors_->matrix.rows() - factors_->minimum_norm.Rank();
}

int BorderedSolver::DeterminantSign() const { return factors_->regular ? PivotSign() : 0; }

int BorderedSolver::PivotSign() const { return factors_->HasFactors() ? factors_->DeterminantSign() : 0; }

}  // namespace contact_path
