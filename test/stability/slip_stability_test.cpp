#include "contact_path/stability/slip_stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace contact_path::slip_stability_test {
namespace {

Eigen::MatrixXd Matrix2(double a, double b, double c, double d) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << a, b, c, d;
  return matrix;
}

TEST(SlipStabilityTest, OneContact) {
  const Eigen::MatrixXd holds = Eigen::MatrixXd::Constant(1, 1, 2.0);
  EXPECT_TRUE(IsStrictlyCopositive(holds));
  EXPECT_EQ(ComplementarityDegree(holds), 1);
  EXPECT_TRUE(GrowingSlips(holds).empty());
  const Eigen::MatrixXd slips = -holds;
  EXPECT_FALSE(IsStrictlyCopositive(slips));
  EXPECT_EQ(ComplementarityDegree(slips), 0);
  ASSERT_EQ(GrowingSlips(slips).size(), 1U);
  EXPECT_DOUBLE_EQ(GrowingSlips(slips)[0].rate, 2.0);
}

// Two contacts that do not know of each other: the determinant is that of a stable structure.
TEST(SlipStabilityTest, TwoIndependentContacts) {
  const Eigen::MatrixXd H = Matrix2(-0.5, 0.0, 0.0, -0.6);
  EXPECT_EQ(ComplementarityDegree(H), 0);
  EXPECT_EQ(CountGrowing(H, GrowingSlips(H)), 2);
}

// Each alone holds, both together do not.
TEST(SlipStabilityTest, TwoContactsTogether) {
  const Eigen::MatrixXd H = Matrix2(1.0, -1.5, -1.5, 1.0);
  EXPECT_FALSE(IsStrictlyCopositive(H));
  EXPECT_EQ(ComplementarityDegree(H), 0);
  const std::vector<GrowingSlip> growing = GrowingSlips(H);
  ASSERT_EQ(growing.size(), 1U);
  EXPECT_NEAR(growing[0].z[0], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(growing[0].z[1], std::sqrt(0.5), 1e-12);
  EXPECT_EQ(CountGrowing(H, growing), 1);
}

// A slip back against the other, which the signs of friction forbid, would grow.
TEST(SlipStabilityTest, CopositiveWithANegativeEigenvalue) {
  const Eigen::MatrixXd H = Matrix2(1.0, 1.5, 1.5, 1.0);
  EXPECT_TRUE(IsStrictlyCopositive(H));
  EXPECT_EQ(ComplementarityDegree(H), 1);
  EXPECT_TRUE(GrowingSlips(H).empty());
}

TEST(SlipStabilityTest, NeitherCopositiveNorOfAnotherDegree) {
  const Eigen::MatrixXd H = Matrix2(1.0, -5.0, 1.0, 1.0);
  EXPECT_FALSE(IsStrictlyCopositive(H));
  EXPECT_EQ(ComplementarityDegree(H), 1);
  EXPECT_TRUE(GrowingSlips(H).empty());
}

TEST(SlipStabilityTest, SingularAlongAPossibleSlip) {
  const Eigen::MatrixXd H = Matrix2(1.0, -1.0, -1.0, 1.0);
  EXPECT_EQ(ComplementarityDegree(H), std::nullopt);
  ASSERT_FALSE(GrowingSlips(H).empty());
  EXPECT_NEAR(GrowingSlips(H)[0].rate, 0.0, 1e-12);
}

// The degree does not depend on q: of matrices with a positive definite symmetric part it is 1, and a copositive matrix
// has no growing slip.
TEST(SlipStabilityTest, RandomMatrices) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const int n = 1 + static_cast<int>(seed % 6);
    Eigen::MatrixXd H(n, n);
    for (int j = 0; j < n; ++j) H.col(j) = random.Vector(n, -1.0, 1.0);
    H += 0.6 * Eigen::MatrixXd::Identity(n, n);
    const std::optional<int> degree = ComplementarityDegree(H);
    ASSERT_TRUE(degree) << seed;
    if (!IsStrictlyCopositive(H)) continue;
    EXPECT_EQ(*degree, 1) << seed;
    EXPECT_TRUE(GrowingSlips(H).empty()) << seed;
  }
}

}  // namespace
}  // namespace contact_path::slip_stability_test
