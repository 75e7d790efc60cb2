#include "contact_path/structure/bar.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "support/derivative_checker.h"
#include "support/random.h"

namespace contact_path::bar_test {
namespace {

// Units in the last place of quantities of order 1 after a handful of operations.
constexpr double kRounding = 1e-14;

constexpr double kEA = 2.0;
constexpr double kRestLength = 0.8;

Eigen::VectorXd Force(const BarElement& bar, const Eigen::VectorXd& x) {
  Eigen::VectorXd force(4);
  bar.Force(x, force);
  return force;
}

Eigen::MatrixXd Tangent(const BarElement& bar, const Eigen::VectorXd& x) {
  Eigen::MatrixXd tangent(4, 4);
  bar.Tangent(x, tangent);
  return tangent;
}

Eigen::MatrixXd TangentDerivative(const BarElement& bar, const Eigen::VectorXd& x, const Eigen::VectorXd& v) {
  Eigen::MatrixXd derivative(4, 4);
  bar.TangentDerivative(x, v, derivative);
  return derivative;
}

class BarOfEachStrain : public testing::TestWithParam<StrainMeasure> {
 protected:
  // Lengths from about half to three times the rest length, any direction.
  Eigen::VectorXd Configuration() {
    const double length = random_.Number(0.5, 3.0) * kRestLength;
    const double angle = random_.Number(0.0, 6.3);
    Eigen::VectorXd x(4);
    x.head<2>() = random_.Vector(2, -1.0, 1.0);
    x.tail<2>() = x.head<2>() + length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    return x;
  }

  const BarElement bar_{kEA, kRestLength, GetParam()};
  Random random_{1};
};

INSTANTIATE_TEST_SUITE_P(Strains, BarOfEachStrain,
                         testing::Values(StrainMeasure::kBiot, StrainMeasure::kGreenLagrange,
                                         StrainMeasure::kLogarithmic),
                         [](const auto& instance) { return std::string(ToString(instance.param)); });

TEST_P(BarOfEachStrain, ForceIsTheGradientOfTheEnergy) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Configuration();
    const auto energy = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, bar_.Energy(at)); };
    EXPECT_TRUE(IsJacobian(energy, x, Force(bar_, x).transpose()));
  }
}

TEST_P(BarOfEachStrain, TangentIsTheDerivativeOfTheForce) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Configuration();
    EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Force(bar_, at); }, x, Tangent(bar_, x)));
  }
}

TEST_P(BarOfEachStrain, TangentDerivativeIsTheDerivativeOfTheTangentAlongADirection) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Configuration(), v = random_.Vector(4, -1.0, 1.0);
    const auto along = [&](const Eigen::VectorXd& h) { return Entries(Tangent(bar_, x + h[0] * v)); };
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Entries(TangentDerivative(bar_, x, v))));
  }
}

TEST_P(BarOfEachStrain, TangentDerivativeIsTheGradientOfTangentTimesDirection) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Configuration(), v = random_.Vector(4, -1.0, 1.0);
    const auto product = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd(Tangent(bar_, at) * v); };
    EXPECT_TRUE(IsJacobian(product, x, TangentDerivative(bar_, x, v)));
  }
}

TEST_P(BarOfEachStrain, RigidMotionTurnsTheForceAndKeepsTheEnergy) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Configuration();
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(random_.Number(0.0, 6.3)).toRotationMatrix();
    const Eigen::Vector2d shift = random_.Vector(2, -1.0, 1.0);
    Eigen::VectorXd moved(4);
    moved << turn * x.head<2>() + shift, turn * x.tail<2>() + shift;
    EXPECT_NEAR(bar_.Energy(moved), bar_.Energy(x), 10.0 * kRounding);
    const Eigen::VectorXd force = Force(bar_, x);
    Eigen::VectorXd turned(4);
    turned << turn * force.head<2>(), turn * force.tail<2>();
    EXPECT_LE((Force(bar_, moved) - turned).norm(), 20.0 * kRounding);
  }
}

TEST_P(BarOfEachStrain, ForcesAreInBalanceAndAlongTheBar) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Configuration(), force = Force(bar_, x);
    EXPECT_EQ(force[0], -force[2]);
    EXPECT_EQ(force[1], -force[3]);
    const Eigen::Vector2d span = x.tail<2>() - x.head<2>();
    EXPECT_NEAR(span[0] * force[3] - span[1] * force[2], 0.0, kRounding * (1.0 + force.norm()));
    EXPECT_EQ(span.dot(force.tail<2>()) > 0.0, span.norm() > kRestLength);  // longer than at rest: it pulls
  }
}

TEST_P(BarOfEachStrain, NothingAtRestLength) {
  const Eigen::VectorXd x = Eigen::Vector4d(0.0, 0.0, 0.0, kRestLength);
  EXPECT_EQ(bar_.Energy(x), 0.0);
  EXPECT_EQ(Force(bar_, x).norm(), 0.0);
  // All strains agree to first order: EA / l0 along the bar, nothing across.
  EXPECT_NEAR(Tangent(bar_, x)(3, 3), kEA / kRestLength, kRounding);
  EXPECT_EQ(Tangent(bar_, x)(2, 2), 0.0);
}

// A bar of rest length 1 stretched to 3/2: energy EA e^2 / 2 and pull EA e de/dl worked out by hand.
struct StretchedBar {
  StrainMeasure strain;
  double energy, pull;
};

TEST(BarElement, StretchedByOneHalf) {
  const double logarithm = 0.40546510810816438198;  // ln 1.5
  for (const StretchedBar& expected :
       {StretchedBar{StrainMeasure::kBiot, 0.25, 1.0}, StretchedBar{StrainMeasure::kGreenLagrange, 0.390625, 1.875},
        StretchedBar{StrainMeasure::kLogarithmic, logarithm * logarithm, 4.0 / 3.0 * logarithm}}) {
    const BarElement bar(kEA, 1.0, expected.strain);
    const Eigen::VectorXd x = Eigen::Vector4d(0.5, 2.0, 2.0, 2.0);
    EXPECT_NEAR(bar.Energy(x), expected.energy, kRounding) << ToString(expected.strain);
    EXPECT_NEAR(Force(bar, x)[2], expected.pull, kRounding) << ToString(expected.strain);
    EXPECT_EQ(Force(bar, x)[3], 0.0) << ToString(expected.strain);
  }
}

TEST(BarElement, OnlyGreenLagrangeIsSmoothAtZeroLength) {
  const Eigen::VectorXd x = Eigen::Vector4d(0.3, 0.4, 0.3, 0.4), v = Eigen::Vector4d(0.1, 0.2, -0.3, 0.5);
  const BarElement smooth(kEA, kRestLength, StrainMeasure::kGreenLagrange);
  EXPECT_EQ(Force(smooth, x).norm(), 0.0);
  EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Force(smooth, at); }, x, Tangent(smooth, x)));
  EXPECT_TRUE(TangentDerivative(smooth, x, v).allFinite());
  for (const StrainMeasure strain : {StrainMeasure::kBiot, StrainMeasure::kLogarithmic}) {
    const BarElement bar(kEA, kRestLength, strain);
    EXPECT_FALSE(Force(bar, x).allFinite()) << ToString(strain);
    EXPECT_FALSE(Tangent(bar, x).allFinite()) << ToString(strain);
    EXPECT_FALSE(TangentDerivative(bar, x, v).allFinite()) << ToString(strain);
  }
}

}  // namespace
}  // namespace contact_path::bar_test
