#include "support/dense.h"

#include <Eigen/SVD>

namespace contact_path {

Eigen::Index SingularValueDecomposition::Rank(double tolerance) const {
  return (values.array() > tolerance * values[0]).count();
}

SingularValueDecomposition Decompose(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::VectorXd ShortestSolution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& b) {
  const SingularValueDecomposition s = Decompose(matrix);
  const Eigen::Index rank = s.Rank(1e-10);
  const Eigen::VectorXd along = s.u.leftCols(rank).transpose() * b;
  return s.v.leftCols(rank) * along.cwiseQuotient(s.values.head(rank));
}

}  // namespace contact_path
