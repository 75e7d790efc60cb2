// Algorithm 3.2, every increment by Ipopt, on the reference cases, against closed forms and independent
// results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "contact_path/path/mpec_method.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::mpec_cases_test {
namespace {

// Increments are equilibria to rounding. Largest distance from the closed forms that was measured: 9e-15 (sliding_bar,
// forces of order 10), 3e-16 (the others, of order 1).
constexpr double kClosedForm = 1e-13;

// Residuals that any accepted increment may have; measured up to 2e-15 (arch19).
constexpr double kResidual = 1e-9;

TraceRequest Example(const std::string& name, double step) {
  TraceRequest request = ReadExample(name);
  request.options.method = Method::kMpec;
  request.options.step = step;
  return request;
}

// To a stop criterion.
TracedPath TraceSound(const TraceRequest& request) {
  TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectSoundIncrements(path, kResidual);
  return path;
}

double SmallestLoadFactor(const TracedPath& path) {
  double smallest = 0.0;
  for (const Increment& increment : path.increments) smallest = std::min(smallest, increment.load_factor);
  return smallest;
}

// The traces that several tests look at are made once.
class SlidingBar : public testing::Test {
 protected:
  static const TracedPath& Path() {
    static const TracedPath path = TraceIncrements(Example("sliding_bar", 0.05));
    return path;
  }
  static double X(const Increment& increment) { return PositionX(Path(), increment, "b"); }
};

TEST_F(SlidingBar, ReachesItsEndWithSoundIncrements) {
  EXPECT_EQ(Path().result.reason, EndReason::kStopCriterion);
  EXPECT_GT(Path().increments.size(), 30u);
  ExpectSoundIncrements(Path(), kResidual);
}

TEST_F(SlidingBar, EveryIncrementIsOnTheClosedForm) {
  for (const Increment& increment : Path().increments) {
    const double x = X(increment);
    EXPECT_NEAR(PositionY(Path(), increment, "b"), 0.0, kClosedForm);
    EXPECT_NEAR(increment.load_factor, sliding_bar::LoadFactor(x), kClosedForm) << x;
    EXPECT_NEAR(increment.contacts[0].rn, sliding_bar::NormalReaction(x), kClosedForm) << x;
    EXPECT_NEAR(increment.contacts[0].rt, -sliding_bar::kFriction * sliding_bar::NormalReaction(x), kClosedForm) << x;
    EXPECT_TRUE(increment.index == 0 || increment.contacts[0].state == ContactState::kSlipPlus) << x;
  }
}

TEST_F(SlidingBar, SlidesOnAndNeverBack) {
  for (std::size_t i = 1; i < Path().increments.size(); ++i)
    EXPECT_GT(X(Path().increments[i]), X(Path().increments[i - 1]));
}

TEST_F(SlidingBar, BothLimitPointsAreBracketedAndNamed) {
  std::size_t limits = 0;
  for (std::size_t i = 2; i < Path().increments.size(); ++i) {
    const Increment& increment = Path().increments[i];
    if (increment.kind != IncrementKind::kSmoothLimit) {
      EXPECT_EQ(increment.kind, IncrementKind::kRegular);
      continue;
    }
    // The increment after the limit point: it lies within the last two increments.
    const double expected = limits++ == 0 ? sliding_bar::kFirstLimitX : sliding_bar::kSecondLimitX;
    EXPECT_LT(X(Path().increments[i - 2]), expected);
    EXPECT_GT(X(increment), expected);
  }
  EXPECT_EQ(limits, 2u);
}

TEST_F(SlidingBar, LimitLoadsComeOutToTheSquareOfTheStep) {
  const double largest = LargestLoadFactor(Path()), smallest = SmallestLoadFactor(Path());
  EXPECT_LE(largest, sliding_bar::kFirstLimit + 1e-9);  // the limit is known to 1e-9
  EXPECT_NEAR(largest, sliding_bar::kFirstLimit, 0.02);
  EXPECT_GE(smallest, sliding_bar::kSecondLimit - 1e-9);
  EXPECT_NEAR(smallest, sliding_bar::kSecondLimit, 0.02);
}

// Errors of the trapezoidal rule in the last increment, at three steps.
TEST(SlidingBarWorkByMpec, DissipationAndEnergyBalanceConvergeWithSecondOrder) {
  double dissipation_error = 0.0, balance_error = 0.0;
  for (const double step : {0.1, 0.05, 0.025}) {
    const TracedPath path = TraceIncrements(Example("sliding_bar", step));
    const Increment& last = path.increments.back();
    const double dissipation = std::abs(last.dissipation - sliding_bar::Dissipation(PositionX(path, last, "b")));
    const double balance =
        std::abs(last.external_work - last.dissipation - (last.strain_energy - path.increments[0].strain_energy));
    if (dissipation_error > 0.0) {
      EXPECT_GT(dissipation_error / dissipation, 3.0) << step;
      EXPECT_GT(balance_error / balance, 3.0) << step;
    }
    dissipation_error = dissipation;
    balance_error = balance;
  }
  EXPECT_LE(dissipation_error, 1e-3 * sliding_bar::Dissipation(5.0));
  EXPECT_LE(balance_error, 1e-3 * sliding_bar::Dissipation(5.0));
}

class RoughTruss : public testing::Test {
 protected:
  static const TracedPath& Path() {
    static const TracedPath path = TraceIncrements(Example("rough_truss", 0.05));
    return path;
  }
};

TEST_F(RoughTruss, ReachesItsEndWithSoundIncrements) {
  EXPECT_EQ(Path().result.reason, EndReason::kStopCriterion);
  ExpectSoundIncrements(Path(), kResidual);
}

TEST_F(RoughTruss, EveryIncrementIsOnOneOfTheTwoArcs) {
  std::size_t stuck = 0, sliding = 0;
  for (const Increment& increment : Path().increments) {
    const double foot = PositionX(Path(), increment, "foot"), apex = PositionY(Path(), increment, "apex");
    switch (increment.contacts[0].state) {
      case ContactState::kStick:
        ++stuck;
        EXPECT_NEAR(foot, rough_truss::kHalfSpan, kClosedForm);
        EXPECT_NEAR(increment.load_factor, rough_truss::StickingLoad(apex), kClosedForm);
        break;
      case ContactState::kSlipPlus:
        ++sliding;
        EXPECT_NEAR(apex / (0.5 * (foot + rough_truss::kHalfSpan)), 1.0 / rough_truss::kFriction, kClosedForm);
        EXPECT_NEAR(increment.load_factor, rough_truss::SlidingLoad(foot), kClosedForm);
        break;
      default: EXPECT_NEAR(increment.load_factor, 0.0, kClosedForm);
    }
    EXPECT_NEAR(increment.contacts[0].rn, 0.5 * increment.load_factor, kClosedForm);
  }
  EXPECT_GT(stuck, 3u);
  EXPECT_GT(sliding, 3u);
}

TEST_F(RoughTruss, LoadFallsInAStraightLineWhileTheFootSlides) {
  const std::vector<Increment>& increments = Path().increments;
  for (std::size_t i = LargestLoad(Path()) + 1; i < increments.size(); ++i) {
    if (increments[i].contacts[0].state != ContactState::kSlipPlus ||
        increments[i - 1].contacts[0].state != ContactState::kSlipPlus)
      continue;
    const double foot = PositionX(Path(), increments[i], "foot"), before = PositionX(Path(), increments[i - 1], "foot");
    ASSERT_GT(foot, before);
    const double slope = (increments[i].load_factor - increments[i - 1].load_factor) / (foot - before);
    // l0 and the slope of the bars are constants of the case: ds / dx = -tan(a) / l0.
    EXPECT_NEAR(slope, -1.0 / std::hypot(1.0, 1.2), 1e-10);
  }
}

TEST_F(RoughTruss, DissipatesWhatIsLeftInTheBarsAtTheCorner) {
  // Cutting the corner short and the last arc to s = 0 short; measured 5e-6 of 7e-3.
  EXPECT_NEAR(Path().increments.back().dissipation, rough_truss::TotalDissipation(), 1e-5);
  // On the straight arc the trapezoidal rule is exact: between any two sliding increments.
  const Increment *first = nullptr, *last = nullptr;
  for (const Increment& increment : Path().increments) {
    if (increment.contacts[0].state != ContactState::kSlipPlus) continue;
    if (first == nullptr) first = &increment;
    last = &increment;
  }
  ASSERT_NE(first, last);
  EXPECT_NEAR(last->dissipation - first->dissipation,
              rough_truss::Dissipation(PositionX(Path(), *last, "foot")) -
                  rough_truss::Dissipation(PositionX(Path(), *first, "foot")),
              kClosedForm);
}

// Jumping early onto the sliding branch would show here, at every step: 7 to 30 % too low.
TEST(RoughTrussCorner, LargestLoadIsTheCornerLoadAtStepsThatDifferAHundredfold) {
  for (const double step : {0.05, 0.005, 0.0005}) {
    TraceRequest request = Example("rough_truss", step);
    request.options.stop = {{"foot.x", ">", 1.005}};
    const TracedPath path = TraceSound(request);
    const double largest = LargestLoadFactor(path);
    EXPECT_NEAR(largest, rough_truss::CornerLoad(), 0.01 * rough_truss::CornerLoad()) << step;
    EXPECT_LE(largest, rough_truss::CornerLoad() + kClosedForm) << step;
  }
}

TEST(RoughTrussCorner, IsCutByNoMoreThanTheAccuracyAllows) {
  for (const Accuracy accuracy : kPresets) {
    TraceRequest request = Example("rough_truss", 0.05);
    request.options.accuracy = accuracy;
    request.options.stop = {{"foot.x", ">", 1.005}};
    const TracedPath path = TraceIncrements(request);
    ExpectSoundIncrements(path, kResidual);
    const double largest = LargestLoadFactor(path);
    EXPECT_NEAR(largest, rough_truss::CornerLoad(), MpecOptions::For(request.options, 1.0).corner_tolerance);
    EXPECT_LE(largest, rough_truss::CornerLoad() + kClosedForm) << ToString(accuracy);
  }
}

class TwoDofFriction : public testing::Test {
 protected:
  static const TracedPath& Path() {
    static const TracedPath path = TraceIncrements(Example("two_dof_friction", 0.1));
    return path;
  }
};

TEST_F(TwoDofFriction, ReachesItsEndWithSoundIncrements) {
  EXPECT_EQ(Path().result.reason, EndReason::kStopCriterion);
  ExpectSoundIncrements(Path(), kResidual);
}

TEST_F(TwoDofFriction, ThreeStretches) {
  // Stick: u = 0. Slip: u_y = 0, s = 1 - u_x / 2. Open: K u = (s, -1), so s = 0.375 + 0.4375 u_x.
  std::size_t stretches[3] = {0, 0, 0};
  for (const Increment& increment : Path().increments) {
    const double x = PositionX(Path(), increment, "p"), y = PositionY(Path(), increment, "p");
    switch (increment.contacts[0].state) {
      case ContactState::kStick:
        ++stretches[0];
        EXPECT_NEAR(x, 0.0, kClosedForm);
        EXPECT_NEAR(increment.contacts[0].rn, 1.0, kClosedForm);
        EXPECT_NEAR(increment.contacts[0].rt, -increment.load_factor, kClosedForm);
        break;
      case ContactState::kSlipPlus:
        ++stretches[1];
        EXPECT_NEAR(y, 0.0, kClosedForm);
        EXPECT_NEAR(increment.load_factor, 1.0 - 0.5 * x, kClosedForm);
        EXPECT_NEAR(increment.contacts[0].rn, 1.0 - 1.5 * x, kClosedForm);
        break;
      case ContactState::kOpen:
        ++stretches[2];
        EXPECT_NEAR(increment.load_factor, 0.375 + 0.4375 * x, kClosedForm);
        EXPECT_NEAR(y, (1.5 * x - 1.0) / 4.0, kClosedForm);
        break;
      default: ADD_FAILURE() << ToString(increment.contacts[0].state);
    }
  }
  for (const std::size_t increments : stretches) EXPECT_GT(increments, 3u);
}

TEST_F(TwoDofFriction, CornersAreNamedAndNear) {
  // A corner is cut by no more than the corner tolerance, 5e-4 by default, and the increment after it is up to a step
  // away.
  const std::vector<Increment>& increments = Path().increments;
  double largest = 0.0, after_slip = 1.0, lift_off = 0.0;
  std::size_t corners = 0;
  for (std::size_t i = 1; i < increments.size(); ++i) {
    if (increments[i].kind == IncrementKind::kCornerLimit) ++corners;
    EXPECT_NE(increments[i].kind, IncrementKind::kSmoothLimit);
    if (increments[i].contacts[0].state != ContactState::kOpen) largest = std::max(largest, increments[i].load_factor);
    if (increments[i].contacts[0].state == ContactState::kSlipPlus)
      after_slip = std::min(after_slip, increments[i].load_factor);
    if (increments[i].contacts[0].state == ContactState::kOpen && lift_off == 0.0) lift_off = increments[i].load_factor;
    // From stick to slip to open, and never back.
    EXPECT_GE(increments[i].contacts[0].state == ContactState::kOpen,
              increments[i - 1].contacts[0].state == ContactState::kOpen);
    EXPECT_GE(increments[i].contacts[0].state != ContactState::kStick,
              increments[i - 1].contacts[0].state != ContactState::kStick);
  }
  EXPECT_EQ(corners, 2u);
  EXPECT_NEAR(largest, 1.0, 1e-3);
  EXPECT_LE(largest, 1.0 + kClosedForm);
  EXPECT_NEAR(after_slip, 2.0 / 3.0, 1e-3);
  EXPECT_NEAR(lift_off, 2.0 / 3.0, 1e-3);
}

TEST_F(TwoDofFriction, DissipatesTheFrictionOverTheSlip) {
  // Integral of 1 - 1.5 x from 0 to 2/3. The trapezoidal rule is exact; the corners are cut, by up to 5e-4 each.
  EXPECT_NEAR(Path().increments.back().dissipation, 1.0 / 3.0, 1e-6);
}

// Limit loads at the square of the step, by the largest and smallest increment.
TEST(VonMises, BiotLimits) {
  for (const auto& [half_span, rise] : {std::pair(1.0, 1.0), std::pair(1.0, 0.3)}) {
    TraceRequest request = Example("von_mises", 0.01 * rise);
    request.scene.nodes[0].x = -half_span;
    request.scene.nodes[1].y = rise;
    request.scene.nodes[2].x = half_span;
    request.options.stop = {{"apex.y", "<", -1.1 * rise}};
    const TracedPath path = TraceSound(request);
    for (const Increment& increment : path.increments) {
      const double y = PositionY(path, increment, "apex");
      EXPECT_NEAR(PositionX(path, increment, "apex"), 0.0, kClosedForm);
      EXPECT_NEAR(increment.load_factor, von_mises::BiotLoad(half_span, rise, y), kClosedForm) << y;
      EXPECT_TRUE(increment.kind == IncrementKind::kStart || increment.kind == IncrementKind::kRegular ||
                  increment.kind == IncrementKind::kSmoothLimit);
    }
    EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSmoothLimit).size(), 2u);
    const double limit = von_mises::BiotLimit(half_span, rise);
    EXPECT_NEAR(LargestLoadFactor(path), limit, 1e-3 * limit);
    EXPECT_NEAR(SmallestLoadFactor(path), -limit, 1e-3 * limit);
  }
}

TEST(VonMises, GreenLagrangeLimits) {
  TraceRequest request = Example("von_mises", 0.01);
  for (Bar& bar : request.scene.bars) bar.strain = StrainMeasure::kGreenLagrange;
  const TracedPath path = TraceSound(request);
  double largest = 0.0, smallest = 0.0;
  for (const Increment& increment : path.increments) {
    // s = EA y (h^2 - y^2) / l0^3
    const double y = PositionY(path, increment, "apex");
    EXPECT_NEAR(increment.load_factor, y * (1.0 - y * y) / std::pow(2.0, 1.5), kClosedForm) << y;
    if (std::abs(y) > 1.0) continue;  // snapped through, and pulled on
    largest = std::max(largest, increment.load_factor);
    smallest = std::min(smallest, increment.load_factor);
  }
  const double limit = von_mises::GreenLagrangeLimit(1.0, 1.0);
  EXPECT_NEAR(largest, limit, 1e-3 * limit);
  EXPECT_NEAR(smallest, -limit, 1e-3 * limit);
}

TEST(RigidStop, KinkWhereTheGapCloses) {
  const TracedPath path = TraceSound(Example("rigid_stop", 0.02));
  std::size_t open = 0, closed = 0;
  for (const Increment& increment : path.increments) {
    const double x = PositionX(path, increment, "b");
    if (increment.contacts[0].state == ContactState::kOpen) {
      ++open;
      EXPECT_EQ(closed, 0u);
      EXPECT_NEAR(x, 1.0 + increment.load_factor, kClosedForm);
      EXPECT_LE(increment.load_factor, 0.1 + kClosedForm);
    } else {
      ++closed;
      EXPECT_NEAR(x, 1.1, kClosedForm);
      EXPECT_NEAR(increment.contacts[0].rn, increment.load_factor - 0.1, kClosedForm);
    }
  }
  EXPECT_GT(open, 3u);
  EXPECT_GT(closed, 3u);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kContactEvent).size(), 1u);
}

// A block of weight 1 on a rough floor, dragged by a bar that is stretched from 0.8 to 1 at the start: increment 0 is
// where friction 0.1 stops it, at 0.8 (1 + 0.1). Pulled on with s, it sticks until the bar would push: s = 0.2.
TEST(Prestress, IncrementZeroIsInEquilibriumWithItsFrictionHistory) {
  TraceRequest request;
  request.options.method = Method::kMpec;
  request.options.step = 0.05;
  request.options.stop = {{"load_factor", ">", 0.3}};
  request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, false}};
  request.scene.bars = {{{"a", "b"}, 1.0, 0.8, StrainMeasure::kBiot}};
  request.scene.loads = {{"b", 1.0, 0.0, false}, {"b", 0.0, -1.0, true}};
  request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.1}};
  request.scene.contacts = {{"b", "floor"}};
  const TracedPath path = TraceSound(request);
  EXPECT_NEAR(PositionX(path, path.increments[0], "b"), 0.88, kClosedForm);
  EXPECT_NEAR(path.increments[0].contacts[0].rn, 1.0, kClosedForm);
  EXPECT_NEAR(path.increments[0].contacts[0].rt, 0.1, kClosedForm);
  EXPECT_EQ(path.increments[0].contacts[0].state, ContactState::kSlipMinus);
  for (const Increment& increment : path.increments) {
    if (increment.index == 0) continue;
    const double x = PositionX(path, increment, "b");
    if (increment.contacts[0].state == ContactState::kStick)
      EXPECT_NEAR(x, 0.88, kClosedForm);
    else
      EXPECT_NEAR(x / 0.8 - 1.0, increment.load_factor - 0.1, kClosedForm);
  }
  EXPECT_EQ(path.increments[1].contacts[0].state, ContactState::kStick);
  EXPECT_EQ(path.increments.back().contacts[0].state, ContactState::kSlipPlus);
}

TEST(Prestress, FreeTrussGoesToItsRestLength) {
  TraceRequest request = Example("von_mises", 0.05);
  request.options.max_increments = 40;
  request.options.stop = {{"load_factor", ">", 0.02}};
  for (Bar& bar : request.scene.bars) bar.rest_length = 1.3;
  request.scene.loads.push_back({"apex", 0.0, -0.05, true});
  const TracedPath path = TraceSound(request);
  const double y = PositionY(path, path.increments[0], "apex");
  EXPECT_NEAR(2.0 * y * (1.0 / std::hypot(1.0, y) - 1.0 / 1.3), 0.05, kClosedForm);
}

}  // namespace
}  // namespace contact_path::mpec_cases_test
