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

namespace contact_path {
namespace {

const double kPi = std::acos(-1.0);

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
    ExpectSameEvents(TraceProved(request), path, 1e-10);
  }
  request.options.accuracy = Accuracy::kBalanced;
  request.options.method = Method::kMpec;
  const TracedPath other = TraceProved(request);
  const Increment &a = other.increments.back(), &b = path.increments.back();
  for (std::size_t i = 0; i < b.positions.size(); ++i) EXPECT_NEAR(a.positions[i], b.positions[i], 1e-3);
  EXPECT_NEAR(SumOfNormals(a), SumOfNormals(b), 1e-3 * SumOfNormals(b));
}

// In both passes the nodes of the lower block are held back by the upper one, too, whose surface goes round its
// corners. Resultants are those of one pass but for what the curves differ by.
TEST(SurfaceScenes, TwoBlocksInBothPasses) {
  TraceRequest request = ReadExample("two_blocks");
  const TracedPath one = TraceProved(request);
  request.scene.groups.push_back({"of_table", {"b2_2", "b3_2", "b4_2", "b5_2"}});
  request.scene.surfaces.push_back({"of_sole", {"u4_1", "u4_0", "u3_0", "u2_0", "u1_0", "u0_0", "u0_1"}});
  request.scene.contacts.push_back({"", "", "of_table", "of_sole", 0.4});
  const TracedPath both = TraceProved(request);
  EXPECT_NEAR(SupportForces(both, both.increments.back(), 'u')[1], SupportForces(one, one.increments.back(), 'u')[1],
              0.05 * SumOfNormals(one.increments.back()));
}

// Both rings as springs, at first.
TEST(SurfaceScenes, RingOnRing) {
  const TracedPath path = TraceProved(ReadExample("ring_on_ring"));
  const double stiffness = 1.0 / (2.0 * (kPi / 4.0 - 2.0 / kPi));
  const Increment *touching = nullptr, *later = nullptr;
  for (const Increment& increment : path.increments) {
    if (increment.stage != 1) break;
    // While they are only pressed, the scene is its own mirror image.
    for (const ContactRecord& contact : increment.contacts) EXPECT_NEAR(contact.rt, 0.0, 1e-10);
    if (SumOfNormals(increment) == 0.0) touching = &increment;
    if (later == nullptr && SumOfNormals(increment) > 0.0) later = &increment;
  }
  ASSERT_NE(touching, nullptr);
  ASSERT_NE(later, nullptr);
  const double approach = 0.4 * (later->load_factor - touching->load_factor);
  EXPECT_NEAR(SumOfNormals(*later) / approach, stiffness, 0.03 * stiffness);

  // Rolling over each other, the rings come to slide at a load that the mesh hardly changes.
  const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kCornerLimit);
  ASSERT_FALSE(limits.empty());
  EXPECT_NEAR(limits[0].load_factor, 0.7457, 1e-4);
}

}  // namespace
}  // namespace contact_path
