#include "contact_path/linear/symmetric_factors.h"

#include <dmumps_c.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "contact_path/linear/large_system.h"
#include "contact_path/linear/linear_solver_error.h"
#include "contact_path/tolerances.h"
#include "linear/low_rank_update.h"

namespace contact_path {
namespace {

// Of scaled matrices, whose entries are 1 at most.
constexpr double kMostGrowth = 1e6;    // of |L| |D| |L'|: beyond, rounding may hide a small eigenvalue
constexpr double kStiffened = 4.0;     // more than a negative stiffness
constexpr double kLarge = 0.5;         // an entry of a constraint
constexpr Eigen::Index kDense = 200;   // unknowns and constraints, of which eigenvalues are found as soon as by MUMPS
constexpr double kCompliance = -1e-9;  // of redundant constraints: entry of their diagonal

// The numbers of MUMPS' manual, which counts from 1.
enum Communicator : int { kUseCommWorld = -987654 };
enum Job : int { kInitialise = -1, kTerminate = -2, kAnalyse = 1, kFactorise = 2, kSolve = 3 };
enum Outcome : int { kNotEnoughWorkspace = -9, kSingular = -10, kOutOfMemory = -13 };
constexpr int kMostRelaxed = 8;  // times that the estimate of the workspace is doubled

bool HaveSamePattern(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b) {
  const auto same = [](const int* of_a, const int* of_b, Eigen::Index size) {
    return std::equal(of_a, of_a + size, of_b);
  };
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         same(a.outerIndexPtr(), b.outerIndexPtr(), a.cols() + 1) &&
         same(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros());
}

// Constraints, at the end with zeros or kCompliance on their diagonal, each right behind the first unknown that is
// among its largest: the two pivots are one of size two, and what is left is the matrix on the motions that the
// constraint admits.
struct UnknownsWithConstraints {
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

  void operator()(const Eigen::SparseMatrix<double>& matrix, Permutation& order) const {
    Eigen::Index unknowns = matrix.rows();
    const auto is_constraint = [](double diagonal) { return diagonal == 0.0 || diagonal == kCompliance; };
    while (unknowns > 0 && is_constraint(matrix.coeff(unknowns - 1, unknowns - 1))) --unknowns;
    Permutation of_unknowns;
    Eigen::AMDOrdering<int>()(Eigen::SparseMatrix<double>(matrix.topLeftCorner(unknowns, unknowns)), of_unknowns);
    std::vector<bool> placed(static_cast<std::size_t>(matrix.rows()));
    order.resize(matrix.rows());
    Eigen::Index next = 0;
    const auto place = [&](Eigen::Index k) {
      placed[static_cast<std::size_t>(k)] = true;
      order.indices()[next++] = static_cast<int>(k);
    };
    for (Eigen::Index k = 0; k < unknowns; ++k) {
      const Eigen::Index unknown = of_unknowns.indices()[k];
      place(unknown);
      Eigen::Index with = -1;
      double largest = kLarge;
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, unknown); it; ++it) {
        if (it.row() < unknowns || placed[static_cast<std::size_t>(it.row())] || std::abs(it.value()) < largest)
          continue;
        largest = std::abs(it.value());
        with = it.row();
      }
      if (with >= 0) place(with);
    }
    for (Eigen::Index k = unknowns; k < matrix.rows(); ++k)
      if (!placed[static_cast<std::size_t>(k)]) place(k);
  }
};

}  // namespace

// No call of the BLAS. Pivots are not looked for, as hardly any is small: the matrix is definite on the motions that
// the constraints admit, up to a few directions.
struct SymmetricFactors::Small {
  using Matrix = Eigen::SparseMatrix<double>;

  // False where |L| |D| |L'| says that a pivot was small beside what it divides.
  bool Factorize(const Matrix& scaled, Eigen::Index constraints) {
    dense.reset();
    // K + kStiffened C' C in place of K: the same solutions, and no pivot of an unknown that comes with its constraint
    // is small. Not of constraints that give way by themselves: they admit other motions.
    const Eigen::Index unknowns = scaled.rows() - constraints;
    columns = scaled.rightCols(constraints);
    columns.prune([&](Eigen::Index row, Eigen::Index constraint, double) {
      const double own = scaled.coeff(unknowns + constraint, unknowns + constraint);
      return row < unknowns && (own == 0.0 || own == kCompliance);
    });
    Matrix stiffened = scaled;
    if (constraints > 0) stiffened += Matrix(kStiffened * columns * Matrix(columns.transpose()));
    stiffened.makeCompressed();
    const bool analysed = HaveSamePattern(pattern, stiffened);
    pattern.swap(stiffened);
    factors.setShift(tolerances::kLastDigits);  // so that a pivot which is zero is told by the growth
    for (const bool anew : {false, true}) {     // which entries of the constraints are large may have changed
      if (anew && !analysed) break;
      if (anew || !analysed) factors.analyzePattern(pattern);
      factors.factorize(pattern);
      if (factors.info() == Eigen::Success && Growth() < kMostGrowth) return Count(factors.vectorD());
    }
    if (scaled.rows() > kDense) return false;
    const Eigen::MatrixXd all = scaled;
    dense.emplace(all);
    return Count(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(all, Eigen::EigenvaluesOnly).eigenvalues());
  }

  bool Count(const Eigen::VectorXd& pivots) {
    negative = (pivots.array() < 0.0).count();
    regular = (pivots.array().abs() > tolerances::kSingularPivot).all();
    return true;
  }

  // The largest entry of |L| |D| |L'|, which is on its diagonal.
  double Growth() const {
    const Matrix& lower = factors.matrixL().nestedExpression();  // without its diagonal
    const Eigen::VectorXd pivots = factors.vectorD().cwiseAbs();
    Eigen::VectorXd growth = pivots;
    for (Eigen::Index k = 0; k < lower.cols(); ++k)
      for (Matrix::InnerIterator it(lower, k); it; ++it) growth[it.row()] += it.value() * it.value() * pivots[k];
    return growth.size() > 0 ? growth.maxCoeff() : 0.0;
  }

  void Solve(Eigen::MatrixXd* right) const {
    if (dense) {
      *right = dense->solve(*right);
      return;
    }
    if (columns.cols() > 0) *right += kStiffened * columns * right->bottomRows(columns.cols());
    *right = factors.solve(*right);
  }

  Matrix pattern;  // with the values of the last time
  Matrix columns;  // of the constraints
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, UnknownsWithConstraints> factors;
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> dense;  // where a small pivot takes digits of the factors
  Eigen::Index negative = 0;
  bool regular = false;
};

// By MUMPS, with the pivots of Bunch and Kaufman.
struct SymmetricFactors::Large {
  Large() {
    mumps.par = 1;
    mumps.sym = 2;  // symmetric and indefinite
    mumps.comm_fortran = kUseCommWorld;
    Call(kInitialise);
    for (const int stream : {1, 2, 3}) Control(stream) = -1;  // none
    Control(4) = 0;                                           // nothing printed
    Control(13) = 1;                                          // all pivots are counted
    Control(24) = 1;                                          // pivots next to zero are told
    mumps.cntl[2] = tolerances::kSingularPivot;               // relative to the matrix
  }
  ~Large() { Call(kTerminate); }
  Large(const Large&) = delete;
  Large& operator=(const Large&) = delete;

  int& Control(int number) { return mumps.icntl[number - 1]; }
  int Information(int number) const { return mumps.infog[number - 1]; }

  void Call(Job job) {
    mumps.job = job;
    dmumps_c(&mumps);
  }

  bool Factorize(const Eigen::SparseMatrix<double>& matrix) {
    std::vector<int> in_rows, in_columns;
    values.clear();
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
        if (it.row() < column) continue;
        in_rows.push_back(static_cast<int>(it.row()) + 1);
        in_columns.push_back(static_cast<int>(column) + 1);
        values.push_back(it.value());
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
    negative = Information(12);
    update.Clear();
    return Information(1) != kSingular && Information(28) == 0;
  }

  // Of a matrix of the same pattern that differs from the last one, `last`, in few rows and columns: last + E d E', E
  // the columns of 1 of these rows. With G = E' last^-1 E, [last E; E' -d^-1] has its negative eigenvalues and those of
  // -d^-1, or those of last and of -d^-1 - G (Haynsworth), here with d = Q diag(q) Q' between roots of |q|.
  bool Update(const Eigen::SparseMatrix<double>& matrix) {
    if (!HaveSamePattern(last, matrix)) return false;
    std::vector<int> changed;
    for (int k = 0; k < static_cast<int>(matrix.cols()); ++k) {
      if (std::equal(matrix.valuePtr() + matrix.outerIndexPtr()[k], matrix.valuePtr() + matrix.outerIndexPtr()[k + 1],
                     last.valuePtr() + matrix.outerIndexPtr()[k]))
        continue;
      if (changed.size() == kMostChanged) return false;
      changed.push_back(k);
    }
    negative = Information(12);
    update.Clear();
    if (changed.empty()) return true;
    const auto count = static_cast<Eigen::Index>(changed.size());
    Eigen::MatrixXd difference(count, count), moved = Eigen::MatrixXd::Zero(matrix.rows(), count), G(count, count);
    LowRankUpdate::Differences of_rows(count, matrix.rows());
    for (Eigen::Index j = 0; j < count; ++j) {
      const int column = changed[static_cast<std::size_t>(j)];
      moved(column, j) = 1.0;
      for (Eigen::Index i = 0; i < count; ++i) {
        const int row = changed[static_cast<std::size_t>(i)];
        of_rows.insert(i, column) = difference(i, j) = matrix.coeff(row, column) - last.coeff(row, column);
      }
    }
    SolveLast(&moved);
    for (Eigen::Index i = 0; i < count; ++i) G.row(i) = moved.row(changed[static_cast<std::size_t>(i)]);
    if (!update.Set(std::move(moved), of_rows)) return false;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(difference);
    const Eigen::MatrixXd roots = of.eigenvectors() * of.eigenvalues().cwiseAbs().cwiseSqrt().asDiagonal();
    Eigen::MatrixXd condensed = -roots.transpose() * G * roots;
    for (Eigen::Index j = 0; j < count; ++j) condensed(j, j) -= of.eigenvalues()[j] < 0.0 ? -1.0 : 1.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> with(condensed, Eigen::EigenvaluesOnly);
    negative += (with.eigenvalues().array() < 0.0).count() - (of.eigenvalues().array() >= 0.0).count();
    return true;
  }

  void Solve(Eigen::MatrixXd* right) {
    SolveLast(right);
    update.Correct(*right);
  }

  void SolveLast(Eigen::MatrixXd* right) {
    *right = scale.asDiagonal() * *right;
    mumps.rhs = right->data();
    mumps.nrhs = static_cast<int>(right->cols());
    mumps.lrhs = static_cast<int>(right->rows());
    Call(kSolve);
    *right = scale.asDiagonal() * *right;
  }

  DMUMPS_STRUC_C mumps = {};
  Eigen::Index negative = 0;
  Eigen::SparseMatrix<double> last;  // without its scale; empty: not to be updated
  Eigen::VectorXd scale;
  LowRankUpdate update;  // of last
  std::vector<int> rows, columns;
  std::vector<double> values;
};

SymmetricFactors::SymmetricFactors() = default;
SymmetricFactors::~SymmetricFactors() = default;

bool SymmetricFactors::Factorize(const Eigen::SparseMatrix<double>& matrix, Eigen::Index constraints, bool redundant) {
  const Eigen::Index unknowns = matrix.rows() - constraints;
  scale_.setZero(matrix.rows());
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    const bool is_constraint = column >= unknowns;
    double largest = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it)
      largest = std::max(largest, std::abs(it.value()) * (is_constraint ? scale_[it.row()] : 1.0));
    if (const double own = std::abs(matrix.coeff(column, column)); is_constraint && largest == 0.0 && own != 0.0) {
      scale_[column] = 1.0 / std::sqrt(own);  // of a force that acts on nothing
      continue;
    }
    scale_[column] =
        redundant && is_constraint && largest == 0.0 ? 1.0 : 1.0 / (is_constraint ? largest : std::sqrt(largest));
  }
  const bool updates = matrix.rows() >= kLargeSystem && !redundant;
  if (updates && large_ && large_->Update(matrix)) return is_large_ = true;
  if (!scale_.allFinite() || !(scale_.array() > 0.0).all()) return false;
  Eigen::SparseMatrix<double> scaled = scale_.asDiagonal() * matrix * scale_.asDiagonal();
  for (Eigen::Index k = unknowns; redundant && k < matrix.rows(); ++k)
    if (double& own = scaled.coeffRef(k, k); own == 0.0) own = kCompliance;
  scaled.makeCompressed();
  if (!small_) small_ = std::make_unique<Small>();
  is_large_ = matrix.rows() >= kLargeSystem || !small_->Factorize(scaled, constraints);
  if (!is_large_) return small_->regular;
  if (!large_) large_ = std::make_unique<Large>();
  large_->last.resize(0, 0);
  large_->scale = scale_;
  const bool regular = large_->Factorize(scaled);
  if (regular && updates) large_->last = matrix;
  return regular;
}

Eigen::Index SymmetricFactors::NegativeEigenvalues() const { return is_large_ ? large_->negative : small_->negative; }

void SymmetricFactors::Solve(Eigen::MatrixXd* columns) const {
  if (columns->size() == 0) return;
  if (is_large_) {
    large_->Solve(columns);
    return;
  }
  *columns = scale_.asDiagonal() * *columns;
  small_->Solve(columns);
  *columns = scale_.asDiagonal() * *columns;
}

}  // namespace contact_path
