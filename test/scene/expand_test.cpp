#include "contact_path/scene/expand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/validate.h"
#include "support/broken_rule.h"

namespace contact_path::expand_test {
namespace {

constexpr char kFrame[] = R"(
scene:
  name: frame
  nodes:
  - {name: a, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true, fixed_rotation: true}
  - {name: b, x: 2.0, y: 0.0}
  - {name: c, x: 2.0, y: 1.0}
  beams:
  - {name: leg, nodes: [a, b], EA: 100.0, EI: 1.0, segments: 4, angle: 3.141592653589793}
  - {nodes: [b, c], EA: 100.0, EI: 1.0, segments: 2, hinged: [true, false]}
  groups:
  - {name: some, nodes: [b, leg/2]}
  loads:
  - {group: some, fx: 1.0}
  - {group: beam2, py: -3.0, constant: true}
  - {node: c, moment: 2.0}
  obstacles:
  - {name: floor, px: 0.0, py: -2.0, nx: 0.0, ny: 1.0}
  contacts:
  - {group: leg, obstacle: floor}
  - {node: c, obstacle: floor}
)";

TraceRequest Frame() { return ReadTraceRequest(kFrame, "frame.yaml"); }

TEST(Expand, InnerNodesAreOnTheArc) {
  const Scene scene = Expand(Frame()).request.scene;
  ASSERT_EQ(scene.nodes.size(), 3u + 3u + 1u);
  EXPECT_EQ(scene.nodes[3].name, "leg/1");
  EXPECT_EQ(scene.nodes[6].name, "beam2/1");
  EXPECT_EQ(scene.beams[0].nodes, (std::vector<std::string>{"a", "leg/1", "leg/2", "leg/3", "b"}));
  // A half circle round (1, 0) that turns to the left: below its chord.
  for (int i = 1; i < 4; ++i) {
    const double at = 3.141592653589793 * (1.0 + i / 4.0);
    EXPECT_NEAR(scene.nodes[static_cast<std::size_t>(2 + i)].x, 1.0 + std::cos(at), 1e-15);
    EXPECT_NEAR(scene.nodes[static_cast<std::size_t>(2 + i)].y, std::sin(at), 1e-15);
  }
  EXPECT_EQ(scene.nodes[6].x, 2.0);
  EXPECT_EQ(scene.nodes[6].y, 0.5);
}

TEST(Expand, NodesThatTurn) {
  EXPECT_EQ(NodesThatTurn(Expand(Frame()).request.scene), (std::vector<bool>(7, true)));
  TraceRequest hinged = Frame();
  hinged.scene.beams[0].hinged = {false, true};
  std::vector<bool> all_but_b(7, true);
  all_but_b[1] = false;
  EXPECT_EQ(NodesThatTurn(Expand(hinged).request.scene), all_but_b);
}

TEST(Expand, LoadsAndContactsOfGroups) {
  const Expansion expansion = Expand(Frame());
  const std::vector<Load>& loads = expansion.request.scene.loads;
  ASSERT_EQ(loads.size(), 2u + 3u + 1u);
  EXPECT_EQ(loads[1].node, "leg/2");
  EXPECT_EQ(loads[1].fx, 1.0);
  // A traction of -3 on a length of 1, in two segments.
  EXPECT_EQ(loads[2].node, "b");
  EXPECT_EQ(loads[2].fy, -0.75);
  EXPECT_EQ(loads[3].node, "beam2/1");
  EXPECT_EQ(loads[3].fy, -1.5);
  EXPECT_TRUE(loads[3].constant);
  EXPECT_EQ(expansion.loads[0], (ListPlaces{0, 0, 1, 1, 1, 2}));
  // The first node of the leg is fixed.
  ASSERT_EQ(expansion.request.scene.contacts.size(), 5u);
  EXPECT_EQ(expansion.request.scene.contacts[2].Name(), "leg/3@floor");
  EXPECT_EQ(expansion.contacts, (ListPlaces{0, 0, 0, 0, 1}));
}

// A traction of 6 along the edge of an element of 6 nodes: by its shape functions, a sixth of the resultant on each
// corner.
TEST(Expand, TractionsOnSurfaces) {
  constexpr char kTriangle[] = R"(
scene:
  nodes:
  - {name: a, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: b, x: 2.0, y: 0.0, fixed_x: true, fixed_y: true}
  - {name: c, x: 0.0, y: 2.0}
  - {name: ab, x: 1.0, y: 0.0}
  - {name: bc, x: 1.0, y: 1.0}
  - {name: ca, x: 0.0, y: 1.0}
  materials: [{name: m, E: 1.0}]
  solids: [{material: m, nodes_per_element: 6, nodes: [a, b, c, ab, bc, ca]}]
  surfaces: [{name: side, nodes: [a, ca, c]}, {name: all, nodes: [a, ca, c, bc, b, ab], closed: true}]
  loads: [{surface: side, px: 6.0}, {surface: all, py: 1.0}]
)";
  const std::vector<Load> loads = Expand(ReadTraceRequest(kTriangle, "triangle.yaml")).request.scene.loads;
  ASSERT_EQ(loads.size(), 3u + 9u);
  EXPECT_NEAR(loads[0].fx, 2.0, 1e-14);
  EXPECT_NEAR(loads[1].fx, 8.0, 1e-14);
  EXPECT_NEAR(loads[2].fx, 2.0, 1e-14);
  EXPECT_EQ(loads[1].node, "ca");
  double sum = 0.0;
  for (std::size_t i = 3; i < loads.size(); ++i) sum += loads[i].fy;
  EXPECT_NEAR(sum, 4.0 + std::sqrt(8.0), 1e-14);
}

TEST(Expand, SupportsAndTheirMotionsOfGroups) {
  TraceRequest request = Frame();
  request.scene.contacts.clear();
  request.scene.supports = {{"", "some", false, true, true}, {"c", "", true, false, false}};
  request.scene.support_motions = {{"c", 2.0}, {"", 0.0, 1.0, 0.5, "some"}};
  EXPECT_EQ(Validate(request).size(), 0u);
  const Expansion expansion = Expand(request);
  const Scene& scene = expansion.request.scene;
  for (const std::size_t node : {std::size_t{1}, std::size_t{4}}) {  // b, leg/2
    EXPECT_FALSE(scene.nodes[node].fixed_x);
    EXPECT_TRUE(scene.nodes[node].fixed_y && scene.nodes[node].fixed_rotation);
  }
  EXPECT_TRUE(scene.nodes[2].fixed_x);
  EXPECT_FALSE(scene.nodes[2].fixed_y);
  ASSERT_EQ(scene.support_motions.size(), 3u);
  EXPECT_EQ(scene.support_motions[2].node, "leg/2");
  EXPECT_EQ(scene.support_motions[2].dy, 1.0);
  EXPECT_EQ(scene.support_motions[2].rotation, 0.5);
  EXPECT_EQ(expansion.motions[0], (ListPlaces{0, 1, 1}));
  // The same of a stage.
  TraceRequest program = request;
  program.scene.loads.clear();
  program.program.resize(1);
  program.program[0].support_motions = std::exchange(program.scene.support_motions, {});
  EXPECT_EQ(Validate(program).size(), 0u);
  EXPECT_EQ(Expand(program).request.program[0].support_motions.size(), 3u);
  EXPECT_EQ(WriteTraceRequest(ReadTraceRequest(WriteTraceRequest(program), "again.yaml")), WriteTraceRequest(program));
}

TEST(Expand, ChangesNothingASecondTime) {
  const TraceRequest once = Expand(Frame()).request;
  EXPECT_EQ(WriteTraceRequest(Expand(once).request), WriteTraceRequest(once));
}

TEST(Expand, WrittenAsGiven) {
  EXPECT_EQ(WriteTraceRequest(ReadTraceRequest(WriteTraceRequest(Frame()), "again.yaml")), WriteTraceRequest(Frame()));
}

std::function<void(TraceRequest&)> WithMotions(const std::vector<SupportMotion>& motions) {
  return [=](TraceRequest& request) { request.scene.support_motions = motions; };
}

std::function<void(TraceRequest&)> WithSupports(const std::vector<Support>& supports) {
  return [=](TraceRequest& request) { request.scene.supports = supports; };
}

const BrokenRule kRules[] = {
    {"scene.beams[1].EI", "0", "must be > 0 (at least 1e-100)"},
    {[](auto& r) { r.scene.nodes[2].y = 0.0; }, "scene.beams[1].nodes", "[b, c]",
     "the two nodes must not be at the same point"},
    {[](auto& r) {
       r.scene.beams[1].nodes = {"a", "b", "c"};
     },
     "scene.beams[1].nodes", "[a, b, c]", "must name two nodes"},
    {"scene.beams[0].angle", "-6.3", "must be between -2 pi and 2 pi"},
    {"scene.beams[0].segments", "-1", "must be >= 0"},
    {[](auto& r) { r.scene.beams[1].hinged = {true}; }, "scene.beams[1].hinged", "1 entries",
     "must be empty or have 2 entries: whether the beam is hinged at its "
     "first and its second node"},
    {[](auto& r) { r.scene.contacts.pop_back(); }, "scene.beams[1].hinged[0]", "true",
     "the hinge leaves node c loose: no support, contact or other part holds "
     "it"},
    {[](auto& r) { r.scene.groups[0].name = r.scene.loads[0].group = "leg"; }, "scene.groups[0].name", "leg",
     "must be unique, but an earlier one has the same name"},
    {"scene.loads[0].group", "sume", "must name a group or a beam of the scene; did you mean some?"},
    {"scene.contacts[0].node", "a", "must be left out where there is a group"},
    {"scene.loads[0].px", "1", "must be 0: a traction needs a surface, or a beam as its group"},
    {"scene.groups[0].nodes[1]", "leg/4", "must name a node of the scene; did you mean leg/1?"},
    {[](auto& r) {
       r.scene.beams[0].hinged = {false, true};
       r.scene.loads[2].node = "b";
     },
     "scene.loads[2].moment", "2", "must be 0: no beam turns node b"},
    {[](auto& r) {
       r.scene.beams[0].hinged = {false, true};
       r.scene.nodes[1].fixed_rotation = true;
     },
     "scene.nodes[1].fixed_rotation", "true", "must be false: no beam turns this node"},
    {WithMotions({{"c", 0.0, 0.0, 1.0}}), "scene.support_motions[0].rotation", "1",
     "must be 0: the rotation of node c is not fixed"},
    {[](auto& r) {
       r.scene.contacts.erase(r.scene.contacts.begin());
       r.scene.support_motions = {{"", 1.0, 0.0, 0.0, "some"}};
     },
     "scene.support_motions[0].dx", "1", "must be 0: node b is not fixed in x"},
    {WithMotions({{"", 1.0, 0.0, 0.0, "sme"}}), "scene.support_motions[0].group", "sme",
     "must name a group or a beam of the scene; did you mean"},
    {WithMotions({{"a", 1.0}, {"", 0.0, 1.0, 0.0, "leg"}}), "scene.support_motions[1].node", "a",
     "must not be repeated"},
    {WithSupports({{"leg/4", "", true}}), "scene.supports[0].node", "leg/4",
     "must name a node of the scene; did you mean leg/1?"},
    {WithSupports({{"", "some"}}), "scene.supports[0]", "some", "fixed_x, fixed_y or fixed_rotation must be true"},
    {[](auto& r) {
       r.scene.beams[0].hinged = {false, true};
       r.scene.supports = {{"", "some", false, false, true}};
     },
     "scene.supports[0].fixed_rotation", "true", "must be false: no beam turns node b"},
    {[](auto& r) { r.scene.obstacles[0].py = -0.9; }, "scene.contacts[0]", "leg/2@floor",
     "initial position penetrates the obstacle by 0."},
    {[](auto& r) {
       r.scene.beams[0].hinged = {false, true};
       r.options.stop = {{"b.rotation", ">", 1.0}};
     },
     "options.stop[0].quantity", "b.rotation", "must be of a node that a beam turns"},
};

TEST(ExpansionRules, BrokenRulesAreReportedAlone) {
  for (const BrokenRule& rule : kRules) ExpectBrokenAlone(rule, Frame());
}

}  // namespace
}  // namespace contact_path::expand_test
