#include "contact_path/structure/superelement.h"

#include <gtest/gtest.h>

#include "support/derivative_checker.h"
#include "support/random.h"

namespace contact_path::superelement_test {
namespace {

class Superelement : public testing::Test {
 protected:
  Superelement() {
    stiffness_ << 4.0, 1.0, -2.0, 0.5,  //
        1.0, 3.0, 0.3, -1.0,            //
        -2.0, 0.3, 5.0, 0.7,            //
        0.5, -1.0, 0.7, 2.0;
  }

  Eigen::Matrix4d stiffness_;
  const Eigen::VectorXd initial_ = Eigen::Vector4d(0.1, 0.2, 1.3, -0.4);
  Random random_{2};
};

TEST_F(Superelement, ForceIsStiffnessTimesDisplacement) {
  const LinearSuperelement element(stiffness_, initial_);
  ASSERT_EQ(element.Dofs().size(), 4u);
  EXPECT_EQ(element.Dofs()[3].node, 1);
  EXPECT_EQ(element.Dofs()[3].component, 1);
  Eigen::VectorXd force(4);
  element.Force(initial_, force);
  EXPECT_EQ(force.norm(), 0.0);
  EXPECT_EQ(element.Energy(initial_), 0.0);
  for (Eigen::Index j = 0; j < 4; ++j) {
    const Eigen::VectorXd x = initial_ + 2.0 * Eigen::VectorXd::Unit(4, j);
    element.Force(x, force);
    EXPECT_LE((force - 2.0 * stiffness_.col(j)).norm(), 1e-14);
    EXPECT_NEAR(element.Energy(x), 2.0 * stiffness_(j, j), 1e-14);
  }
}

TEST_F(Superelement, DerivativesMeetDifferences) {
  const LinearSuperelement element(stiffness_, initial_);
  const Eigen::VectorXd x = random_.Vector(4, -1.0, 1.0), v = random_.Vector(4, -1.0, 1.0);
  const auto energy = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, element.Energy(at)); };
  const auto force = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd value(4);
    element.Force(at, value);
    return value;
  };
  const auto tangent = [&](const Eigen::VectorXd& at) {
    Eigen::MatrixXd value(4, 4);
    element.Tangent(at, value);
    return value;
  };
  EXPECT_TRUE(IsJacobian(energy, x, force(x).transpose()));
  EXPECT_TRUE(IsJacobian(force, x, tangent(x)));
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Constant(4, 4, 7.0);
  element.TangentDerivative(x, v, derivative);
  EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Eigen::VectorXd(tangent(at) * v); }, x, derivative));
}

}  // namespace
}  // namespace contact_path::superelement_test
