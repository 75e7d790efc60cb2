#include "contact_path/linear/minimum_norm.h"

#include <Eigen/SPQRSupport>
#include <cmath>

namespace contact_path {

struct MinimumNormSolver::Factors {
  Eigen::SPQR<Eigen::SparseMatrix<double>> qr;
  Eigen::SPQR<Eigen::SparseMatrix<double>>::MatrixType r;
  Eigen::Index rank = 0;
  Eigen::Index unknowns = 0;
  Eigen::SparseMatrix<double> scaled;
  Eigen::VectorXd scale;  // of the equations
};

MinimumNormSolver::MinimumNormSolver() : factors_(std::make_unique<Factors>()) {}
MinimumNormSolver::~MinimumNormSolver() = default;

bool MinimumNormSolver::Factorize(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance) {
  // Equations of unit norm: so that what is soft beside something stiff counts as much.
  factors_->scaled = transposed;
  factors_->scale = Eigen::VectorXd::Ones(transposed.cols());
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
    const double norm = transposed.col(column).norm();
    if (!std::isfinite(norm)) return false;
    if (norm == 0.0) continue;
    factors_->scale[column] = 1.0 / norm;
    for (Eigen::SparseMatrix<double>::InnerIterator it(factors_->scaled, column); it; ++it) it.valueRef() /= norm;
  }
  factors_->qr.setPivotThreshold(rank_tolerance);
  factors_->qr.compute(factors_->scaled);
  if (factors_->qr.info() != Eigen::Success) return false;
  factors_->rank = factors_->qr.rank();
  factors_->unknowns = transposed.rows();
  factors_->r = factors_->qr.matrixR();
  return true;
}

Eigen::Index MinimumNormSolver::Rank() const { return factors_->rank; }

Eigen::VectorXd MinimumNormSolver::Solve(const Eigen::VectorXd& b) const {
  // A' E = Q R, so A x = b is R' (Q' x) = E' b: forward substitution, and zero in the rest of Q' x for the shortest x.
  const Eigen::VectorXd permuted = factors_->qr.colsPermutation().transpose() * factors_->scale.cwiseProduct(b);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(factors_->unknowns);
  for (Eigen::Index j = 0; j < factors_->rank; ++j) {
    double sum = permuted[j], diagonal = 0.0;
    for (Eigen::SPQR<Eigen::SparseMatrix<double>>::MatrixType::InnerIterator it(factors_->r, j); it; ++it) {
      if (it.row() < j) sum -= it.value() * y[it.row()];
      if (it.row() == j) diagonal = it.value();
    }
    y[j] = sum / diagonal;
  }
  return factors_->qr.matrixQ() * y;
}

Eigen::MatrixXd MinimumNormSolver::NullSpace() const {
  const Eigen::Index size = factors_->unknowns - factors_->rank;
  Eigen::MatrixXd basis(factors_->unknowns, size);
  for (Eigen::Index k = 0; k < size; ++k)
    basis.col(k) =
        factors_->qr.matrixQ() * Eigen::VectorXd(Eigen::VectorXd::Unit(factors_->unknowns, factors_->rank + k));
  return basis;
}

}  // namespace contact_path
