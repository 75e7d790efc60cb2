// Right singular vectors of small dense matrices.
#ifndef CONTACT_PATH_LINEAR_SINGULAR_VECTORS_H_
#define CONTACT_PATH_LINEAR_SINGULAR_VECTORS_H_

#include <Eigen/SVD>

namespace contact_path {

struct SingularVectors {
  Eigen::VectorXd values;  // singular values, largest first; as many as the smaller side of the matrix
  Eigen::MatrixXd v;  // square, orthogonal: matrix * v.col(k) has the length values[k], or is zero beyond their end
};

// matrix: any shape, with at least one row and column. Takes time with the third power of its sides.
inline SingularVectors RightSingularVectors(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_SINGULAR_VECTORS_H_
