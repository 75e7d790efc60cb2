// What slides while the load rests: a path that goes on, no jump, and a verdict that no energy tells.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/traced_path.h"

namespace contact_path::sliding_test {
namespace {

// A block of the weight <w> on a rough floor, pushed at the height <h> by 0 to w, and a wall as far from it as it is
// wide.
TracedPath Pushed(double w, double h, bool wall_first, const std::string& at_limit) {
  const std::string floor = "  - {node: l, obstacle: floor}\n  - {node: r, obstacle: floor}\n",
                    wall = "  - {node: n, obstacle: wall}\n";
  return TraceText(R"(
scene:
  name: pushed
  bodies:
  - {name: B, x: 0.0, y: 1.0}
  nodes:
  - {name: l, x: -0.5, y: 0.0, body: B}
  - {name: r, x: 0.5, y: 0.0, body: B}
  - {name: t, x: -0.5, y: <h>, body: B}
  - {name: n, x: 0.5, y: 0.4, body: B}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.4}
  - {name: wall, shape: half_plane, px: 1.5, nx: -1.0}
  loads:
  - {body: B, by: -<w>, constant: true}
  contacts:
)" + (wall_first ? wall + floor : floor + wall) +
                       R"(program:
- name: push
  loads:
  - {node: t, fx: <w>}
  target: 1.0
options: {at_limit: )" +
                       at_limit + "}\n",
                   {{"w", w}, {"h", h}});
}

TEST(Sliding, ABlockIsPushedToAWall) {
  for (const double w : {2e-3, 2.0, 2e4})
    for (const double height : {0.05, 0.3, 0.5})
      for (const bool wall_first : {false, true}) {
        SCOPED_TRACE(testing::Message() << w << " " << height << " " << wall_first);
        for (const char* at_limit : {"follow", "jump"}) {
          const TracedPath path = Pushed(w, height, wall_first, at_limit);
          ASSERT_TRUE(path.result.reached) << path.result.message;
          EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kJump).empty());
          const std::size_t wall = wall_first ? 0 : 2;
          EXPECT_NEAR(path.increments.back().contacts[wall].rn, 0.6 * w, 1e-8 * w);
          EXPECT_NEAR(path.increments.back().dissipation, 0.4 * w, 1e-7 * w);
          int slides = 0;
          for (const Increment& increment : path.increments) {
            if (increment.kind != IncrementKind::kRegular || std::abs(increment.load_factor - 0.4) > 1e-9) continue;
            ++slides;
            EXPECT_EQ(increment.stability.stability, Verdict::kNotProved) << increment.index;
          }
          EXPECT_GT(slides, 10);
          ExpectNoFindings(path);
        }
        const TracedPath stopped = Pushed(w, height, wall_first, "stop");
        EXPECT_EQ(stopped.result.reason, EndReason::kAtLimit) << stopped.result.message;
        EXPECT_NEAR(stopped.increments.back().load_factor, 0.4, 1e-8);
      }
}

// A floor that tilts slides a block down to a stop at tan(turn) = 0.4, and turns on.
TEST(Sliding, ABlockOnATiltedFloor) {
  for (const char* at_limit : {"follow", "jump", "jump, step: 0.003"}) {
    const TracedPath path = TraceText(std::string(R"(
scene:
  name: tilted
  bodies:
  - {name: B, x: 0.0, y: 0.5}
  nodes:
  - {name: l, x: -0.5, y: 0.0, body: B}
  - {name: r, x: 0.5, y: 0.0, body: B}
  - {name: n, x: -0.5, y: 0.3, body: B}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.4}
  - {name: stop, shape: half_plane, px: -2.0, nx: 1.0}
  contacts:
  - {node: l, obstacle: floor}
  - {node: r, obstacle: floor}
  - {node: n, obstacle: stop}
  loads:
  - {body: B, by: -2.0, constant: true}
program:
- name: tilt
  obstacle_motions:
  - {obstacle: floor, turn: 1.0}
  - {obstacle: stop, turn: 1.0}
  target: 0.5
options: {at_limit: )") + at_limit + "}\n");
    ASSERT_TRUE(path.result.reached) << path.result.message;
    EXPECT_NEAR(path.increments.back().contacts[2].rn, 2.0 * (std::sin(0.5) - 0.4 * std::cos(0.5)), 1e-8);
    ExpectNoFindings(path);
  }
}

// A rope over a rough roller, dead loads at both ends: from 2 (exp(0.3 pi) - 1) on it runs through, and what keeps a
// slack rope determined is all that resists.
TEST(Sliding, ARopeRunsOverARoller) {
  for (const double EA : {20.0, 2e3, 2e6})
    for (const double radius : {0.01, 1.0})
      for (const char* at_limit : {"stop", "follow"}) {
        SCOPED_TRACE(testing::Message() << EA << " " << radius << " " << at_limit);
        const TracedPath path = TraceText(std::string(R"(
scene:
  name: capstan
  nodes:
  - {name: hub, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: A, x: -<r>, y: -3.0, fixed_x: true}
  - {name: B, x: <r>, y: -3.0, fixed_x: true}
  tendons:
  - {nodes: [A, hub, B], radii: [0.0, <r>, 0.0], turns: [0, -1, 0], EA: <EA>, friction: 0.3}
  loads:
  - {node: A, fy: -2.0, constant: true}
  - {node: B, fy: -2.0, constant: true}
  - {node: B, fy: -1.0}
options: {max_increments: 20, at_limit: )") + at_limit +
                                              "}\n",
                                          {{"r", radius}, {"EA", EA}});
        const double limit = 2.0 * std::expm1(0.3 * std::acos(-1.0));
        if (path.result.reason == EndReason::kAtLimit) {
          EXPECT_NEAR(path.increments.back().load_factor, limit, 1e-8);
        }
        EXPECT_EQ(path.result.reason == EndReason::kAtLimit, at_limit == std::string("stop")) << path.result.message;
        EXPECT_EQ(path.increments.back().stability.stability, Verdict::kNotProved);
      }
}

// A box is tied to the wall by a rope of the length that it has: it settles by the 1e-8 by which its contacts give way.
TEST(Sliding, ABoxThatIsTied) {
  for (const double up : {-0.3, -0.1, 0.0, 0.1, 0.3})
    for (const double EA : {0.5, 46.0, 1e4}) {
      SCOPED_TRACE(testing::Message() << up << " " << EA);
      const TracedPath path = TraceText(R"(
scene:
  name: tied
  bodies:
  - {name: box, x: 0.0, y: 0.5}
  nodes:
  - {name: l, x: -0.3, y: 0.0, body: box}
  - {name: r, x: 0.3, y: 0.0, body: box}
  - {name: ring, x: -0.3, y: 0.1, body: box}
  - {name: wall, x: -1.5, y: <y>, fixed_x: true, fixed_y: true}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.2}
  contacts:
  - {node: l, obstacle: floor}
  - {node: r, obstacle: floor}
  tendons:
  - {nodes: [wall, ring], EA: <EA>}
  loads:
  - {body: box, by: -0.7, constant: true}
  - {node: ring, fx: 1.0}
options:
  stop:
  - {quantity: load_factor, when: '>', value: 0.2}
)",
                                        {{"y", 0.1 + up}, {"EA", EA}});
      ASSERT_TRUE(path.result.reached) << path.result.message;
      ExpectNoFindings(path);
      // The rope takes what friction, 0.14, does not.
      if (up == 0.0) {
        EXPECT_NEAR(PositionX(path, path.increments.back(), "ring"), -0.3 + 0.06 * 1.2 / EA, 2e-8);
      }
    }
}

}  // namespace
}  // namespace contact_path::sliding_test
