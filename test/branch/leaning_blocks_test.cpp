// Blocks pressed flat by a rough plate: slips come to rest one by one, and rates of zero hide which state is next.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::leaning_blocks_test {
namespace {

TraceRequest LeaningBlock(int nx, double lean, double friction) {
  TraceRequest request = PressedBlock(nx, 2, 4, lean, friction);
  request.options.max_increments = 60;
  return request;
}

void ExpectNoneLost(const TracedPath& path) {
  ASSERT_FALSE(path.increments.empty());
  for (const Increment& increment : path.increments) {
    const std::vector<BranchRecord>& branches = increment.event.branches;
    EXPECT_TRUE(
        branches.empty() || !increment.event.complete ||
        std::any_of(branches.begin(), branches.end(), [](const auto& branch) { return branch.load_rate > 0.0; }))
        << "increment " << increment.index;
  }
}

TEST(LeaningBlocks, GoOnToTheEnd) {
  struct Case {
    int nx;
    double lean, friction;
  };
  for (const Case& of : {Case{3, 0.25, 0.05},
                         {3, 0.3, 0.1},
                         {4, 0.1, 0.05},
                         {4, 0.4, 0.2},
                         {5, 0.15, 0.05},
                         {6, 0.25, 0.2},
                         {6, 0.5, 0.2},
                         {7, 0.4, 0.1},
                         {8, 0.15, 0.1},
                         {8, 0.25, 0.1}}) {
    const TracedPath path = TraceIncrements(LeaningBlock(of.nx, of.lean, of.friction));
    ExpectNoneLost(path);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << of.nx << " " << of.lean << " " << of.friction;
  }
}

// 0.2651 by an independent code; with the frictions beside it no rates hide a state.
TEST(LeaningBlocks, ForceOfTheOneWithFourContacts) {
  const auto force = [](double friction) {
    const TracedPath path = TraceIncrements(LeaningBlock(3, 0.3, friction));
    ExpectNoneLost(path);
    return SumOfNormals(path.increments.back());
  };
  EXPECT_NEAR(force(0.05), 0.2651, 1e-4);
  EXPECT_NEAR(force(0.04), 0.26448, 1e-5);
  EXPECT_NEAR(force(0.2), 0.27596, 1e-5);
}

// A symmetric pad: its corners come to rest at one point.
TEST(LeaningBlocks, TwoContactsThatComeToRestTogether) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "pad";
  scene.materials = {ElasticMaterial("rubber", 3.0, 0.45)};
  Solid pad;
  pad.material = "rubber";
  pad.nodes_per_element = 8;
  pad.thickness = 15.0;
  AddGrid(
      &scene, 12, 5, [](double x, double y) { return Eigen::Vector2d(20.0 * x, 10.0 * y); }, pad);
  PressOn({"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}, 0.8, 10.0, 0.0, &scene);
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceIncrements(request);
  ExpectNoneLost(path);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kCornerLimit).empty());
  for (const char* corner : {"0_0@floor", "24_0@floor"})
    EXPECT_EQ(Contact(path, path.increments.back(), corner).state, ContactState::kStick);
}

}  // namespace
}  // namespace contact_path::leaning_blocks_test
