#include "contact_path/linear/singular_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.h"

namespace contact_path::singular_vectors_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kRounding = 1e-14;

void ExpectRightSingularVectors(const MatrixXd& matrix) {
  const SingularVectors s = RightSingularVectors(matrix);
  const Index n = matrix.cols();
  ASSERT_EQ(s.values.size(), std::min(matrix.rows(), n));
  ASSERT_EQ(s.v.rows(), n);
  ASSERT_EQ(s.v.cols(), n);
  EXPECT_LE((s.v.transpose() * s.v - MatrixXd::Identity(n, n)).norm(), kRounding * static_cast<double>(n));
  // The images of the vectors are orthogonal, as long as the singular values, which descend.
  const MatrixXd image = matrix * s.v;
  for (Index k = 0; k < n; ++k) {
    EXPECT_NEAR(image.col(k).norm(), k < s.values.size() ? s.values[k] : 0.0, kRounding * matrix.norm());
    for (Index j = 0; j < k; ++j) EXPECT_NEAR(image.col(j).dot(image.col(k)), 0.0, kRounding * matrix.squaredNorm());
    if (k > 0 && k < s.values.size()) {
      EXPECT_LE(s.values[k], s.values[k - 1]);
    }
  }
}

TEST(SingularVectors, OfMatricesOfEveryShape) {
  Random random(7);
  for (Index rows = 1; rows <= 6; ++rows)
    for (Index columns = 1; columns <= 6; ++columns) {
      MatrixXd matrix(rows, columns);
      for (Index j = 0; j < columns; ++j) matrix.col(j) = random.Vector(rows, -1.0, 1.0);
      ExpectRightSingularVectors(matrix);
      matrix.col(columns - 1) = 2.0 * matrix.col(0);  // rank rank-deficient, for more than one column
      ExpectRightSingularVectors(matrix);
    }
}

TEST(SingularVectors, NullVectorByHand) {
  MatrixXd matrix(2, 3);
  matrix << 3.0, 0.0, 4.0, 0.0, 1.0, 0.0;
  const SingularVectors s = RightSingularVectors(matrix);
  EXPECT_NEAR(s.values[0], 5.0, kRounding);
  EXPECT_NEAR(s.values[1], 1.0, kRounding);
  EXPECT_NEAR(s.v.col(2).cwiseAbs().dot(Eigen::Vector3d(0.8, 0.0, 0.6)), 1.0, kRounding);
}

}  // namespace
}  // namespace contact_path::singular_vectors_test
