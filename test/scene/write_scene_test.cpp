#include "contact_path/scene/write_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "contact_path/scene/lattice.h"
#include "contact_path/scene/read_scene.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

// Of scenes or stages.
template <typename Loading>
void ExpectSameLoading(const Loading& a, const Loading& b) {
  ASSERT_EQ(a.loads.size(), b.loads.size());
  for (std::size_t i = 0; i < a.loads.size(); ++i) {
    EXPECT_EQ(a.loads[i].node, b.loads[i].node);
    EXPECT_EQ(a.loads[i].fx, b.loads[i].fx);
    EXPECT_EQ(a.loads[i].fy, b.loads[i].fy);
    EXPECT_EQ(a.loads[i].constant, b.loads[i].constant);
  }
  ASSERT_EQ(a.support_motions.size(), b.support_motions.size());
  for (std::size_t i = 0; i < a.support_motions.size(); ++i) {
    EXPECT_EQ(a.support_motions[i].node, b.support_motions[i].node);
    EXPECT_EQ(a.support_motions[i].dx, b.support_motions[i].dx);
    EXPECT_EQ(a.support_motions[i].dy, b.support_motions[i].dy);
  }
  ASSERT_EQ(a.obstacle_motions.size(), b.obstacle_motions.size());
  for (std::size_t i = 0; i < a.obstacle_motions.size(); ++i) {
    EXPECT_EQ(a.obstacle_motions[i].obstacle, b.obstacle_motions[i].obstacle);
    EXPECT_EQ(a.obstacle_motions[i].dx, b.obstacle_motions[i].dx);
    EXPECT_EQ(a.obstacle_motions[i].dy, b.obstacle_motions[i].dy);
  }
}

void ExpectSameScene(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    EXPECT_EQ(a.nodes[i].name, b.nodes[i].name);
    EXPECT_EQ(a.nodes[i].x, b.nodes[i].x);
    EXPECT_EQ(a.nodes[i].y, b.nodes[i].y);
    EXPECT_EQ(a.nodes[i].fixed_x, b.nodes[i].fixed_x);
    EXPECT_EQ(a.nodes[i].fixed_y, b.nodes[i].fixed_y);
  }
  ASSERT_EQ(a.bars.size(), b.bars.size());
  for (std::size_t i = 0; i < a.bars.size(); ++i) {
    EXPECT_EQ(a.bars[i].nodes, b.bars[i].nodes);
    EXPECT_EQ(a.bars[i].EA, b.bars[i].EA);
    EXPECT_EQ(a.bars[i].rest_length, b.bars[i].rest_length);
    EXPECT_EQ(a.bars[i].strain, b.bars[i].strain);
  }
  ASSERT_EQ(a.superelements.size(), b.superelements.size());
  for (std::size_t i = 0; i < a.superelements.size(); ++i) {
    EXPECT_EQ(a.superelements[i].nodes, b.superelements[i].nodes);
    EXPECT_EQ(a.superelements[i].stiffness, b.superelements[i].stiffness);
    EXPECT_EQ(a.superelements[i].rest_positions, b.superelements[i].rest_positions);
  }
  ExpectSameLoading(a, b);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].name, b.obstacles[i].name);
    EXPECT_EQ(a.obstacles[i].px, b.obstacles[i].px);
    EXPECT_EQ(a.obstacles[i].py, b.obstacles[i].py);
    EXPECT_EQ(a.obstacles[i].nx, b.obstacles[i].nx);
    EXPECT_EQ(a.obstacles[i].ny, b.obstacles[i].ny);
    EXPECT_EQ(a.obstacles[i].friction, b.obstacles[i].friction);
  }
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) EXPECT_EQ(a.contacts[i].Name(), b.contacts[i].Name());
}

void ExpectSameOptions(const TraceOptions& a, const TraceOptions& b) {
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.accuracy, b.accuracy);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.max_increments, b.max_increments);
  EXPECT_EQ(a.full_state_every, b.full_state_every);
  ASSERT_EQ(a.stop.size(), b.stop.size());
  for (std::size_t i = 0; i < a.stop.size(); ++i) {
    EXPECT_EQ(a.stop[i].quantity, b.stop[i].quantity);
    EXPECT_EQ(a.stop[i].when, b.stop[i].when);
    EXPECT_EQ(a.stop[i].value, b.stop[i].value);
  }
  ASSERT_EQ(a.branch_choices.size(), b.branch_choices.size());
  for (std::size_t i = 0; i < a.branch_choices.size(); ++i) {
    EXPECT_EQ(a.branch_choices[i].event, b.branch_choices[i].event);
    EXPECT_EQ(a.branch_choices[i].row, b.branch_choices[i].row);
    EXPECT_EQ(a.branch_choices[i].way, b.branch_choices[i].way);
  }
}

void ExpectRoundTrip(const TraceRequest& request) {
  const TraceRequest read = ReadTraceRequest(WriteTraceRequest(request), "written");
  ExpectSameScene(read.scene, request.scene);
  ExpectSameOptions(read.options, request.options);
  ASSERT_EQ(read.program.size(), request.program.size());
  for (std::size_t i = 0; i < request.program.size(); ++i) {
    ExpectSameLoading(read.program[i], request.program[i]);
    EXPECT_EQ(read.program[i].name, request.program[i].name);
    EXPECT_EQ(read.program[i].Target(), request.program[i].Target());
  }
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
