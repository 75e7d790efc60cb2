// What slides while the load rests: a path that goes on, no jump, and a verdict that no energy tells.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::sliding_test {
namespace {

// A block of the weight w on a rough floor, pushed at the height h by 0 to w, and a wall as far from it as it is wide.
TracedPath Pushed(double w, double h, bool wall_first, AtLimit at_limit) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene = BoxOnFloor(1.0, 1.0, 0.4);
  scene.loads = {WeightOf("box", w)};
  scene.nodes.push_back(NodeOf("box", "t", -0.5, h));
  scene.nodes.push_back(NodeOf("box", "n", 0.5, 0.4));
  scene.obstacles.push_back({"wall", ObstacleShape::kHalfPlane, 1.5, 0.0, -1.0, 0.0});
  scene.contacts.insert(wall_first ? scene.contacts.begin() : scene.contacts.end(), {"n", "wall"});
  request.program = {LoadingStage({{"t", w, 0.0}})};
  request.options.at_limit = at_limit;
  return TraceIncrements(request);
}

TEST(Sliding, ABlockIsPushedToAWall) {
  for (const double w : {2e-3, 2.0, 2e4})
    for (const double height : {0.05, 0.3, 0.5})
      for (const bool wall_first : {false, true}) {
        SCOPED_TRACE(testing::Message() << w << " " << height << " " << wall_first);
        for (const AtLimit at_limit : {AtLimit::kFollow, AtLimit::kJump}) {
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
        const TracedPath stopped = Pushed(w, height, wall_first, AtLimit::kStop);
        EXPECT_EQ(stopped.result.reason, EndReason::kAtLimit) << stopped.result.message;
        EXPECT_NEAR(stopped.increments.back().load_factor, 0.4, 1e-8);
      }
}

// A floor that tilts slides a block down to a stop at tan(turn) = 0.4, and turns on.
TEST(Sliding, ABlockOnATiltedFloor) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene = BoxOnFloor(1.0, 0.5, 0.4);
  scene.loads = {WeightOf("box", 2.0)};
  scene.nodes.push_back(NodeOf("box", "n", -0.5, 0.3));
  scene.obstacles.push_back({"stop", ObstacleShape::kHalfPlane, -2.0, 0.0, 1.0, 0.0});
  scene.contacts.push_back({"n", "stop"});
  request.program = {{"", {}, {}, {{"floor", 0.0, 0.0, 1.0}, {"stop", 0.0, 0.0, 1.0}}, 0.5}};
  for (const auto& [at_limit, step] :
       {std::pair(AtLimit::kFollow, 0.0), {AtLimit::kJump, 0.0}, {AtLimit::kJump, 0.003}}) {
    request.options.at_limit = at_limit;
    request.options.step = step;
    const TracedPath path = TraceVerified(request);
    ASSERT_TRUE(path.result.reached) << path.result.message;
    EXPECT_NEAR(path.increments.back().contacts[2].rn, 2.0 * (std::sin(0.5) - 0.4 * std::cos(0.5)), 1e-8);
  }
}

// A rope over a rough roller, dead loads at both ends: from 2 (exp(0.3 pi) - 1) on it runs through, and what keeps a
// slack rope determined is all that resists.
TEST(Sliding, ARopeRunsOverARoller) {
  for (const double EA : {20.0, 2e3, 2e6})
    for (const double radius : {0.01, 1.0})
      for (const AtLimit at_limit : {AtLimit::kStop, AtLimit::kFollow}) {
        SCOPED_TRACE(testing::Message() << EA << " " << radius << " " << ToString(at_limit));
        TraceRequest request;
        Scene& scene = request.scene;
        scene.nodes = {{"hub", 0.0, 0.0, true, true}, {"A", -radius, -3.0, true}, {"B", radius, -3.0, true}};
        scene.tendons = {{"", {"A", "hub", "B"}, EA, 0.0, 0.3, {0.0, radius, 0.0}, {0.0, -1.0, 0.0}}};
        scene.loads = {{"A", 0.0, -2.0, true}, {"B", 0.0, -2.0, true}, {"B", 0.0, -1.0}};
        request.options.max_increments = 20;
        request.options.at_limit = at_limit;
        const TracedPath path = TraceIncrements(request);
        const double limit = 2.0 * std::expm1(0.3 * std::acos(-1.0));
        if (path.result.reason == EndReason::kAtLimit) {
          EXPECT_NEAR(path.increments.back().load_factor, limit, 1e-8);
        }
        EXPECT_EQ(path.result.reason == EndReason::kAtLimit, at_limit == AtLimit::kStop) << path.result.message;
        EXPECT_EQ(path.increments.back().stability.stability, Verdict::kNotProved);
      }
}

// A box is tied to the wall by a rope of the length that it has: it settles by the 1e-8 by which its contacts give way.
TEST(Sliding, ABoxThatIsTied) {
  for (const double up : {-0.3, -0.1, 0.0, 0.1, 0.3})
    for (const double EA : {0.5, 46.0, 1e4}) {
      SCOPED_TRACE(testing::Message() << up << " " << EA);
      Scene scene = BoxOnFloor(0.6, 0.5, 0.2);
      scene.nodes.push_back(NodeOf("box", "ring", -0.3, 0.1));
      scene.nodes.push_back({"wall", -1.5, 0.1 + up, true, true});
      scene.tendons = {{"", {"wall", "ring"}, EA}};
      scene.loads = {WeightOf("box", 0.7), {"ring", 1.0, 0.0}};
      const TracedPath path = TraceUntil({"load_factor", ">", 0.2}, scene);
      // The rope takes what friction, 0.14, does not.
      if (up == 0.0) {
        EXPECT_NEAR(PositionX(path, path.increments.back(), "ring"), -0.3 + 0.06 * 1.2 / EA, 2e-8);
      }
    }
}

}  // namespace
}  // namespace contact_path::sliding_test
