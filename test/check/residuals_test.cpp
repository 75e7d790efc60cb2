#include "contact_path/check/residuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/scaling.h"
#include "support/reference_cases.h"
#include "support/transformations.h"

namespace contact_path::residuals_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();

// Residuals of exact states that were rounded to double: a unit in the last place of terms up to 1.
constexpr double kRounding = 1e-15;

// The bar of sliding_bar::MakeScene(), loaded by (s, 0) at b, which starts at (-h, 0).
using sliding_bar::kFriction;
using sliding_bar::kHeight;
constexpr double kAxialStiffness = sliding_bar::kEA;

// EA (1/l - 1/l0), the force of the bar on b over the vector from a to b.
long double Push(long double x, long double y) {
  const long double height = static_cast<long double>(kHeight) - y;
  return kAxialStiffness * (1.0L / std::hypot(x, height) - 1.0L / (kHeight * std::sqrt(2.0L)));
}

// The closed form: b at (x, 0) slides towards +x.
CheckedState SlidingAt(double x) {
  CheckedState state;
  const long double rn = kHeight * Push(x, 0.0L);
  state.load_factor = static_cast<double>(Push(x, 0.0L) * (kHeight * static_cast<long double>(kFriction) - x));
  state.positions = {0.0, kHeight, x, 0.0};
  state.rn = {static_cast<double>(rn)};
  state.rt = {static_cast<double>(-kFriction * rn)};
  return state;
}

class SlidingBarResiduals : public testing::Test {
 protected:
  const Scene scene_ = sliding_bar::MakeScene();
  const double length_ = CharacteristicScales(scene_).length;
  const double force_ = CharacteristicScales(scene_).force;
  const double x_ = -1.0;
  const double slip_ = 0.1;  // from before to now
  const CheckedState before_ = SlidingAt(x_ - slip_);
  CheckedState now_ = SlidingAt(x_);

  Residuals Check() const { return ResidualCheck(scene_).Check(before_, now_); }
};

TEST_F(SlidingBarResiduals, ScalesAreThoseOfTheHandComputedCases) {
  EXPECT_NEAR(length_, kHeight * std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(force_, kAxialStiffness, 1e-14);
}

TEST_F(SlidingBarResiduals, ClosedFormLeavesNothing) {
  for (double x = -4.9; x < 5.0; x += 0.1) {
    EXPECT_LE(ResidualCheck(scene_).Check(SlidingAt(x - slip_), SlidingAt(x)).Largest(), 1e-16) << x;
  }
}

TEST_F(SlidingBarResiduals, FirstIncrementHasNoMotion) {
  EXPECT_LE(ResidualCheck(scene_).Check(now_, now_).Largest(), 1e-16);
}

TEST_F(SlidingBarResiduals, LoadFactorOff) {
  now_.load_factor += 0.01;
  EXPECT_NEAR(Check().equilibrium, 0.01 / force_, kRounding);
  EXPECT_LE(Check().Contact(), kRounding);
}

TEST_F(SlidingBarResiduals, PositionOff) {
  const double off = 0.01;
  now_.positions[2] += off;
  const long double before = Push(x_, 0.0L);
  const long double after = Push(x_ + off, 0.0L);
  const double along = static_cast<double>(std::abs((x_ + off) * after - x_ * before)) / force_;
  const double across = static_cast<double>(std::abs(kHeight * (after - before))) / force_;
  EXPECT_NEAR(Check().equilibrium, std::max(along, across), kRounding);
  EXPECT_GT(Check().equilibrium, 1e-4);
  EXPECT_LE(Check().Contact(), kRounding);
}

TEST_F(SlidingBarResiduals, NormalReactionTooLarge) {
  now_.rn[0] += 0.01;
  const Residuals residuals = Check();
  EXPECT_NEAR(residuals.equilibrium, 0.01 / force_, kRounding);
  EXPECT_NEAR(residuals.friction_law, kFriction * 0.01 / force_, kRounding);  // slips inside the cone
  EXPECT_EQ(residuals.cone, 0.0);
}

TEST_F(SlidingBarResiduals, TangentialReactionOutsideTheCone) {
  now_.rt[0] -= 0.01;
  const Residuals residuals = Check();
  EXPECT_NEAR(residuals.equilibrium, 0.01 / force_, kRounding);
  EXPECT_NEAR(residuals.cone, 0.01 / force_, kRounding);
  EXPECT_NEAR(residuals.friction_law, 0.01 / force_, kRounding);
  EXPECT_NEAR(residuals.Contact(), 0.01 / force_, kRounding);
}

TEST_F(SlidingBarResiduals, TangentialReactionOfTheWrongSign) {
  const double twice = 2.0 * kFriction * now_.rn[0] / force_;
  now_.rt[0] = -now_.rt[0];
  EXPECT_NEAR(Check().equilibrium, twice, kRounding);
  EXPECT_NEAR(Check().friction_law, slip_ / length_, kRounding);
  EXPECT_LE(Check().cone, kRounding);
  // After a long slip, the distance of the two reactions is the smaller of the two.
  EXPECT_NEAR(ResidualCheck(scene_).Check(SlidingAt(x_ - 3.0), now_).friction_law, twice, kRounding);
}

TEST_F(SlidingBarResiduals, SlipAlongTheReaction) {
  const Residuals residuals = ResidualCheck(scene_).Check(SlidingAt(x_ + slip_), now_);
  EXPECT_NEAR(residuals.friction_law, slip_ / length_, kRounding);
  EXPECT_NEAR(residuals.Contact(), slip_ / length_, kRounding);
  EXPECT_LE(residuals.equilibrium, 1e-16);
}

TEST_F(SlidingBarResiduals, StickingInsideTheConeIsAdmissible) {
  now_.rt[0] *= 0.5;
  EXPECT_EQ(ResidualCheck(scene_).Check(now_, now_).friction_law, 0.0);
  EXPECT_NEAR(Check().friction_law, std::min(slip_ / length_, 0.5 * kFriction * now_.rn[0] / force_), kRounding);
}

TEST_F(SlidingBarResiduals, Penetration) {
  now_.positions[3] = -0.01;
  const Residuals residuals = Check();
  EXPECT_NEAR(residuals.penetration, 0.01 / length_, kRounding);
  EXPECT_NEAR(residuals.complementarity, 0.01 / length_, kRounding);
  EXPECT_EQ(residuals.tensile_reaction, 0.0);
  EXPECT_LE(residuals.friction_law, kRounding);
}

TEST_F(SlidingBarResiduals, Adhesion) {
  now_.rn[0] = -0.01;
  now_.rt[0] = 0.0;
  const Residuals residuals = Check();
  EXPECT_NEAR(residuals.tensile_reaction, 0.01 / force_, kRounding);
  EXPECT_NEAR(residuals.complementarity, 0.01 / force_, kRounding);
  EXPECT_NEAR(residuals.cone, kFriction * 0.01 / force_, kRounding);
  EXPECT_EQ(residuals.penetration, 0.0);
  EXPECT_EQ(residuals.friction_law, 0.0);
}

TEST_F(SlidingBarResiduals, ReactionAcrossAGap) {
  now_.positions[3] = 0.01;
  EXPECT_NEAR(Check().complementarity, 0.01 / length_, kRounding);  // the gap is the smaller
  now_.positions[3] = 3.0;
  EXPECT_NEAR(Check().complementarity, now_.rn[0] / force_, kRounding);  // the reaction is
  EXPECT_EQ(Check().penetration, 0.0);
}

TEST_F(SlidingBarResiduals, OpenContactMovesFreely) {
  now_.positions = {0.0, kHeight, 3.0, 1.0};
  now_.rn = now_.rt = {0.0};
  EXPECT_EQ(Check().Contact(), 0.0);
}

TEST_F(SlidingBarResiduals, SupportsTakeAnyForce) {
  Scene held = scene_;
  held.nodes[1].fixed_y = true;
  now_.rn = now_.rt = {0.0};
  now_.load_factor = static_cast<double>(-x_ * Push(x_, 0.0L));
  EXPECT_LE(ResidualCheck(held).Check(before_, now_).equilibrium, 1e-16);
  EXPECT_NEAR(Check().equilibrium, static_cast<double>(kHeight * Push(x_, 0.0L)) / force_, kRounding);
}

TEST_F(SlidingBarResiduals, ConstantLoadIsNotScaled) {
  Scene loaded = scene_;
  loaded.loads.push_back({"b", 0.0, -0.25, true});
  now_.rn[0] += 0.25;
  now_.rt[0] = -kFriction * now_.rn[0];
  now_.load_factor += kFriction * 0.25;
  EXPECT_LE(ResidualCheck(loaded).Check(before_, now_).Largest(), kRounding);
}

TEST_F(SlidingBarResiduals, MirrorImageSlidesTowardsMinus) {
  Scene mirrored = scene_;
  mirrored.nodes[1].x = kHeight;
  const auto mirror = [](CheckedState state) {
    state.positions[2] = -state.positions[2];
    state.load_factor = -state.load_factor;
    state.rt[0] = -state.rt[0];
    return state;
  };
  const CheckedState now = mirror(now_);
  EXPECT_GT(now.rt[0], 0.0);
  EXPECT_LE(ResidualCheck(mirrored).Check(mirror(before_), now).Largest(), 1e-16);
}

TEST_F(SlidingBarResiduals, NormalOfAnyLength) {
  Scene stretched = scene_;
  stretched.obstacles[0].ny = 7.0;
  now_.positions[3] = -0.01;
  EXPECT_NEAR(ResidualCheck(stretched).Check(before_, now_).equilibrium, Check().equilibrium, kRounding);
  EXPECT_NEAR(ResidualCheck(stretched).Check(before_, now_).penetration, 0.01 / length_, kRounding);
}

TEST_F(SlidingBarResiduals, TurnedScene) {
  for (const double angle : {0.5, 1.5707963267948966, 3.0, -2.0}) {
    const long double cosine = std::cos(static_cast<long double>(angle));
    const long double sine = std::sin(static_cast<long double>(angle));
    const auto turn = [&](double& x, double& y) {
      const long double turned = cosine * x - sine * y;
      y = static_cast<double>(sine * x + cosine * y);
      x = static_cast<double>(turned);
    };
    Scene turned = scene_;
    for (Node& node : turned.nodes) turn(node.x, node.y);
    for (Load& load : turned.loads) turn(load.fx, load.fy);
    for (Obstacle& obstacle : turned.obstacles) turn(obstacle.nx, obstacle.ny);
    CheckedState before = before_;
    turn(before.positions[0], before.positions[1]);
    turn(before.positions[2], before.positions[3]);
    CheckedState now = now_;
    turn(now.positions[0], now.positions[1]);
    turn(now.positions[2], now.positions[3]);
    EXPECT_LE(ResidualCheck(turned).Check(before, now).Largest(), kRounding) << angle;
    EXPECT_NEAR(ResidualCheck(turned).Check(now, before).friction_law,
                ResidualCheck(scene_).Check(now_, before_).friction_law, kRounding)
        << angle;
  }
}

TEST_F(SlidingBarResiduals, LargestOfSeveralContactsWhateverTheOrder) {
  Scene cornered = scene_;
  cornered.obstacles.push_back({"wall", ObstacleShape::kHalfPlane, x_ + 0.5, 0.0, -1.0, 0.0, 0.0});
  cornered.contacts = {{"b", "wall"}, {"b", "floor"}};
  now_.positions[2] = x_ + 0.52;  // 0.02 behind the wall
  now_.positions[3] = -0.01;
  CheckedState now = now_;
  now.rn = {0.0, now_.rn[0]};
  now.rt = {0.0, now_.rt[0]};
  CheckedState before = before_;
  before.rn = before.rt = {0.0, 0.0};
  EXPECT_NEAR(ResidualCheck(cornered).Check(before, now).penetration, 0.02 / length_, kRounding);
  std::swap(cornered.contacts[0], cornered.contacts[1]);
  std::swap(now.rn[0], now.rn[1]);
  std::swap(now.rt[0], now.rt[1]);
  EXPECT_NEAR(ResidualCheck(cornered).Check(before, now).penetration, 0.02 / length_, kRounding);
}

TEST_F(SlidingBarResiduals, FrictionlessContactTakesNoTangentialReaction) {
  Scene smooth = scene_;
  smooth.obstacles[0].friction = 0.0;
  now_.load_factor = static_cast<double>(-x_ * Push(x_, 0.0L));
  now_.rt[0] = 0.0;
  EXPECT_LE(ResidualCheck(smooth).Check(before_, now_).equilibrium, 1e-16);
  EXPECT_EQ(ResidualCheck(smooth).Check(before_, now_).Contact(), 0.0);
  for (const double rt : {0.01, -0.01}) {
    now_.rt[0] = rt;
    EXPECT_NEAR(ResidualCheck(smooth).Check(before_, now_).cone, 0.01 / force_, kRounding);
    EXPECT_NEAR(ResidualCheck(smooth).Check(before_, now_).friction_law, 0.01 / force_, kRounding);
  }
}

// Contact() is the largest of all but the first.
constexpr std::array<double Residuals::*, 6> kResiduals = {
    &Residuals::equilibrium,     &Residuals::penetration, &Residuals::tensile_reaction,
    &Residuals::complementarity, &Residuals::cone,        &Residuals::friction_law};

TEST_F(SlidingBarResiduals, UnitsDoNotMatter) {
  const double length = 1000.0;
  const double force = 0.45;
  TraceRequest request;
  request.scene = scene_;
  const Scene converted = ChangeUnits(request, length, force).scene;
  const auto convert = [&](CheckedState state) {
    for (double& position : state.positions) position *= length;
    state.rn[0] *= force;
    state.rt[0] *= force;
    return state;
  };
  // Each of these breaks other rules; together they make every residual large.
  std::vector<CheckedState> states(4, now_);
  states[0].positions[3] = -0.01;
  states[1].rn[0] = -0.02;
  states[2].positions[3] = 0.03;
  states[3].rt[0] *= 1.5;
  std::array<double, 6> largest{};
  for (const CheckedState& state : states) {
    const Residuals r = ResidualCheck(scene_).Check(before_, state);
    const Residuals c = ResidualCheck(converted).Check(convert(before_), convert(state));
    for (std::size_t i = 0; i < kResiduals.size(); ++i) {
      EXPECT_NEAR(r.*kResiduals[i], c.*kResiduals[i], kRounding) << i;
      largest[i] = std::max(largest[i], r.*kResiduals[i]);
    }
  }
  for (const double residual : largest) EXPECT_GT(residual, 1e-3);
}

void ExpectAllInfinite(const Residuals& residuals, const std::string& what) {
  for (double Residuals::*residual : kResiduals) EXPECT_EQ(residuals.*residual, kInfinity) << what;
  EXPECT_EQ(residuals.Contact(), kInfinity) << what;
}

TEST_F(SlidingBarResiduals, NothingThatIsNotFinitePasses) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t i = 0; i < 7; ++i) {
      const auto spoil = [&](CheckedState state) {
        const std::array<double*, 7> entries{&state.load_factor,  &state.positions[0], &state.positions[1],
                                             &state.positions[2], &state.positions[3], &state.rn[0],
                                             &state.rt[0]};
        *entries[i] = bad;
        return state;
      };
      const std::string what = std::to_string(bad) + " in entry " + std::to_string(i);
      ExpectAllInfinite(ResidualCheck(scene_).Check(before_, spoil(now_)), what);
      ExpectAllInfinite(ResidualCheck(scene_).Check(spoil(before_), now_), what);
    }
  }
}

TEST_F(SlidingBarResiduals, BarWithoutLengthIsNoEquilibrium) {
  now_.positions[2] = 0.0;
  now_.positions[3] = kHeight;
  EXPECT_EQ(Check().equilibrium, kInfinity);
}

TEST_F(SlidingBarResiduals, WrongSizesThrow) {
  CheckedState wrong = now_;
  wrong.positions.pop_back();
  EXPECT_THROW(ResidualCheck(scene_).Check(before_, wrong), std::invalid_argument);
  EXPECT_THROW(ResidualCheck(scene_).Check(wrong, now_), std::invalid_argument);
  EXPECT_THROW(ResidualCheck(scene_).StrainEnergy(wrong.positions), std::invalid_argument);
  wrong = now_;
  wrong.rn.clear();
  EXPECT_THROW(ResidualCheck(scene_).Check(before_, wrong), std::invalid_argument);
  wrong = now_;
  wrong.rt.push_back(0.0);
  EXPECT_THROW(ResidualCheck(scene_).Check(before_, wrong), std::invalid_argument);
}

TEST(ResidualsContact, IsTheLargestOfAllButEquilibrium) {
  for (double Residuals::*member : kResiduals) {
    if (member == &Residuals::equilibrium) continue;
    Residuals residuals{9.0, 0.1, 0.1, 0.1, 0.1, 0.1};
    residuals.*member = 0.5;
    EXPECT_EQ(residuals.Contact(), 0.5);
    residuals.*member = kNan;
    EXPECT_EQ(residuals.Contact(), kInfinity);
  }
  EXPECT_EQ(Residuals().Contact(), 0.0);
}

TEST(StrainEnergy, OfOneBarByHand) {
  Scene scene = sliding_bar::MakeScene();
  scene.bars[0].rest_length = 2.0;
  const std::vector<double> positions{0.0, 5.0, 3.0, 5.0};  // l = 3
  const auto energy = [&](StrainMeasure strain) {
    scene.bars[0].strain = strain;
    return ResidualCheck(scene).StrainEnergy(positions);
  };
  EXPECT_NEAR(energy(StrainMeasure::kBiot), kAxialStiffness * 0.25, 1e-14);
  EXPECT_NEAR(energy(StrainMeasure::kGreenLagrange), kAxialStiffness * 0.390625, 1e-14);
  EXPECT_NEAR(energy(StrainMeasure::kLogarithmic), kAxialStiffness * std::pow(std::log(1.5), 2), 1e-14);
}

TEST(StrainEnergy, OfASuperelementByHand) {
  Scene scene = sliding_bar::MakeScene();
  scene.bars.clear();
  scene.superelements = {{{"b"}, {1.0, -1.5, -1.5, 4.0}}};
  // x - X = (2, 1): (1 * 4 - 2 * 1.5 * 2 + 4 * 1) / 2
  EXPECT_NEAR(ResidualCheck(scene).StrainEnergy({0.0, 5.0, -3.0, 1.0}), 1.0, 1e-15);
}

// Forces of the check against central differences of its energy: with one component free at a time, the load that
// balances it is the derivative.
void ExpectForcesAreTheGradient(Scene scene, const std::vector<double>& positions) {
  constexpr double kDifference = 1e-5;
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = true;
  scene.obstacles.clear();
  scene.contacts.clear();
  for (std::size_t component = 0; component < positions.size(); ++component) {
    const std::size_t node = component / 2;
    const bool is_x = component % 2 == 0;
    Scene released = scene;
    (is_x ? released.nodes[node].fixed_x : released.nodes[node].fixed_y) = false;
    released.loads = {{released.nodes[node].name, is_x ? 1.0 : 0.0, is_x ? 0.0 : 1.0, false}};
    std::vector<double> forward = positions, backward = positions;
    forward[component] += kDifference;
    backward[component] -= kDifference;
    CheckedState state;
    state.positions = positions;
    state.load_factor = (ResidualCheck(scene).StrainEnergy(forward) - ResidualCheck(scene).StrainEnergy(backward)) /
                        (2.0 * kDifference);
    EXPECT_GT(std::abs(state.load_factor), 1e-3) << component;
    // Truncation and rounding of the difference are both near 1e-10.
    EXPECT_LE(ResidualCheck(released).Check(state, state).equilibrium, 1e-8) << component;
    state.load_factor *= 1.001;
    EXPECT_GT(ResidualCheck(released).Check(state, state).equilibrium, 1e-7) << component;
  }
}

TEST(StrainEnergy, ForcesOfBarsAreItsGradient) {
  for (const StrainMeasure strain :
       {StrainMeasure::kBiot, StrainMeasure::kGreenLagrange, StrainMeasure::kLogarithmic}) {
    for (const double rest_length : {0.0, 6.0}) {
      Scene scene = sliding_bar::MakeScene();
      scene.bars[0].strain = strain;
      scene.bars[0].rest_length = rest_length;
      ExpectForcesAreTheGradient(scene, {0.3, 5.2, -4.1, 0.7});
      ExpectForcesAreTheGradient(scene, {0.3, 9.2, -4.1, -2.7});
    }
  }
}

TEST(StrainEnergy, ForcesOfSuperelementsAreItsGradient) {
  Scene scene = sliding_bar::MakeScene();
  scene.bars.clear();
  // The nodes in another order than in the scene.
  scene.superelements = {{{"b", "a"},
                          {4.0, 1.0, -2.0, 0.5,  //
                           1.0, 3.0, 0.3, -1.0,  //
                           -2.0, 0.3, 5.0, 0.7,  //
                           0.5, -1.0, 0.7, 2.0}},
                         {{"a"}, {1.0, -1.5, -1.5, 4.0}}};
  ExpectForcesAreTheGradient(scene, {0.3, 5.2, -4.1, 0.7});
}

// A support that an earlier stage has moved is where the configuration has it; the bar keeps its length at rest.
TEST(ResidualCheckOfAStage, SupportsAreAtTheStartAndRestIsOfTheReference) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}};
  scene.bars = {{{"a", "b"}, 2.0}};
  scene.loads = {{"b", 0.5, 0.0, true}};
  Configuration configuration = Configuration::Of(scene);
  configuration.start[0] = -0.5;
  const ResidualCheck check(scene, configuration, Scaling());
  CheckedState state;
  state.positions = {-0.5, 0.0, 0.75, 0.0};  // N = 2 (1.25 - 1) = 0.5
  EXPECT_LE(check.Check(state, state).Largest(), kRounding);
  state.positions = {0.0, 0.0, 1.25, 0.0};  // the same bar with its support where it was
  EXPECT_LE(check.Check(state, state).equilibrium, kRounding);
  EXPECT_NEAR(check.Check(state, state).support, 0.5, kRounding);
}

}  // namespace
}  // namespace contact_path::residuals_test
