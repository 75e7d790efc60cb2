// The total law of friction against closed forms: the path of unloading is the path of loading.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact_path/verify/verify_path.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::total_law_test {
namespace {

constexpr double kRounding = 1e-11;

class TotalLaw : public testing::Test {
 protected:
  // Complete, and proved by verify.
  static TracedPath TraceTotal(TraceRequest request) {
    request.options.friction_law = FrictionLaw::kTotal;
    TracedPath path = TraceProved(request);
    EXPECT_LE(VerifyPath(path.request, path.increments).energy_balance, 1e-6);
    for (const Increment& increment : path.increments)
      for (const BranchRecord& branch : increment.event.branches) EXPECT_EQ(branch.dissipation_rate, 0.0);
    return path;
  }
};

// A block on a spring, k = 1, mu N = 0.3, and a belt that has moved by b: the block moves with the belt up to mu N / k
// to either side, whatever was before. No hysteresis.
TEST_F(TotalLaw, AStickSlipCycleHasNoLoop) {
  const TracedPath path = TraceTotal(ReadExample("stick_slip_cycle"));
  int slipping = 0;
  for (const Increment& increment : path.increments) {
    const double begin = increment.stage == 1 ? 0.0 : increment.stage == 2 ? 0.5 : -0.5;
    const double belt = begin + (increment.stage == 2 ? -1.0 : 1.0) * increment.load_factor;
    const double block = std::clamp(belt, -0.3, 0.3), slipped = block - belt;
    EXPECT_NEAR(PositionX(path, increment, "b"), 1.0 + block, kRounding) << "increment " << increment.index;
    EXPECT_NEAR(Contact(path, increment, "b@belt").rt, block, kRounding);
    EXPECT_NEAR(increment.dissipation, 0.3 * std::abs(slipped), kRounding);
    if (std::abs(slipped) < 1e-9) continue;
    ++slipping;
    EXPECT_EQ(Contact(path, increment, "b@belt").state,
              slipped > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus);
  }
  EXPECT_GT(slipping, 10);
}

// The foot slides to one side only: both laws have the same path.
TEST_F(TotalLaw, RoughTrussIsThatOfTheIncrementalLaw) {
  const TracedPath path = TraceTotal(ReadExample("rough_truss"));
  const double l0 = std::hypot(1.0, 1.2), lc = std::sqrt(2.0), corner = std::sqrt(2.0) * (1.0 - lc / l0);
  EXPECT_NEAR(LargestLoadFactor(path), corner, kRounding);
  for (const Increment& increment : path.increments) {
    if (Contact(path, increment, "foot@floor").state != ContactState::kSlipPlus) continue;
    // The slope of the bars stays 1 / mu = 1.
    const double l = std::sqrt(2.0) * PositionY(path, increment, "apex");
    EXPECT_NEAR(increment.load_factor, std::sqrt(2.0) * (1.0 - l / l0), 1e-9);
  }
  EXPECT_NEAR(path.increments.back().dissipation, 0.5 * std::pow(l0 - lc, 2) / l0, 1e-8);
}

// A node between springs is lifted off, carried along and pressed down again: where it touches, it has slipped.
TEST_F(TotalLaw, SlipIsToldByWhereANodeTouchesAgain) {
  TraceRequest request;
  request.scene = NodeOnFloor("p", 1.0, 0.5);
  request.program = {LoadingStage({{"p", 0.0, 0.2}}), LoadingStage({{"p", 1.0, 0.0}}),
                     LoadingStage({{"p", 0.0, -1.0}}, 3.2)};
  request.options.step = 0.1;
  const TracedPath path = TraceTotal(request);
  for (const Increment& increment : path.increments) {
    if (increment.stage != 3) continue;
    const double pressed = std::max(increment.load_factor - 0.2, 0.0), x = std::max(1.0 - 0.5 * pressed, 0.0);
    EXPECT_NEAR(PositionX(path, increment, "p"), x, kRounding) << "increment " << increment.index;
    EXPECT_NEAR(increment.contacts[0].rn, pressed, kRounding);
    EXPECT_NEAR(increment.contacts[0].rt, x - 1.0, kRounding);
    if (increment.load_factor > 2.3) {
      EXPECT_EQ(increment.contacts[0].state, ContactState::kStick);
    }
  }
  EXPECT_EQ(path.increments.back().contacts[0].state, ContactState::kStick);
}

// A node on two springs, dragged round a disc and back: for each angle a from the top, equilibrium with r_t = -mu r_n
// gives load factor and normal reaction.
TEST_F(TotalLaw, TheWayBackRoundADiscIsTheWayThere) {
  constexpr double kFriction = 0.3, kStart = -0.2, kTarget = 0.15;
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"p", std::sin(kStart), std::cos(kStart), false, false}};
  scene.superelements = {{{"p"}, {1.3, 0.0, 0.0, 0.8}, {0.2, -0.3}}};
  scene.obstacles = {Circle("peg", 0.0, 0.0, 1.0, kFriction)};
  scene.contacts = {{"p", "peg"}};
  request.program = {LoadingStage({{"p", 1.0, -0.2}}, kTarget), UnloadingStage()};
  request.options.step = 0.2;
  const TracedPath path = TraceTotal(request);
  int sliding = 0;
  for (const Increment& increment : path.increments) {
    const double angle = std::atan2(increment.positions[0], increment.positions[1]);
    EXPECT_GE(angle, kStart - kRounding);
    if (increment.contacts[0].state != ContactState::kSlipPlus) {
      EXPECT_NEAR(angle, kStart, kRounding);
      continue;
    }
    ++sliding;
    const double s = increment.stage == 1 ? increment.load_factor : kTarget * (1.0 - increment.load_factor);
    const double nx = std::sin(angle), ny = std::cos(angle), cx = nx - kFriction * ny, cy = ny + kFriction * nx;
    const double rn = increment.contacts[0].rn;
    EXPECT_NEAR(1.3 * (nx - 0.2), s + rn * cx, 1e-9);
    EXPECT_NEAR(0.8 * (ny + 0.3), -0.2 * s + rn * cy, 1e-9);
  }
  EXPECT_GT(sliding, 10);
  EXPECT_EQ(path.increments.back().contacts[0].state, path.increments.front().contacts[0].state);
}

TEST_F(TotalLaw, AResumedPathIsTheWholeOne) {
  const TracedPath whole = TraceTotal(ReadExample("stick_slip_cycle"));
  const std::size_t count = whole.increments.size();
  for (const std::size_t cut : {count / 4, count / 2, count - 2}) {
    const std::vector<Increment> increments = ResumeAfter(cut, whole).increments;
    ASSERT_EQ(increments.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(increments[i].contacts[0].state, whole.increments[i].contacts[0].state);
      EXPECT_NEAR(increments[i].positions[2], whole.increments[i].positions[2], kRounding);
      EXPECT_NEAR(increments[i].dissipation, whole.increments[i].dissipation, kRounding);
    }
  }
}

TEST(VerifyTotalLaw, TellsThePathOfTheOtherLaw) {
  TracedPath path = TraceIncrements(ReadExample("stick_slip_cycle"));
  ExpectNoFindings(path);
  path.request.options.friction_law = FrictionLaw::kTotal;
  EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
}

}  // namespace
}  // namespace contact_path::total_law_test
