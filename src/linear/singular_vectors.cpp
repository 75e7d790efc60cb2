#include "contact_path/linear/singular_vectors.h"

#include <Eigen/SVD>

namespace contact_path {

SingularVectors RightSingularVectors(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace contact_path
