// Reactions that have to change while nothing moves: exact answers, by both methods.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "contact_path/verify/verify_path.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::redistribution_test {
namespace {

constexpr ObstacleShape kHalfPlane = ObstacleShape::kHalfPlane;
constexpr double kRounding = 1e-12;

Scene Block(double side, double friction_of_floor) {
  Scene scene = NodeOnFloor("b", 1.0, friction_of_floor);
  scene.loads = {{"b", side, -1.0, true}};
  return scene;
}

TracedPath TraceWhole(const TraceRequest& request) { return TraceTo(request, EndReason::kStopCriterion, 1e-9); }

TraceRequest BeltAgainstStop(double clearance) {
  TraceRequest request;
  request.scene = Block(0.0, 0.3);
  request.scene.obstacles.push_back({"stop", kHalfPlane, clearance, 0.0, -1.0, 0.0, 0.0});
  request.scene.contacts.push_back({"b", "stop"});
  request.program = {{"forth", {}, {}, {{"floor", 1.0, 0.0}}, 0.5}};
  return request;
}

// The belt pulls with the spring's force x; then the stop holds the block, and all at once the belt slips.
TEST(Redistribution, ABlockOnABeltMeetsAStop) {
  for (const double clearance : {0.0, 0.1, 0.2}) {
    const TracedPath path = TraceWhole(BeltAgainstStop(clearance));
    const Increment& end = path.increments.back();
    EXPECT_NEAR(PositionX(path, end, "b"), clearance, kRounding);
    EXPECT_NEAR(Contact(path, end, "b@floor").rt, 0.3, kRounding);
    EXPECT_NEAR(Contact(path, end, "b@stop").rn, 0.3 - clearance, kRounding);
    EXPECT_EQ(Contact(path, end, "b@floor").state, ContactState::kSlipMinus);
    EXPECT_NEAR(end.dissipation, 0.3 * (0.5 - clearance), kRounding);
    EXPECT_NEAR(end.strain_energy, 0.5 * clearance * clearance, kRounding);
  }
}

// The change is an increment of its own: same place, same load factor, other reactions.
TEST(Redistribution, TheChangeIsAnIncrement) {
  const TraceRequest request = BeltAgainstStop(0.1);
  TracedPath path = TraceIncrements(request);
  std::size_t changes = 0;
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    const Increment &before = path.increments[i - 1], &increment = path.increments[i];
    if (increment.arc_length > before.arc_length) continue;
    ++changes;
    EXPECT_EQ(increment.positions, before.positions);
    EXPECT_EQ(increment.load_factor, before.load_factor);
    EXPECT_EQ(increment.dissipation, before.dissipation);
    EXPECT_EQ(increment.kind, IncrementKind::kRegular);
    EXPECT_EQ(before.kind, IncrementKind::kContactEvent);
    EXPECT_NEAR(Contact(path, before, "b@stop").rn, 0.0, kRounding);
    EXPECT_NEAR(Contact(path, increment, "b@stop").rn, 0.2, kRounding);
  }
  EXPECT_EQ(changes, 1u);
  // Anywhere else it is not proved.
  std::vector<Increment> increments = path.increments;
  increments[2].positions = increments[1].positions;
  increments[2].load_factor = increments[1].load_factor;
  increments[2].arc_length = increments[1].arc_length;
  EXPECT_FALSE(VerifyPath(request, increments).findings.empty());
}

// A block that a side load draws, and another rough half plane at this height; one of the two obstacles moves by dy.
TraceRequest Between(double side, const std::string& other, double height, double friction, const std::string& moves,
                     double dy, double target) {
  TraceRequest request;
  request.scene = Block(side, 0.3);
  request.scene.obstacles.push_back({other, kHalfPlane, 0.0, height, 0.0, 1.0, friction});
  request.scene.contacts.push_back({"b", other});
  request.program = {{"", {}, {}, {{moves, 0.0, dy}}, target}};
  return request;
}

// A lift takes the node off the table; a side load rests on friction before and after.
TEST(Redistribution, ALiftTakesANodeOffATable) {
  const TracedPath path = TraceWhole(Between(0.1, "lift", -0.05, 0.3, "lift", 1.0, 0.15));
  const Increment& end = path.increments.back();
  EXPECT_NEAR(PositionX(path, end, "b"), 0.0, kRounding);
  EXPECT_NEAR(PositionY(path, end, "b"), 0.1, kRounding);
  EXPECT_NEAR(Contact(path, end, "b@lift").rn, 1.1, kRounding);
  EXPECT_NEAR(Contact(path, end, "b@lift").rt, -0.1, kRounding);
  EXPECT_EQ(Contact(path, end, "b@floor").state, ContactState::kOpen);
  EXPECT_NEAR(end.dissipation, 0.0, kRounding);
}

TraceRequest TableAbove(double friction_of_low) {
  return Between(0.2, "low", -0.1, friction_of_low, "floor", -1.0, 0.25);
}

// A table goes down and hands a node over to a lower one that can hold its side load.
TEST(Redistribution, ATableHandsANodeOver) {
  const TracedPath path = TraceWhole(TableAbove(0.6));
  const Increment& end = path.increments.back();
  EXPECT_NEAR(PositionX(path, end, "b"), 0.0, kRounding);
  EXPECT_NEAR(PositionY(path, end, "b"), -0.1, kRounding);
  EXPECT_NEAR(Contact(path, end, "b@low").rn, 0.9, kRounding);
  EXPECT_NEAR(Contact(path, end, "b@low").rt, -0.2, kRounding);
  EXPECT_EQ(Contact(path, end, "b@floor").state, ContactState::kOpen);
}

// The lower one cannot: while the tables are level, the node slides as far as the spring takes its share. Friction of
// both, 0.3 r + 0.1 (0.9 - r) = 0.2 - x, with all of the weight on the upper one at first and none in the end.
TEST(Redistribution, ATableHandsANodeOverThatSlides) {
  const TracedPath path = TraceTo(TableAbove(0.1));
  const Increment& end = path.increments.back();
  EXPECT_NEAR(PositionX(path, end, "b"), 0.11, kRounding);
  EXPECT_NEAR(PositionY(path, end, "b"), -0.1, kRounding);
  EXPECT_NEAR(Contact(path, end, "b@low").rt, -0.09, kRounding);
  EXPECT_NEAR(end.dissipation, 0.2 * 0.11 - 0.5 * 0.11 * 0.11, kRounding);
  for (const Increment& increment : path.increments)
    if (const double x = PositionX(path, increment, "b"); x > kRounding && x < 0.11 - kRounding) {
      EXPECT_NEAR(increment.load_factor, 0.1, kRounding);
    }
}

TEST(Redistribution, IsTheSameInOtherWords) {
  const TraceRequest request = BeltAgainstStop(0.1);
  const TracedPath path = TraceIncrements(request);
  ExpectSameInOtherWords(request, path, 1e-9);
  ExpectSamePath(UndoRotation(TraceIncrements(Rotate(request, 0.7)), 0.7), path, 1e-9);
}

}  // namespace
}  // namespace contact_path::redistribution_test
