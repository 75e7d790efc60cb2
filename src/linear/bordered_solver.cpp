#include "contact_path/linear/bordered_solver.h"

#include <Eigen/QR>
#include <algorithm>

#include "contact_path/linear/linearised_equations.h"
#include "contact_path/linear/minimum_norm.h"
#include "linear/klu_factors.h"
#include "linear/large_factors.h"

namespace contact_path {

struct BorderedSolver::Factors {
  // Puts `matrix` together; whether its pattern is the pattern of the last time.
  bool Assemble(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row) {
    const Eigen::Index rows = transposed.rows(), columns = transposed.cols();
    const Eigen::Index in_row = (row.array() != 0.0).count();
    // A row of many entries has all of them in the pattern, so that one that happens to be zero does not change it.
    const bool full = 2 * in_row > rows;
    const Eigen::Index before = transposed.nonZeros(), all = before + (full ? rows : in_row);
    bool same = matrix.rows() == rows && matrix.cols() == columns + 1 && matrix.nonZeros() == all;
    if (!same) {
      matrix.resize(rows, columns + 1);
      matrix.resizeNonZeros(all);
    }
    same = same &&
           std::equal(transposed.outerIndexPtr(), transposed.outerIndexPtr() + columns + 1, matrix.outerIndexPtr()) &&
           std::equal(transposed.innerIndexPtr(), transposed.innerIndexPtr() + before, matrix.innerIndexPtr());
    std::copy_n(transposed.valuePtr(), before, matrix.valuePtr());
    if (!same) {
      std::copy_n(transposed.outerIndexPtr(), columns + 1, matrix.outerIndexPtr());
      std::copy_n(transposed.innerIndexPtr(), before, matrix.innerIndexPtr());
    }
    Eigen::Index end = before;
    for (Eigen::Index i = 0; i < rows; ++i) {
      if (!full && row[i] == 0.0) continue;
      same = same && matrix.innerIndexPtr()[end] == static_cast<int>(i);
      matrix.innerIndexPtr()[end] = static_cast<int>(i);
      matrix.valuePtr()[end++] = row[i];
    }
    matrix.outerIndexPtr()[columns + 1] = static_cast<int>(all);
    return same;
  }

  // LU of [J; row], which is square and finite: of its pivots, smallest over largest; 0 if it is singular.
  double FactorizeLu(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row, const Frame* frame) {
    is_large = transposed.rows() >= kLargeSystem;
    if (is_large) {
      klu.Free();
      return large.Factorize(transposed, row, frame) ? large.PivotRatio() : 0.0;
    }
    large.Free();
    const bool same_pattern = Assemble(transposed, row);
    return klu.Factorize(&matrix, same_pattern) ? klu.PivotRatio() : 0.0;
  }

  // In place: M x = (b, value) for each column, without what lies along the null vectors.
  void SolveLu(double* x, Eigen::Index columns) {
    if (is_large)
      large.Solve(x, columns);
    else
      klu.SolveTransposed(x, static_cast<int>(columns));
    Eigen::Map<Eigen::MatrixXd> solutions(x, unknowns, columns);
    if (null_space.cols() > 0) solutions -= null_space * (null_space.transpose() * solutions);
  }

  // Needs the factors.
  int DeterminantSign() const { return is_large ? large.DeterminantSign() : klu.DeterminantSign(); }

  Eigen::SparseMatrix<double> matrix;  // M', unknowns x rows: of small systems
  Eigen::Index unknowns = 0;
  bool is_large = false;
  bool regular = false;        // LU solves
  Eigen::MatrixXd null_space;  // of M, orthonormal, where it is held by springs: LU is of M with them
  Eigen::SparseMatrix<double> held;
  KluFactors klu;
  LargeFactors large;
  MinimumNormSolver minimum_norm;  // where not regular
};

BorderedSolver::BorderedSolver() : factors_(std::make_unique<Factors>()) {}
BorderedSolver::~BorderedSolver() = default;

bool BorderedSolver::Factorize(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                               const Frame* frame) {
  if (FactorizeRegular(transposed, row, tolerances::kSingularPivot, frame)) return true;
  if (!transposed.coeffs().allFinite() || !row.allFinite()) return false;
  factors_->Assemble(transposed, row);
  return factors_->minimum_norm.Factorize(factors_->matrix);
}

bool BorderedSolver::FactorizeRegular(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                                      double regular, const Frame* frame) {
  const bool possible =
      transposed.rows() == transposed.cols() + 1 && transposed.coeffs().allFinite() && row.allFinite();
  if (!possible) {
    factors_->klu.Free();
    factors_->large.Free();
  }
  factors_->unknowns = transposed.rows();
  factors_->null_space.resize(factors_->unknowns, 0);
  factors_->regular =
      possible && factors_->FactorizeLu(transposed, row, frame) > std::max(regular, tolerances::kSingularPivot);
  return factors_->regular;
}

bool BorderedSolver::FactorizeHeld(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                                   const Eigen::MatrixXd& modes, const Frame* frame, Eigen::VectorXd* tangent) {
  factors_->held = transposed;
  // One unknown for each mode, so that none of their combinations moves without moving one of these.
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> places(modes.transpose());
  const double rounding =
      tolerances::kDependentColumn *
      Eigen::Map<const Eigen::VectorXd>(transposed.valuePtr(), transposed.nonZeros()).lpNorm<Eigen::Infinity>();
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    const Eigen::Index place = places.colsPermutation().indices()[k];
    double stiffness = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, place); it; ++it)
      stiffness = std::max(stiffness, std::abs(it.value()));
    factors_->held.coeffRef(place, place) += stiffness > rounding ? stiffness : 1.0;
  }
  if (!FactorizeRegular(factors_->held, row, tolerances::kSingularPivot, frame)) return false;
  *tangent = Solve(Eigen::VectorXd::Zero(transposed.cols()), 1.0);
  LinearisedEquations(factors_->held).Refine(*this, tangent);
  if (!LinearisedEquations(transposed).Hold(*tangent, tolerances::kDependentColumn)) {
    tangent->resize(0);
    return true;
  }
  const Eigen::MatrixXd null_vectors = modes - *tangent * (row.transpose() * modes);
  factors_->null_space = Eigen::HouseholderQR<Eigen::MatrixXd>(null_vectors).householderQ() *
                         Eigen::MatrixXd::Identity(modes.rows(), modes.cols());
  return factors_->null_space.allFinite();
}

bool BorderedSolver::ReplaceRow(const Eigen::VectorXd& row) {
  return factors_->regular && factors_->is_large && factors_->large.ReplaceRow(row);
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
  x->resize(factors_->unknowns, B.cols());
  x->topRows(B.rows()) = B;
  x->bottomRows(1).setZero();
  factors_->SolveLu(x->data(), x->cols());
}

bool BorderedSolver::HasLu() const { return factors_->regular; }

Eigen::VectorXd BorderedSolver::SolveTransposed(const Eigen::VectorXd& c) const {
  Eigen::VectorXd y = c;
  if (factors_->is_large)
    factors_->large.SolveTransposed(y.data());
  else
    factors_->klu.Solve(y.data());
  return y;
}

Eigen::MatrixXd BorderedSolver::NullSpace() const {
  return factors_->regular ? factors_->null_space : factors_->minimum_norm.NullSpace();
}

Eigen::MatrixXd BorderedSolver::LeftNullSpace() const { return factors_->minimum_norm.LeftNullSpace(); }

Eigen::Index BorderedSolver::Nullity() const {
  return factors_->regular ? factors_->null_space.cols() : factors_->unknowns - factors_->minimum_norm.Rank();
}

std::optional<Eigen::Index> BorderedSolver::NegativeEigenvalues(Eigen::Index motions) const {
  if (!factors_->regular || !factors_->is_large || Nullity() > 0) return std::nullopt;
  return factors_->large.NegativeEigenvalues(motions);
}

int BorderedSolver::DeterminantSign() const {
  return factors_->regular && Nullity() == 0 ? factors_->DeterminantSign() : 0;
}

}  // namespace contact_path
