#include "contact_path/response/contact_pressure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene_index.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::contact_pressure_test {
namespace {

// A block of columns x 2 elements, 2 wide and 1 high, that a uniform traction presses onto a floor without friction.
TraceRequest BlockOnFloor(int columns, int nodes_per_element) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.materials = {ElasticMaterial("rubber", 10.0, 0.3)};
  Solid solid;
  solid.material = "rubber";
  solid.nodes_per_element = nodes_per_element;
  AddGrid(
      &scene, columns, 2, [](double x, double y) { return Eigen::Vector2d(2.0 * x, y); }, solid);
  for (Node& node : scene.nodes) node.fixed_x = node.x == 0.0;
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}};
  BoundarySurface top = {"top", {}};
  for (int i = 0; i <= 2 * columns; ++i) {
    if (!HasGridNode(scene, i, 0)) continue;
    top.nodes.push_back(GridNode(&scene, i, 4).name);
    scene.contacts.push_back({GridNode(&scene, i, 0).name, "floor"});
  }
  scene.surfaces = {top};
  Load load;
  load.surface = "top";
  load.py = -1.0;
  scene.loads = {load};
  request.options.record = {"pressures"};
  request.options.stop = {{"load_factor", ">", 1.0}};
  return request;
}

// Under a uniform traction the pressure is the same everywhere, at corners and at nodes in the middle of edges, too:
// the block stretches by the same factor wherever one looks.
TEST(ContactPressure, OfAUniformTractionIsUniform) {
  for (const int nodes : {4, 8})
    for (const int columns : {3, 8}) {
      SCOPED_TRACE(std::to_string(nodes) + " nodes, " + std::to_string(columns) + " columns");
      const TracedPath path = TraceIncrements(BlockOnFloor(columns, nodes));
      ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
      const Increment& last = path.increments.back();
      double force = 0.0, length = 0.0, smallest = 1e300, largest = 0.0;
      for (std::size_t i = 0; i < last.contacts.size(); ++i) {
        const ContactPressure& of = last.pressures[i];
        EXPECT_NEAR(of.pressure * of.length, last.contacts[i].rn, 1e-13);
        force += last.contacts[i].rn;
        length += of.length;
        smallest = std::min(smallest, of.pressure);
        largest = std::max(largest, of.pressure);
      }
      EXPECT_NEAR(force, 2.0, 1e-10);
      EXPECT_LE(largest - smallest, 1e-9);
      ASSERT_EQ(last.widths.size(), 1U);
      EXPECT_NEAR(last.widths[0], length, 1e-13);
      EXPECT_GT(last.widths[0], 2.0);  // it is wider than at the start
      EXPECT_NEAR(largest, 2.0 / last.widths[0], 1e-9);
    }
}

TEST(ContactPressure, StopsAPath) {
  TraceRequest request = BlockOnFloor(4, 4);
  request.options.record.clear();
  request.options.stop = {{"4_0@floor.pressure", ">", 0.5}, {"load_factor", ">", 1.0}};
  const TracedPath path = TraceIncrements(request);
  EXPECT_NEAR(path.increments.back().pressures[2].pressure, 0.5, 1e-12);
  request.options.stop = {{"floor.width", ">", 2.05}, {"load_factor", ">", 1.0}};
  const TracedPath wide = TraceIncrements(request);
  EXPECT_NEAR(wide.increments.back().widths[0], 2.05, 1e-12);
}

// A node alone stands for no length of a boundary.
TEST(ContactPressure, OfANodeAloneIsZero) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.record = {"pressures"};
  request.options.max_increments = 5;
  const TracedPath path = TraceIncrements(request);
  for (const Increment& increment : path.increments) {
    EXPECT_EQ(increment.pressures[0].length, 0.0);
    EXPECT_EQ(increment.pressures[0].pressure, 0.0);
    EXPECT_EQ(increment.widths[0], 0.0);
  }
}

// ----- all example scenes -----

constexpr std::array<const char*, 7> kWithPressures = {"crushed_ring", "fin_ray",     "hertz",     "peg_in_hole",
                                                       "ring_on_ring", "rubber_foot", "two_blocks"};

TraceRequest WithPressures(const std::string& scene) {
  TraceRequest request = ReadExample(scene);
  request.options.record = {"pressures"};
  return request;
}

// Where candidates stand for a length of a boundary.
TEST(Pressures, AreOfTheseScenes) {
  for (const auto& file : std::filesystem::directory_iterator(CONTACT_PATH_SCENES)) {
    if (file.path().extension() != ".yaml") continue;
    const std::string scene = file.path().stem().string();
    TraceRequest request = WithPressures(scene);
    request.options.max_increments = 1;
    const std::vector<ContactPressure> pressures = TraceIncrements(request).increments.front().pressures;
    const bool some =
        std::any_of(pressures.begin(), pressures.end(), [](const ContactPressure& of) { return of.length > 0.0; });
    EXPECT_EQ(some, std::count(kWithPressures.begin(), kWithPressures.end(), scene) == 1) << scene;
  }
}

class PressuresOfScene : public testing::TestWithParam<const char*> {};

// Pressures times lengths are the reactions, of a level floor its resultant; the widths are the lengths of what
// touches.
TEST_P(PressuresOfScene, SumUpToTheReactions) {
  const TracedPath path = TraceIncrements(WithPressures(GetParam()));
  const ExpandedRequest expanded(path.request);
  const Scene& scene = expanded.Get().scene;
  const std::vector<TouchedBoundary> boundaries = TouchedBoundaries(scene);
  const std::vector<std::size_t> boundary_of = BoundaryOfContacts(scene, boundaries);
  const auto is_level = [&](const TouchedBoundary& of) {
    return !of.is_surface && scene.obstacles[of.place].shape == ObstacleShape::kHalfPlane &&
           scene.obstacles[of.place].nx == 0.0;
  };
  double off = 0.0, off_width = 0.0, largest = 0.0, longest = 0.0;
  for (const Increment& increment : path.increments) {
    std::vector<double> widths(boundaries.size()), forces(boundaries.size()), reactions(boundaries.size());
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      const ContactPressure& of = increment.pressures[i];
      if (of.length == 0.0) continue;  // a node alone
      forces[boundary_of[i]] += of.pressure * of.length;
      reactions[boundary_of[i]] += increment.contacts[i].rn;
      if (increment.contacts[i].state != ContactState::kOpen) widths[boundary_of[i]] += of.length;
    }
    ASSERT_EQ(increment.widths.size(), widths.size());
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      off = std::max(off, std::abs(forces[i] - reactions[i]));
      largest = std::max(largest, reactions[i]);
      off_width = std::max(off_width, std::abs(increment.widths[i] - widths[i]));
      longest = std::max(longest, widths[i]);
      if (is_level(boundaries[i])) off = std::max(off, std::abs(forces[i] - increment.boundaries[i].ry));
    }
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_GT(longest, 0.0);
  EXPECT_LE(off, 1e-12 * largest);
  EXPECT_LE(off_width, 1e-12 * longest);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PressuresOfScene, testing::ValuesIn(kWithPressures),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace contact_path::contact_pressure_test
