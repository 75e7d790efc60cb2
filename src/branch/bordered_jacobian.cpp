#include "contact_path/branch/bordered_jacobian.h"

#include <Eigen/QR>

#include "contact_path/linear/generic_vector.h"

namespace contact_path {
namespace {

Eigen::MatrixXd Orthonormal(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 1) return columns.normalized();
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).householderQ() *
         Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

// Right-hand sides that are orthogonal to no vector of interest.
Eigen::VectorXd Generic(Eigen::Index size, Eigen::Index k) { return GenericVector(size).array().pow(k + 1); }

}  // namespace

BorderedJacobian::BorderedJacobian(ArcEquations* equations, const Eigen::VectorXd& t)
    : equations_(*equations), motion_(t.size()), unknowns_(equations->NumUnknowns()), t_(t) {}

bool BorderedJacobian::ChooseBorders(const Eigen::VectorXd& x, Eigen::Index k) {
  const Eigen::Index equations = equations_.NumEquations();
  BorderedSolver solver;
  Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns_);
  row.head(motion_) = t_;
  if (!solver.Factorize(equations_.TransposedJacobian(x), row, equations_.InFrame())) return false;
  if (!solver.HasLu()) return false;
  Eigen::MatrixXd right(unknowns_, k), left(equations, k);
  for (Eigen::Index j = 0; j < k; ++j) {
    right.col(j) = solver.Solve(Generic(equations, j), 0.0);
    left.col(j) = solver.SolveTransposed(Generic(unknowns_, j)).head(equations);
  }
  SetBorders(right, left);
  return v_.allFinite() && b_.allFinite();
}

bool BorderedJacobian::Factorize(const Eigen::VectorXd& x) {
  const Eigen::SparseMatrix<double>& transposed = equations_.TransposedJacobian(x);
  const Eigen::Index equations = transposed.cols(), k = v_.cols();
  bordered_.resize(unknowns_ + k, equations + k);
  bordered_.reserve(transposed.nonZeros() + k * (equations + motion_));
  for (Eigen::Index column = 0; column < equations; ++column) {
    bordered_.startVec(column);
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, column); it; ++it)
      bordered_.insertBack(it.row(), column) = it.value();
    for (Eigen::Index j = 0; j < k; ++j) bordered_.insertBack(unknowns_ + j, column) = b_(column, j);
  }
  for (Eigen::Index j = 0; j < k; ++j) {
    bordered_.startVec(equations + j);
    for (Eigen::Index i = 0; i < motion_; ++i) bordered_.insertBack(i, equations + j) = v_(i, j);
  }
  bordered_.finalize();
  Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns_ + k);
  row.head(motion_) = t_;
  if (!solver_.FactorizeRegular(bordered_, row)) return false;
  determinant_sign = solver_.DeterminantSign();
  across.resize(unknowns_, k);
  psi.resize(equations, k);
  sigma.resize(k, k);
  const Eigen::VectorXd of_t = solver_.Solve(Eigen::VectorXd::Zero(equations + k), 1.0);
  along = of_t.head(unknowns_);
  left_along = of_t.tail(k);
  for (Eigen::Index j = 0; j < k; ++j) {
    const Eigen::VectorXd of_v = solver_.Solve(Eigen::VectorXd::Unit(equations + k, equations + j), 0.0);
    across.col(j) = of_v.head(unknowns_);
    sigma.col(j) = of_v.tail(k);
    psi.col(j) = solver_.SolveTransposed(Eigen::VectorXd::Unit(unknowns_ + k, unknowns_ + j)).head(equations);
  }
  return along.allFinite() && across.allFinite() && psi.allFinite();
}

Eigen::VectorXd BorderedJacobian::Solve(const Eigen::VectorXd& right, Eigen::VectorXd* l) const {
  Eigen::VectorXd extended = Eigen::VectorXd::Zero(right.size() + v_.cols());
  extended.head(right.size()) = right;
  const Eigen::VectorXd solution = solver_.Solve(extended, 0.0);
  *l = solution.tail(v_.cols());
  return solution.head(unknowns_);
}

void BorderedJacobian::SetBorders(const Eigen::MatrixXd& v, const Eigen::MatrixXd& psi_found) {
  v_ = Orthonormal(v.topRows(motion_));
  b_ = Orthonormal(psi_found);
}

}  // namespace contact_path
