// Structures that contacts alone hold, and lines of contact: scenes that people write.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/beams.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::parts_on_contacts_test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// ----- arches -----

// Below the thrust that held ends have, both slide outwards, or inwards where the thrust is inwards; above, both stick.
// The arch carries the load from the start, however stiff its axis.
TEST(PartsOnContacts, AnArchOnARoughFloorCarriesItsLoadFromTheStart) {
  for (const double degrees : {72.0, 95.0, 110.0, 126.0, 133.0, 150.0, 158.0, 163.0, 169.0})
    for (const double share : {0.9, 0.95, 1.05})
      for (const double EA : {1e3, 1e5, 1e7})
        for (const int segments : {12, 40}) {
          const double thrust = ThrustOfArch(degrees * kDegree);
          // The mesh and a soft axis shift the border by more than this share where the thrust is small, and where the
          // axis is soft.
          if (EA < 1e4 && share > 0.9) continue;
          SCOPED_TRACE(testing::Message() << degrees << " degrees, friction " << share << " |H/V|, EA " << EA
                                          << ", segments " << segments);
          TraceRequest request = RestingArch(degrees * kDegree, share * std::abs(thrust), EA, segments);
          request.scene.nodes[1].fixed_x = false;
          const TracedPath path = TraceIncrements(request);
          ASSERT_GT(path.increments.size(), 3U) << path.result.message;
          const bool outwards = thrust > 0.0;
          const ContactState left = outwards ? ContactState::kSlipMinus : ContactState::kSlipPlus,
                             right = outwards ? ContactState::kSlipPlus : ContactState::kSlipMinus;
          for (std::size_t i = 1; i < 3; ++i) {
            const Increment& at = path.increments[i];
            EXPECT_EQ(at.contacts[0].state, share < 1.0 ? left : ContactState::kStick);
            EXPECT_EQ(at.contacts[1].state, share < 1.0 ? right : ContactState::kStick);
            EXPECT_GT(at.load_factor, path.increments[i - 1].load_factor);
            EXPECT_NEAR(SumOfNormals(at), at.load_factor, 1e-6 * at.load_factor + 1e-9 * EA);
          }
        }
}

// ----- a heavy beam on a table -----

// Length 6, EI 1, weight 1 per length; its right end is lifted by 0.05 and lowered.
TraceRequest HeavyBeam(int segments, double slenderness, double friction) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"l", 0.0, 0.0, friction == 0.0}, {"e", 6.0, 0.0, false, true}};
  scene.beams = {Between("B", "l", "e", slenderness / 36.0, 1.0, segments)};
  scene.loads = {LoadOnGroup("B", 0.0, -1.0, true)};
  scene.obstacles = {{"table", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.groups = {{"c", {"l"}}};
  for (int i = 1; i < segments; ++i) scene.groups[0].nodes.push_back("B/" + std::to_string(i));
  scene.contacts = {{"", "table", "c"}};
  request.program = {MovingStage({{"e", 0.0, 0.05}}), MovingStage({{"e", 0.0, -0.05}})};
  request.options.max_increments = 4000;
  return request;
}

// Small slopes: what is lifted has the length a = (24 EI d / q)^(1/4), and the force at the end is q a / 2. Where the
// beam lies down again, it bears on all nodes as before.
TEST(PartsOnContacts, AHeavyBeamIsLiftedOffATableAndLoweredAgain) {
  const double force = 0.5 * std::pow(24.0 * 0.05, 0.25);
  for (const int segments : {15, 30, 60, 120})
    for (const double slenderness : {1e2, 1e4, 1e7})
      for (const double friction : {0.0, 0.5}) {
        SCOPED_TRACE(testing::Message() << segments << " segments, EA L^2 / EI " << slenderness << ", friction "
                                        << friction);
        const TracedPath path = TraceIncrements(HeavyBeam(segments, slenderness, friction));
        ExpectEnd(path, EndReason::kStopCriterion);
        const Increment& lifted = LastOfStage(path, 1);
        // Measured: 0.057 of 15 segments, 0.0035 of 60; a soft axis adds 0.004.
        const double mesh = 15.0 / segments * (15.0 / segments);
        EXPECT_NEAR(6.0 - SumOfNormals(lifted), force, (0.06 * mesh + 0.005) * force);
        const Increment &start = path.increments.front(), &end = path.increments.back();
        EXPECT_NEAR(SumOfNormals(end), SumOfNormals(start), 1e-6);
        for (std::size_t i = 0; i < start.contacts.size(); ++i) EXPECT_LE(end.contacts[i].gap, 1e-9);
      }
}

// ----- blocks, frames, springs, arms -----

TEST(PartsOnContacts, APileOfStiffBlocksStandsAndItsTopBlockTopples) {
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced}) {
    TraceRequest request = ReadData("pile_of_blocks");
    request.options.accuracy = accuracy;
    const TracedPath path = TraceIncrements(request);
    ExpectEnd(path, EndReason::kStopCriterion);
    EXPECT_NEAR(LargestLoadFactor(path), 0.5, 1e-4);
  }
}

TEST(PartsOnContacts, LeavesOfASpringThatAllTouchSlideOnEachOther) {
  const TracedPath path = TraceTo(ReadData("leaf_spring"));
  EXPECT_GE(path.increments.back().load_factor, 216.7);
}

TEST(PartsOnContacts, CornersBetweenATableAndJaws) { TraceTo(ReadData("grip")); }

// It turns about its pin without a reaction, so that rounding alone has a sign where the obstacle touches it: the path
// may end there by name, and is right otherwise.
TEST(PartsOnContacts, AFrameThatIsPinnedOnlyGivesWayToAnObstacle) {
  for (const Accuracy accuracy : {Accuracy::kBalanced, Accuracy::kAccurate}) {
    TraceRequest request = ReadData("free_frame_pushed");
    request.options.accuracy = accuracy;
    const TracedPath path = TraceVerified(request);
    const Increment& last = path.increments.back();
    if (path.result.reason == EndReason::kPathEnd) {
      EXPECT_EQ(last.event.number, 1);
      EXPECT_NEAR(last.load_factor, 0.3045104878, 1e-9);
      EXPECT_NE(path.result.message.find("move freely"), std::string::npos) << path.result.message;
    } else {
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
      EXPECT_EQ(last.event.number, 0);
    }
  }
}

// An arm without a load, pinned at one end, that a load lifts off a floor: nothing resists, and the path ends there,
// for each mesh, load and accuracy.
TEST(PartsOnContacts, AnArmThatNothingHoldsTakesNoLoad) {
  for (const int segments : {1, 4, 8, 20})
    for (const double fx : {0.0, 0.1, 1.0})
      for (const Accuracy accuracy : kPresets) {
        TraceRequest request;
        Scene& scene = request.scene;
        scene.nodes = {{"a", 0.0, 0.5, true, true}, {"b", 2.0, 0.0}};
        scene.beams = {Between("B", "a", "b", 1e4, 1.0, segments)};
        scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0}};
        scene.contacts = {{"b", "floor"}};
        scene.loads = {{"b", fx, 1.0}};
        request.options.max_increments = 100;
        request.options.accuracy = accuracy;
        const TracedPath path = TraceIncrements(request);
        EXPECT_EQ(path.result.reason, EndReason::kPathEnd) << segments << ", fx " << fx << ": " << path.result.message;
        EXPECT_EQ(path.increments.size(), 1U);
      }
}

}  // namespace
}  // namespace contact_path::parts_on_contacts_test
