// Forces of rigid bodies from far below to far above the characteristic one, and what is clamped.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "contact_path/path/trace.h"
#include "contact_path/scene/read_scene.h"
#include "support/traced_path.h"

namespace contact_path::forces_of_bodies_test {
namespace {

TracedPath Traced(const std::string& text) { return TraceIncrements(ReadTraceRequest(text, "test")); }

std::string Text(double value) {
  std::ostringstream text;
  text.precision(17);
  text << std::fixed << value;
  return text.str();
}

// A plate presses a disc of the radius r and the weight w onto a wall half a radius away, and would come further by
// `beyond`.
TracedPath Clamped(double r, double w, double beyond) {
  return Traced(R"(
scene:
  name: clamped
  bodies:
  - {name: disc, x: 0.0, y: )" +
                Text(r) + R"(}
  - {name: plate, x: )" +
                Text(1.5 * r) + R"(, y: 0.0, fixed_x: true, fixed_y: true, fixed_rotation: true}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.3}
  - {name: wall, shape: half_plane, px: )" +
                Text(-1.5 * r) + R"(, nx: 1.0, friction: 0.3}
  - {name: face, shape: half_plane, px: )" +
                Text(1.5 * r) + R"(, nx: -1.0, body: plate, friction: 0.3}
  - {name: rim, shape: circle, py: )" +
                Text(r) + ", radius: " + Text(r) + R"(, body: disc}
  contacts:
  - {obstacles: [rim, floor]}
  - {obstacles: [rim, wall]}
  - {obstacles: [rim, face]}
  loads:
  - {body: disc, by: )" +
                Text(-w) + R"(, constant: true}
program:
- name: press
  support_motions:
  - {body: plate, dx: )" +
                Text(-r) + R"(}
  target: )" + Text(1.0 + beyond));
}

TEST(ForcesOfBodies, ADiscThatIsClampedEndsThePath) {
  for (const double r : {1e-3, 1.0, 500.0})
    for (const double w : {1e-3, 1.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << r << " " << w);
      const TracedPath path = Clamped(r, w, 0.1);
      EXPECT_FALSE(path.result.reached);
      EXPECT_NE(path.result.message.find("is pressed together by more than"), std::string::npos) << path.result.message;
      EXPECT_NEAR(path.increments.back().load_factor, 1.0, 1e-6);
      ExpectNoFindings(path);
      EXPECT_TRUE(Clamped(r, w, -0.01).result.reached);
    }
}

// A block on a floor that tilts. The weight is that of a program, whose stages bring no load on.
TEST(ForcesOfBodies, AWeightIsAsLargeAsItIs) {
  for (const double w : {1e-3, 1.0, 1e4, 1e7}) {
    SCOPED_TRACE(w);
    const TracedPath path = Traced(R"(
scene:
  name: tilted
  bodies:
  - {name: block, x: 0.0, y: 1.0}
  nodes:
  - {name: l, x: -0.5, y: 0.0, body: block}
  - {name: r, x: 0.5, y: 0.0, body: block}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.4}
  contacts:
  - {node: l, obstacle: floor}
  - {node: r, obstacle: floor}
  loads:
  - {body: block, by: )" + Text(-w) +
                                   R"(, constant: true}
program:
- name: tilt
  obstacle_motions:
  - {obstacle: floor, turn: 1.0}
  target: 0.3
)");
    ASSERT_TRUE(path.result.reached) << path.result.message;
    const Increment& last = path.increments.back();
    // Of a block twice as high as it is wide, the lower edge bears more.
    const double N = w * std::cos(0.3), moment = w * std::sin(0.3);
    EXPECT_NEAR(last.contacts[0].rn, 0.5 * N + moment, 1e-6 * w);
    EXPECT_NEAR(last.contacts[1].rn, 0.5 * N - moment, 1e-6 * w);
    ExpectNoFindings(path);
  }
}

// A node on a spring slides on a plane that turns by 1 about the origin.
TEST(ForcesOfBodies, APlaneThatTurnsIsTheSameInOtherUnits) {
  std::size_t increments = 0;
  for (const double length : {1.0, 1e-3, 1e4}) {
    SCOPED_TRACE(length);
    const TracedPath path = Traced(R"(
scene:
  name: turns
  nodes:
  - {name: q, x: )" + Text(length) +
                                   R"(, y: 0.0}
  superelements:
  - {nodes: [q], stiffness: [0.05, 0.0, 0.0, 0.05]}
  obstacles:
  - {name: plane, shape: half_plane, ny: 1.0, friction: 0.2}
  contacts:
  - {node: q, obstacle: plane}
program:
- name: turn
  obstacle_motions:
  - {obstacle: plane, turn: 1.0}
  target: 1.0
)");
    EXPECT_TRUE(path.result.reached) << path.result.message;
    if (increments == 0) increments = path.increments.size();
    EXPECT_EQ(path.increments.size(), increments);
  }
}

// A weight on a rope over a rough peg draws a block on a rough floor: 0.4 W = 2.0 exp(mu phi) where it slides. Nothing
// but the rope holds the weight and the block.
TEST(ForcesOfBodies, ARopeIsAPartThatHolds) {
  for (const double EA : {1e2, 1e4, 1e6}) {
    SCOPED_TRACE(EA);
    const TracedPath path = Traced(R"(
scene:
  name: drawn
  nodes:
  - {name: block, x: -1.0, y: 0.0}
  - {name: peg, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: weight, x: 0.0, y: -1.0}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.4}
  contacts:
  - {node: block, obstacle: floor}
  loads:
  - {node: block, fy: -5.0, constant: true}
  - {node: weight, fy: -0.5, constant: true}
  - {node: weight, fy: -1.0}
  tendons:
  - {nodes: [block, peg, weight], EA: )" +
                                   Text(EA) + R"(, friction: 0.25}
options:
  at_limit: stop
)");
    ASSERT_GT(path.increments.size(), 1u) << path.result.message;
    EXPECT_NEAR(path.increments.back().load_factor, 2.0 * std::exp(0.125 * std::acos(-1.0)) - 0.5, 1e-6);
    ExpectNoFindings(path);
  }
}

}  // namespace
}  // namespace contact_path::forces_of_bodies_test
