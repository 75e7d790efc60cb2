#include "contact_path/geometry/projection.h"

#include <gtest/gtest.h>

#include "support/curved_surfaces.h"
#include "support/derivative_checker.h"

namespace contact_path::projection_test {
namespace {

constexpr double kStep = 1e-3;

// A curve of which no derivative of the curvature is zero, and a point beside it.
class ProjectionOnASpiral : public testing::Test {
 protected:
  Projection At(const Eigen::Vector2d& x) const { return spiral_.Project(x, 0); }

  const Spiral spiral_{0.3, -0.4, 0.5};
  const Eigen::Vector2d x_{0.4, 0.3};
};

TEST_F(ProjectionOnASpiral, GradientsMeetDifferences) {
  const auto values = [this](const Eigen::VectorXd& x) { return Eigen::Vector2d(At(x).gap, At(x).xi); };
  Eigen::Matrix2d gradients;
  gradients << At(x_).normal.transpose(), XiGradient(At(x_)).transpose();
  EXPECT_TRUE(IsJacobian(values, x_, gradients, kDerivativeTolerance, kStep));
}

TEST_F(ProjectionOnASpiral, HessiansMeetDifferences) {
  const auto of_gap = [this](const Eigen::VectorXd& x) { return Eigen::VectorXd(At(x).normal); };
  const auto of_xi = [this](const Eigen::VectorXd& x) { return Eigen::VectorXd(XiGradient(At(x))); };
  EXPECT_TRUE(IsJacobian(of_gap, x_, GapHessian(At(x_)), kDerivativeTolerance, kStep));
  EXPECT_TRUE(IsJacobian(of_xi, x_, XiHessian(At(x_)), kDerivativeTolerance, kStep));
}

TEST_F(ProjectionOnASpiral, ChangesOfHessiansMeetDifferences) {
  const Eigen::Vector2d v(0.7, -0.4);
  const auto of_gap = [&](const Eigen::VectorXd& h) { return Entries(GapHessian(At(x_ + h[0] * v))); };
  const auto of_xi = [&](const Eigen::VectorXd& h) { return Entries(XiHessian(At(x_ + h[0] * v))); };
  const Eigen::VectorXd here = Eigen::VectorXd::Zero(1);
  EXPECT_TRUE(IsJacobian(of_gap, here, Entries(GapHessianChange(At(x_), v)), kDerivativeTolerance, kStep));
  EXPECT_TRUE(IsJacobian(of_xi, here, Entries(XiHessianChange(At(x_), v)), kDerivativeTolerance, kStep));
}

TEST(Projection, TheNormalIsOnTheLeftOfTheTangent) {
  EXPECT_EQ(TangentOf({0.0, 1.0}), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(TangentOf({-1.0, 0.0}), Eigen::Vector2d(0.0, 1.0));
}

}  // namespace
}  // namespace contact_path::projection_test
