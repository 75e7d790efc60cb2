// Critical loads of columns and masts: where a step ends on them, beside what touches without force, turned, and under
// machines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "support/traced_path.h"

namespace contact_path::critical_loads_test {
namespace {

// The first increment that is not stable, or the last one.
const Increment& LeavesStability(const TracedPath& path) {
  const auto found = std::find_if(path.increments.begin(), path.increments.end(),
                                  [](const Increment& of) { return of.stability.stability != Verdict::kStable; });
  return found == path.increments.end() ? path.increments.back() : *found;
}

// A rigid column of the length l on a pin with a spring k, under a dead load up to twice the critical one, k / l.
// contacts: of its head with walls, "left" at the distance 0 and "right" far off.
TracedPath Column(double l, double k, const std::string& contacts, const std::string& options) {
  return TraceText(R"(
scene:
  name: column
  bodies:
  - {name: ground, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true, fixed_rotation: true}
  - {name: column, x: 0.0, y: <l>}
  nodes:
  - {name: foot, x: 0.0, y: 0.0, body: column}
  - {name: head, x: 0.0, y: <l>, body: column}
  pins:
  - {nodes: [ground, foot], stiffness: <k>}
  obstacles:
  - {name: left, nx: 1.0}
  - {name: right, px: <far>, nx: -1.0}
  contacts:
)" + contacts + R"(
program:
- name: press
  loads:
  - {node: head, fy: -1.0}
  target: <target>
options: {)" + options +
                       "}\n",
                   {{"l", l}, {"k", k}, {"far", 0.9 * l}, {"target", 2.0 * k / l}});
}

// Whatever the length of a step is, and where it ends.
TEST(CriticalLoads, AStepMayEndOnABifurcation) {
  for (const double l : {0.7, 1.0, 1.3, 2.5})
    for (const double k : {1.0, 2.0, 17.0})
      for (const char* step : {"0.02", "0.1", "0.013"}) {
        SCOPED_TRACE(testing::Message() << l << " " << k << " " << step);
        const std::string right = "  - {node: head, obstacle: right}";
        const TracedPath path = Column(l, k, right, std::string("at_limit: stop, step: ") + step);
        ASSERT_TRUE(path.result.reached) << path.result.message;
        ExpectNear(LoadsOfKind(path, IncrementKind::kBifurcation), {k / l}, 1e-9 * k / l);
        EXPECT_EQ(path.increments.back().stability.stability, Verdict::kStable);  // of the curve that crosses
        ExpectNoFindings(path);
      }
}

// The wall carries nothing: the column leans away from it.
TEST(CriticalLoads, AColumnBesideAWall) {
  for (const double l : {0.7, 1.3})
    for (const double k : {1.1, 1.7e4})
      for (const char* friction : {"0.0", "0.3"}) {
        SCOPED_TRACE(testing::Message() << l << " " << k << " " << friction);
        const std::string walls = std::string("  - {node: head, obstacle: left, friction: ") + friction +
                                  "}\n  - {node: head, obstacle: right}";
        const TracedPath stops = Column(l, k, walls, "at_limit: stop, step: 0.0137");
        EXPECT_EQ(stops.result.reason, EndReason::kAtLimit) << stops.result.message;
        EXPECT_NEAR(LeavesStability(stops).load_factor, k / l, 1e-8 * k / l);
        ExpectNoFindings(stops);
        const TracedPath jumps = Column(l, k, walls, "at_limit: jump, step: 0.0137");
        EXPECT_TRUE(jumps.result.reached) << jumps.result.message;
        EXPECT_NEAR(jumps.increments.back().contacts[1].gap, 0.0, 1e-7 * l);
        ExpectNoFindings(jumps);
      }
}

// Of two guys without force one holds a mast that leans: EA / l^3 times the square of its height and of its foot.
TEST(CriticalLoads, AMastWithGuysOfTheLengthThatTheyHave) {
  for (const char* guys : {"tendons", "bars"})
    for (const double EA : {50.0, 5e5}) {
      SCOPED_TRACE(testing::Message() << guys << " " << EA);
      const std::string sense = guys == std::string("bars") ? ", sense: tension" : "";
      const std::string mast = R"(
scene:
  name: mast
  bodies:
  - {name: ground, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true, fixed_rotation: true}
  - {name: mast, x: 0.0, y: 4.0}
  nodes:
  - {name: foot, x: 0.0, y: 0.0, body: mast}
  - {name: head, x: 0.0, y: 4.0, body: mast}
  - {name: left, x: -3.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: right, x: 3.0, y: 0.0, fixed_x: true, fixed_y: true}
  pins:
  - {nodes: [ground, foot]}
  )" + std::string(guys) + R"(:
  - {nodes: [left, head], EA: <EA>)" +
                               sense + R"(}
  - {nodes: [right, head], EA: <EA>)" +
                               sense + R"(}
program:
- name: press
  loads:
  - {node: head, fy: -1.0}
  target: <target>
options: {at_limit: )";
      const std::map<std::string, double> values = {{"EA", EA}, {"target", 0.6 * EA}};
      const double critical = 4.0 * EA * 9.0 / 125.0;
      const TracedPath path = TraceText(mast + "stop}\n", values), followed = TraceText(mast + "follow}\n", values);
      EXPECT_EQ(path.result.reason, EndReason::kAtLimit) << path.result.message;
      EXPECT_NEAR(LeavesStability(path).load_factor, critical, 1e-8 * critical);
      ASSERT_TRUE(followed.result.reached) << followed.result.message;
      EXPECT_EQ(followed.increments.back().stability.stability, Verdict::kUnstable);
      ExpectNoFindings(followed);
    }
}

// Between two pads on springs of 9, at no distance: the column leans on one of them, and may do so from 10 on.
TEST(CriticalLoads, AColumnBetweenPads) {
  const TracedPath path = TraceText(R"(
scene:
  name: pads
  bodies:
  - {name: m, x: 0.0, y: 1.0}
  - {name: g, x: 0.0, y: 0.0, fixed_rotation: true, fixed_x: true, fixed_y: true}
  nodes:
  - {name: foot, x: 0.0, y: 0.0, body: m}
  - {name: wl, x: -1.0, y: 1.0, fixed_x: true, fixed_y: true}
  - {name: wr, x: 1.0, y: 1.0, fixed_x: true, fixed_y: true}
  - {name: pl, x: -0.1, y: 1.0, fixed_y: true}
  - {name: pr, x: 0.1, y: 1.0, fixed_y: true}
  pins:
  - {nodes: [g, foot]}
  bars:
  - {nodes: [wl, pl], EA: 9.0}
  - {nodes: [wr, pr], EA: 9.0}
  obstacles:
  - {name: fl, px: -0.1, py: 1.0, nx: -1.0, body: m}
  - {name: fr, px: 0.1, py: 1.0, nx: 1.0, body: m}
  contacts:
  - {node: pl, obstacle: fl}
  - {node: pr, obstacle: fr}
program:
- name: press
  loads:
  - {body: m, fy: -1.0}
  target: 30.0
options: {at_limit: stop}
)");
  EXPECT_EQ(path.result.reason, EndReason::kAtLimit) << path.result.message;
  EXPECT_NEAR(path.increments.back().load_factor, 10.0, 2e-7);
  EXPECT_EQ(path.increments.back().stability.stability, Verdict::kUnstable);
}

// A cantilever that buckles under a dead load goes on along the curve that is stable, whatever its axis is.
TEST(CriticalLoads, AColumnThatIsTurned) {
  for (const double angle : {0.0, 0.3, 0.55, 1.2})
    for (const char* step : {"0.0", "0.005"}) {
      SCOPED_TRACE(testing::Message() << angle << " " << step);
      const TracedPath path = TraceText(std::string(R"(
scene:
  name: cantilever
  nodes:
  - {name: root, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true, fixed_rotation: true}
  - {name: tip, x: -<s>, y: <c>}
  beams:
  - {nodes: [root, tip], EA: 1000000.0, EI: 1.0, segments: 20}
program:
- name: press
  loads:
  - {node: tip, fx: <s>, fy: -<c>}
  target: 2.6
options: {at_limit: stop, step: )") + step + "}\n",
                                        {{"s", std::sin(angle)}, {"c", std::cos(angle)}});
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
    const TracedPath path =
        TraceText(R"(
scene:
  name: slider
  nodes:
  - {name: a, x: <ax>, y: <ay>, fixed_x: true, fixed_y: true}
  - {name: b, x: 0.0, y: 0.0}
  bars:
  - {nodes: [a, b], EA: 1.0}
  loads:
  - {node: b, fx: <s>, fy: <ax>, constant: true}
  obstacles:
  - {name: floor, nx: <ay>, ny: <c>, friction: 0.3}
  contacts:
  - {node: b, obstacle: floor}
program:
- name: push
  loads:
  - {node: b, fx: <c>, fy: <s>}
  target: 1.0
options: {machine_stiffness: .inf, at_limit: stop}
)",
                  {{"c", std::cos(angle)}, {"s", std::sin(angle)}, {"ax", -std::cos(angle)}, {"ay", -std::sin(angle)}});
    ASSERT_TRUE(path.result.reached) << path.result.message;
    EXPECT_NEAR(path.increments.back().dissipation, 0.21, 1e-12);
  }
}

// A column between springs, whose curves behind the bifurcation fall: at rest the machine lets it go to one of the
// walls.
TEST(CriticalLoads, AMachineLetsAColumnGo) {
  for (const double K : {0.1, 1.0}) {
    SCOPED_TRACE(K);
    const TracedPath path = TraceText(R"(
scene:
  name: between_springs
  nodes:
  - {name: b, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: t, x: 0.0, y: 1.0}
  - {name: s, x: -5.0, y: 1.0, fixed_x: true, fixed_y: true}
  - {name: s2, x: 5.0, y: 1.0, fixed_x: true, fixed_y: true}
  bars:
  - {nodes: [b, t], EA: 100.0}
  - {nodes: [s, t], EA: 5.0}
  - {nodes: [s2, t], EA: 5.0}
  obstacles:
  - {name: w, px: 0.4, nx: -1.0}
  - {name: w2, px: -0.4, nx: 1.0}
  contacts:
  - {node: t, obstacle: w}
  - {node: t, obstacle: w2}
program:
- name: press
  loads:
  - {node: t, fy: -1.0}
  target: 3.0
options: {at_limit: jump, machine_stiffness: <K>}
)",
                                      {{"K", K}});
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
