// Forces of rigid bodies from far below to far above the characteristic one, and what is clamped.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::forces_of_bodies_test {
namespace {

// A plate comes from half a radius beside a disc, moves it on by half a radius to a wall, and is to go on by `beyond`
// radii.
TracedPath Clamped(double radius, double weight, double beyond) {
  Scene scene;
  const double away = 1.5 * radius;
  scene.bodies = {{"disc", 0.0, radius}, {"plate", away, 0.0, true, true, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3},
                     {"wall", ObstacleShape::kHalfPlane, -away, 0.0, 1.0, 0.0, 0.3},
                     {"face", ObstacleShape::kHalfPlane, away, 0.0, -1.0, 0.0, 0.3},
                     Circle("rim", 0.0, radius, radius, 0.0, "disc")};
  scene.obstacles[2].body = "plate";
  scene.contacts = {Rolls("rim", "floor"), Rolls("rim", "wall"), Rolls("rim", "face")};
  scene.loads = {WeightOf("disc", weight)};
  return TraceIncrements(RequestOf(scene, {MovingStage({{"", -radius, 0.0, 0.0, "", "plate"}}, 1.0 + beyond)}));
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
    TraceRequest request;
    request.scene = BoxOnFloor(1.0, 1.0, 0.4);
    request.scene.loads = {WeightOf("box", weight)};
    request.program = {{"", {}, {}, {{"floor", 0.0, 0.0, 1.0}}, 0.3}};
    const TracedPath path = TraceTo(request);
    const Increment& last = path.increments.back();
    EXPECT_NEAR(last.contacts[0].rn, (0.5 * std::cos(0.3) + std::sin(0.3)) * weight, 1e-8 * weight);
    EXPECT_NEAR(last.contacts[1].rn, (0.5 * std::cos(0.3) - std::sin(0.3)) * weight, 1e-8 * weight);
  }
}

// A node on a spring is carried by a plane that turns by 1 about the origin.
TEST(ForcesOfBodies, APlaneThatTurnsIsTheSameInOtherUnits) {
  const auto path_with = [](double length) {
    TraceRequest request;
    request.scene = NodeOnFloor("q", 0.05, 0.2);
    request.scene.nodes[0].x = length;
    request.program = {{"", {}, {}, {{"floor", 0.0, 0.0, 1.0}}, 1.0}};
    return TraceIncrements(request);
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
    Scene scene;
    scene.nodes = {{"block", -1.0, 0.0}, {"peg", 0.0, 0.0, true, true}, {"weight", 0.0, -1.0}};
    scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.4}};
    scene.contacts = {{"block", "floor"}};
    scene.loads = {{"block", 0.0, -5.0, true}, {"weight", 0.0, -0.5, true}, {"weight", 0.0, -1.0}};
    scene.tendons = {{"", {"block", "peg", "weight"}, EA, 0.0, 0.25}};
    const TracedPath path = TraceVerified(RequestUpToALimit(scene));
    const Increment& slips = FirstThat(path, [](const Increment& increment) {
      return increment.kind == IncrementKind::kContactEvent && increment.load_factor > 0.0;
    });
    EXPECT_NEAR(slips.load_factor, 2.0 * std::exp(0.125 * std::acos(-1.0)) - 0.5, 1e-9);
    ExpectNoFindings(path);
  }
}

}  // namespace
}  // namespace contact_path::forces_of_bodies_test
