// Dense matrices of a few increments, for comparison.
#ifndef CONTACT_PATH_TEST_SUPPORT_DENSE_H_
#define CONTACT_PATH_TEST_SUPPORT_DENSE_H_

#include <Eigen/Core>

namespace contact_path {

// matrix = u diag(values) v(:, 0..values.size())', values largest first; v is square.
struct SingularValueDecomposition {
  Eigen::MatrixXd u;
  Eigen::VectorXd values;
  Eigen::MatrixXd v;

  // Singular values larger than `tolerance` times the largest one.
  Eigen::Index Rank(double tolerance) const;
};

SingularValueDecomposition Decompose(const Eigen::MatrixXd& matrix);

// The shortest of the vectors for which |matrix x - b| is smallest; rank by a relative tolerance of 1e-10.
Eigen::VectorXd ShortestSolution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& b);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_DENSE_H_
