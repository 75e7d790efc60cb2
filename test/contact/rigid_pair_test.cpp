#include "contact_path/contact/rigid_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/curved_contacts.h"
#include "support/derivative_checker.h"
#include "support/kinematics.h"
#include "support/random.h"

namespace contact_path {
namespace {

constexpr double kRounding = 1e-13;

class RigidPairs : public testing::Test {
 protected:
  // u and s with the entries q of a pair.
  Eigen::VectorXd At(const ContactPair& pair, const Eigen::VectorXd& q) const {
    Eigen::VectorXd x(structure_.NumDofs() + 1);
    x << structure_.Start(), 0.0;
    for (std::size_t k = 0; k < pair.Dofs().size(); ++k) x[pair.Dofs()[k]] = q[static_cast<Eigen::Index>(k)];
    x[structure_.NumDofs()] = q[q.size() - 1];
    return x;
  }
  Kinematics Evaluate(const ContactPair& pair, const Eigen::VectorXd& q) const {
    const Eigen::VectorXd x = At(pair, q);
    return KinematicsAt(pair, x, x[structure_.NumDofs()]);
  }
  Eigen::VectorXd Start(const ContactPair& pair) const { return pair.Local(structure_.Start(), 0.3); }

  const Scene scene_ = MovingScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = CurvedContacts(structure_);
  Random random_{2};
};

TEST_F(RigidPairs, GradientsMeetDifferencesAndTheirSparsityIsDeclared) {
  for (const auto& pair : contacts_) {
    const Eigen::VectorXd q = Start(*pair);
    const Kinematics at = Evaluate(*pair, q);
    const auto values = [&](const Eigen::VectorXd& to) {
      const Kinematics kinematics = Evaluate(*pair, to);
      return Eigen::Vector2d(kinematics.gap, kinematics.xi);
    };
    Eigen::MatrixXd gradients(2, q.size());
    gradients << at.gap_gradient.transpose(), at.xi_gradient.transpose();
    EXPECT_TRUE(IsJacobian(values, q, gradients, kDerivativeTolerance, 1e-3));
    for (std::size_t k = 0; k <= pair->Dofs().size(); ++k) {
      EXPECT_EQ(pair->MovesGap(k), at.gap_gradient[static_cast<Eigen::Index>(k)] != 0.0);
      EXPECT_EQ(pair->MovesXi(k), at.xi_gradient[static_cast<Eigen::Index>(k)] != 0.0);
    }
    const Eigen::VectorXd x = At(*pair, q);
    EXPECT_NEAR(pair->Gap(x, 0.3), at.gap, kRounding);
    EXPECT_LE(at.gap_gradient.norm(), pair->LargestGapRate());
  }
}

TEST_F(RigidPairs, HessiansMeetDifferences) {
  for (const auto& pair : contacts_) {
    if (!pair->Curved()) continue;
    const Eigen::VectorXd q = Start(*pair);
    const Kinematics at = Evaluate(*pair, q);
    const auto of_gap = [&](const Eigen::VectorXd& to) { return Eigen::VectorXd(Evaluate(*pair, to).gap_gradient); };
    const auto of_xi = [&](const Eigen::VectorXd& to) { return Eigen::VectorXd(Evaluate(*pair, to).xi_gradient); };
    EXPECT_TRUE(IsJacobian(of_gap, q, at.gap_hessian, kDerivativeTolerance, 1e-3));
    EXPECT_TRUE(IsJacobian(of_xi, q, at.xi_hessian, kDerivativeTolerance, 1e-3));
  }
}

TEST_F(RigidPairs, DerivativesOfHessiansMeetDifferences) {
  constexpr double kRn = 0.7, kRt = -0.4;
  for (const auto& pair : contacts_) {
    if (!pair->Curved()) continue;
    const Eigen::VectorXd q = Start(*pair), x = At(*pair, q);
    const PairVector direction = random_.Vector(q.size(), -1.0, 1.0);
    const auto hessian = [&](const Eigen::VectorXd& h) {
      const Kinematics at = Evaluate(*pair, q + h[0] * direction);
      return Entries(kRn * at.gap_hessian + kRt * at.xi_hessian);
    };
    PairMatrix derivative;
    pair->HessianDerivative(x, 0.3, kRn, kRt, direction, &derivative);
    EXPECT_TRUE(IsJacobian(hessian, Eigen::VectorXd::Zero(1), Entries(derivative), kDerivativeTolerance, 1e-3));
  }
}

// A node that slides on a disc from its top by a quarter of a circle at the distance g.
TEST(RigidPair, OfADiscHasTheClosedForm) {
  const auto disc = std::make_shared<Disc>(Eigen::Vector2d(1.0, 2.0), 0.5);
  const RigidPair pair(disc, {{0, 1}, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}, 0.3);
  const Eigen::VectorXd top = Eigen::Vector2d(1.0, 2.75), right = Eigen::Vector2d(1.75, 2.0);
  EXPECT_NEAR(pair.Gap(top, 0.0), 0.25, kRounding);
  EXPECT_NEAR(pair.Gap(right, 0.0), 0.25, kRounding);
  EXPECT_NEAR(pair.Slip(top, 0.0, right - top, 0.0), 0.5 * std::acos(-1.0) / 2.0, kRounding);
  // The foot moves slower than the node, by the ratio of the radii.
  EXPECT_NEAR(pair.SlipRate(top, 0.0, Eigen::Vector2d(1.0, 0.0), 0.0), 0.5 / 0.75, kRounding);
}

TEST(RigidPair, XiIsMeasuredFromTheReference) {
  const RigidPair pair(std::make_shared<HalfPlane>(Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.0, 2.0)),
                       {{0, -1}, {7.0, 1.25}, Eigen::Vector2d::Zero()}, 0.3);
  Kinematics at;
  pair.Evaluate(Eigen::VectorXd::Constant(1, 3.0), 0.0, 2.5, &at);
  EXPECT_EQ(at.xi, 0.5);
  EXPECT_EQ(at.gap, 0.25);
  EXPECT_EQ(pair.Dofs(), std::vector<int>{0});
}

}  // namespace
}  // namespace contact_path
