// Increments of method mpec that are predicted and certified: the example scenes against method branch, and closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/path/trace.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::certified_paths_test {
namespace {

TraceRequest ByMpec(TraceRequest request) {
  request.options.method = Method::kMpec;
  return request;
}

// Limit points, crossing paths and changes of contact states.
std::vector<const Increment*> Located(const TracedPath& path) {
  std::vector<const Increment*> located;
  for (const Increment& increment : path.increments)
    if (increment.kind != IncrementKind::kStart && increment.kind != IncrementKind::kRegular &&
        increment.kind != IncrementKind::kSample)
      located.push_back(&increment);
  return located;
}

class ExampleScene : public testing::TestWithParam<const char*> {};

// Both methods locate the same corners and limit points, with the same loads and the same friction work, and end alike.
TEST_P(ExampleScene, HasThePathOfMethodBranch) {
  const TraceRequest request = ReadExample(GetParam());
  const TracedPath branch = TraceIncrements(request), mpec = TraceIncrements(ByMpec(request));
  EXPECT_EQ(mpec.result.reason, branch.result.reason) << mpec.result.message;
  ExpectNoFindings(mpec);
  const std::vector<const Increment*> wanted = Located(branch), found = Located(mpec);
  ASSERT_EQ(found.size(), wanted.size());
  const double largest = branch.increments.back().dissipation;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i]->kind, wanted[i]->kind) << i;
    EXPECT_NEAR(found[i]->load_factor, wanted[i]->load_factor, 1e-10 * (1.0 + std::abs(wanted[i]->load_factor))) << i;
    EXPECT_NEAR(found[i]->dissipation, wanted[i]->dissipation, 1e-6 * largest) << i;  // measured 1.4e-7
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExampleScene,
                         testing::Values("arch19", "cam", "cantilever_block", "crushed_ring", "deep_arch", "fin_ray",
                                         "gripper", "hertz", "lee_frame", "peg", "peg_in_hole", "portal_frame",
                                         "press_slide_lift", "rigid_stop", "ring_on_ring", "rope", "rough_arch",
                                         "rough_truss", "rubber_foot", "sliding_bar", "snap_hook", "stick_slip_cycle",
                                         "two_blocks", "two_dof_friction", "von_mises", "williams_toggle"));

TEST(CertifiedPaths, LimitPointsOfTheSlidingBarAreLocated) {
  const TracedPath path = TraceIncrements(ByMpec(ReadExample("sliding_bar")));
  std::vector<const Increment*> limits = Located(path);
  ASSERT_GE(limits.size(), 2u);
  EXPECT_NEAR(limits[0]->load_factor, sliding_bar::LoadFactor(sliding_bar::kFirstLimitX), 1e-13);
  EXPECT_NEAR(PositionX(path, *limits[0], "b"), sliding_bar::kFirstLimitX, 1e-10);
  EXPECT_NEAR(limits[1]->load_factor, sliding_bar::LoadFactor(sliding_bar::kSecondLimitX), 1e-13);
  EXPECT_NEAR(PositionX(path, *limits[1], "b"), sliding_bar::kSecondLimitX, 1e-10);
}

// Corners where the load turns by 100 degrees and more, whatever the length of increments.
TEST(CertifiedPaths, SharpCornersDoNotDependOnTheLengthOfIncrements) {
  for (const double step : {0.3, 0.05, 0.01, 0.002}) {
    SCOPED_TRACE(step);
    TraceRequest request = ByMpec(ReadExample("two_dof_friction"));
    request.options.step = step;
    request.options.max_increments = 4000;
    const TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    const std::vector<const Increment*> corners = Located(path);
    ASSERT_EQ(corners.size(), 2u);
    EXPECT_EQ(corners[0]->kind, IncrementKind::kCornerLimit);
    EXPECT_NEAR(corners[0]->load_factor, 1.0, 1e-13);
    EXPECT_EQ(corners[1]->kind, IncrementKind::kCornerLimit);
    EXPECT_NEAR(corners[1]->load_factor, 2.0 / 3.0, 1e-13);
    // The integral of 1 - 1.5 x from 0 to 2/3.
    EXPECT_NEAR(path.increments.back().dissipation, 1.0 / 3.0, 1e-12);
  }
}

// A belt that moves with the load factor drags a node of weight N on a spring k: the node moves with the belt up to
// mu N / k, and stays there while the belt slides on. Friction acts along the motion of the belt.
TEST(CertifiedPaths, ABeltDragsANodeUntilItSlips) {
  for (const double speed : {1.0, -1.0})
    for (const double mu : {0.2, 0.7})
      for (const double stiffness : {0.5, 40.0}) {
        SCOPED_TRACE(testing::Message() << "speed " << speed << ", friction " << mu << ", stiffness " << stiffness);
        constexpr double kWeight = 2.0;
        TraceRequest request;
        request.scene.nodes.resize(1);
        request.scene.nodes[0].name = "p";
        request.scene.superelements = {{{"p"}, {stiffness, 0.0, 0.0, 1.0}}};
        Load weight;
        weight.node = "p";
        weight.fy = -kWeight;
        weight.constant = true;
        request.scene.loads = {weight};
        Obstacle belt;
        belt.name = "belt";
        belt.ny = 1.0;
        belt.friction = mu;
        request.scene.obstacles = {belt};
        ContactCandidate contact;
        contact.node = "p";
        contact.obstacle = "belt";
        request.scene.contacts = {contact};
        ObstacleMotion motion;
        motion.obstacle = "belt";
        motion.dx = speed;
        request.scene.obstacle_motions = {motion};
        const double slips_at = mu * kWeight / stiffness;
        request.options.stop = {{"load_factor", ">", 2.0 * slips_at}};
        request.options.max_increments = 4000;
        const TracedPath path = TraceIncrements(ByMpec(request));
        EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
        ExpectNoFindings(path);
        ASSERT_EQ(Located(path).size(), 1u);
        EXPECT_NEAR(Located(path)[0]->load_factor, slips_at, 1e-12 * (1.0 + slips_at));
        for (const Increment& increment : path.increments) {
          const double moved = std::min(increment.load_factor, slips_at);
          EXPECT_NEAR(PositionX(path, increment, "p"), speed * moved, 1e-12 * (1.0 + slips_at));
          EXPECT_NEAR(increment.contacts[0].rt, speed * stiffness * moved, 1e-11);
          const double slipped = increment.load_factor - moved;
          EXPECT_NEAR(increment.dissipation, mu * kWeight * slipped, 1e-11);
        }
      }
}

}  // namespace
}  // namespace contact_path::certified_paths_test
