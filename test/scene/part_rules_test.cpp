// Rules of bodies, circles that roll, tendons, weights and fillets.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/validate.h"
#include "support/broken_rule.h"
#include "support/curved_obstacles.h"

namespace contact_path::part_rules_test {
namespace {

// A disc with a rim and an eye at its top, in a rope between two hooks, above a floor; and an elastic square.
TraceRequest SoundRequest() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.bodies = {{"disc", 0.0, 1.0}};
  scene.nodes = {{"eye", 0.0, 2.0},
                 {"left", -2.0, 4.0, true, true},
                 {"right", 2.0, 4.0, true, true},
                 {"n1", 5.0, 0.0, true, true},
                 {"n2", 7.0, 0.0, true, true},
                 {"n3", 7.0, 3.0},
                 {"n4", 5.0, 2.0}};
  scene.nodes[0].body = "disc";
  scene.materials = {{"rubber"}};
  scene.materials[0].E = 1.0;
  scene.solids = {{"block", "rubber", 0.5, PlaneState::kStrain, 4, {"n1", "n2", "n3", "n4"}}};
  scene.beams = {{"leg", {"n3", "n4"}, 10.0, 1.0}};
  scene.beams[0].segments = 2;
  scene.tendons = {{"rope", {"left", "eye", "right"}, 10.0}};
  Obstacle rim = CurveThrough(ObstacleShape::kCircle, {});
  rim.name = "rim";
  rim.py = rim.radius = 1.0;
  rim.body = "disc";
  scene.obstacles = {rim, {"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  ContactCandidate rolls;
  rolls.obstacles = {"rim", "floor"};
  scene.contacts = {rolls};
  Load of_body, of_solid, of_beam;
  of_body.body = "disc";
  of_solid.solid = "block";
  of_beam.beam = "leg";
  for (Load* const load : {&of_body, &of_solid, &of_beam}) {
    load->by = -2.0;
    scene.loads.push_back(*load);
  }
  return request;
}

const BrokenRule kRules[] = {
    {"scene.nodes[0].body", "disk", "must name a body of the scene"},
    {"scene.nodes[0].fixed_x", "true", "must be false: the node moves with body disc"},
    {[](auto& r) { r.scene.contacts[0].obstacles.pop_back(); }, "scene.contacts[0].obstacles", "[rim]",
     "must name two obstacles: a circle, and what it may touch"},
    {"scene.contacts[0].obstacles[1]", "flor", "must name an obstacle of the scene; did you mean floor?"},
    {[](auto& r) { std::swap(r.scene.contacts[0].obstacles[0], r.scene.contacts[0].obstacles[1]); },
     "scene.contacts[0].obstacles[0]", "floor", "must be a circle that a body carries, and not be its inside"},
    {"scene.contacts[0].node", "eye", "must be left out where there are obstacles"},
    {[](auto& r) { r.scene.obstacles[0].radius = 1.5; }, "scene.contacts[0]", "rim@floor",
     "the circle penetrates the obstacle at the start by 0.5"},
    {[](auto& r) {
       r.scene.obstacles[0].px = 0.1;
       r.scene.obstacles[0].name = r.scene.contacts[0].obstacles[0] = "n1";
     },
     "scene.contacts[0].obstacles[0]", "n1",
     "must not have the name of a node that is not at the centre of the circle"},
    {[](auto& r) { r.scene.tendons[0].nodes = {"eye"}; }, "scene.tendons[0].nodes", "[eye]",
     "must name two nodes at least"},
    {"scene.tendons[0].nodes[1]", "left", "must not be at the same point as the node before"},
    {"scene.loads[1].solid", "blok", "must name a solid of the scene; did you mean block?"},
    {"scene.loads[2].fx", "1", "must be 0 where there is a beam: bx and by act on it"},
    {[](auto& r) {
       r.scene.loads[0] = {"n3"};
       r.scene.loads[0].bx = 1.0;
     },
     "scene.loads[0].bx", "1", "must be 0: a weight needs a solid, a beam or a body"},
    {"options.friction_law", "total", "must be incremental where a body carries an obstacle"},
};

TEST(PartRulesTest, BrokenRulesAreReportedAlone) {
  for (const BrokenRule& rule : kRules) ExpectBrokenAlone(rule, SoundRequest());
}

// The area of the square is 5, and its centre at (5 + 16/15, 19/15).
TEST(PartRules, WeightsActOnNodes) {
  const Expansion expansion = Expand(SoundRequest());
  const Scene& scene = expansion.request.scene;
  double force = 0.0, moment = 0.0, of_beam = 0.0;
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const Load& load = scene.loads[i];
    if (expansion.loads[0][i] == 2) of_beam += load.fy;
    if (expansion.loads[0][i] != 1) continue;
    force += load.fy;
    for (const Node& node : scene.nodes)
      if (node.name == load.node) moment += node.x * load.fy;
  }
  EXPECT_EQ(scene.loads[0].node, "disc");
  EXPECT_EQ(scene.loads[0].fy, -2.0);
  EXPECT_NEAR(force, -0.5 * 5.0 * 2.0, 1e-13);
  EXPECT_NEAR(moment / force, 5.0 + 16.0 / 15.0, 1e-13);
  EXPECT_NEAR(of_beam, -2.0 * std::hypot(2.0, 1.0), 1e-13);
  EXPECT_EQ(scene.contacts[0].Name(), "rim@floor");
  EXPECT_EQ(scene.contacts[0].node, "disc");
}

// Names of solids need not differ: the weight is that of all that have it.
TEST(PartRules, WeightsAreOfAllSolidsOfAName) {
  TraceRequest request = SoundRequest();
  request.scene.solids.push_back(request.scene.solids[0]);
  const Expansion expansion = Expand(request);
  double force = 0.0;
  for (std::size_t i = 0; i < expansion.request.scene.loads.size(); ++i)
    if (expansion.loads[0][i] == 1) force += expansion.request.scene.loads[i].fy;
  EXPECT_NEAR(force, 2.0 * -0.5 * 5.0 * 2.0, 1e-13);
}

// A negative friction of a contact with an obstacle stands for that of the obstacle.
TEST(PartRules, FrictionOfAContact) {
  TraceRequest request = SoundRequest();
  for (const auto& [given, is] : {std::pair(-1.0, 0.3), std::pair(0.0, 0.3), std::pair(0.7, 0.7)}) {
    request.scene.contacts[0].friction = given;
    EXPECT_TRUE(Validate(request).empty());
    EXPECT_EQ(request.scene.contacts[0].FrictionWith(request.scene.obstacles[1]), is);
  }
}

TEST(PartRules, ACentreBesideTheBodyIsANode) {
  TraceRequest request = SoundRequest();
  request.scene.obstacles[0].px = 0.1;
  EXPECT_TRUE(Validate(request).empty());
  const Scene scene = Expand(request).request.scene;
  EXPECT_EQ(scene.contacts[0].node, "rim");
  EXPECT_EQ(scene.nodes.back().name, "rim");
  EXPECT_EQ(scene.nodes.back().body, "disc");
}

// Two corners of one polyline with fillets of their own.
TEST(PartRules, FilletsHaveRoom) {
  TraceRequest request = SoundRequest();
  Obstacle step = CurveThrough(ObstacleShape::kPolyline, {-9.0, 0.0, -4.0, 0.0, -4.0, -1.0, -3.0, -1.0});
  step.name = "step";
  step.fillets = {0.0, 0.2, 0.8, 0.0};
  request.scene.obstacles.push_back(step);
  for (const Violation& violation : Validate(request)) ADD_FAILURE() << violation.ToLine();
  request.scene.obstacles.back().fillets[1] = 0.3;
  ASSERT_EQ(Validate(request).size(), 1U);
  EXPECT_EQ(Validate(request)[0].rule, "the edge from point 2 must have room for those at both of its ends");
  request.scene.obstacles.back().fillets.pop_back();
  EXPECT_EQ(Validate(request)[0].rule, "must be empty or have 4 entries, one for each point");
}

}  // namespace
}  // namespace contact_path::part_rules_test
