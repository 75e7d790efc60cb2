// The rules of materials and solids, and what of them depends on the units.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/validate.h"
#include "support/broken_rule.h"
#include "support/same_request.h"
#include "support/solid_grid.h"

namespace contact_path::solid_rules_test {
namespace {

// Two cells side by side, held on the left, pulled on the right.
TraceRequest SoundRequest(int nodes_per_element = 4) {
  TraceRequest request;
  request.scene.materials = {ElasticMaterial("rubber", 2.0, 0.3)};
  Solid solid;
  solid.name = "block";
  solid.material = "rubber";
  solid.nodes_per_element = nodes_per_element;
  AddGrid(
      &request.scene, 2, 1, [](double x, double y) { return Eigen::Vector2d(2.0 * x, y); }, solid);
  for (Node& node : request.scene.nodes) node.fixed_x = node.fixed_y = node.x == 0.0;
  request.scene.loads = {{"4_0", 1.0, 0.0}};
  return request;
}

Material& FirstMaterial(TraceRequest& request) { return request.scene.materials[0]; }
std::vector<std::string>& FirstNodes(TraceRequest& request) { return request.scene.solids[0].nodes; }

const BrokenRule kRules[] = {
    {"scene.materials[0].E", "-1", "must be 0 or positive"},
    {[](auto& r) { FirstMaterial(r).E = FirstMaterial(r).nu = 0.0; }, "scene.materials[0].E", "0",
     "must be > 0 where mu is not given"},
    {"scene.materials[0].nu", "0.5", "must be > -1 and < 0.5"},
    {"scene.materials[0].nu", "-1", "must be > -1 and < 0.5"},
    {"scene.materials[0].mu", "1", "must be 0 where E is given"},
    {[](auto& r) { FirstMaterial(r) = {"rubber", MaterialModel::kNeoHookean, 0.0, 0.0, -0.7, 1.0, 0.0}; },
     "scene.materials[0].lambda", "-0.7", "must be > -2/3 mu"},
    {[](auto& r) { FirstMaterial(r) = {"rubber", MaterialModel::kCiarletGeymonat, 0.0, 0.0, 4000.0, 120.0, 61.0}; },
     "scene.materials[0].a", "61", "must be from max(0, mu/2 - lambda/4) to mu/2: from 0 to 60"},
    {[](auto& r) { FirstMaterial(r) = {"rubber", MaterialModel::kCiarletGeymonat, 0.0, 0.0, 1.0, 1.0, 0.2}; },
     "scene.materials[0].a", "0.2", "must be from max(0, mu/2 - lambda/4) to mu/2: from 0.25 to 0.5"},
    {[](auto& r) { FirstMaterial(r) = {"rubber", MaterialModel::kCiarletGeymonat, 0.0, 0.0, -0.1, 1.0, 0.5}; },
     "scene.materials[0].lambda", "-0.1", "must be >= 0 where the model is ciarlet_geymonat"},
    {"scene.materials[0].a", "0.1", "must be 0 unless the model is ciarlet_geymonat"},
    {[](auto& r) { r.scene.materials.push_back(r.scene.materials[0]); }, "scene.materials[1].name", "rubber",
     "must be unique"},
    {"scene.solids[0].material", "ruber", "must name a material of the scene; did you mean rubber?"},
    {"scene.solids[0].nodes_per_element", "5", "must be 3, 4, 6 or 8"},
    {"scene.solids[0].nodes_per_element", "-4", "must be 3, 4, 6 or 8"},
    {[](auto& r) { FirstNodes(r).push_back("0_0"); }, "scene.solids[0].nodes", "9 entries",
     "must have 4 entries for each element"},
    {[](auto& r) {
       r.scene.solids.push_back(r.scene.solids[0]);
       r.scene.solids[1].nodes.clear();
     },
     "scene.solids[1].nodes", "[]", "at least one element is needed"},
    {[](auto& r) { r.scene.solids.push_back(r.scene.solids[0]), r.scene.solids[1].nodes[2] = "x"; },
     "scene.solids[1].nodes[2]", "x", "must name a node of the scene"},
    {[](auto& r) { r.scene.solids.push_back(r.scene.solids[0]), r.scene.solids[1].nodes[5] = "2_0"; },
     "scene.solids[1].nodes", "element 2 [2_0, 2_0, 4_2, 2_2]", "must not repeat a node"},
    {[](auto& r) { std::swap(FirstNodes(r)[5], FirstNodes(r)[7]); }, "scene.solids[0].nodes",
     "element 2 [2_0, 2_2, 4_2, 4_0]", "must have its corners counterclockwise"},
    {[](auto& r) { GridNode(&r.scene, 4, 0).x = GridNode(&r.scene, 4, 2).x = 1.0; }, "scene.solids[0].nodes",
     "element 2 [2_0, 4_0, 4_2, 2_2]", "must have an area"},
    {[](auto& r) {
       GridNode(&r.scene, 4, 2).x = 1.1;
       GridNode(&r.scene, 4, 2).y = 0.1;
     },
     "scene.solids[0].nodes", "element 2 [2_0, 4_0, 4_2, 2_2]", "must be less distorted"},
    {"scene.solids[0].thickness", "-1", "must be 0 or positive"},
};

TEST(SolidRules, BrokenRulesAreReportedAlone) {
  for (const BrokenRule& rule : kRules) ExpectBrokenAlone(rule, SoundRequest());
}

TEST(SolidRules, OneLineForAllElementsAtFault) {
  TraceRequest request = SoundRequest();
  for (Node& node : request.scene.nodes) node.x = -node.x;
  const std::vector<Violation> violations = Validate(request);
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(
      violations[0].ToLine(),
      "scene.solids[0].nodes = element 1 [0_0, 2_0, 2_2, 0_2]: must have its corners counterclockwise (elements at "
      "fault: 2)");
}

TEST(SolidRules, SoundScenes) {
  for (const int nodes : {3, 4, 6, 8}) EXPECT_TRUE(Validate(SoundRequest(nodes)).empty()) << nodes;
  TraceRequest request = SoundRequest(3);
  request.scene.solids[0].nodes_per_element = 0;
  request.scene.materials.push_back({"unused", MaterialModel::kNeoHookean, 1.0});
  request.scene.materials[0] = {"rubber", MaterialModel::kCiarletGeymonat, 0.0, 0.0, 4000.0, 120.0, 30.0};
  EXPECT_TRUE(Validate(request).empty());
}

TEST(SolidFields, AreReadAsWritten) {
  TraceRequest request = SoundRequest(8);
  request.scene.materials.push_back({"ciarlet", MaterialModel::kCiarletGeymonat, 0.0, 0.0, 4000.0, 120.0, 30.0});
  request.scene.solids[0].plane = PlaneState::kStress;
  request.scene.solids[0].thickness = 0.1;
  EXPECT_EQ(FirstDifference(ReadTraceRequest(WriteTraceRequest(request), "test"), request), "");
}

// Length and force of all solids do not depend on the mesh, and follow the units; a thickness of 0 is 1 in the units of
// the scene.
TEST(SolidScales, AreThoseOfTheBody) {
  for (const int nodes : {3, 4, 6, 8}) {
    const Scaling scales = CharacteristicScales(SoundRequest(nodes).scene);
    EXPECT_NEAR(scales.length, std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(scales.force, 2.0 * std::sqrt(2.0), 1e-14);
    const Scene scaled = ScaleScene(SoundRequest(nodes).scene, scales);
    EXPECT_NEAR(scaled.solids[0].thickness, 1.0 / scales.length, 1e-15);
    EXPECT_NEAR(scaled.materials[0].E * scaled.solids[0].thickness, 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace contact_path::solid_rules_test
