// What slides while the load rests: a path that goes on, no jump, and a verdict that no energy tells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "contact_path/path/trace.h"
#include "contact_path/scene/read_scene.h"
#include "support/traced_path.h"

namespace contact_path::sliding_test {
namespace {

std::string Text(double value) {
  std::ostringstream text;
  text.precision(17);
  text << std::fixed << value;
  return text.str();
}

TracedPath Traced(const std::string& text) { return TraceIncrements(ReadTraceRequest(text, "test")); }

// A block of the weight w on a rough floor, pushed by 0 to w at a height, from which a wall is as far as the block is
// wide.
struct Pushed {
  double w = 2.0, height = 0.1;
  bool wall_first = false;

  TracedPath By(const std::string& options) const {
    const std::string floor = "  - {node: l, obstacle: floor}\n  - {node: r, obstacle: floor}\n",
                      wall = "  - {node: n, obstacle: wall}\n";
    return Traced(R"(
scene:
  name: pushed
  bodies:
  - {name: B, x: 0.0, y: 1.0}
  nodes:
  - {name: l, x: -0.5, y: 0.0, body: B}
  - {name: r, x: 0.5, y: 0.0, body: B}
  - {name: t, x: -0.5, y: )" +
                  Text(height) + R"(, body: B}
  - {name: n, x: 0.5, y: 0.4, body: B}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.4}
  - {name: wall, shape: half_plane, px: 1.5, nx: -1.0}
  contacts:
)" + (wall_first ? wall + floor : floor + wall) +
                  R"(
  loads:
  - {body: B, by: -)" +
                  Text(w) + R"(, constant: true}
program:
- name: push
  loads:
  - {node: t, fx: )" +
                  Text(w) + R"(}
  target: 1.0
options: {)" + options +
                  "}\n");
  }
};

TEST(Sliding, ABlockIsPushedToAWall) {
  for (const double w : {2e-3, 2.0, 2e4})
    for (const double height : {0.05, 0.3, 0.5})
      for (const bool wall_first : {false, true}) {
        SCOPED_TRACE(testing::Message() << w << " " << height << " " << wall_first);
        const Pushed pushed{w, height, wall_first};
        for (const char* at_limit : {"follow", "jump"}) {
          const TracedPath path = pushed.By(std::string("at_limit: ") + at_limit);
          ASSERT_TRUE(path.result.reached) << path.result.message;
          EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kJump).empty());
          const std::size_t wall = wall_first ? 0 : 2;
          EXPECT_NEAR(path.increments.back().contacts[wall].rn, 0.6 * w, 1e-7 * w);
          EXPECT_NEAR(path.increments.back().dissipation, 0.4 * w, 1e-6 * w);
          int slides = 0;
          for (const Increment& increment : path.increments) {
            if (increment.kind != IncrementKind::kRegular || std::abs(increment.load_factor - 0.4) > 1e-9) continue;
            ++slides;
            EXPECT_EQ(increment.stability.stability, Verdict::kNotProved) << increment.index;
          }
          EXPECT_GT(slides, 10);
          ExpectNoFindings(path);
        }
        const TracedPath stopped = pushed.By("at_limit: stop");
        EXPECT_EQ(stopped.result.reason, EndReason::kAtLimit) << stopped.result.message;
        EXPECT_NEAR(stopped.increments.back().load_factor, 0.4, 1e-8);
      }
}

// A floor that tilts slides a block down to a stop at tan(turn) = 0.4, and turns on.
TEST(Sliding, ABlockOnATiltedFloor) {
  for (const char* at_limit : {"follow", "jump", "jump, step: 0.003"}) {
    const TracedPath path = Traced(std::string(R"(
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
options: {at_limit: )") + at_limit +
                                   "}\n");
    ASSERT_TRUE(path.result.reached) << path.result.message;
    EXPECT_NEAR(path.increments.back().contacts[2].rn, 2.0 * (std::sin(0.5) - 0.4 * std::cos(0.5)), 1e-7);
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
        const TracedPath path = Traced(R"(
scene:
  name: capstan
  nodes:
  - {name: hub, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: A, x: -)" + Text(radius) + R"(, y: -3.0, fixed_x: true}
  - {name: B, x: )" + Text(radius) + R"(, y: -3.0, fixed_x: true}
  tendons:
  - {nodes: [A, hub, B], radii: [0.0, )" +
                                       Text(radius) + R"(, 0.0], turns: [0, -1, 0], EA: )" + Text(EA) +
                                       R"(, friction: 0.3}
  loads:
  - {node: A, fy: -2.0, constant: true}
  - {node: B, fy: -2.0, constant: true}
  - {node: B, fy: -1.0}
options: {max_increments: 20, at_limit: )" +
                                       at_limit + "}\n");
        const double limit = 2.0 * std::expm1(0.3 * std::acos(-1.0));
        if (path.result.reason == EndReason::kAtLimit) {
          EXPECT_NEAR(path.increments.back().load_factor, limit, 1e-7);
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
      const TracedPath path = Traced(R"(
scene:
  name: tied
  bodies:
  - {name: box, x: 0.0, y: 0.5}
  nodes:
  - {name: l, x: -0.3, y: 0.0, body: box}
  - {name: r, x: 0.3, y: 0.0, body: box}
  - {name: ring, x: -0.3, y: 0.1, body: box}
  - {name: wall, x: -1.5, y: )" + Text(0.1 + up) +
                                     R"(, fixed_x: true, fixed_y: true}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.2}
  contacts:
  - {node: l, obstacle: floor}
  - {node: r, obstacle: floor}
  tendons:
  - {nodes: [wall, ring], EA: )" + Text(EA) +
                                     R"(}
  loads:
  - {body: box, by: -0.7, constant: true}
  - {node: ring, fx: 1.0}
options:
  stop:
  - {quantity: load_factor, when: '>', value: 0.2}
)");
      EXPECT_TRUE(path.result.reached) << path.result.message;
      ExpectNoFindings(path);
    }
}

}  // namespace
}  // namespace contact_path::sliding_test
