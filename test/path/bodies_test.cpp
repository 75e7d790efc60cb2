// Rigid bodies in scenes: limits in closed form, and bodies against the same bodies of stiff bars.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::bodies_test {
namespace {

constexpr double kLeast = 1e-8;
constexpr double kExact = 5e-8;  // contacts of bodies give way by 1e-8 of their forces

// A box of the weight 1, `width` wide, on a rough floor; the reference point is above its middle at this height.
TraceRequest Box(double width, double height, double friction) {
  TraceRequest request;
  request.scene = BoxOnFloor(width, height, friction);
  request.scene.loads = {LoadOnBody("box", 0.0, -1.0, true), LoadOnBody("box", 1.0, 0.0)};
  request.options.max_increments = 400;
  return request;
}

// Pushed at the height z, a box slides at mu W where mu < b / (2 z), and tips at W b / (2 z) otherwise.
TEST(Bodies, ABoxSlidesOrTips) {
  for (const double friction : {0.05, 0.2, 0.49, 0.51, 0.8})
    for (const double width : {0.5, 1.0, 3.0}) {
      SCOPED_TRACE(testing::Message() << "mu " << friction << ", width " << width);
      const double height = 1.0, tips = width / (2.0 * height);
      const TracedPath path = TraceVerified(Box(width, height, friction));
      EXPECT_NEAR(LargestLoadFactor(path), std::min(friction, tips), kExact) << path.result.message;
    }
}

// About the edge b a moment tips the box at M = W (b cos t - h sin t) / 2, t its turn, 2 z = h the height.
TEST(Bodies, ABoxTipsByAMoment) {
  TraceRequest request = Box(1.0, 0.8, 0.9);
  request.scene.loads[1] = LoadOnBody("box", 0.0, 0.0, false, -1.0);
  request.options.stop = {{"box.rotation", "<", -0.5}};
  const TracedPath path = TraceTo(request);
  EXPECT_NEAR(LargestLoadFactor(path), 0.5, kExact);
  int tipped = 0;
  for (const Increment& increment : path.increments) {
    const double t = -increment.rotations.back();
    if (!(t > 1e-6)) continue;
    EXPECT_NEAR(increment.load_factor, 0.5 * (std::cos(t) - 1.6 * std::sin(t)), kExact);
    // It is unstable, and goes round the foot b.
    const std::vector<double>& at = increment.positions;
    const std::vector<double>& falls = increment.stability.unstable_direction;
    ASSERT_EQ(falls.size(), at.size());
    EXPECT_NEAR(falls[0] * (at[0] - at[2]) + falls[1] * (at[1] - at[3]), 0.0, kExact);
    EXPECT_GT(std::hypot(falls[0], falls[1]), 0.1);
    EXPECT_NEAR(std::hypot(falls[2], falls[3]), 0.0, kExact);
    ++tipped;
  }
  EXPECT_GT(tipped, 3);
}

// A ladder at the angle a to the floor holds its weight while tan a >= (1 - mu_f mu_w) / (2 mu_f).
TEST(Bodies, ALadderHoldsOrSlides) {
  for (const double floor : {0.3, 0.6})
    for (const double wall : {0.0, 0.4}) {
      const double critical = std::atan((1.0 - floor * wall) / (2.0 * floor));
      for (const double beside : {-0.01, 0.01}) {
        SCOPED_TRACE(testing::Message() << floor << ", " << wall << ", " << beside);
        const double angle = critical + beside, x = std::cos(angle), y = std::sin(angle);
        Scene scene;
        scene.bodies = {{"ladder", 0.5 * x, 0.5 * y}};
        scene.nodes = {NodeOf("ladder", "foot", 0.0, 0.0), NodeOf("ladder", "top", x, y)};
        scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, floor},
                           {"wall", ObstacleShape::kHalfPlane, x, 0.0, -1.0, 0.0, wall}};
        scene.contacts = {{"foot", "floor"}, {"top", "wall"}};
        scene.loads = {LoadOnBody("ladder", 0.0, -1.0)};
        const TracedPath path = TraceVerified(RequestUntil({"load_factor", ">", 2.0}, scene));
        const double reached = path.increments.empty() ? 0.0 : path.increments.back().load_factor;
        if (beside > 0.0)
          EXPECT_NEAR(reached, 2.0, kExact) << path.result.message;
        else
          EXPECT_LT(reached, kExact) << path.result.message;
      }
    }
}

// Feet at x_i share a weight W in the middle, a moment M and a push H as least reactions do: W / n + M x_i / sum x^2
// each, and H / n. In any order, and in any size.
TEST(Bodies, LeastReactionsWhereEquilibriumDoesNotTellThem) {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const std::vector<double>& feet :
         {std::vector<double>{-1.0, 0.0, 1.0}, {1.0, -1.0, 0.0}, {-1.0, 0.3, 0.5, 0.2}}) {
      SCOPED_TRACE(testing::Message() << "size " << size << ", " << feet.size() << " feet");
      TraceRequest request = Box(1.0, size, 0.9);
      Scene& scene = request.scene;
      scene.nodes.clear();
      scene.contacts.clear();
      double squares = 0.0;
      for (const double foot : feet) {
        const std::string name = "foot" + std::to_string(scene.nodes.size());
        scene.nodes.push_back(NodeOf("box", name, size * foot, 0.0));
        scene.contacts.push_back({name, "floor"});
        squares += foot * foot;
      }
      request.options.stop = {{"load_factor", ">", 0.1}};  // H, and M = -H size
      const TracedPath path = TraceTo(request);
      const Increment& last = path.increments.back();
      const double push = last.load_factor, count = static_cast<double>(feet.size());
      for (std::size_t i = 0; i < feet.size(); ++i) {
        EXPECT_NEAR(last.contacts[i].rn, 1.0 / count + push * feet[i] / squares, kLeast) << i;
        EXPECT_NEAR(last.contacts[i].rt, -push / count, kLeast) << i;
      }
    }
}

// A disc between two fingers, nodes on springs that press it with N, mu at its rim: it slips down at W = 2 mu N, and
// the rim turns with it.
TEST(Bodies, ADiscIsHeldByFriction) {
  for (const double friction : {0.1, 0.4, 1.2})
    for (const double size : {1e-3, 1.0, 1e3}) {
      SCOPED_TRACE(testing::Message() << "mu " << friction << ", size " << size);
      Scene scene;
      scene.bodies = {{"disc", 0.0, 0.0}};
      scene.nodes = {{"left", -size, 0.0, false, true}, {"right", size, 0.0, false, true}};
      for (const auto& [name, x] : {std::pair("l", -3.0 * size), std::pair("r", 3.0 * size)})
        scene.nodes.push_back({name, x, 0.0, true, true});
      constexpr double kEA = 5.0, kPress = 0.5;  // N: EA (l0 / l - 1) of bars of the length l
      scene.bars = {{{"l", "left"}, kEA, 2.0 * size / (1.0 - kPress / kEA)},
                    {{"right", "r"}, kEA, 2.0 * size / (1.0 - kPress / kEA)}};
      scene.obstacles = {Circle("rim", 0.0, 0.0, size, friction, "disc")};
      scene.contacts = {{"left", "rim"}, {"right", "rim"}};
      scene.loads = {LoadOnBody("disc", 0.0, -1.0)};
      const TracedPath path = TraceVerified(RequestWithin(60, scene));
      EXPECT_NEAR(LargestLoadFactor(path), 2.0 * friction * kPress, kExact) << path.result.message;
    }
}

// A block between beams and strings over a floor, the block a body or of stiff bars.
TraceRequest Clamped(bool rigid) {
  Scene scene;
  scene.name = "clamped";
  scene.nodes = {{"ground", -1.0, 0.5, true, true}, {"a", 0.0, 0.0}, {"b", 0.6, 0.0}, {"c", 0.6, 0.5}, {"d", 0.0, 0.5},
                 {"top", 0.3, 1.8, true, true}};
  scene.bars = {{{"c", "top"}, 0.8, 0.0, StrainMeasure::kBiot, BarSense::kTension, "cord"}, {{"ground", "d"}, 0.5}};
  scene.beams = {{"spring", {"ground", "a"}, 5.0, 0.05, 0.0, 6, 0.0, {false, true}}};
  scene.obstacles = {{"floor", ObstacleShape::kCircle, 0.5, -3.3, 0.0, 0.0, 0.3, 3.2}};
  scene.contacts = {{"a", "floor"}, {"b", "floor"}};
  if (rigid) {
    scene.bodies = {{"block", 0.25, 0.3}};
    for (std::size_t i = 1; i < 5; ++i) scene.nodes[i].body = "block";
    scene.loads = {LoadOnBody("block", 0.1, -0.4)};
  } else {
    scene.nodes.push_back({"block", 0.25, 0.3});
    constexpr double kStiff = 1e6;
    const std::vector<std::string> names = {"a", "b", "c", "d", "block"};
    for (std::size_t i = 0; i < names.size(); ++i)
      for (std::size_t k = i + 1; k < names.size(); ++k) scene.bars.push_back({{names[i], names[k]}, kStiff});
    scene.loads = {{"block", 0.1, -0.4}};
  }
  return RequestUntil({"load_factor", ">", 0.51}, scene);
}

TEST(Bodies, AreTheSameAsBodiesOfStiffBars) {
  const TracedPath body = TraceIncrements(Clamped(true)), bars = TraceIncrements(Clamped(false));
  ASSERT_EQ(body.result.reason, EndReason::kStopCriterion) << body.result.message;
  ASSERT_EQ(bars.result.reason, EndReason::kStopCriterion) << bars.result.message;
  ExpectSameEvents(body, bars, 3e-7);
  for (const char* const node : {"a", "b", "c", "d"}) {
    EXPECT_NEAR(PositionX(body, body.increments.back(), node), PositionX(bars, bars.increments.back(), node), 3e-7);
    EXPECT_NEAR(PositionY(body, body.increments.back(), node), PositionY(bars, bars.increments.back(), node), 3e-7);
  }
  ExpectNoFindings(body);
}

// Also where two contacts stick at once, behind a load of 0.513.
TEST(Bodies, AreTheSameInOtherWords) {
  TraceRequest request = Clamped(true);
  request.options.stop = {{"load_factor", ">", 0.7}};
  const TracedPath path = TraceIncrements(request);
  ExpectSameInOtherWords(request, path, 1e-7);
}

}  // namespace
}  // namespace contact_path::bodies_test
