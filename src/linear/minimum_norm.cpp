#include "contact_path/linear/minimum_norm.h"

#include <Eigen/SPQRSupport>
#include <cmath>

namespace contact_path {

struct MinimumNormSolver::Factors {
  Eigen::SPQR<Eigen::SparseMatrix<double>> qr;
  Eigen::SPQR<Eigen::SparseMatrix<double>>::MatrixType r;
  Eigen::Index rank = 0;
  Eigen::Index unknowns = 0;
};

MinimumNormSolver::MinimumNormSolver() : factors_(std::make_unique<Factors>()) {}
MinimumNormSolver::~MinimumNormSolver() = default;

bool MinimumNormSolver::Factorize(const Eigen::SparseMatrix<double>& transposed, double rank_tolerance) {
  double largest = 0.0;
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
    double sum = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, column); it; ++it) sum += it.value() * it.value();
    if (!std::isfinite(sum)) return false;
    largest = std::max(largest, std::sqrt(sum));
  }
  factors_->qr.setPivotThreshold(rank_tolerance * largest);
  factors_->qr.compute(transposed);
  if (factors_->qr.info() != Eigen::Success) return false;
  factors_->rank = factors_->qr.rank();
  factors_->unknowns = transposed.rows();
  factors_->r = factors_->qr.matrixR();
  return true;
}

Eigen::Index MinimumNormSolver::Rank() const { return factors_->rank; }

Eigen::VectorXd MinimumNormSolver::Solve(const Eigen::VectorXd& b) const {
  // A' E = Q R, so A x = b is R' (Q' x) = E' b: forward substitution, and zero in the rest of Q' x for the shortest x.
  const Eigen::VectorXd permuted = factors_->qr.colsPermutation().transpose() * b;
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
