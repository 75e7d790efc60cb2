#include "contact_path/path/free_motion.h"

#include <gtest/gtest.h>

#include <string>

#include "support/traced_path.h"

namespace contact_path::free_motion_test {
namespace {

constexpr double kForce = 1e-10;

std::string Question(const TraceRequest& request) {
  const Model model(request.scene, CharacteristicScales(request.scene));
  return FreeMotionQuestion(model, model.InitialPoint(), kForce);
}

// The bar from a, pinned, to b on the floor can swing about a: only pressed on the floor would b be held.
TEST(FreeMotion, OfABarAboutItsSupport) {
  const TraceRequest request = ReadExample("sliding_bar");
  const Model model(request.scene, CharacteristicScales(request.scene));
  PathPoint point = model.InitialPoint();
  EXPECT_EQ(FreeNodes(model, point, kForce), std::vector<int>{1});
  EXPECT_EQ(FreeMotionText(model, point, kForce), "node b moves freely; b@floor touches");
  point.forces[0] = 0.1;
  EXPECT_TRUE(FreeNodes(model, point, kForce).empty());
  EXPECT_EQ(FreeMotionText(model, point, kForce), "");
  EXPECT_EQ(FreeMotionQuestion(model, point, kForce), "");
}

TEST(FreeMotion, AsksTheLikelyQuestion) {
  TraceRequest request = ReadExample("sliding_bar");
  EXPECT_EQ(Question(request),
            "node b moves freely; b@floor touches: does the normal of floor point to the side where the node may be? "
            "is a contact or a support missing? is the friction of floor (0.3) too small?");
  request.scene.contacts.clear();
  EXPECT_EQ(Question(request), "node b moves freely: is a contact or a support missing?");
  request.scene.nodes[0].fixed_x = request.scene.nodes[0].fixed_y = false;
  EXPECT_EQ(Question(request), "nodes a, b move freely: is a contact or a support missing?");
}

// Over the middle one of three nodes of an arch, at which the smooth curve is by an eighth of its rise of 0.2 lower.
TEST(FreeMotion, TellsTheGapAtWhichTheCurvePasses) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"l0", -1.0, -0.1, true, true},
                 {"l1", 0.0, 0.0, true, true},
                 {"l2", 1.0, -0.1, true, true},
                 {"p", 0.0, 0.0, true, false},
                 {"q", 0.0, 1.0, true, false}};
  scene.bars = {{{"l0", "l1"}, 1.0}, {{"l1", "l2"}, 1.0}, {{"p", "q"}, 1.0}};
  scene.surfaces = {{"lower", {"l0", "l1", "l2"}}};
  scene.contacts = {{"p", "", "", "lower"}};
  scene.loads = {{"q", 0.0, -1.0}};
  EXPECT_EQ(Question(request),
            "nodes p, q move freely; the nearest candidate is open: p@lower, gap 0.025 (the smooth curve of surface "
            "lower passes 0.025 from its node l1): is a contact or a support missing?");
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kPathEnd, Question(request));
  scene.nodes[3].y = 0.475;
  EXPECT_EQ(Question(request),
            "nodes p, q move freely; the nearest candidate is open: p@lower, gap 0.5: is a contact or a support "
            "missing?");
}

// A post in a guide across the floor cannot slide on it: the friction of the floor is that of the bar.
TEST(FreeMotion, AsksForTheFrictionThoughTheFirstContactCannotSlide) {
  TraceRequest request = ReadExample("sliding_bar");
  Scene& scene = request.scene;
  scene.nodes.push_back({"post", 3.0, 0.0, true, false});
  scene.nodes.push_back({"wall", 4.0, 0.0, true, true});
  scene.bars.push_back({{"post", "wall"}, 1.0});
  scene.contacts.insert(scene.contacts.begin(), {"post", "floor"});
  EXPECT_EQ(
      Question(request),
      "nodes b, post move freely; post@floor, b@floor touch: does the normal of floor point to the side where the "
      "nodes may be? is a contact or a support missing? is the friction of floor (0.3) too small?");
}

// A chain of seven bars that hangs loose, beside a truss that does not move.
TEST(FreeMotion, ListsFiveNodesAndCountsTheRest) {
  TraceRequest request = ReadExample("von_mises");
  std::string before = request.scene.nodes[0].name;
  for (int i = 0; i < 7; ++i) {
    const std::string name = "link" + std::to_string(i);
    request.scene.nodes.push_back({name, -2.0 - i, 0.3 * (i % 2), false, false});
    request.scene.bars.push_back({{before, name}, 1.0});
    before = name;
  }
  EXPECT_EQ(Question(request),
            "nodes link0, link1, link2, link3, link4 and 2 more move freely: is a contact or a support missing?");
}

// The three mistakes of a beginner, as the trace tells them.
TEST(FreeMotion, IsToldWhereThePathEndsAtItsStart) {
  TraceRequest reversed = ReadExample("sliding_bar"), forgotten = reversed, hanging = reversed;
  reversed.scene.obstacles[0].ny = -1.0;
  forgotten.scene.contacts.clear();
  hanging.scene.nodes[0].fixed_x = hanging.scene.nodes[0].fixed_y = false;
  for (const TraceRequest& request : {reversed, forgotten, hanging}) {
    const TracedPath path = TraceIncrements(request);
    ExpectEnd(path, EndReason::kPathEnd, Question(request));
  }
}

// Above the floor, without a load.
TEST(FreeMotion, IsToldWhereThePathWandersWithoutALoad) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.stop = {{"load_factor", ">", 7.0}};
  request.options.max_increments = 150;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements);
  EXPECT_EQ(path.result.message,
            "the wanted number of increments was accepted; no stop criterion was met (load_factor > 7); without a "
            "load, node b moves freely");
}

}  // namespace
}  // namespace contact_path::free_motion_test
