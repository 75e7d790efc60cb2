// Tendons through eyes without friction, in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::tendons_test {
namespace {

constexpr double kExact = 1e-10;
constexpr double kSame = 1e-9;

// An eye that hangs in a rope of the length l0 from (-a, 0) to (a, 0), and is pushed aside by H under a weight W: it is
// on the ellipse of the strings, pulled by N along both of them.
TEST(Tendons, AnEyeSlidesAlongARope) {
  for (const double EA : {10.0, 1e3, 1e6}) {
    SCOPED_TRACE(EA);
    TraceRequest request;
    Scene& scene = request.scene;
    scene.nodes = {{"left", -1.0, 0.0, true, true}, {"eye", 0.0, -1.0}, {"right", 1.0, 0.0, true, true}};
    scene.tendons = {{"rope", {"left", "eye", "right"}, EA, 2.8}};
    scene.loads = {{"eye", 0.0, -1.0, true}, {"eye", 1.0, 0.0}};
    request.options.stop = {{"eye.x", ">", 0.6}};
    request.options.record = {"sections"};
    const TracedPath path = TraceTo(request);
    for (const Increment& increment : path.increments) {
      const double x = increment.positions[2], y = increment.positions[3];
      const double left = std::hypot(x + 1.0, y), right = std::hypot(x - 1.0, y);
      const double N = EA * ((left + right) / 2.8 - 1.0);
      EXPECT_NEAR(-N * (y / left + y / right), 1.0, 1e-9);
      EXPECT_NEAR(N * ((x + 1.0) / left + (x - 1.0) / right), increment.load_factor, 1e-9);
      ASSERT_EQ(increment.sections.size(), 2U);
      for (const SectionForces& section : increment.sections) EXPECT_NEAR(section.N, N, 1e-9);
      EXPECT_EQ(increment.bars[0], BarState::kTaut);
    }
  }
}

// A tackle: the rope goes n times between a fixed block and a block with the weight W; the hand pulls W / n.
TEST(Tendons, ATackleShares) {
  for (const int parts : {2, 3, 4, 6}) {
    SCOPED_TRACE(parts);
    Scene scene;
    scene.nodes = {{"roof", 0.0, 0.0, true, true}, {"load", 0.0, -5.0, true, false}, {"hand", 1.0, 0.0, true, true}};
    std::vector<std::string> nodes;
    for (int i = 0; i <= parts; ++i) nodes.emplace_back((parts - i) % 2 == 0 ? "roof" : "load");
    nodes.emplace_back("hand");
    scene.tendons = {{"", nodes, 1e3, 0.0}};
    scene.loads = {{"load", 0.0, -1.0, true}};
    scene.support_motions = {{"hand", 1.0, 0.0}};
    const TracedPath path = TraceUntil({"load_factor", ">", 2.0}, scene);
    const double first = path.increments.front().positions[3];
    for (const Increment& increment : path.increments) {
      EXPECT_NEAR(increment.supports.back().rx, 1.0 / parts, kExact);
      EXPECT_NEAR(increment.positions[3] - first, increment.load_factor / parts, kExact);
    }
  }
}

// A slack tendon bears nothing; a body with two eyes that is lifted by one becomes horizontal: both ends of the rope
// hang from it at equal tensions.
TEST(Tendons, AreTheSameInOtherWords) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.bodies = {{"load", 0.05, -1.8}};
  scene.nodes = {NodeOf("load", "one", -0.5, -0.9), NodeOf("load", "two", 0.6, -0.8), {"hook", 0.0, 0.0, true, true}};
  scene.tendons = {{"sling", {"one", "hook", "two"}, 50.0, 2.0}};
  scene.loads = {WeightOf("load", 1.0), LoadOnBody("load", 0.4, 0.0, false, 0.2)};
  scene.superelements = {{{"one"}, {0.3, 0.0, 0.0, 0.3}}};
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceTo(request);
  EXPECT_EQ(path.increments.front().bars[0], BarState::kTaut);
  ExpectSameInOtherWords(request, path, kSame);
}

}  // namespace
}  // namespace contact_path::tendons_test
