#include "contact_path/scene/write_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "contact_path/scene/lattice.h"
#include "contact_path/scene/read_scene.h"
#include "support/same_request.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

void ExpectRoundTrip(const TraceRequest& request) {
  EXPECT_EQ(FirstDifference(ReadTraceRequest(WriteTraceRequest(request), "written"), request), "");
}

TEST(WriteTraceRequest, ExamplesAreReadBackToTheLastBit) {
  for (const char* name : {"sliding_bar", "arch19", "rough_truss", "two_dof_friction", "von_mises", "rigid_stop",
                           "stick_slip_cycle", "press_slide_lift", "gripper"})
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
  request.options.branch_choices = {{2, 0, 3}, {0, 4, 1}};
  ExpectRoundTrip(request);
}

TEST(WriteTraceRequest, LatticesAreSound) {
  for (const LatticeKind kind : {LatticeKind::kColumn, LatticeKind::kArch, LatticeKind::kWall}) {
    LatticeOptions options;
    options.kind = kind;
    options.far_candidates = 500;
    ExpectRoundTrip(LatticeRequest(options));
  }
}

}  // namespace
}  // namespace contact_path
