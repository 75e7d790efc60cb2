#include "contact_path/path/work.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/reference_cases.h"

namespace contact_path::work_test {
namespace {

class SlidingBarWork : public testing::Test {
 protected:
  PathPoint At(double x, ContactState state) const {
    PathPoint point = model_.InitialPoint();
    point.u = Eigen::Vector2d(x, 0.0) / model_.scaling.length;
    point.s = sliding_bar::LoadFactor(x) / model_.scaling.load_factor;
    point.rn[0] = sliding_bar::NormalReaction(x) / model_.scaling.force;
    point.rt[0] = -sliding_bar::kFriction * point.rn[0];
    point.states = {state};
    return point;
  }
  // Over [-5, 4] in equal increments.
  Work Total(int increments) const {
    Work total;
    for (int i = 0; i < increments; ++i) {
      const double from = -5.0 + 9.0 * i / increments, to = -5.0 + 9.0 * (i + 1) / increments;
      const Work work = WorkOfIncrement(model_, At(from, ContactState::kSlipPlus), At(to, ContactState::kSlipPlus));
      total.friction += work.friction;
      total.loads += work.loads;
    }
    return total;
  }
  double Energy(double x) const {
    const double strain = std::hypot(x, sliding_bar::kHeight) / sliding_bar::kRestLength - 1.0;
    return 0.5 * sliding_bar::kEA * sliding_bar::kRestLength * strain * strain;
  }

  const Scene scene_ = sliding_bar::MakeScene();
  const Model model_{scene_, CharacteristicScales(scene_)};
};

TEST_F(SlidingBarWork, ConvergesToTheIntegralsWithSecondOrder) {
  double friction_error = 0.0, loads_error = 0.0;
  for (const int increments : {40, 80, 160, 320}) {
    const Work work = Total(increments);
    const double friction = std::abs(work.friction - sliding_bar::Dissipation(4.0));
    const double loads = std::abs(work.loads - sliding_bar::Dissipation(4.0) - Energy(4.0));
    if (increments > 40) {
      EXPECT_NEAR(friction_error / friction, 4.0, 0.1) << increments;
      EXPECT_NEAR(loads_error / loads, 4.0, 0.1) << increments;
    }
    friction_error = friction;
    loads_error = loads;
  }
  EXPECT_LE(friction_error, 1e-3);
}

TEST_F(SlidingBarWork, FrictionTakesWorkWhicheverWayItSlides) {
  const PathPoint left = At(-3.0, ContactState::kSlipMinus), right = At(-2.5, ContactState::kSlipPlus);
  EXPECT_GT(WorkOfIncrement(model_, left, right).friction, 0.0);
  EXPECT_EQ(WorkOfIncrement(model_, right, left).friction, WorkOfIncrement(model_, left, right).friction);
  EXPECT_LT(WorkOfIncrement(model_, right, left).loads, 0.0);
}

TEST_F(SlidingBarWork, OnlySlipDissipates) {
  for (const ContactState state : {ContactState::kOpen, ContactState::kStick, ContactState::kClosed}) {
    const Work work = WorkOfIncrement(model_, At(-3.0, ContactState::kSlipPlus), At(-2.5, state));
    EXPECT_EQ(work.friction, 0.0) << ToString(state);
    EXPECT_NE(work.loads, 0.0) << ToString(state);
  }
}

TEST(Work, ConstantLoadsWorkAlsoAtLoadFactorZero) {
  Scene scene = sliding_bar::MakeScene();
  scene.loads.push_back({"b", 0.25, -2.0, true});
  const Model model(scene, CharacteristicScales(scene));
  PathPoint from = model.InitialPoint(), to = from;
  to.u += Eigen::Vector2d(4.0, 1.0) / model.scaling.length;
  to.states = {ContactState::kOpen};
  EXPECT_NEAR(WorkOfIncrement(model, from, to).loads, 0.25 * 4.0 - 2.0 * 1.0, 1e-14);
}

}  // namespace
}  // namespace contact_path::work_test
