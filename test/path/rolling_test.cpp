// Circles of bodies that roll and slide, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::rolling_test {
namespace {

constexpr double kExact = 5e-9;  // contacts of bodies give way by 1e-8 of their forces

// A disc of the weight 1 and this radius at a place, with its rim.
void AddDisc(const std::string& name, double x, double y, double radius, double friction, Scene* scene) {
  scene->bodies.push_back({name, x, y});
  scene->obstacles.push_back(Circle("rim_" + name, x, y, radius, friction, name));
}

Obstacle Floor(double friction) { return {"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}; }

// On a floor, held by a spring k at its centre, under a moment M: it rolls by x = M / (k r) and turns by -x / r, and
// slips at M = mu W r. Friction of the contact stands before that of the floor.
TEST(Rolling, ADiscRollsUntilItSlips) {
  for (const double radius : {1e-3, 1.0, 1e3})
    for (const double friction : {0.05, 0.4}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", mu " << friction);
      constexpr double kStiffness = 2.0;
      Scene scene;
      AddDisc("disc", 0.0, radius, radius, 0.0, &scene);
      scene.nodes = {NodeOf("disc", "hub", 0.0, radius)};
      scene.superelements = {{{"hub"}, {kStiffness / radius, 0.0, 0.0, 0.0}}};
      scene.obstacles.push_back(Floor(0.9));
      scene.contacts = {Rolls("rim_disc", "floor")};
      scene.contacts[0].friction = friction;
      scene.loads = {WeightOf("disc", 1.0), LoadOnBody("disc", 0.0, 0.0, false, -radius)};
      const TracedPath path = TraceVerified(RequestWithin(60, scene));
      for (const Increment& increment : path.increments) {
        const double x = increment.positions[0] / radius;
        EXPECT_NEAR(x, increment.load_factor / kStiffness, kExact);
        if (increment.contacts[0].state != ContactState::kStick) continue;
        EXPECT_NEAR(increment.rotations.back(), -x, kExact);
      }
      EXPECT_NEAR(LargestLoadFactor(path), friction, kExact) << path.result.message;
    }
}

// Round a drum of the radius R: where its centre has gone round by phi, the disc has turned by (1 + R / r) phi; within
// a drum by (1 - R / r) phi.
TEST(Rolling, ADiscRollsRoundADrum) {
  for (const bool inside : {false, true})
    for (const double drum : {1.5, 40.0}) {
      SCOPED_TRACE(testing::Message() << (inside ? "inside " : "outside ") << drum);
      const double radius = 0.5, away = inside ? radius - drum : drum + radius;
      Scene scene;
      AddDisc("disc", 0.0, away, radius, 0.0, &scene);
      scene.nodes = {NodeOf("disc", "hub", 0.0, away), {"wall", 3.0, away, true, true}};
      scene.bars = {{{"hub", "wall"}, 5.0}};
      scene.obstacles.push_back(Circle("drum", 0.0, 0.0, drum, 2.0));
      scene.obstacles.back().inside = inside;
      scene.contacts = {Rolls("rim_disc", "drum")};
      scene.loads = {WeightOf("disc", 1.0), LoadOnBody("disc", 0.0, 0.0, false, -0.5)};
      const TracedPath path = TraceVerified(RequestWithin(20, scene));
      ASSERT_GT(path.increments.size(), 10U) << path.result.message;
      double farthest = 0.0;
      for (const Increment& increment : path.increments) {
        if (increment.contacts[0].state != ContactState::kStick) break;
        const double x = increment.positions[increment.positions.size() - 2], y = increment.positions.back();
        const double phi = inside ? std::atan2(x, -y) : std::atan2(-x, y);
        EXPECT_NEAR(increment.rotations.back(), (1.0 + (inside ? -drum : drum) / radius) * phi, 10.0 * kExact);
        farthest = std::max(farthest, std::abs(x));
      }
      EXPECT_GT(farthest, 0.02);
    }
}

// Two discs on a floor beside each other bear a third one as long as friction between discs is at least tan 15 degrees
// and that of the floor (2 - sqrt 3) / 3.
TEST(Rolling, ThreeDiscsHoldByFriction) {
  const double between = std::tan(M_PI / 12.0), floor = (2.0 - std::sqrt(3.0)) / 3.0;
  for (const double radius : {0.01, 1.0})
    for (const auto& [of_discs, of_floor, holds] : {std::tuple(1.001, 1.5, true), std::tuple(1.5, 1.001, true),
                                                    std::tuple(0.999, 1.5, false), std::tuple(1.5, 0.999, false)}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", " << of_discs << ", " << of_floor);
      Scene scene;
      AddDisc("a", -radius, radius, radius, of_discs * between, &scene);
      AddDisc("b", radius, radius, radius, of_discs * between, &scene);
      AddDisc("c", 0.0, (1.0 + std::sqrt(3.0)) * radius, radius, 0.0, &scene);
      scene.obstacles.push_back(Floor(of_floor * floor));
      scene.contacts = {Rolls("rim_a", "floor"), Rolls("rim_b", "floor"), Rolls("rim_a", "rim_b"),
                        Rolls("rim_c", "rim_a"), Rolls("rim_c", "rim_b")};
      for (const RigidBody& body : scene.bodies) {
        scene.loads.push_back(WeightOf(body.name, 1.0));
        scene.loads.back().constant = false;
      }
      const TracedPath path = TraceVerified(RequestUntil({"load_factor", ">", 2.0}, scene));
      ASSERT_FALSE(path.increments.empty()) << path.result.message;
      if (holds)
        EXPECT_NEAR(path.increments.back().load_factor, 2.0, kExact) << path.result.message;
      else
        EXPECT_LT(path.increments.back().load_factor, kExact) << path.result.message;
    }
}

}  // namespace
}  // namespace contact_path::rolling_test
