// The example scenes in which deformable parts touch each other: closed forms, balance, the same path for other
// settings.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/scene/program.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::surface_scenes_test {
namespace {

// Forces and moment about the origin of the supports of a block, whose names begin with a letter.
std::array<double, 3> SupportForces(const TracedPath& path, const Increment& increment, char block) {
  const SceneIndex index(path.request.scene);
  const std::size_t stage = increment.stage > 0 ? static_cast<std::size_t>(increment.stage) - 1 : 0;
  const Scene scene = StageScene(path.request, index, stage);
  const ResidualCheck check(scene, StageConfiguration(path.request, index, stage), {});
  const std::vector<double> forces = check.Unbalance(StateOf(increment));
  std::array<double, 3> sum = {};
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].name[0] != block || !scene.nodes[i].fixed_x) continue;
    sum[0] += forces[2 * i];
    sum[1] += forces[2 * i + 1];
    sum[2] += increment.positions[2 * i] * forces[2 * i + 1] - increment.positions[2 * i + 1] * forces[2 * i];
  }
  return sum;
}

// What holds one block holds the other, whatever happens between them; sliding, the force aside is the friction
// coefficient of the force down, but for the tilt of the surface.
TEST(SurfaceScenes, TwoBlocks) {
  constexpr double kMu = 0.4;
  const TracedPath path = TraceProved(ReadExample("two_blocks"));
  for (const Increment& increment : path.increments) {
    const std::array<double, 3> lower = SupportForces(path, increment, 'b'),
                                upper = SupportForces(path, increment, 'u');
    for (std::size_t i = 0; i < lower.size(); ++i) EXPECT_NEAR(lower[i] + upper[i], 0.0, 1e-12);
  }
  const Increment& last = path.increments.back();
  for (const ContactRecord& contact : last.contacts) EXPECT_EQ(ToString(contact.state), "slip+");
  const std::array<double, 3> upper = SupportForces(path, last, 'u');
  EXPECT_NEAR(std::abs(upper[0] / upper[1]), kMu, 0.02);
  EXPECT_NEAR(-upper[1], SumOfNormals(last), 0.02 * SumOfNormals(last));
}

TEST(SurfaceScenes, TwoBlocksByAllSettings) {
  TraceRequest request = ReadExample("two_blocks");
  const TracedPath path = TraceProved(request);
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kAccurate}) {
    request.options.accuracy = accuracy;
    ExpectSameEvents(path, TraceProved(request), 1e-10);
  }
  request.options.accuracy = Accuracy::kBalanced;
  request.options.method = Method::kMpec;
  const TracedPath other = TraceProved(request);
  const Increment &a = other.increments.back(), &b = path.increments.back();
  for (std::size_t i = 0; i < b.positions.size(); ++i) EXPECT_NEAR(a.positions[i], b.positions[i], 1e-3);
  EXPECT_NEAR(SumOfNormals(a), SumOfNormals(b), 1e-3 * SumOfNormals(b));
}

// The scene with nodes of the table as candidates, too, whose surface goes round the corners of the sole.
TraceRequest InBothPasses(TraceRequest request, const std::vector<std::string>& of_table) {
  request.scene.groups.push_back({"of_table", of_table});
  request.scene.surfaces.push_back({"of_sole", {"u4_1", "u4_0", "u3_0", "u2_0", "u1_0", "u0_0", "u0_1"}});
  request.scene.contacts.push_back({"", "", "of_table", "of_sole", 0.4});
  return request;
}

double SumOfTable(const TracedPath& path, const Increment& increment) {
  double sum = 0.0;
  for (const std::string& node : path.request.scene.groups.back().nodes)
    sum += Contact(path, increment, node + "@of_sole").rn;
  return sum;
}

// The nodes of the lower block are farther from each other than those of the upper one: none of them is held back.
TEST(SurfaceScenes, TwoBlocksInBothPasses) {
  const TraceRequest request = ReadExample("two_blocks");
  const TracedPath one = TraceProved(request);
  const TracedPath both = TraceProved(InBothPasses(request, {"b2_2", "b3_2", "b4_2", "b5_2"}));
  for (const Increment& increment : both.increments) EXPECT_EQ(SumOfTable(both, increment), 0.0);
  const double expected = SumOfNormals(one.increments.back());
  EXPECT_NEAR(SumOfNormals(both.increments.back()), expected, 1e-12 * expected);
}

// The scene with a lower block of 24 columns, pressed: edges of 0.125 below those of 0.3.
TraceRequest OnFineBlock() {
  TraceRequest request = ReadExample("two_blocks");
  request.program.resize(1);
  Scene& scene = request.scene;
  const auto is_lower = [](const Node& node) { return node.name[0] == 'b'; };
  scene.nodes.erase(std::remove_if(scene.nodes.begin(), scene.nodes.end(), is_lower), scene.nodes.end());
  Solid lower = scene.solids[0];
  lower.nodes.clear();
  scene.solids.erase(scene.solids.begin());
  AddNamedGrid(
      &scene, "b", 24, 2, [](double x, double y) { return Eigen::Vector2d(3.0 * x, y); }, lower);
  std::vector<std::string>& table = scene.surfaces[0].nodes;
  table.clear();
  for (int i = 0; i <= 48; i += 2) table.push_back("b" + std::to_string(i) + "_4");
  for (Node& node : scene.nodes)
    if (is_lower(node)) node.fixed_x = node.fixed_y = node.y == 0.0;
  return request;
}

// Nodes of a finer block would penetrate between those of the other one. Held back, they make both blocks stiffer, and
// take over a part of what those carry.
TEST(SurfaceScenes, AFinerBlockPressesInBothPasses) {
  const TraceRequest request = OnFineBlock();
  const TracedPath one = TraceProved(request);
  std::vector<std::string> of_table;
  for (const Node& node : one.request.scene.nodes)
    if (node.name[0] == 'b' && node.y == 1.0 && node.x > 0.5 && node.x < 2.3) of_table.push_back(node.name);
  const TracedPath both = TraceProved(InBothPasses(request, of_table));
  const Increment& end = both.increments.back();
  const double sum = SumOfNormals(end), expected = SumOfNormals(one.increments.back());
  EXPECT_GT(SumOfTable(both, end), 0.1 * sum);
  EXPECT_GT(sum, expected);
  EXPECT_NEAR(sum, expected, 0.01 * expected);
  const std::array<double, 3> lower = SupportForces(both, end, 'b'), upper = SupportForces(both, end, 'u');
  for (std::size_t i = 0; i < lower.size(); ++i) EXPECT_NEAR(lower[i] + upper[i], 0.0, 1e-12);
}

// Both rings as springs, at first.
TEST(SurfaceScenes, RingOnRing) {
  const TracedPath path = TraceProved(ReadExample("ring_on_ring"));
  const double stiffness = 1.0 / (2.0 * (M_PI / 4.0 - 2.0 / M_PI));
  // While they are only pressed, the scene is its own mirror image.
  for (const Increment& increment : path.increments)
    for (const ContactRecord& contact : increment.contacts)
      EXPECT_TRUE(increment.stage > 1 || std::abs(contact.rt) <= 1e-10) << increment.index;
  const Increment& later = FirstThat(path, [](const Increment& increment) { return SumOfNormals(increment) > 0.0; });
  ASSERT_EQ(later.stage, 1);
  const Increment& touching = path.increments[static_cast<std::size_t>(later.index) - 1];
  const double approach = 0.4 * (later.load_factor - touching.load_factor);
  EXPECT_NEAR(SumOfNormals(later) / approach, stiffness, 0.03 * stiffness);

  // Rolling over each other, the rings come to slide at a load that the mesh hardly changes.
  EXPECT_NEAR(LoadsOfKind(path, IncrementKind::kCornerLimit).at(0), 0.7457, 1e-4);
}

}  // namespace
}  // namespace contact_path::surface_scenes_test
