// The fixed-mode system with contacts on a deformable surface.
#include <gtest/gtest.h>

#include <string>

#include "contact_path/contact/scene_contacts.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "support/contact_points.h"
#include "support/deformable_scene.h"
#include "support/derivative_checker.h"
#include "support/random.h"
#include "support/system_derivatives.h"

namespace contact_path::deformable_system_test {
namespace {

using State = ContactState;

class DeformableSystem : public testing::Test {
 protected:
  Eigen::VectorXd RandomUnknowns() {
    Eigen::VectorXd x = random_.Vector(system_.NumUnknowns(), 0.1, 1.0);
    x.head(structure_.NumDofs()) = structure_.Start() + random_.Vector(structure_.NumDofs(), -0.03, 0.03);
    return x;
  }

  static constexpr double kStep = 1e-3;  // of differences
  const Scene scene_ = DeformableScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Laws laws_ = LawsOf(contacts_);
  FixedModeSystem system_{structure_, laws_};
  Random random_{11};
};

TEST_F(DeformableSystem, DerivativesMeetDifferencesInEveryStateOnEveryPatch) {
  for (const State state : {State::kOpen, State::kStick, State::kSlipPlus, State::kSlipMinus})
    for (const int patch : {0, 1, 2, 3, 4})
      for (const bool active : {false, true}) {
        system_.SetModes(ModesOf({state, State::kClosed}, {patch, 4 - patch}), ByPort(random_.Vector(2, -0.3, 0.3)));
        if (active) system_.SetActive(system_.mode_limits().All());
        const Eigen::VectorXd x = RandomUnknowns(), dx = random_.Vector(system_.NumUnknowns(), -1.0, 1.0);
        SCOPED_TRACE(std::string(ToString(state)) + std::to_string(patch));
        ExpectDerivativesMeetDifferences(&system_, x, dx, kStep);
      }
}

TEST_F(DeformableSystem, ValuesAlongACurveMeetDifferences) {
  system_.SetModes(ModesOf({State::kSlipPlus, State::kClosed}, {2, 3}), ByPort(random_.Vector(2, -0.3, 0.3)));
  const Eigen::VectorXd x = RandomUnknowns(), first = random_.Vector(system_.NumUnknowns(), -1.0, 1.0),
                        second = random_.Vector(system_.NumUnknowns(), -1.0, 1.0);
  const auto on_curve = [&](double h) { return Eigen::VectorXd(x + h * first + 0.5 * h * h * second); };
  const auto velocity = [&](double h) { return Eigen::VectorXd(first + h * second); };
  for (const Limit& constraint : system_.mode_limits().All()) {
    const auto along = [&](const Eigen::VectorXd& h) {
      return Eigen::Vector2d(system_.Value(constraint, on_curve(h[0])),
                             system_.mode_limits().Rate(constraint, on_curve(h[0]), velocity(h[0])));
    };
    const Jet jet = system_.ValueAlong(constraint, x, first, second);
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Eigen::Vector2d(jet.first, jet.second),
                           kDerivativeTolerance, kStep));
  }
  const auto sliding = [&](const Eigen::VectorXd& h) {
    const Jet jet = system_.laws_in_modes().LeadingForceAlong(0, kTangent, on_curve(h[0]), velocity(h[0]), second);
    return Eigen::Vector2d(jet.value, jet.first);
  };
  const Jet jet = system_.laws_in_modes().LeadingForceAlong(0, kTangent, x, first, second);
  EXPECT_TRUE(IsJacobian(sliding, Eigen::VectorXd::Zero(1), Eigen::Vector2d(jet.first, jet.second),
                         kDerivativeTolerance, kStep));
  // Nothing moves with the load factor but the loads.
  EXPECT_EQ(system_.DrivingForceAlong(x, first, second).value, 0.0);
}

}  // namespace
}  // namespace contact_path::deformable_system_test
