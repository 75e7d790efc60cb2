#include "contact_path/contact/contact_pair.h"

#include <gtest/gtest.h>

#include "support/curved_contacts.h"
#include "support/derivative_checker.h"
#include "support/kinematics.h"
#include "support/random.h"

namespace contact_path::contact_pair_test {
namespace {

constexpr double kRounding = 1e-13;

class Pairs : public testing::Test {
 protected:
  const Scene scene_ = MovingScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = CurvedContacts(structure_);
  const Eigen::VectorXd u_ = structure_.Start();
  Random random_{7};
};

TEST_F(Pairs, SecondDirectionalMeetsDifferencesOfTheForce) {
  constexpr double kRn = 0.9, kRt = 0.6;
  for (const auto& pair : contacts_) {
    if (!pair->Curved()) continue;
    const Eigen::VectorXd du = random_.Vector(u_.size(), -1.0, 1.0);
    const LawVector direction = LocalOf(pair->Dofs(0), du, 0.4);
    const auto force_rate = [&](const Eigen::VectorXd& h) {
      const PortsAt at = KinematicsAt(*pair, u_ + h[0] * du, 0.2 + h[0] * 0.4);
      return Eigen::VectorXd((kRn * at[kNormal].hessian + kRt * at[kTangent].hessian) * direction);
    };
    const Eigen::VectorXd second = pair->SecondDirectional(u_, 0.2, 0, {kRn, kRt}, direction);
    EXPECT_TRUE(IsJacobian(force_rate, Eigen::VectorXd::Zero(1), second, kDerivativeTolerance, 1e-3));
  }
}

TEST_F(Pairs, SlipIsTheChangeOfXiAndItsRateTheLimitOfSlip) {
  const Eigen::VectorXd du = random_.Vector(u_.size(), -0.1, 0.1);
  for (const auto& pair : contacts_) {
    EXPECT_NEAR(pair->Travel(kTangent, u_, 0.2, 0, du, 0.05, 0), pair->Xi(u_ + du, 0.25, 0) - pair->Xi(u_, 0.2, 0),
                kRounding);
    const double h = 1e-5;
    EXPECT_NEAR(pair->TravelRate(kTangent, u_, 0.2, 0, du, 0.05),
                pair->Travel(kTangent, u_ - h * du, 0.2 - h * 0.05, 0, 2.0 * h * du, 2.0 * h * 0.05, 0) / (2.0 * h),
                1e-8);
  }
}

// Power of the reaction at a fixed load: force times velocity.
TEST_F(Pairs, TheForceOfAReactionHasThePowerOfItsMotion) {
  const Eigen::VectorXd du = random_.Vector(u_.size(), -1.0, 1.0);
  for (const auto& pair : contacts_) {
    const PortsAt at = KinematicsAt(*pair, u_, 0.2);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(u_.size());
    at.AddForce(at[kNormal].gradient, 2.0, &force);
    at.AddForce(at[kTangent].gradient, -3.0, &force);
    EXPECT_NEAR(force.dot(du),
                2.0 * GapRate(*pair, u_, 0.2, du, 0.0) - 3.0 * pair->TravelRate(kTangent, u_, 0.2, 0, du, 0.0),
                kRounding);
  }
}

TEST_F(Pairs, SlipReferencesAreThoseOfAllCandidates) {
  PathPoint point;
  point.u = u_;
  point.s = 0.2;
  point.modes.resize(contacts_.size());
  const Laws laws = LawsOf(contacts_);
  point.forces = Eigen::VectorXd::Zero(laws.NumPorts());
  const Eigen::VectorXd references = laws.ReferencesAt(point);
  ASSERT_EQ(references.size(), 10);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    EXPECT_EQ(laws.Of(references, i)[kTangent], contacts_[i]->Xi(u_, 0.2, 0));
}

}  // namespace
}  // namespace contact_path::contact_pair_test
