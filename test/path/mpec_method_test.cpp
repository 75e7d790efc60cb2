#include "contact_path/path/mpec_method.h"

#include <gtest/gtest.h>

#include "contact_path/path/preload.h"
#include "contact_path/path/work.h"
#include "support/parts.h"
#include "support/reference_cases.h"

namespace contact_path::mpec_method_test {
namespace {

// Accepted points are exact; measured up to 3e-16 in scaled quantities.
constexpr double kRounding = 1e-14;

MpecOptions Options(double step, double direction = 1.0) {
  TraceOptions options;
  options.method = Method::kMpec;
  options.step = step;
  options.direction = direction;
  return MpecOptions::For(options, 1);
}

TEST(MpecOptions, MoreAccuracyMeansSmallerEverything) {
  TraceOptions options;
  options.accuracy = Accuracy::kFast;
  const MpecOptions fast = MpecOptions::For(options, 1);
  options.accuracy = Accuracy::kBalanced;
  const MpecOptions balanced = MpecOptions::For(options, 1);
  options.accuracy = Accuracy::kAccurate;
  const MpecOptions accurate = MpecOptions::For(options, 1);
  for (const auto& [coarse, fine] : {std::pair(fast, balanced), std::pair(balanced, accurate)}) {
    EXPECT_GT(coarse.step, fine.step);
    EXPECT_GT(coarse.corner_tolerance, fine.corner_tolerance);
    EXPECT_GT(fine.smallest_step, 0.0);
    EXPECT_LT(fine.smallest_step, 1e-3 * fine.step);
  }
}

class SlidingBarMethod : public testing::Test {
 protected:
  const Model model_{sliding_bar::MakeScene(), CharacteristicScales(sliding_bar::MakeScene())};
};

TEST_F(SlidingBarMethod, GivesOneExactIncrementAtATime) {
  MpecMethod method(model_, Options(0.05), nullptr);
  PathPoint point = model_.InitialPoint();
  for (int i = 0; i < 5; ++i) {
    const Advance advance = method.Next(point);
    ASSERT_FALSE(advance.end) << EndText(advance.end->causes);
    ASSERT_TRUE(advance.increment);
    const AcceptedPoint& increment = *advance.increment;
    EXPECT_LE(increment.residuals.equilibrium, kRounding);
    EXPECT_LE(increment.residuals.Contact(), kRounding);
    EXPECT_TRUE(increment.solve.exact);
    EXPECT_EQ(increment.solve.method, Method::kMpec);
    EXPECT_GT(increment.solve.regularisation, 0.0);
    EXPECT_EQ(increment.solve.variables, 6);
    EXPECT_EQ(increment.solve.constraints, 9);
    EXPECT_DOUBLE_EQ(increment.arc_length, Distance(point, increment.point));
    EXPECT_EQ(increment.work.friction, WorkOfIncrement(model_, point, increment.point).friction);
    point = increment.point;
  }
}

TEST_F(SlidingBarMethod, EndsAtTheTarget) {
  MpecOptions options = Options(0.05);
  options.targets = {0.112};
  MpecMethod method(model_, options, nullptr);
  PathPoint point = model_.InitialPoint();
  int increments = 0;
  while (point.s < options.targets[0]) {
    const Advance advance = method.Next(point);
    ASSERT_TRUE(advance.increment);
    EXPECT_LE(advance.increment->residuals.Largest(), kRounding);
    point = advance.increment->point;
    ++increments;
  }
  EXPECT_NEAR(point.s, options.targets[0], kRounding);
  EXPECT_GE(increments, 2);
}

TEST_F(SlidingBarMethod, CancelledGivesNoIncrement) {
  bool cancel = false;
  MpecMethod method(model_, Options(0.05), [&] { return cancel; });
  const Advance first = method.Next(model_.InitialPoint());
  ASSERT_FALSE(first.end);
  cancel = true;
  const Advance second = method.Next(first.increment->point);
  ASSERT_TRUE(second.end);
  EXPECT_FALSE(second.increment);
  EXPECT_EQ(second.end->reason, EndReason::kCancelled);
  cancel = false;
  EXPECT_FALSE(method.Next(first.increment->point).end);
}

// A block of weight 1 with mu = 0.3, pulled against a spring of stiffness 1: load up to 1, down to 0, up to 1.
//   up: stick to s = 0.3, then u = s - 0.3; down: stick to s = 0.4, then u = s + 0.3; up again: stick to s = 0.6.
// Each later half cycle slides over 0.4 against mu N = 0.3.
class StickSlipCycle : public testing::Test {
 protected:
  StickSlipCycle() {
    scene_ = NodeOnFloor("p", 1.0, 0.3);
    scene_.loads = {{"p", 1.0, 0.0, false}, {"p", 0.0, -1.0, true}};
  }

  // From *point until the load factor passes `target`; every increment is on the expected line. Returns the
  // dissipation.
  double Drive(const Model& model, double direction, double target, double stick_until, double offset,
               PathPoint* point) {
    MpecMethod method(model, Options(0.15, direction), nullptr);
    const double held = point->u[0];
    double dissipation = 0.0;
    for (int i = 0; i < 100 && direction * (point->s - target) < 0.0; ++i) {
      const Advance advance = method.Next(*point);
      EXPECT_FALSE(advance.end) << EndText(advance.end->causes);
      if (advance.end) return dissipation;
      if (advance.increment) {
        const AcceptedPoint& increment = *advance.increment;
        const double s = increment.point.s;
        const bool sticks = direction * (s - stick_until) < 0.0;
        EXPECT_NEAR(increment.point.u[0], sticks ? held : s + offset, 1e-3) << s;  // a corner is cut by less than this
        if (!sticks && StateOf(increment.point, 0) != ContactState::kStick) {
          EXPECT_NEAR(increment.point.u[0], s + offset, kRounding) << s;
          EXPECT_EQ(StateOf(increment.point, 0), direction > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus)
              << s;
        }
        dissipation += increment.work.friction;
        *point = increment.point;
      }
    }
    return dissipation;
  }

  Scene scene_;
};

TEST_F(StickSlipCycle, DissipatesFrictionTimesTheWayInEveryCycle) {
  const Model model(scene_, CharacteristicScales(scene_));
  ASSERT_NEAR(model.scaling.length, 1.0, 1e-14);  // so that the numbers below are those of the scene
  ASSERT_NEAR(model.scaling.load_factor, 1.0, 1e-14);
  Preload preload = TracePreload(model, 100, [](const Model& of, double target) {
    MpecOptions options = Options(0.1);
    options.targets = {target};
    return std::make_unique<MpecMethod>(of, options, nullptr);
  });
  ASSERT_TRUE(preload.done) << EndText(preload.end.causes);
  PathPoint point = preload.point;
  Drive(model, +1.0, 1.0, 0.3, -0.3, &point);
  const double top_s = point.s, top_u = point.u[0];
  EXPECT_NEAR(top_u, top_s - 0.3, kRounding);
  double dissipation = Drive(model, -1.0, 0.0, top_s - 0.6, 0.3, &point);
  const double bottom_s = point.s, bottom_u = point.u[0];
  EXPECT_NEAR(bottom_u, bottom_s + 0.3, kRounding);
  dissipation += Drive(model, +1.0, 1.0, bottom_s + 0.6, -0.3, &point);
  EXPECT_NEAR(point.u[0], point.s - 0.3, kRounding);
  const double distance = (top_u - bottom_u) + (point.u[0] - bottom_u);
  EXPECT_GE(distance, 0.8);  // it turns in the increment after the load was reached
  EXPECT_NEAR(dissipation, 0.3 * distance, kRounding);
}

}  // namespace
}  // namespace contact_path::mpec_method_test
