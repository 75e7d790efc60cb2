#include "contact_path/equations/nearest_point.h"

#include <gtest/gtest.h>

#include <limits>

#include "contact_path/contact/scene_contacts.h"
#include "support/contact_points.h"
#include "support/reference_cases.h"

namespace contact_path::nearest_point_test {
namespace {

// Newton's method stops at rounding; measured up to 3e-14 in the unscaled lengths of the sliding bar.
constexpr double kRounding = 1e-12;

class SlidingBarNearest : public testing::Test {
 protected:
  SlidingBarNearest() { system_.SetModes(ModesOf({ContactState::kSlipPlus}), Eigen::Vector2d(0.0, -5.0)); }

  Eigen::VectorXd PackClosedForm(double x) const {
    PathPoint point;
    point.u = Eigen::Vector2d(x, 0.0);
    point.s = sliding_bar::LoadFactor(x);
    point.forces = sliding_bar::NormalReaction(x) * Eigen::Vector2d(1.0, -sliding_bar::kFriction);
    return system_.Pack(point);
  }

  const Scene scene_ = sliding_bar::MakeScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Laws laws_ = LawsOf(contacts_);
  FixedModeSystem system_{structure_, laws_};
};

TEST_F(SlidingBarNearest, PointOnThePathIsItsOwn) {
  for (double x = -4.5; x < 5.0; x += 0.5) {
    const Eigen::VectorXd on_path = PackClosedForm(x);
    const NearestPoint nearest = FindNearestPoint(&system_, on_path, on_path.head(3));
    ASSERT_TRUE(nearest.converged) << x;
    EXPECT_LE((nearest.x - on_path).norm(), kRounding) << x;
  }
}

TEST_F(SlidingBarNearest, IsOnThePathAndTheWayToItIsNormal) {
  for (double x = -4.5; x < 4.6; x += 0.5) {
    const Eigen::VectorXd start = PackClosedForm(x);
    const Eigen::VectorXd wanted = start.head(3) + Eigen::Vector3d(0.05, 0.1, -0.08);
    const NearestPoint nearest = FindNearestPoint(&system_, start, wanted);
    ASSERT_TRUE(nearest.converged) << x;
    EXPECT_EQ(nearest.rank, system_.NumEquations());
    EXPECT_LE((nearest.x - PackClosedForm(nearest.x[0])).norm(), kRounding) << x;
    EXPECT_NEAR((wanted[0] - nearest.x[0]) + (wanted[2] - nearest.x[2]) * sliding_bar::LoadFactorSlope(nearest.x[0]),
                0.0, kRounding)
        << x;
  }
}

TEST_F(SlidingBarNearest, PinnedLoadFactorIsMet) {
  system_.FixLoadFactor(1.0);
  const NearestPoint nearest = FindNearestPoint(&system_, PackClosedForm(-4.0), PackClosedForm(-4.0).head(3));
  ASSERT_TRUE(nearest.converged);
  EXPECT_NEAR(nearest.x[2], 1.0, kRounding);
  EXPECT_NEAR(sliding_bar::LoadFactor(nearest.x[0]), 1.0, kRounding);
}

TEST_F(SlidingBarNearest, EquationsThatContradictEachOtherDoNotConverge) {
  system_.SetModes(ModesOf({ContactState::kStick}), Eigen::Vector2d(0.0, -3.0));
  system_.SetActive(
      {{0, NumberOf(ContactLimit::kNormalReaction)}});  // b held away from rest length without a normal reaction
  const Eigen::VectorXd start = PackClosedForm(-3.0);
  EXPECT_FALSE(FindNearestPoint(&system_, start, start.head(3)).converged);
}

TEST_F(SlidingBarNearest, WhatIsNotFiniteDoesNotConverge) {
  const Eigen::VectorXd good = PackClosedForm(-3.0);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (Eigen::Index i = 0; i < good.size(); ++i) {
      Eigen::VectorXd start = good;
      start[i] = bad;
      EXPECT_FALSE(FindNearestPoint(&system_, start, good.head(3)).converged) << i;
    }
    Eigen::VectorXd wanted = good.head(3);
    wanted[1] = bad;
    EXPECT_FALSE(FindNearestPoint(&system_, good, wanted).converged);
  }
}

// The same floor twice: the reactions are not unique, the position is.
TEST(NearestPoint, RedundantContactsAreNoObstacle) {
  Scene scene = sliding_bar::MakeScene();
  scene.contacts.push_back(scene.contacts[0]);
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  FixedModeSystem system(structure, laws);
  system.SetModes(ModesOf({ContactState::kSlipPlus, ContactState::kSlipPlus}), ByPort(Eigen::Vector2d(-5.0, -5.0)));
  PathPoint start;
  start.u = Eigen::Vector2d(-3.0, 0.0);
  start.s = sliding_bar::LoadFactor(-3.0);
  const Eigen::Vector2d rn(sliding_bar::NormalReaction(-3.0), 0.0);
  start.forces = ByPort(rn, -sliding_bar::kFriction * rn);
  const NearestPoint nearest = FindNearestPoint(&system, system.Pack(start), Eigen::Vector3d(-2.9, 0.0, start.s));
  ASSERT_TRUE(nearest.converged);
  EXPECT_LT(nearest.rank, system.NumEquations());
  const double x = nearest.x[0];
  EXPECT_NEAR(nearest.x[2], sliding_bar::LoadFactor(x), kRounding);
  EXPECT_NEAR(nearest.x[3] + nearest.x[4], sliding_bar::NormalReaction(x), kRounding);
}

// A bar that nothing but its constant length holds: of all equilibria the nearest is taken.
TEST(NearestPoint, RigidModesAreNoObstacle) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}, {"q", 1.0, 0.0}};
  scene.bars = {{{"p", "q"}, 1.0}};
  scene.loads = {{"p", -1.0, 0.0}, {"q", 1.0, 0.0}};
  const Structure structure(scene);
  const Laws none;
  FixedModeSystem system(structure, none);
  Eigen::VectorXd start(5), wanted(5);
  start << 0.0, 0.0, 1.0, 0.0, 0.0;
  wanted << 0.3, 0.2, 1.5, 0.2, 0.1;
  const NearestPoint nearest = FindNearestPoint(&system, start, wanted);
  ASSERT_TRUE(nearest.converged);
  // Along the bar: stretch d = s; nearest to d = 0.2, s = 0.1 with (x_q - x_p) = 1 + d. The middle goes where wanted.
  EXPECT_NEAR(0.5 * (nearest.x[0] + nearest.x[2]), 0.9, kRounding);
  EXPECT_NEAR(nearest.x[1], 0.2, kRounding);
  EXPECT_NEAR(nearest.x[3], 0.2, kRounding);
  // Distance^2 = (d - 0.2)^2 / 2 + (d - 0.1)^2: d = 2/15.
  EXPECT_NEAR(nearest.x[4], 2.0 / 15.0, kRounding);
  EXPECT_NEAR(nearest.x[2] - nearest.x[0], 1.0 + 2.0 / 15.0, kRounding);
}

}  // namespace
}  // namespace contact_path::nearest_point_test
