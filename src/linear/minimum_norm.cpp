#include "contact_path/linear/minimum_norm.h"

#include <Eigen/SPQRSupport>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "contact_path/linear/linear_solver_error.h"

namespace contact_path {
namespace {

using Spqr = Eigen::SPQR<Eigen::SparseMatrix<double>>;

// Eigen takes lack of memory for a singular matrix, and does not look whether a product was computed.
class SparseQr : public Spqr {
 public:
  SparseQr() { cholmodCommon()->print = 0; }  // standard output is not its own

  // Throws std::bad_alloc or LinearSolverError.
  void Factorize(const Eigen::SparseMatrix<double>& matrix) {
    compute(matrix);
    if (m_cR != nullptr) return;
    RequireMemory();
    throw LinearSolverError("SuiteSparseQR", cholmodCommon()->status);
  }

  // Q v. Throws std::bad_alloc or LinearSolverError.
  Eigen::VectorXd Multiply(Eigen::VectorXd v) const {
    cholmod_common* const common = cholmodCommon();
    cholmod_dense dense = Eigen::viewAsCholmod(v);
    const auto free = [common](cholmod_dense* product) { cholmod_l_free_dense(&product, common); };
    const std::unique_ptr<cholmod_dense, decltype(free)> product(
        SuiteSparseQR_qmult<double>(SPQR_QX, m_H, m_HTau, m_HPinv, &dense, common), free);
    if (product == nullptr) {
      RequireMemory();
      throw LinearSolverError("SuiteSparseQR", common->status);
    }
    return Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(product->x),
                                             static_cast<Eigen::Index>(product->nrow));
  }

 private:
  void RequireMemory() const {
    const int status = cholmodCommon()->status;
    if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
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
Eigen::VectorXd NormsOf(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance,
                        const Eigen::VectorXd& least_norms) {
  const bool singular = rank_tolerance > tolerances::kDependentColumn;
  const Eigen::VectorXd around = singular ? NormsAround(transposed) : Eigen::VectorXd::Zero(transposed.cols());
  Eigen::VectorXd norms = tolerances::kFadingEquation * around;
  if (least_norms.size() > 0) norms = norms.cwiseMax(least_norms);
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
    const double norm = std::max(transposed.col(column).norm(), norms[column]);
    norms[column] = norm == 0.0 ? 1.0 : norm;
  }
  return norms;
}

}  // namespace

struct MinimumNormSolver::Factors {
  std::unique_ptr<SparseQr> qr;  // a new one each time: after a failure, Eigen frees what it has freed
  Spqr::MatrixType r;
  Eigen::Index rank = 0;
  Eigen::Index unknowns = 0;
  Eigen::SparseMatrix<double> scaled;
  Eigen::VectorXd scale;  // of the equations
};

MinimumNormSolver::MinimumNormSolver() : factors_(std::make_unique<Factors>()) {}
MinimumNormSolver::~MinimumNormSolver() = default;

bool MinimumNormSolver::Factorize(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance,
                                  const Eigen::VectorXd& least_norms) {
  const Eigen::VectorXd norms = NormsOf(transposed, rank_tolerance, least_norms);
  if (!norms.allFinite()) return false;
  factors_->scaled = transposed;
  factors_->scale = norms.cwiseInverse();
  for (Eigen::Index column = 0; column < transposed.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(factors_->scaled, column); it; ++it)
      it.valueRef() /= norms[column];
  factors_->qr = std::make_unique<SparseQr>();
  factors_->qr->setPivotThreshold(rank_tolerance);
  factors_->qr->Factorize(factors_->scaled);
  factors_->rank = factors_->qr->rank();
  factors_->unknowns = transposed.rows();
  factors_->r = factors_->qr->matrixR();
  return true;
}

Eigen::Index MinimumNormSolver::Rank() const { return factors_->rank; }

Eigen::VectorXd MinimumNormSolver::Solve(const Eigen::VectorXd& b) const {
  // A' E = Q R, so A x = b is R' (Q' x) = E' b: forward substitution, and zero in the rest of Q' x for the shortest x.
  const Eigen::VectorXd permuted = factors_->qr->colsPermutation().transpose() * factors_->scale.cwiseProduct(b);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(factors_->unknowns);
  for (Eigen::Index j = 0; j < factors_->rank; ++j) {
    double sum = permuted[j], diagonal = 0.0;
    for (Spqr::MatrixType::InnerIterator it(factors_->r, j); it; ++it) {
      if (it.row() < j) sum -= it.value() * y[it.row()];
      if (it.row() == j) diagonal = it.value();
    }
    y[j] = sum / diagonal;
  }
  return factors_->qr->Multiply(y);
}

Eigen::MatrixXd MinimumNormSolver::NullSpace() const {
  const Eigen::Index size = factors_->unknowns - factors_->rank;
  Eigen::MatrixXd basis(factors_->unknowns, size);
  for (Eigen::Index k = 0; k < size; ++k) basis.col(k) = NullVector(k);
  return basis;
}

Eigen::VectorXd MinimumNormSolver::NullVector(Eigen::Index column) const {
  return factors_->qr->Multiply(Eigen::VectorXd::Unit(factors_->unknowns, factors_->rank + column));
}

Eigen::MatrixXd MinimumNormSolver::LeftNullSpace() const {
  // A' E = Q [R1 R2]: R1 w + R2 v = 0 for each unit vector v, by backward substitution.
  const Eigen::Index equations = factors_->r.cols(), rank = factors_->rank;
  Eigen::MatrixXd basis(equations, equations - rank);
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(equations);
    w[rank + k] = 1.0;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rank);
    for (Spqr::MatrixType::InnerIterator it(factors_->r, rank + k); it; ++it)
      if (it.row() < rank) right[it.row()] -= it.value();
    for (Eigen::Index j = rank; j-- > 0;) {
      double diagonal = 0.0;
      for (Spqr::MatrixType::InnerIterator it(factors_->r, j); it; ++it)
        if (it.row() == j) diagonal = it.value();
      w[j] = right[j] / diagonal;
      for (Spqr::MatrixType::InnerIterator it(factors_->r, j); it; ++it)
        if (it.row() < j) right[it.row()] -= it.value() * w[j];
    }
    basis.col(k) = factors_->scale.cwiseProduct(factors_->qr->colsPermutation() * w);
  }
  return basis;
}

}  // namespace contact_path
