// Forces of rigid bodies from far below to far above the characteristic one, and what is clamped.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/traced_path.h"

namespace contact_path::forces_of_bodies_test {
namespace {

// A plate comes from half a radius beside a disc, moves it on by half a radius to a wall, and is to go on by `beyond`
// radii.
TracedPath Clamped(double radius, double weight, double beyond) {
  return TraceText(R"(
scene:
  name: clamped
  bodies:
  - {name: disc, x: 0.0, y: <r>}
  - {name: plate, x: <away>, y: 0.0, fixed_x: true, fixed_y: true, fixed_rotation: true}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.3}
  - {name: wall, shape: half_plane, px: -<away>, nx: 1.0, friction: 0.3}
  - {name: face, shape: half_plane, px: <away>, nx: -1.0, body: plate, friction: 0.3}
  - {name: rim, shape: circle, py: <r>, radius: <r>, body: disc}
  contacts:
  - {obstacles: [rim, floor]}
  - {obstacles: [rim, wall]}
  - {obstacles: [rim, face]}
  loads:
  - {body: disc, by: -<w>, constant: true}
program:
- name: press
  support_motions:
  - {body: plate, dx: -<r>}
  target: <target>
)",
                   {{"r", radius}, {"away", 1.5 * radius}, {"w", weight}, {"target", 1.0 + beyond}});
}

TEST(ForcesOfBodies, ADiscThatIsClampedEndsThePath) {
  for (const double radius : {1e-3, 1.0, 500.0})
    for (const double weight : {1e-3, 1.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << radius << " " << weight);
      const TracedPath path = Clamped(radius, weight, 0.1);
      EXPECT_FALSE(path.result.reached);
      EXPECT_NE(path.result.message.find("gives way by more than"), std::string::npos) << path.result.message;
      EXPECT_NEAR(path.increments.back().load_factor, 1.0, 2e-7);
      ExpectNoFindings(path);
      EXPECT_TRUE(Clamped(radius, weight, -0.01).result.reached);
    }
}

// A block, whose weight is as high above the floor as its edges are apart, on a floor that tilts by 0.3. The weight is
// that of a program, whose stage brings no load on.
TEST(ForcesOfBodies, AWeightIsAsLargeAsItIs) {
  for (const double weight : {1e-3, 1.0, 1e4, 1e7}) {
    SCOPED_TRACE(weight);
    const TracedPath path = TraceText(R"(
scene:
  name: tilted
  bodies:
  - {name: block, x: 0.0, y: 1.0}
  nodes:
  - {name: lower, x: -0.5, y: 0.0, body: block}
  - {name: upper, x: 0.5, y: 0.0, body: block}
  obstacles:
  - {name: floor, shape: half_plane, ny: 1.0, friction: 0.4}
  contacts:
  - {node: lower, obstacle: floor}
  - {node: upper, obstacle: floor}
  loads:
  - {body: block, by: -<w>, constant: true}
program:
- name: tilt
  obstacle_motions:
  - {obstacle: floor, turn: 1.0}
  target: 0.3
)",
                                      {{"w", weight}});
    ASSERT_TRUE(path.result.reached) << path.result.message;
    const Increment& last = path.increments.back();
    EXPECT_NEAR(last.contacts[0].rn, (0.5 * std::cos(0.3) + std::sin(0.3)) * weight, 1e-8 * weight);
    EXPECT_NEAR(last.contacts[1].rn, (0.5 * std::cos(0.3) - std::sin(0.3)) * weight, 1e-8 * weight);
    ExpectNoFindings(path);
  }
}

// A node on a spring is carried by a plane that turns by 1 about the origin.
TEST(ForcesOfBodies, APlaneThatTurnsIsTheSameInOtherUnits) {
  const auto path_with = [](double length) {
    return TraceText(R"(
scene:
  name: turns
  nodes:
  - {name: q, x: <x>, y: 0.0}
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
)",
                     {{"x", length}});
  };
  const TracedPath path = path_with(1.0);
  EXPECT_TRUE(path.result.reached) << path.result.message;
  for (const double length : {1e-3, 1e4}) {
    SCOPED_TRACE(length);
    const TracedPath other = path_with(length);
    ASSERT_EQ(other.increments.size(), path.increments.size());
    for (std::size_t i = 0; i < path.increments.size(); ++i) {
      EXPECT_NEAR(other.increments[i].positions[1] / length, path.increments[i].positions[1], 1e-12);
      EXPECT_NEAR(other.increments[i].contacts[0].rn / length, path.increments[i].contacts[0].rn, 1e-12);
    }
  }
}

// Over a rough peg a rope draws a block, 5 heavy, on a rough floor: it slides where the weight W at the other end is
// 0.4 * 5 exp(mu phi). Nothing but the rope holds either of them.
TEST(ForcesOfBodies, ARopeIsAPartThatHolds) {
  for (const double EA : {1e2, 1e4, 1e6}) {
    SCOPED_TRACE(EA);
    const TracedPath path = TraceText(R"(
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
  - {nodes: [block, peg, weight], EA: <EA>, friction: 0.25}
options:
  at_limit: stop
)",
                                      {{"EA", EA}});
    const Increment& slips = FirstThat(path, [](const Increment& increment) {
      return increment.kind == IncrementKind::kContactEvent && increment.load_factor > 0.0;
    });
    EXPECT_NEAR(slips.load_factor, 2.0 * std::exp(0.125 * std::acos(-1.0)) - 0.5, 1e-9);
    ExpectNoFindings(path);
  }
}

}  // namespace
}  // namespace contact_path::forces_of_bodies_test
