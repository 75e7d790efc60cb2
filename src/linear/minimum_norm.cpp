#include "contact_path/linear/minimum_norm.h"

#include <Eigen/SPQRSupport>
#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "contact_path/linear/linear_solver_error.h"

namespace contact_path {
namespace {

// A' E = Q R with R upper triangular in its first rank columns, A' unknowns x equations.
struct RankRevealingQr {
  virtual ~RankRevealingQr() = default;
  // Q v. Throws std::bad_alloc or LinearSolverError.
  virtual Eigen::VectorXd Multiply(const Eigen::VectorXd& v) const = 0;

  Eigen::Index rank = 0;
  Eigen::SparseMatrix<double> R;
  // Of vectors of the equations: (E w) has w in the order of A.
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Eigen::Index> E;

 protected:
  template <typename Qr>
  void TakeFrom(const Qr& qr) {
    rank = qr.rank();
    R = qr.matrixR();
    E.indices() = qr.colsPermutation().indices().template cast<Eigen::Index>();
  }
};

// Of small matrices: no call of the BLAS, so that the result does not depend on the processor.
class SmallQr : public RankRevealingQr {
 public:
  SmallQr(const Eigen::SparseMatrix<double>& matrix, double rank_tolerance) {
    qr_.setPivotThreshold(rank_tolerance);
    qr_.compute(matrix);
    if (qr_.info() != Eigen::Success) throw LinearSolverError("Eigen::SparseQR", static_cast<int>(qr_.info()));
    TakeFrom(qr_);
  }
  Eigen::VectorXd Multiply(const Eigen::VectorXd& v) const override { return qr_.matrixQ() * v; }

 private:
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr_;
};

using Spqr = Eigen::SPQR<Eigen::SparseMatrix<double>>;

// Of large matrices, by SuiteSparseQR. Eigen takes lack of memory for a singular matrix, and does not look whether a
// product was computed.
class LargeQr : public RankRevealingQr, private Spqr {
 public:
  // Throws std::bad_alloc or LinearSolverError.
  LargeQr(const Eigen::SparseMatrix<double>& matrix, double rank_tolerance) {
    cholmodCommon()->print = 0;  // standard output is not its own
    setPivotThreshold(rank_tolerance);
    compute(matrix);
    if (m_cR == nullptr) ThrowStatus();
    TakeFrom<Spqr>(*this);
  }
  Eigen::VectorXd Multiply(const Eigen::VectorXd& v) const override {
    cholmod_common* const common = cholmodCommon();
    Eigen::VectorXd copy = v;
    cholmod_dense dense = Eigen::viewAsCholmod(copy);
    const auto free = [common](cholmod_dense* product) { cholmod_l_free_dense(&product, common); };
    const std::unique_ptr<cholmod_dense, decltype(free)> product(
        SuiteSparseQR_qmult<double>(SPQR_QX, m_H, m_HTau, m_HPinv, &dense, common), free);
    if (product == nullptr) ThrowStatus();
    return Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(product->x),
                                             static_cast<Eigen::Index>(product->nrow));
  }

 private:
  [[noreturn]] void ThrowStatus() const {
    const int status = cholmodCommon()->status;
    if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
    throw LinearSolverError("SuiteSparseQR", status);
  }
};

// For each equation the largest entry, in any equation, of the unknowns that it has.
Eigen::VectorXd NormsAround(const Eigen::SparseMatrix<double>& transposed) {
  Eigen::VectorXd of_unknown = Eigen::VectorXd::Zero(transposed.rows());
  Eigen::VectorXd norms = Eigen::VectorXd::Zero(transposed.cols());
  for (Eigen::Index column = 0; column < transposed.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, column); it; ++it)
      of_unknown[it.row()] = std::max(of_unknown[it.row()], std::abs(it.value()));
  for (Eigen::Index column = 0; column < transposed.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, column); it; ++it)
      norms[column] = std::max(norms[column], of_unknown[it.row()]);
  return norms;
}

// The norms by which Factorize() divides the equations.
Eigen::VectorXd NormsOf(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance) {
  const bool singular = rank_tolerance > tolerances::kDependentColumn;
  const Eigen::VectorXd around = singular ? NormsAround(transposed) : Eigen::VectorXd::Zero(transposed.cols());
  Eigen::VectorXd norms = tolerances::kFadingEquation * around;
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
    const double norm = std::max(transposed.col(column).norm(), norms[column]);
    norms[column] = norm == 0.0 ? 1.0 : norm;
  }
  return norms;
}

}  // namespace

struct MinimumNormSolver::Factors {
  std::unique_ptr<const RankRevealingQr> qr;  // a new one each time: after a failure, Eigen frees what it has freed
  Eigen::Index unknowns = 0;
  Eigen::VectorXd scale;  // of the equations
};

MinimumNormSolver::MinimumNormSolver() : factors_(std::make_unique<Factors>()) {}
MinimumNormSolver::~MinimumNormSolver() = default;

bool MinimumNormSolver::Factorize(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance) {
  const Eigen::VectorXd norms = NormsOf(transposed, rank_tolerance);
  if (!norms.allFinite()) return false;
  Eigen::SparseMatrix<double> scaled = transposed;
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) scaled.col(column) /= norms[column];
  factors_->scale = norms.cwiseInverse();
  factors_->unknowns = transposed.rows();
  if (transposed.rows() < kLargeSystem)
    factors_->qr = std::make_unique<SmallQr>(scaled, rank_tolerance);
  else
    factors_->qr = std::make_unique<LargeQr>(scaled, rank_tolerance);
  return true;
}

Eigen::Index MinimumNormSolver::Rank() const { return factors_->qr->rank; }

Eigen::VectorXd MinimumNormSolver::Solve(const Eigen::VectorXd& b) const {
  // A' E = Q R, so A x = b is R' (Q' x) = E' b: forward substitution, and zero in the rest of Q' x for the shortest x.
  const RankRevealingQr& qr = *factors_->qr;
  const Eigen::VectorXd permuted = qr.E.transpose() * factors_->scale.cwiseProduct(b);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(factors_->unknowns);
  for (Eigen::Index j = 0; j < qr.rank; ++j) {
    double sum = permuted[j], diagonal = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(qr.R, j); it; ++it) {
      if (it.row() < j) sum -= it.value() * y[it.row()];
      if (it.row() == j) diagonal = it.value();
    }
    y[j] = sum / diagonal;
  }
  return qr.Multiply(y);
}

Eigen::MatrixXd MinimumNormSolver::NullSpace() const {
  const Eigen::Index size = factors_->unknowns - Rank();
  Eigen::MatrixXd basis(factors_->unknowns, size);
  for (Eigen::Index k = 0; k < size; ++k) basis.col(k) = NullVector(k);
  return basis;
}

Eigen::VectorXd MinimumNormSolver::NullVector(Eigen::Index column) const {
  return factors_->qr->Multiply(Eigen::VectorXd::Unit(factors_->unknowns, Rank() + column));
}

Eigen::MatrixXd MinimumNormSolver::LeftNullSpace() const {
  // A' E = Q [R1 R2]: R1 w + R2 v = 0 for each unit vector v, by backward substitution.
  const RankRevealingQr& qr = *factors_->qr;
  const Eigen::Index equations = qr.R.cols(), rank = qr.rank;
  Eigen::MatrixXd basis(equations, equations - rank);
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(equations);
    w[rank + k] = 1.0;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rank);
    for (Eigen::SparseMatrix<double>::InnerIterator it(qr.R, rank + k); it; ++it)
      if (it.row() < rank) right[it.row()] -= it.value();
    for (Eigen::Index j = rank; j-- > 0;) {
      double diagonal = 0.0;
      for (Eigen::SparseMatrix<double>::InnerIterator it(qr.R, j); it; ++it)
        if (it.row() == j) diagonal = it.value();
      w[j] = right[j] / diagonal;
      for (Eigen::SparseMatrix<double>::InnerIterator it(qr.R, j); it; ++it)
        if (it.row() < j) right[it.row()] -= it.value() * w[j];
    }
    basis.col(k) = factors_->scale.cwiseProduct(qr.E * w);
  }
  return basis;
}

}  // namespace contact_path
