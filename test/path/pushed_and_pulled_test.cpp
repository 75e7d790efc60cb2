// Rigid bodies that are pushed, pulled back and pulled over: rough contacts alone tell most of their forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::pushed_and_pulled_test {
namespace {

constexpr double kExact = 1e-7;  // contacts of bodies give way by 1e-8 of their forces

double ForceOf(const Resultant& support) { return std::hypot(support.rx, support.ry); }

// Blocks of the weight 1 in a row on a floor with friction 0.3. A hand on a bar pushes the first one on by 1, and pulls
// it back as far.
TraceRequest BlocksInARow(int count) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"hand", -1.5, 0.25, true, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i), block = "block" + number;
    const double x = 1.1 * i;
    scene.bodies.push_back({block, x, 0.5});
    for (const Node& node :
         {NodeOf(block, "l" + number, x - 0.5, 0.0), NodeOf(block, "r" + number, x + 0.5, 0.0),
          NodeOf(block, "behind" + number, x - 0.5, 0.25), NodeOf(block, "ahead" + number, x + 0.5, 0.25)})
      scene.nodes.push_back(node);
    scene.contacts.push_back({"l" + number, "floor"});
    scene.contacts.push_back({"r" + number, "floor"});
    scene.loads.push_back(WeightOf(block, 1.0));
    if (i == 0) continue;
    Obstacle face{"face" + number, ObstacleShape::kHalfPlane, x - 0.5, 0.0, -1.0, 0.0};
    face.body = block;
    scene.obstacles.push_back(face);
    scene.contacts.push_back({"ahead" + std::to_string(i - 1), face.name});
  }
  scene.bars = {{{"hand", "behind0"}, 50.0}};
  request.program = {MovingStage({{"hand", 1.0, 0.0}}), MovingStage({{"hand", -1.0, 0.0}})};
  return request;
}

TEST(PushedAndPulled, BlocksInARow) {
  for (const int count : {1, 2, 3})
    for (const double angle : {0.0, 0.02, 0.1, 0.5, 0.8})
      for (const bool backwards : {false, true}) {
        SCOPED_TRACE(testing::Message() << count << " blocks, turned by " << angle << (backwards ? ", backwards" : ""));
        const TraceRequest turned = Rotate(BlocksInARow(count), angle);
        const TracedPath path = TraceProved(backwards ? Reverse(turned) : turned);
        EXPECT_NEAR(ForceOf(LastOfStage(path, 1).supports[0]), 0.3 * count, kExact);
        EXPECT_NEAR(ForceOf(path.increments.back().supports[0]), 0.3, kExact);
      }
}

// Two bodies cross in a pin; one stands in a fixed pin, the other slides on the floor. A platform on them is pinned to
// the second one, and slides on the first one. A hand on a bar drives the foot inwards and back.
TEST(PushedAndPulled, AScissorLift) {
  const double x = 2.0 * std::cos(0.4), y = 2.0 * std::sin(0.4);
  for (const double below : {0.05, 0.2})
    for (const double above : {0.05, 0.2, 0.4}) {
      SCOPED_TRACE(testing::Message() << below << " " << above);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.bodies = {{"one", 0.0, 0.0}, {"other", 0.5 * x, 0.5 * y}, {"platform", 0.5 * x, y}};
      scene.nodes = {{"base", 0.0, 0.0, true, true},
                     NodeOf("one", "heel", 0.0, 0.0),
                     NodeOf("one", "middle", 0.5 * x, 0.5 * y),
                     NodeOf("one", "tip", x, y),
                     NodeOf("other", "foot", x, 0.0),
                     NodeOf("other", "centre", 0.5 * x, 0.5 * y),
                     NodeOf("other", "head", 0.0, y),
                     NodeOf("platform", "edge", 0.0, y),
                     {"hand", x + 2.0, 0.0, true, true}};
      scene.pins = {{{"base", "heel"}}, {{"middle", "centre"}}, {{"head", "edge"}}};
      scene.bars = {{{"foot", "hand"}, 200.0}};
      scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, below},
                         {"plate", ObstacleShape::kHalfPlane, 0.0, y, 0.0, -1.0, above}};
      scene.obstacles[1].body = "platform";
      scene.contacts = {{"foot", "floor"}, {"tip", "plate"}};
      scene.loads = {WeightOf("platform", 1.0)};
      request.program = {MovingStage({{"hand", -0.8, 0.0}}), MovingStage({{"hand", 0.8, 0.0}})};
      const TracedPath path = TraceProved(request);
      for (const Increment& increment : path.increments) {
        if (increment.kind != IncrementKind::kRegular) continue;
        EXPECT_NEAR(SumOfNormals(increment), 2.0 * increment.contacts[0].rn, kExact);  // both bear alike
      }
    }
}

// A disc of the weight 1 rolls to a curb of the height 0.3, rounded by 0.001, and is pulled over it at its centre: the
// curb's force goes through the centre, too.
TEST(PushedAndPulled, ADiscOverACurb) {
  constexpr double kRadius = 0.001, kDown = 1.0 - (0.3 - kRadius);
  const double across = std::sqrt((1.0 + kRadius) * (1.0 + kRadius) - kDown * kDown);
  for (const double friction : {0.2, 0.6, 1.2})
    for (const double angle : {0.0, 0.5}) {
      SCOPED_TRACE(testing::Message() << friction << " " << angle);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.bodies = {{"disc", 0.0, 1.0}};
      scene.nodes = {NodeOf("disc", "hub", 0.0, 1.0), {"hand", 3.0, 1.0, true, true}};
      scene.bars = {{{"hub", "hand"}, 100.0}};
      Obstacle curb{"curb", ObstacleShape::kPolyline};
      curb.friction = friction;
      curb.points = {1.5, -5.0, 1.5, 0.3, 8.0, 0.3};
      curb.fillet = kRadius;
      scene.obstacles = {Circle("rim", 0.0, 1.0, 1.0, 0.0, "disc"),
                         {"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction},
                         curb};
      scene.contacts = {Rolls("rim", "floor"), Rolls("rim", "curb")};
      scene.loads = {WeightOf("disc", 1.0)};
      request.program = {MovingStage({{"hand", 3.0, 0.0}})};
      const TracedPath path = TraceProved(Rotate(request, angle));
      double largest = 0.0;
      for (const Increment& increment : path.increments) largest = std::max(largest, ForceOf(increment.supports[0]));
      EXPECT_NEAR(largest, across / kDown, 1e-6);
    }
}

// A disc between two jaws on springs, whose faces are at +-0.98 where nothing presses them, is pulled out over the ends
// of the faces at x = 0.8: while both rub, nothing tells how it turns. It leaves them where they have closed behind it.
TEST(PushedAndPulled, ADiscOutOfJaws) {
  for (const double friction : {0.1, 0.4, 0.6})
    for (const double force : {1.0, 1e-3, 4.448}) {
      SCOPED_TRACE(testing::Message() << friction << " " << force);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.bodies = {{"disc", 0.0, 0.0}};
      scene.nodes = {NodeOf("disc", "hub", 0.0, 0.0), {"hand", 2.0, 0.0, true, true}};
      scene.obstacles = {Circle("rim", 0.0, 0.0, 1.0, 0.0, "disc")};
      for (const double side : {1.0, -1.0}) {
        const std::string name = side > 0.0 ? "upper" : "lower";
        RigidBody jaw{name, 0.0, side};
        jaw.fixed_x = jaw.fixed_rotation = true;
        scene.bodies.push_back(jaw);
        scene.nodes.push_back(NodeOf(name, "on_" + name, 0.0, side));
        scene.superelements.push_back({{"on_" + name}, {0.0, 0.0, 0.0, 50.0}, {0.0, 0.98 * side}});
        Obstacle face{"face_" + name, ObstacleShape::kPolyline};
        face.friction = friction;
        face.points = {0.8, side, -3.0, side};
        if (side < 0.0) std::swap(face.points[0], face.points[2]);
        face.body = name;
        scene.obstacles.push_back(face);
        scene.contacts.push_back(Rolls("rim", face.name));
      }
      scene.bars = {{{"hub", "hand"}, 20.0}};
      request.program = {MovingStage({{"hand", 1.5, 0.0}})};
      const TracedPath path = TraceProved(ChangeUnits(request, 1.0, force));
      const Increment& open =
          FirstThat(path, [](const Increment& increment) { return SumOfNormals(increment) < 1e-9; });
      EXPECT_NEAR(PositionX(path, open, "hub"), 0.8 + std::sqrt(1.0 - 0.98 * 0.98), kExact);
      EXPECT_EQ(path.increments.back().contacts[0].state, ContactState::kOpen);
    }
}

// A disc of the weight 1 rolls on a rough floor, drawn by a cord round a drum of half its radius, 40 degrees upwards:
// it follows without a force, and nothing tells the cord's stiffness. The hand ends at the same cord length.
TEST(PushedAndPulled, ASpoolFollowsACordWithoutTension) {
  const double up = 40.0 / 180.0 * std::acos(-1.0), c = std::cos(up), s = std::sin(up);
  for (const AtLimit at_limit : {AtLimit::kFollow, AtLimit::kStop, AtLimit::kJump})
    for (const double angle : {0.0, 0.3}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(at_limit) << " " << angle);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.bodies = {{"spool", 0.0, 1.0}};
      // The cord leaves the drum below, at 0.5 (s, -c) from its middle.
      scene.nodes = {NodeOf("spool", "hub", 0.0, 1.0),
                     {"hand", 0.5 * s + 30.0 * c, 1.0 - 0.5 * c + 30.0 * s, true, true}};
      scene.tendons = {{"cord", {"hub", "hand"}, 1e4}};
      scene.tendons[0].radii = {0.5, 0.0};
      scene.tendons[0].turns = {1, 0};
      scene.obstacles = {Circle("rim", 0.0, 1.0, 1.0, 0.0, "spool"),
                         {"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.6}};
      scene.contacts = {Rolls("rim", "floor")};
      scene.loads = {WeightOf("spool", 1.0)};
      request.program = {MovingStage({{"hand", c, s}})};
      request.options.at_limit = at_limit;
      const TracedPath path = TraceProved(Rotate(request, angle));
      for (const Increment& increment : path.increments)
        EXPECT_NE(increment.stability.stability, Verdict::kUnstable) << increment.index;
      EXPECT_NEAR(path.increments.back().contacts[0].rn, 1.0, kExact);
      EXPECT_NEAR(
          std::hypot(PositionX(path, path.increments.back(), "hub") - PositionX(path, path.increments[0], "hub"),
                     PositionY(path, path.increments.back(), "hub") - PositionY(path, path.increments[0], "hub")),
          -path.increments.back().rotations.back(), kExact);
      EXPECT_LT(path.increments.back().rotations.back(), -3.5);  // cos up - 0.5 of its way is what the hand goes
    }
}

// A slider on a guide is driven by a machine against a sprung follower, and past it. Before and behind, nothing but the
// machine holds it.
TEST(PushedAndPulled, ASliderPastADetent) {
  for (const double stiffness : {0.3, 2.0, 20.0, static_cast<double>(INFINITY)}) {
    SCOPED_TRACE(stiffness);
    Scene scene;
    RigidBody slider{"slider", -0.3, 0.0};
    slider.fixed_y = slider.fixed_rotation = true;
    scene.bodies = {slider};
    scene.nodes = {{"follower", 0.0, 0.05, true}};
    scene.superelements = {{{"follower"}, {0.0, 0.0, 0.0, 10.0}, {0.0, 0.05}}};
    scene.obstacles = {Circle("bump", -0.3, 0.0, 0.1, 0.0, "slider")};
    scene.contacts = {{"follower", "bump"}};
    scene.loads = {LoadOnBody("slider", 1.0, 0.0)};
    TraceRequest request = RequestUntil({"setting", ">", 1.5}, scene);
    request.options.machine_stiffness = stiffness;
    request.options.at_limit = AtLimit::kJump;
    const TracedPath path = TraceProved(request);
    EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kJump).size(), stiffness < 5.0 ? 1U : 0U);
    for (const Increment& increment : path.increments)
      if (increment.kind != IncrementKind::kOnset && increment.kind != IncrementKind::kContactEvent) {
        EXPECT_EQ(increment.stability.stability_controlled, Verdict::kStable) << increment.index;
      }
    EXPECT_EQ(path.increments.front().stability.stability, Verdict::kNotProved);
  }
}

// Two equal trusses of two bars under one machine of the stiffness 1 come to their limit points at once. One goes on
// through its own, and the other one back: where one truss alone has the limit load s at the way w, the setting there
// is sqrt(2) (w + s). Nothing jumps, whatever the step.
TEST(PushedAndPulled, TwoTrussesAtOneLimitPoint) {
  const auto trusses = [](int count) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i), top = "top" + number;
      const double x = 3.0 * i;
      scene.nodes.insert(
          scene.nodes.end(),
          {{"left" + number, x - 1.0, 0.0, true, true}, {"right" + number, x + 1.0, 0.0, true, true}, {top, x, 0.3}});
      scene.bars.push_back({{"left" + number, top}, 1.0});
      scene.bars.push_back({{"right" + number, top}, 1.0});
      scene.loads.push_back({top, 0.0, -1.0});
    }
    return scene;
  };
  const Increment limit = TraceTo(RequestUpToALimit(trusses(1)), EndReason::kAtLimit).increments.back();
  const double way = 0.3 - limit.positions[5], load = limit.load_factor;
  for (const double step : {0.0, 0.02, 0.003}) {
    SCOPED_TRACE(step);
    TraceRequest both = RequestUntil({"setting", ">", 0.25}, trusses(2));
    both.options.at_limit = AtLimit::kJump;
    both.options.machine_stiffness = 1.0;
    both.options.step = step;
    const TracedPath path = TraceProved(both);
    EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kJump).empty());
    const std::vector<Increment> turns = IncrementsOfKind(path, IncrementKind::kCornerLimit);
    ASSERT_EQ(turns.size(), 1U);
    EXPECT_NEAR(turns[0].load_factor, load, 1e-10);
    EXPECT_NEAR(turns[0].setting, std::sqrt(2.0) * (way + load), 1e-9);
    EXPECT_GT(std::abs(path.increments.back().positions[5] - path.increments.back().positions[11]), 0.1);
  }
}

// A block on a slope that is steeper than its friction: the sentence of the end asks for the friction of the floor that
// the feet of the body touch.
TEST(PushedAndPulled, ABlockOnASteepSlopeIsToldOfItsFriction) {
  TraceRequest request;
  request.scene = BoxOnFloor(1.0, 0.5, 0.3);
  request.scene.loads = {WeightOf("box", 1.0), LoadOnBody("box", 0.5, 0.0, true), LoadOnBody("box", 1.0, 0.0)};
  const TracedPath path = TraceIncrements(request);
  EXPECT_FALSE(path.result.reached);
  EXPECT_NE(path.result.message.find("is the friction of floor (0.3) too small?"), std::string::npos)
      << path.result.message;
}

// Levers on springs, each from stop to stop over its centre, under one machine: it holds one of them on its way as long
// as its stiffness is more than that of the levers that go, and the others stay on their stops.
TEST(PushedAndPulled, EqualSwitchesGoOneByOneUnderAStiffMachine) {
  TraceRequest request;
  Scene& scene = request.scene;
  const double s = std::sin(0.5), c = std::cos(0.5);
  for (const int i : {0, 1}) {
    const std::string number = std::to_string(i), lever = "lever" + number, tip = "tip" + number;
    const double x = 4.0 * i;
    scene.bodies.push_back({lever, x - s, c});
    scene.nodes.insert(scene.nodes.end(), {{"ground" + number, x, 0.0, true, true},
                                           NodeOf(lever, "pivot" + number, x, 0.0),
                                           NodeOf(lever, tip, x - s, c),
                                           {"anchor" + number, x, -1.0, true, true}});
    scene.bars.push_back({{tip, "anchor" + number}, 10.0, 1.0});
    scene.pins.push_back({{"ground" + number, "pivot" + number}});
    scene.obstacles.push_back({"left" + number, ObstacleShape::kHalfPlane, x - s, 0.0, 1.0, 0.0});
    scene.obstacles.push_back({"right" + number, ObstacleShape::kHalfPlane, x + s, 0.0, -1.0, 0.0});
    scene.contacts.push_back({tip, "left" + number});
    scene.contacts.push_back({tip, "right" + number});
  }
  request.program = {LoadingStage({{"tip0", 1.0, 0.0}, {"tip1", 1.0, 0.0}}, 3.0)};
  request.options.at_limit = AtLimit::kJump;
  request.options.machine_stiffness = 50.0;
  const TracedPath path = TraceProved(request);
  EXPECT_NEAR(LoadsOfKind(path, IncrementKind::kCornerLimit).at(0), 2.643872, 1e-6);
  // One of them is at its other stop while the other one has not left its own.
  const auto at = [&](const Increment& increment, int i) {
    return PositionX(path, increment, "tip" + std::to_string(i)) - 4.0 * i;
  };
  EXPECT_TRUE(std::any_of(path.increments.begin(), path.increments.end(), [&](const Increment& increment) {
    return std::abs(at(increment, 0) + at(increment, 1)) < 1e-6 && std::abs(at(increment, 0)) > s - 1e-6;
  }));
  EXPECT_NEAR(at(path.increments.back(), 0), s, 1e-6);
  EXPECT_NEAR(at(path.increments.back(), 1), s, 1e-6);
}

}  // namespace
}  // namespace contact_path::pushed_and_pulled_test
