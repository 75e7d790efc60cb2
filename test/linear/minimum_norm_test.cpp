#include "contact_path/linear/minimum_norm.h"

#include <gtest/gtest.h>

#include <limits>

#include "contact_path/tolerances.h"
#include "support/dense.h"
#include "support/random.h"

namespace contact_path::minimum_norm_test {
namespace {

// Rounding of factorisations of well-conditioned matrices of a few rows; measured up to 2e-15.
constexpr double kRounding = 1e-13;

Eigen::MatrixXd RandomMatrix(Random* random, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) matrix.col(j) = random->Vector(rows, -1.0, 1.0);
  return matrix;
}

class MinimumNorm : public testing::Test {
 protected:
  // Solves a x = b and compares with the singular value decomposition of the dense matrix. The null space, too.
  void ExpectShortestSolution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, Eigen::Index rank) {
    ASSERT_TRUE(solver_.Factorize(a.transpose().sparseView(1.0, 0.0)));
    EXPECT_EQ(solver_.Rank(), rank);
    const Eigen::VectorXd x = solver_.Solve(b);
    const Eigen::VectorXd expected = ShortestSolution(a, b);
    EXPECT_LE((a * x - b).norm(), kRounding * (1.0 + b.norm()));
    EXPECT_LE((x - expected).norm(), kRounding * (1.0 + expected.norm()));
    const Eigen::MatrixXd null_space = solver_.NullSpace();
    ASSERT_EQ(null_space.rows(), a.cols());
    ASSERT_EQ(null_space.cols(), a.cols() - rank);
    const Eigen::Index size = null_space.cols();
    EXPECT_LE((a * null_space).norm(), kRounding * (1.0 + a.norm()));
    EXPECT_LE((null_space.transpose() * null_space - Eigen::MatrixXd::Identity(size, size)).norm(), kRounding);
    const Eigen::MatrixXd left = solver_.LeftNullSpace();
    ASSERT_EQ(left.rows(), a.rows());
    ASSERT_EQ(left.cols(), a.rows() - rank);
    EXPECT_LE((left.transpose() * a).norm(), 10.0 * kRounding * (1.0 + left.norm() * a.norm()));
    if (left.cols() > 0) {
      EXPECT_GE(left.colwise().norm().minCoeff(), 1e-3);
    }
  }

  MinimumNormSolver solver_;
  Random random_{5};
};

TEST_F(MinimumNorm, SquareSystemHasItsOneSolution) {
  const Eigen::MatrixXd a = RandomMatrix(&random_, 6, 6);
  ExpectShortestSolution(a, random_.Vector(6, -1.0, 1.0), 6);
}

TEST_F(MinimumNorm, OneEquationByHand) {
  ASSERT_TRUE(solver_.Factorize(Eigen::MatrixXd(Eigen::Vector2d(3.0, 4.0)).sparseView()));
  const Eigen::VectorXd x = solver_.Solve(Eigen::VectorXd::Constant(1, 10.0));
  EXPECT_NEAR(x[0], 1.2, kRounding);
  EXPECT_NEAR(x[1], 1.6, kRounding);
}

TEST_F(MinimumNorm, FewerEquationsThanUnknowns) {
  for (Eigen::Index rows = 1; rows < 8; ++rows) {
    const Eigen::MatrixXd a = RandomMatrix(&random_, rows, 8);
    ExpectShortestSolution(a, random_.Vector(rows, -1.0, 1.0), rows);
  }
}

TEST_F(MinimumNorm, RedundantEquationsAreLeftOut) {
  Eigen::MatrixXd a = RandomMatrix(&random_, 7, 6);
  a.row(3) = 2.0 * a.row(0) - a.row(1);
  a.row(5) = a.row(2);
  a.row(6).setZero();
  ExpectShortestSolution(a, a * random_.Vector(6, -1.0, 1.0), 4);
}

TEST_F(MinimumNorm, MoreEquationsThanUnknownsThatAgree) {
  const Eigen::MatrixXd a = RandomMatrix(&random_, 9, 4);
  ExpectShortestSolution(a, a * random_.Vector(4, -1.0, 1.0), 4);
}

TEST_F(MinimumNorm, UnknownsThatNoEquationHolds) {
  Eigen::MatrixXd a = RandomMatrix(&random_, 3, 5);
  a.col(1).setZero();
  a.col(4).setZero();
  ExpectShortestSolution(a, random_.Vector(3, -1.0, 1.0), 3);
  EXPECT_NEAR(solver_.Solve(Eigen::VectorXd::Ones(3))[1], 0.0, kRounding);
}

TEST_F(MinimumNorm, RankDoesNotDependOnTheScaleOfTheMatrix) {
  Eigen::MatrixXd a = RandomMatrix(&random_, 4, 6);
  a.row(2) = a.row(0) + a.row(1);
  for (const double scale : {1e-12, 1.0, 1e12}) {
    ASSERT_TRUE(solver_.Factorize(Eigen::MatrixXd(scale * a.transpose()).sparseView(1.0, 0.0)));
    EXPECT_EQ(solver_.Rank(), 3) << scale;
  }
}

TEST_F(MinimumNorm, WhatIsAboveTheRankToleranceCounts) {
  Eigen::Matrix2d a;
  for (const double off : {100.0 * tolerances::kDependentColumn, 0.01 * tolerances::kDependentColumn}) {
    a << 1.0, 1.0, 1.0, 1.0 + off;
    ASSERT_TRUE(solver_.Factorize(Eigen::MatrixXd(a).sparseView()));
    EXPECT_EQ(solver_.Rank(), off > tolerances::kDependentColumn ? 2 : 1);
  }
}

TEST_F(MinimumNorm, CanBeUsedAgainWithOtherShapes) {
  ExpectShortestSolution(RandomMatrix(&random_, 2, 7), random_.Vector(2, -1.0, 1.0), 2);
  ExpectShortestSolution(RandomMatrix(&random_, 5, 5), random_.Vector(5, -1.0, 1.0), 5);
  ExpectShortestSolution(RandomMatrix(&random_, 1, 3), random_.Vector(1, -1.0, 1.0), 1);
}

TEST_F(MinimumNorm, RefusesWhatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd a = RandomMatrix(&random_, 3, 4);
    a(1, 2) = bad;
    EXPECT_FALSE(solver_.Factorize(a.transpose().sparseView(1.0, 0.0)));
  }
}

}  // namespace
}  // namespace contact_path::minimum_norm_test
