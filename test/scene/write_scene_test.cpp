#include "contact_path/scene/read_scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/same_request.h"
#include "support/traced_path.h"

namespace contact_path::write_scene_test {
namespace {

void ExpectRoundTrip(const TraceRequest& request) {
  EXPECT_EQ(FirstDifference(ReadTraceRequest(WriteTraceRequest(request), "written"), request), "");
}

TEST(WriteTraceRequest, ExamplesAreReadBackToTheLastBit) {
  for (const char* name : {"sliding_bar", "arch19", "rough_truss", "two_dof_friction", "von_mises", "rigid_stop",
                           "stick_slip_cycle", "press_slide_lift", "gripper", "cantilever_block"})
    ExpectRoundTrip(ReadExample(name));
}

TEST(WriteTraceRequest, EveryFieldThatDiffersFromItsDefault) {
  TraceRequest request = ReadExample("sliding_bar");
  request.scene.name = "quotes \" and: colons";
  request.scene.nodes[0].name = request.scene.bars[0].nodes[0] = "1";
  request.scene.bars[0].rest_length = 1.0 / 3.0;
  request.scene.bars[0].strain = StrainMeasure::kLogarithmic;
  request.scene.loads.push_back({"b", 1e-99, -1e99, true});
  request.scene.superelements.push_back({{"b"}, {0.1, 0.2, 0.2, 0.7}, {-4.5, 1.0 / 3.0}});
  request.scene.support_motions = {{request.scene.nodes[0].name, 0.1, -0.2}};
  request.scene.obstacle_motions = {{"floor", 0.3, 0.7}};
  request.options.method = Method::kMpec;
  request.options.accuracy = Accuracy::kFast;
  request.options.direction = -0.5;
  request.options.step = 0.1;
  request.options.max_increments = 7;
  request.options.full_state_every = 3;
  ExpectRoundTrip(request);
  request.options.method = Method::kBranch;  // the default; the other method takes no choices
  request.options.branch_choices = {{2, 0, 3}, {0, 4, 1}};
  request.options.stop[0].exact = DefaultTrue::kFalse;
  request.options.at = {{"b.x", {0.1, 1.0 / 3.0}}, {"load_factor", {}, -1.0, 0.7, 5}};
  request.options.record = {"sections", "pressures"};
  ExpectRoundTrip(request);
  request.options.stability = DefaultTrue::kFalse;
  request.options.at_limit = AtLimit::kStop;
  request.options.branch_rule = BranchRule::kForward;
  request.scene.support_motions.clear();  // a machine goes with loads alone
  request.scene.obstacle_motions.clear();
  request.options.machine_stiffness = 0.1;
  ExpectRoundTrip(request);
  request.options.machine_stiffness = std::numeric_limits<double>::infinity();
  ExpectRoundTrip(request);
}

TEST(WriteTraceRequest, StagesThatUnload) {
  TraceRequest request = ReadExample("stick_slip_cycle");
  Stage unload;
  unload.name = "back";
  unload.target = 0.5;
  unload.unload = true;
  request.program.push_back(unload);
  ExpectRoundTrip(request);
}

// Whoever reads the file sees what was meant, and no defaults.
TEST(WriteTraceRequest, OnePartALineWithoutDefaults) {
  TraceRequest request;
  request.scene.name = "two";
  request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.5}};
  request.scene.bars = {{{"a", "b"}, 2.0, 0.0, StrainMeasure::kGreenLagrange}};
  request.scene.loads = {{"b", 1.0, 0.0}};
  request.options.stop = {{"b.x", ">", 2.0}};
  EXPECT_EQ(WriteTraceRequest(request),
            "scene:\n"
            "  name: \"two\"\n"
            "  nodes:\n"
            "    - {name: \"a\", fixed_x: true, fixed_y: true}\n"
            "    - {name: \"b\", x: 1, y: 0.5}\n"
            "  bars:\n"
            "    - {nodes: [\"a\", \"b\"], EA: 2, strain: green_lagrange}\n"
            "  loads:\n"
            "    - {node: \"b\", fx: 1}\n"
            "options:\n"
            "  stop:\n"
            "    - {quantity: \"b.x\", when: \">\", value: 2}\n");
}

}  // namespace
}  // namespace contact_path::write_scene_test
