// Critical loads of columns and masts: where a step ends on them, beside what touches without force, turned, and under
// machines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/beams.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::critical_loads_test {
namespace {

// The first increment that is not stable, or the last one.
Increment LeavesStability(const TracedPath& path) {
  const auto found = std::find_if(path.increments.begin(), path.increments.end(),
                                  [](const Increment& of) { return of.stability.stability != Verdict::kStable; });
  return found == path.increments.end() ? path.increments.back() : *found;
}

// A rigid column of the length l on a pin with a spring k, under a dead load up to twice the critical one, k / l,
// between walls for its head, "left" at the distance 0 and "right" far off. Without contacts.
TraceRequest Column(double l, double k, AtLimit at_limit, double step) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.bodies = {{"ground", 0.0, 0.0, true, true, true}, {"column", 0.0, l}};
  scene.nodes = {NodeOf("column", "foot", 0.0, 0.0), NodeOf("column", "head", 0.0, l)};
  scene.pins = {{{"ground", "foot"}, k}};
  scene.obstacles = {{"left", ObstacleShape::kHalfPlane, 0.0, 0.0, 1.0, 0.0},
                     {"right", ObstacleShape::kHalfPlane, 0.9 * l, 0.0, -1.0, 0.0}};
  request.program = {LoadingStage({{"head", 0.0, -1.0}}, 2.0 * k / l)};
  request.options.at_limit = at_limit;
  request.options.step = step;
  return request;
}

// Whatever the length of a step is, and where it ends.
TEST(CriticalLoads, AStepMayEndOnABifurcation) {
  for (const double l : {0.7, 1.0, 1.3, 2.5})
    for (const double k : {1.0, 2.0, 17.0})
      for (const double step : {0.02, 0.1, 0.013}) {
        SCOPED_TRACE(testing::Message() << l << " " << k << " " << step);
        TraceRequest request = Column(l, k, AtLimit::kStop, step);
        request.scene.contacts = {{"head", "right"}};
        const TracedPath path = TraceVerified(request);
        ASSERT_TRUE(path.result.reached) << path.result.message;
        ExpectNear(LoadsOfKind(path, IncrementKind::kBifurcation), {k / l}, 1e-9 * k / l);
        EXPECT_EQ(path.increments.back().stability.stability, Verdict::kStable);  // of the curve that crosses
      }
}

// The wall carries nothing: the column leans away from it.
TEST(CriticalLoads, AColumnBesideAWall) {
  for (const double l : {0.7, 1.3})
    for (const double k : {1.1, 1.7e4})
      for (const double friction : {0.0, 0.3}) {
        SCOPED_TRACE(testing::Message() << l << " " << k << " " << friction);
        TraceRequest request = Column(l, k, AtLimit::kStop, 0.0137);
        request.scene.contacts = {{"head", "left", "", "", friction}, {"head", "right"}};
        EXPECT_NEAR(LeavesStability(TraceTo(request, EndReason::kAtLimit)).load_factor, k / l, 1e-8 * k / l);
        request.options.at_limit = AtLimit::kJump;
        const TracedPath jumps = TraceVerified(request);
        EXPECT_TRUE(jumps.result.reached) << jumps.result.message;
        EXPECT_NEAR(jumps.increments.back().contacts[1].gap, 0.0, 1e-7 * l);
      }
}

// Of two guys without force one holds a mast that leans: EA / l^3 times the square of its height and of its foot.
TEST(CriticalLoads, AMastWithGuysOfTheLengthThatTheyHave) {
  for (const bool tendons : {true, false})
    for (const double EA : {50.0, 5e5}) {
      SCOPED_TRACE(testing::Message() << tendons << " " << EA);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.bodies = {{"ground", 0.0, 0.0, true, true, true}, {"mast", 0.0, 4.0}};
      scene.nodes = {NodeOf("mast", "foot", 0.0, 0.0),
                     NodeOf("mast", "head", 0.0, 4.0),
                     {"left", -3.0, 0.0, true, true},
                     {"right", 3.0, 0.0, true, true}};
      scene.pins = {{{"ground", "foot"}}};
      for (const char* end : {"left", "right"}) {
        if (tendons)
          scene.tendons.push_back({"", {end, "head"}, EA});
        else
          scene.bars.push_back({{end, "head"}, EA, 0.0, StrainMeasure::kBiot, BarSense::kTension});
      }
      request.program = {LoadingStage({{"head", 0.0, -1.0}}, 0.6 * EA)};
      const double critical = 4.0 * EA * 9.0 / 125.0;
      request.options.at_limit = AtLimit::kStop;
      const TracedPath path = TraceIncrements(request);
      ExpectEnd(path, EndReason::kAtLimit);
      EXPECT_NEAR(LeavesStability(path).load_factor, critical, 1e-8 * critical);
      request.options.at_limit = AtLimit::kFollow;
      const TracedPath followed = TraceVerified(request);
      ASSERT_TRUE(followed.result.reached) << followed.result.message;
      EXPECT_EQ(followed.increments.back().stability.stability, Verdict::kUnstable);
    }
}

// Between two pads on springs of 9, at no distance: the column leans on one of them, and may do so from 10 on.
TEST(CriticalLoads, AColumnBetweenPads) {
  Scene scene;
  scene.bodies = {{"m", 0.0, 1.0}, {"g", 0.0, 0.0, true, true, true}};
  scene.nodes = {NodeOf("m", "foot", 0.0, 0.0),
                 {"wl", -1.0, 1.0, true, true},
                 {"wr", 1.0, 1.0, true, true},
                 {"pl", -0.1, 1.0, false, true},
                 {"pr", 0.1, 1.0, false, true}};
  scene.pins = {{{"g", "foot"}}};
  scene.bars = {{{"wl", "pl"}, 9.0}, {{"wr", "pr"}, 9.0}};
  scene.obstacles = {{"fl", ObstacleShape::kHalfPlane, -0.1, 1.0, -1.0, 0.0},
                     {"fr", ObstacleShape::kHalfPlane, 0.1, 1.0, 1.0, 0.0}};
  for (Obstacle& face : scene.obstacles) face.body = "m";
  scene.contacts = {{"pl", "fl"}, {"pr", "fr"}};
  const TracedPath path = TraceIncrements(RequestUpToALimit(scene, {LoadingStage({LoadOnBody("m", 0.0, -1.0)}, 30.0)}));
  ExpectEnd(path, EndReason::kAtLimit);
  EXPECT_NEAR(path.increments.back().load_factor, 10.0, 2e-7);
  EXPECT_EQ(path.increments.back().stability.stability, Verdict::kUnstable);
}

// A cantilever that buckles under a dead load goes on along the curve that is stable, whatever its axis is.
TEST(CriticalLoads, AColumnThatIsTurned) {
  for (const double angle : {0.0, 0.3, 0.55, 1.2})
    for (const double step : {0.0, 0.005}) {
      SCOPED_TRACE(testing::Message() << angle << " " << step);
      const double s = std::sin(angle), c = std::cos(angle);
      TraceRequest request;
      request.scene.nodes = {{"root", 0.0, 0.0, true, true, true}, {"tip", -s, c}};
      request.scene.beams = {Between("column", "root", "tip", 1e6, 1.0, 20)};
      request.program = {LoadingStage({{"tip", s, -c}}, 2.6)};
      request.options.at_limit = AtLimit::kStop;
      request.options.step = step;
      const TracedPath path = TraceIncrements(request);
      EXPECT_TRUE(path.result.reached) << path.result.message;
      EXPECT_EQ(path.increments.back().stability.stability, Verdict::kStable);
    }
}

// A block on a rough floor that a rigid machine pushes along against a bar: it sticks up to 0.3, and is then moved by
// 0.7.
TEST(CriticalLoads, ARigidMachinePushesWhatSticks) {
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.05 + 0.1 * i;
    SCOPED_TRACE(angle);
    const double s = std::sin(angle), c = std::cos(angle);
    TraceRequest request;
    Scene& scene = request.scene;
    scene.nodes = {{"a", -c, -s, true, true}, {"b", 0.0, 0.0}};
    scene.bars = {{{"a", "b"}, 1.0}};
    scene.loads = {{"b", s, -c, true}};
    scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, -s, c, 0.3}};
    scene.contacts = {{"b", "floor"}};
    request.program = {LoadingStage({{"b", c, s}}, 1.0)};
    request.options.machine_stiffness = std::numeric_limits<double>::infinity();
    request.options.at_limit = AtLimit::kStop;
    const TracedPath path = TraceIncrements(request);
    ASSERT_TRUE(path.result.reached) << path.result.message;
    EXPECT_NEAR(path.increments.back().dissipation, 0.21, 1e-12);
  }
}

// A column between springs, whose curves behind the bifurcation fall: at rest the machine lets it go to one of the
// walls.
TEST(CriticalLoads, AMachineLetsAColumnGo) {
  for (const double K : {0.1, 1.0}) {
    SCOPED_TRACE(K);
    TraceRequest request;
    Scene& scene = request.scene;
    scene.nodes = {
        {"b", 0.0, 0.0, true, true}, {"t", 0.0, 1.0}, {"s", -5.0, 1.0, true, true}, {"s2", 5.0, 1.0, true, true}};
    scene.bars = {{{"b", "t"}, 100.0}, {{"s", "t"}, 5.0}, {{"s2", "t"}, 5.0}};
    scene.obstacles = {{"w", ObstacleShape::kHalfPlane, 0.4, 0.0, -1.0, 0.0},
                       {"w2", ObstacleShape::kHalfPlane, -0.4, 0.0, 1.0, 0.0}};
    scene.contacts = {{"t", "w"}, {"t", "w2"}};
    request.program = {LoadingStage({{"t", 0.0, -1.0}}, 3.0)};
    request.options.at_limit = AtLimit::kJump;
    request.options.machine_stiffness = K;
    const TracedPath path = TraceIncrements(request);
    EXPECT_TRUE(path.result.reached) << path.result.message;
    ASSERT_EQ(IncrementsOfKind(path, IncrementKind::kJump).size(), 1U);
    const Increment jump = IncrementsOfKind(path, IncrementKind::kJump)[0];
    EXPECT_NEAR(std::abs(PositionX(path, jump, "t")), 0.4, 1e-9);
    EXPECT_NEAR(jump.load_factor, K < 0.5 ? 1.952 : 1.8744, 1e-3);
    EXPECT_NEAR(jump.jump.energy_released, K < 0.5 ? 0.00714 : 0.00375, 1e-4);
  }
}

}  // namespace
}  // namespace contact_path::critical_loads_test
