#include "contact_path/linear/symmetric_factors.h"

#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

#include "contact_path/linear/linear_solver_error.h"
#include "contact_path/tolerances.h"

extern "C" {
void dsytrf_(const char* triangle, const int* n, double* a, const int* lda, int* pivots, double* work, const int* lwork,
             int* info);
void dsytrs_(const char* triangle, const int* n, const int* columns, const double* a, const int* lda, const int* pivots,
             double* b, const int* ldb, int* info);
}

namespace contact_path {
namespace {

constexpr int kLargestDense = 150;  // unknowns: up to here dense factors take less time than the analysis of a pattern
constexpr int kBlock = 32;          // columns that LAPACK eliminates at once

// The numbers of MUMPS' manual, which counts from 1.
constexpr int kUseCommWorld = -987654;
constexpr int kInitialise = -1, kTerminate = -2, kAnalyse = 1, kFactorise = 2, kSolve = 3;
constexpr int kNotEnoughWorkspace = -9, kOutOfMemory = -13, kSingular = -10;
constexpr int kMostRelaxed = 8;  // times that the estimate of the workspace is doubled

}  // namespace

struct SymmetricFactors::Dense {
  Eigen::MatrixXd factors;
  std::vector<int> pivots;
  Eigen::VectorXd work;
  Eigen::Index negative = 0;

  bool Factorize(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& scale) {
    const int n = static_cast<int>(matrix.rows());
    factors.setZero(n, n);
    for (Eigen::Index column = 0; column < n; ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it)
        factors(it.row(), column) = scale[it.row()] * it.value() * scale[column];
    pivots.resize(static_cast<std::size_t>(n));
    work.resize(std::max(1, n * kBlock));
    const int size = static_cast<int>(work.size());
    int info = 0;
    dsytrf_("L", &n, factors.data(), &n, pivots.data(), work.data(), &size, &info);
    return info == 0 && CountNegative();
  }

  // Of the blocks of D; false where one of them is next to singular. A block of two has eigenvalues of both signs.
  bool CountNegative() {
    negative = 0;
    double smallest = factors.rows() > 0 ? INFINITY : 1.0, largest = 1.0;
    for (Eigen::Index k = 0; k < factors.rows(); ++k) {
      double size = std::abs(factors(k, k));
      if (pivots[static_cast<std::size_t>(k)] > 0) {
        negative += factors(k, k) < 0.0 ? 1 : 0;
      } else {
        size = std::sqrt(std::abs(factors(k, k) * factors(k + 1, k + 1) - factors(k + 1, k) * factors(k + 1, k)));
        ++negative;
        ++k;
      }
      smallest = std::min(smallest, size);
      largest = std::max(largest, size);
    }
    return smallest > tolerances::kSingularPivot * largest;
  }

  void Solve(Eigen::MatrixXd* columns) const {
    const int n = static_cast<int>(factors.rows()), count = static_cast<int>(columns->cols());
    int info = 0;
    dsytrs_("L", &n, &count, factors.data(), &n, pivots.data(), columns->data(), &n, &info);
  }
};

struct SymmetricFactors::Sparse {
  Sparse() {
    mumps.job = kInitialise;
    mumps.par = 1;
    mumps.sym = 2;  // symmetric and indefinite
    mumps.comm_fortran = kUseCommWorld;
    dmumps_c(&mumps);
    for (const int stream : {1, 2, 3}) Control(stream) = -1;  // none
    Control(4) = 0;                                           // nothing printed
    Control(13) = 1;                                          // all pivots are counted
    Control(24) = 1;                                          // pivots next to zero are told
    mumps.cntl[2] = tolerances::kSingularPivot;               // relative to the matrix
  }
  ~Sparse() {
    mumps.job = kTerminate;
    dmumps_c(&mumps);
  }
  Sparse(const Sparse&) = delete;
  Sparse& operator=(const Sparse&) = delete;

  int& Control(int number) { return mumps.icntl[number - 1]; }
  int Information(int number) const { return mumps.infog[number - 1]; }

  void Call(int job) {
    mumps.job = job;
    dmumps_c(&mumps);
  }

  bool Factorize(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& scale) {
    std::vector<int> in_rows, in_columns;
    values.clear();
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
        if (it.row() < column) continue;
        in_rows.push_back(static_cast<int>(it.row()) + 1);
        in_columns.push_back(static_cast<int>(column) + 1);
        values.push_back(scale[it.row()] * it.value() * scale[column]);
      }
    const bool same = in_rows == rows && in_columns == columns;
    rows.swap(in_rows);
    columns.swap(in_columns);
    mumps.n = static_cast<int>(matrix.rows());
    mumps.nnz = static_cast<MUMPS_INT8>(values.size());
    mumps.irn = rows.data();
    mumps.jcn = columns.data();
    mumps.a = values.data();
    if (!same) Call(kAnalyse);
    for (int relaxed = 0; Information(1) >= 0; ++relaxed) {
      Call(kFactorise);
      if (Information(1) != kNotEnoughWorkspace || relaxed == kMostRelaxed) break;
      Control(14) *= 2;
      mumps.infog[0] = 0;
    }
    if (Information(1) == kOutOfMemory) throw std::bad_alloc();
    if (Information(1) < 0 && Information(1) != kSingular) throw LinearSolverError("MUMPS", Information(1));
    return Information(1) != kSingular && Information(28) == 0;
  }

  void Solve(Eigen::MatrixXd* right) {
    mumps.rhs = right->data();
    mumps.nrhs = static_cast<int>(right->cols());
    mumps.lrhs = static_cast<int>(right->rows());
    Call(kSolve);
  }

  DMUMPS_STRUC_C mumps = {};
  std::vector<int> rows, columns;
  std::vector<double> values;
};

SymmetricFactors::SymmetricFactors() = default;
SymmetricFactors::~SymmetricFactors() = default;

bool SymmetricFactors::Factorize(const Eigen::SparseMatrix<double>& matrix) {
  scale_.setZero(matrix.rows());
  for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it)
      scale_[column] = std::max(scale_[column], std::abs(it.value()));
  if (!(scale_.array() > 0.0).all() || !scale_.allFinite()) return false;
  scale_ = scale_.cwiseSqrt().cwiseInverse();
  is_dense_ = matrix.rows() <= kLargestDense;
  if (is_dense_) {
    if (!dense_) dense_ = std::make_unique<Dense>();
    return dense_->Factorize(matrix, scale_);
  }
  if (!sparse_) sparse_ = std::make_unique<Sparse>();
  return sparse_->Factorize(matrix, scale_);
}

Eigen::Index SymmetricFactors::NegativeEigenvalues() const {
  return is_dense_ ? dense_->negative : sparse_->Information(12);
}

void SymmetricFactors::Solve(Eigen::MatrixXd* columns) const {
  if (columns->size() == 0) return;
  *columns = scale_.asDiagonal() * *columns;
  if (is_dense_)
    dense_->Solve(columns);
  else
    sparse_->Solve(columns);
  *columns = scale_.asDiagonal() * *columns;
}

}  // namespace contact_path
