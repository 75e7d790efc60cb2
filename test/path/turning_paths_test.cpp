// Paths that are driven: where they turn, jump and go on, the path parameter never goes back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/path/end.h"
#include "contact_path/scene/validate.h"
#include "support/beams.h"
#include "support/parts.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::turning_paths_test {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

double Parameter(const TracedPath& path, const Increment& increment) {
  const bool machine = path.request.options.machine_stiffness > 0.0;
  return machine ? increment.setting : increment.load_factor;
}

void ExpectNeverBack(const TracedPath& path) {
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    const Increment &before = path.increments[i - 1], &now = path.increments[i];
    if (before.stage != now.stage) continue;
    EXPECT_GE(Parameter(path, now), Parameter(path, before) - 1e-9) << "increment " << now.index;
  }
}

// By the largest dissipation alone the plate lifts off again where a node begins to slip.
TEST(TurningPaths, APlateThatPressesGoesOn) {
  for (const auto& [friction, force] : {std::pair(0.1, 0.27896), {0.2, 0.28146}, {0.3, 0.28199}}) {
    SCOPED_TRACE(friction);
    const TracedPath path = TraceProved(PressedBlock(4, 4, 8, 0.0, friction));
    ExpectNeverBack(path);
    EXPECT_NEAR(SumOfNormals(path.increments.back()), force, 1e-5);
  }
}

TEST(TurningPaths, TheRuleIsAChoice) {
  TraceRequest request = PressedBlock(4, 4, 8, 0.0, 0.2);
  request.options.max_increments = 200;
  request.options.branch_rule = BranchRule::kDissipation;
  const TracedPath back = TraceIncrements(request);
  EXPECT_LT(back.increments.back().load_factor, 0.0);
  EXPECT_NE(back.result.message.find("see branch_rule"), std::string::npos) << back.result.message;
  const Increment& turns =
      FirstThat(back, [](const Increment& increment) { return increment.kind == IncrementKind::kCornerLimit; });
  EXPECT_LT(turns.event.branches[0].parameter_rate, 0.0);
  EXPECT_GT(turns.event.branches[1].parameter_rate, 0.0);
  request.options.branch_rule = BranchRule::kForward;
  EXPECT_GT(TraceIncrements(request).increments.back().load_factor, 0.2 - 1e-12);
}

// A toggle of two Biot bars (half span 1, apex `rise` up) is pushed down by a plate onto a table at -`below`.
TraceRequest PushedToggle(double rise, double below, double size = 1.0, double EA = 1.0) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"left", -size, 0.0, true, true}, {"apex", 0.0, rise * size}, {"right", size, 0.0, true, true}};
  scene.bars = {{{"left", "apex"}, EA}, {{"right", "apex"}, EA}};
  scene.obstacles = {{"plate", ObstacleShape::kHalfPlane, 0.0, (rise + 0.05) * size, 0.0, -1.0, 0.0},
                     {"table", ObstacleShape::kHalfPlane, 0.0, -below * size, 0.0, 1.0, 0.0}};
  scene.contacts = {{"apex", "plate"}, {"apex", "table"}};
  request.program = {{"", {}, {}, {{"plate", 0.0, -1.0}}, (rise + 0.05 + below) * size * 0.9}};
  request.options.at_limit = AtLimit::kJump;
  return request;
}

TEST(TurningPaths, AToggleThatAPlatePushesOverLands) {
  for (const double rise : {0.05, 0.2, 0.5})
    for (const double size : {1e-3, 1.0, 1e3})
      for (const double EA : {1e-3, 1.0, 1e6}) {
        const double below = 0.75 * rise;
        const TracedPath path = TraceProved(PushedToggle(rise, below, size, EA));
        const std::vector<Increment> jumps = IncrementsOfKind(path, IncrementKind::kJump);
        ASSERT_EQ(jumps.size(), 1U);
        EXPECT_NEAR(jumps[0].load_factor, (rise + 0.05) * size, 1e-9 * size);
        const double pressed = 2.0 * EA * (1.0 / std::hypot(1.0, below) - 1.0 / std::hypot(1.0, rise)) * below;
        EXPECT_NEAR(Contact(path, jumps[0], "apex@table").rn, pressed, 1e-9 * EA);
        EXPECT_EQ(jumps[0].stability.stability, Verdict::kStable);
        ExpectNeverBack(path);
      }
}

// A weight of 1 is pulled up a ramp of 45 degrees and over its crest onto a level table by a machine.
TraceRequest OverTheCrest(double friction, double stiffness) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"block", -1.5, -1.0}};
  scene.superelements = {{{"block"}, {0.0, 0.0, 0.0, 0.1}, {-1.5, -1.0}}};
  scene.loads = {{"block", 0.0, -1.0, true}};
  Obstacle ground{"ground", ObstacleShape::kPolyline};
  ground.points = {-3.0, -1.0, -1.05, -1.0, 0.0, 0.0, 9.0, 0.0};
  ground.fillet = 0.05;
  ground.friction = friction;
  scene.obstacles = {ground, {"wall", ObstacleShape::kHalfPlane, 6.0, 0.0, -1.0, 0.0, 0.0}};
  scene.contacts = {{"block", "ground"}, {"block", "wall"}};
  request.program = {LoadingStage({{"block", 1.0, 0.0}}, 2.0)};
  request.options.at_limit = AtLimit::kJump;
  request.options.machine_stiffness = stiffness;
  return request;
}

TEST(TurningPaths, AWeightThatLandsSlidingIsPulledOn) {
  for (const double friction : {0.1, 0.2, 0.25})
    for (const double stiffness : {0.5, 1.0, 5.0}) {
      const TracedPath path = TraceProved(OverTheCrest(friction, stiffness));
      const std::vector<Increment> jumps = IncrementsOfKind(path, IncrementKind::kJump);
      ASSERT_EQ(jumps.size(), 1U) << friction << " " << stiffness;
      const Increment& slides = FirstThat(path, [&](const Increment& now) {
        return now.index > jumps[0].index && std::abs(PositionX(path, now, "block") - 5.0) < 0.5;
      });
      // The spring of stiffness 0.1 presses it from 1 above its rest.
      EXPECT_NEAR(slides.load_factor, friction * 1.1, 1e-9) << friction << " " << stiffness;
      ExpectNeverBack(path);
    }
}

// A pinned column of 40 segments under a dead load, its axis along y.
TraceRequest EulersColumn(double slenderness, double target) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"foot", 0.0, 0.0, true, true}, {"head", 0.0, 1.0, true, false}};
  scene.beams = {Between("c", "foot", "head", slenderness, 1.0, 40)};
  request.program = {LoadingStage({{"head", 0.0, -1.0}}, target)};
  request.options.at_limit = AtLimit::kJump;
  return request;
}

// The machine goes on along the curve that crosses: no jump is needed. By the elastica 0.3505 at 15.
TEST(TurningPaths, AColumnGoesOnAlongItsBuckledCurve) {
  const double pi = std::acos(-1.0);
  for (const double slenderness : {1e3, 1e4, 1e5, 1e6, 1e7}) {
    const TracedPath path = TraceIncrements(EulersColumn(slenderness, 15.0));
    ExpectEnd(path, EndReason::kStopCriterion);
    const std::vector<Increment> crossed = IncrementsOfKind(path, IncrementKind::kBifurcation);
    ASSERT_EQ(crossed.size(), 1U) << slenderness;
    EXPECT_NEAR(crossed[0].load_factor / (pi * pi), 1.0, 2e-3 + 20.0 / slenderness);
    EXPECT_GT(crossed[0].event.taken, 1);
    EXPECT_NEAR(PositionY(path, path.increments.back(), "head"), 0.3505, 2.2e-3 + 10.0 / slenderness) << slenderness;
    EXPECT_EQ(path.increments.back().stability.stability, Verdict::kStable);
    ExpectNeverBack(path);
  }
}

// The points of a path that follows are the same under each machine, whose setting goes on and back.
TEST(TurningPaths, MachinesFollowTheSamePath) {
  TraceRequest request = ReadExample("bistable_arch");
  request.options.at_limit = AtLimit::kFollow;
  request.options.machine_stiffness = 0.0;
  // A turn of the setting is an onset of its own.
  const auto limits = [](const TracedPath& path) {
    std::vector<Increment> found = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
    for (const Increment& other : IncrementsOfKind(path, IncrementKind::kBifurcation)) found.push_back(other);
    return found;
  };
  const std::vector<Increment> dead = limits(TraceIncrements(request));
  EXPECT_GE(dead.size(), 4U);
  for (const double stiffness : {1.0, 1e6, kRigid}) {
    request.options.machine_stiffness = stiffness;
    const std::vector<Increment> held = limits(TraceProved(request));
    ASSERT_EQ(held.size(), dead.size()) << stiffness;
    for (std::size_t i = 0; i < held.size(); ++i) {
      EXPECT_EQ(held[i].stage, dead[i].stage);
      EXPECT_NEAR(held[i].load_factor, dead[i].load_factor, 1e-8) << stiffness;
    }
  }
}

// s |f| = K (X - x), whatever the size of the loads.
TEST(TurningPaths, TheSettingIsALength) {
  TraceRequest request = ReadExample("bistable_arch");
  request.options.at_limit = AtLimit::kFollow;
  request.options.machine_stiffness = 20.0;
  const TracedPath path = TraceProved(request);
  const double start = PositionY(path, path.increments.front(), "crown");
  for (const Increment& increment : path.increments) {
    if (increment.stage > 1) break;
    EXPECT_NEAR(increment.setting, start - PositionY(path, increment, "crown") + increment.load_factor / 20.0, 1e-12);
  }
  for (Load& load : request.program[0].loads) load.fy *= 5.0;
  request.program[0].target /= 5.0;
  const TracedPath scaled = TraceProved(request);
  EXPECT_NEAR(scaled.increments[10].setting, path.increments[10].setting, 1e-9);
}

TEST(TurningPaths, AMachineAndMotionsInOneStageAreRefused) {
  TraceRequest request = PushedToggle(0.2, 0.15);
  request.options.machine_stiffness = 1.0;
  EXPECT_EQ(TraceIncrements(request).result.reason, EndReason::kStopCriterion);  // no load, no machine
  request.program[0].loads = {{"apex", 0.0, -1e-6}};
  EXPECT_THROW(TraceIncrements(request), InvalidRequest);
  // So is a stage that takes back what two stages have left.
  const std::vector<Load> loads = request.program[0].loads;
  request.program[0].loads.clear();
  request.program.push_back(LoadingStage(loads));
  EXPECT_EQ(TraceIncrements(request).result.reason, EndReason::kStopCriterion);
  request.program.push_back(UnloadingStage());
  EXPECT_THROW(TraceIncrements(request), InvalidRequest);
}

}  // namespace
}  // namespace contact_path::turning_paths_test
