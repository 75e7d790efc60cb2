// The rules of surfaces that contact candidates touch, and of these candidates.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/validate.h"
#include "support/beams.h"
#include "support/broken_rule.h"
#include "support/solid_grid.h"

namespace contact_path::boundary_rules_test {
namespace {

// Two cells side by side, held below, under a node p on two bars and a beam over them.
TraceRequest SoundRequest() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.materials = {ElasticMaterial("rubber", 2.0, 0.3)};
  Solid solid;
  solid.material = "rubber";
  solid.nodes_per_element = 4;
  AddGrid(
      &scene, 2, 1, [](double x, double y) { return Eigen::Vector2d(2.0 * x, y); }, solid);
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.y == 0.0;
  scene.nodes.insert(scene.nodes.end(), {{"p", 0.7, 1.125}, {"l", 0.0, 2.0, true, true}, {"r", 2.0, 2.0, true, true}});
  scene.bars = {{{"l", "p"}, 1.0}, {{"r", "p"}, 1.0}};
  scene.beams = {Between("axis", "l", "r", 1.0, 1.0, 4)};
  scene.loads = {{"p", 0.0, -1.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, -1.0, 0.0, 1.0, 0.2}};
  scene.surfaces = {{"top", {"0_2", "2_2", "4_2"}}};
  scene.contacts = {{"p", "", "", "top", 0.3}};
  return request;
}

BoundarySurface& FirstSurface(TraceRequest& request) { return request.scene.surfaces[0]; }
ContactCandidate& FirstContact(TraceRequest& request) { return request.scene.contacts[0]; }

std::function<void(TraceRequest&)> WithNodes(const std::vector<std::string>& nodes) {
  return [=](TraceRequest& request) { FirstSurface(request).nodes = nodes; };
}

const BrokenRule kRules[] = {
    {"scene.contacts[0].surface", "tap", "must name a surface of the scene; did you mean top?"},
    {"scene.contacts[0].obstacle", "floor", "must be left out where there is a surface"},
    {[](auto& r) { FirstContact(r).surface.clear(); }, "scene.contacts[0].obstacle", "\"\"",
     "must name an obstacle of the scene where there is no surface"},
    {"scene.contacts[0].friction", "-0.1", "must be >= 0"},
    {[](auto& r) { r.scene.contacts.push_back(FirstContact(r)); }, "scene.contacts[1]", "p@top",
     "must not be repeated"},
    {[](auto& r) {
       r.scene.obstacles[0].name = "top";
       r.scene.contacts.push_back({"p", "top"});
     },
     "scene.contacts[1]", "p@top", "must not be repeated"},
    {"scene.contacts[0].node", "2_2",
     "a node of surface top itself must have some of it farther along it than two nodes and pi times its "
     "radius"},
    {[](auto& r) {
       FirstSurface(r).nodes = {"l", "axis/1", "axis/2", "axis/3", "r"};
       FirstSurface(r).radius = 0.6;  // the last patch begins at 1.75
       FirstContact(r).node = "l";
     },
     "scene.contacts[0].node", "l", "a node of surface top itself must have some of it farther along it"},
    {[](auto& r) {
       FirstSurface(r).nodes = {"p", "r", "axis/3", "axis/2", "axis/1", "l"};
       FirstSurface(r).closed = true;
       r.scene.nodes[6].x = 1.0;
       r.scene.nodes[6].y = 2.0625;  // behind the beam
     },
     "scene.contacts[0]", "p@top", "initial position penetrates the surface by 0.0625"},
    {[](auto& r) {
       FirstSurface(r).nodes = {"4_0", "2_0"};
       FirstContact(r).node = "l";
     },
     "scene.contacts[0].node", "l", "must be free to move, or a node of surface top must be"},
    {WithNodes({"2_2", "0_2"}), "scene.surfaces[0].nodes[0]", "2_2",
     "the edge to 0_2 must have the material on its right: list the nodes in the other order"},
    {WithNodes({"2_0", "2_2"}), "scene.surfaces[0].nodes[0]", "2_0",
     "the edge to 2_2 must be on a boundary: there is material on both of its sides"},
    {WithNodes({"0_2", "4_2"}), "scene.surfaces[0].nodes[0]", "0_2",
     "the edge to 4_2 must be on a boundary: no solid, beam or bar has it"},
    {[](auto& r) { FirstSurface(r).closed = true; }, "scene.surfaces[0].nodes[2]", "4_2",
     "the edge to 0_2 must be on a boundary: no solid, beam or bar has it"},
    {[](auto& r) {
       r.scene.nodes.push_back({"back", 1.0, 2.0});
       r.scene.bars.push_back({{"r", "back"}, 1.0});
       FirstSurface(r).nodes = {"axis/3", "r", "back"};
     },
     "scene.surfaces[0].nodes[1]", "r", "the surface must not lead straight back here"},
    {[](auto& r) {
       r.scene.nodes.push_back({"up", 2.0, 3.0});
       r.scene.bars.push_back({{"r", "up"}, 1.0});
       r.scene.bars.push_back({{"l", "up"}, 1.0});
       FirstSurface(r).nodes = {"axis/3", "r", "up"};
       FirstSurface(r).radius = 0.5;
     },
     "scene.surfaces[0].radius", "0.5",
     "must be less than the radius of the curve where it bends to its admissible side, 0.17"},
    {[](auto& r) { r.scene.nodes[6].y = 0.75; }, "scene.contacts[0]", "p@top",
     "initial position penetrates the surface by 0.25"},
    {[](auto& r) { FirstSurface(r).radius = 0.375; }, "scene.contacts[0]", "p@top",
     "initial position penetrates the surface by 0.25"},
    {[](auto& r) {
       FirstSurface(r).nodes = {"l", "axis/1", "axis/2"};
       r.scene.support_motions = {{"l", 0.0, -1.0}};
     },
     "scene.support_motions[0].node", "l", "must not belong to surface top, which contacts touch"},
};

TEST(SurfaceInContact, BrokenRulesAreReportedAlone) {
  for (const BrokenRule& rule : kRules) ExpectBrokenAlone(rule, SoundRequest());
}

// A node that is behind by more than an edge of the surface is past its end.
TEST(SurfacesInContact, BothSidesOfABeamOrABarAreBoundaries) {
  const std::vector<std::vector<std::string>> below = {{"axis/2", "axis/1", "l"}, {"r", "p"}};
  for (const std::vector<std::string>& nodes : below) {
    TraceRequest request = SoundRequest();
    FirstContact(request).node = "2_2";
    FirstSurface(request).nodes = nodes;
    for (Node& node : request.scene.nodes)
      if (node.name == "l" || node.name == "r") node.y = 1.3;
    for (const Violation& violation : Validate(request)) ADD_FAILURE() << violation.ToLine();
    std::reverse(FirstSurface(request).nodes.begin(), FirstSurface(request).nodes.end());
    const std::vector<Violation> violations = Validate(request);
    ASSERT_EQ(violations.size(), 1U);
    EXPECT_EQ(violations[0].rule.rfind("initial position penetrates the surface by ", 0), 0U);
  }
}

// From p over r and the beam back to p: the inside is on the left.
TEST(SurfacesInContact, ANodeOfTheSurfaceMayTouchWhatIsFarFromItAlongTheSurface) {
  TraceRequest request = SoundRequest();
  FirstSurface(request).nodes = {"p", "r", "axis/3", "axis/2", "axis/1", "l"};
  FirstSurface(request).closed = true;
  for (const double radius : {0.0, 0.02}) {
    FirstSurface(request).radius = radius;
    for (const Violation& violation : Validate(request)) ADD_FAILURE() << violation.ToLine();
  }
}

// What no contact touches may be anything: tractions act on it as they did.
TEST(SurfacesInContact, AreOfSurfacesInContactAlone) {
  TraceRequest request = SoundRequest();
  request.scene.contacts.clear();
  FirstSurface(request).nodes = {"2_0", "2_2"};
  EXPECT_TRUE(Validate(request).empty());
}

// A node that is held may be touched by a surface that moves, but not an obstacle.
TEST(SurfacesInContact, HeldNodesOfGroupsAreCandidatesOfSurfaces) {
  TraceRequest request = SoundRequest();
  FirstContact(request).node.clear();
  FirstContact(request).group = "axis";
  request.scene.contacts.push_back({"", "floor", "axis"});
  std::vector<std::string> names;
  for (const ContactCandidate& contact : Expand(request).request.scene.contacts) names.push_back(contact.Name());
  EXPECT_EQ(names, (std::vector<std::string>{"l@top", "axis/1@top", "axis/2@top", "axis/3@top", "r@top", "axis/1@floor",
                                             "axis/2@floor", "axis/3@floor"}));
}

}  // namespace
}  // namespace contact_path::boundary_rules_test
