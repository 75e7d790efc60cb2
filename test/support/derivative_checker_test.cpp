#include "support/derivative_checker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace contact_path::derivative_checker_test {
namespace {

// (x y^2, sin x + 3 z, exp(y z), 5): all kinds of entries, zeros among them.
Eigen::VectorXd Function(const Eigen::VectorXd& x) {
  return Eigen::Vector4d(x[0] * x[1] * x[1], std::sin(x[0]) + 3.0 * x[2], std::exp(x[1] * x[2]), 5.0);
}

Eigen::MatrixXd RightJacobian(const Eigen::VectorXd& x) {
  const double exponential = std::exp(x[1] * x[2]);
  Eigen::MatrixXd jacobian(4, 3);
  jacobian << x[1] * x[1], 2.0 * x[0] * x[1], 0.0,  //
      std::cos(x[0]), 0.0, 3.0,                     //
      0.0, x[2] * exponential, x[1] * exponential,  //
      0.0, 0.0, 0.0;
  return jacobian;
}

class DerivativeChecker : public testing::Test {
 protected:
  const Eigen::VectorXd x_ = Eigen::Vector3d(0.7, -1.3, 0.4);
  Eigen::MatrixXd jacobian_ = RightJacobian(x_);
};

TEST_F(DerivativeChecker, AcceptsARightDerivative) {
  EXPECT_TRUE(IsJacobian(Function, x_, jacobian_));
  // How exact the differences are: rounding over the smallest steps.
  EXPECT_LE(CompareWithDifferences(Function, x_, jacobian_).error, 1e-11);
}

TEST_F(DerivativeChecker, RejectsOneWrongEntry) {
  for (Eigen::Index i = 0; i < jacobian_.rows(); ++i) {
    for (Eigen::Index j = 0; j < jacobian_.cols(); ++j) {
      Eigen::MatrixXd wrong = jacobian_;
      wrong(i, j) += 0.1;
      const DerivativeComparison worst = CompareWithDifferences(Function, x_, wrong);
      EXPECT_FALSE(IsJacobian(Function, x_, wrong));
      EXPECT_EQ(worst.row, i);
      EXPECT_EQ(worst.column, j);
      EXPECT_EQ(worst.given, wrong(i, j));
      EXPECT_NEAR(worst.difference, jacobian_(i, j), 1e-10);
    }
  }
}

TEST_F(DerivativeChecker, RejectsAWrongSign) {
  jacobian_(1, 0) = -jacobian_(1, 0);
  EXPECT_FALSE(IsJacobian(Function, x_, jacobian_));
  EXPECT_FALSE(IsJacobian(Function, x_, -RightJacobian(x_)));
}

TEST_F(DerivativeChecker, RejectsARelativeErrorOfOneInTenThousand) {
  for (Eigen::Index i = 0; i < jacobian_.rows(); ++i) {
    for (Eigen::Index j = 0; j < jacobian_.cols(); ++j) {
      if (jacobian_(i, j) == 0.0) continue;
      Eigen::MatrixXd wrong = jacobian_;
      wrong(i, j) *= 1.0001;
      EXPECT_FALSE(IsJacobian(Function, x_, wrong)) << i << ", " << j;
    }
  }
}

TEST_F(DerivativeChecker, RejectsTheTransposedAndOtherShapes) {
  EXPECT_FALSE(IsJacobian(Function, x_, jacobian_.transpose()));
  EXPECT_FALSE(IsJacobian(Function, x_, jacobian_.topRows(3)));
}

TEST_F(DerivativeChecker, RejectsWhatIsNotFinite) {
  jacobian_(3, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(IsJacobian(Function, x_, jacobian_));
  const auto with_pole = [](const Eigen::VectorXd& x) { return Eigen::VectorXd(x.array().log()); };
  EXPECT_FALSE(IsJacobian(with_pole, Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, 1)));
}

TEST_F(DerivativeChecker, FailureNamesTheWorstEntry) {
  jacobian_(2, 1) += 0.5;
  const std::string message = IsJacobian(Function, x_, jacobian_).message();
  EXPECT_NE(message.find("entry (2, 1) of the 4 x 3 derivative"), std::string::npos) << message;
}

}  // namespace
}  // namespace contact_path::derivative_checker_test
