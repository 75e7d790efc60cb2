#include "contact_path/response/contact_pressure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene_index.h"
#include "support/traced_path.h"

namespace contact_path::contact_pressure_test {
namespace {

// A block of columns x rows elements that a uniform traction presses onto a floor without friction.
TraceRequest PressedBlock(int columns, int rows, int nodes_per_element) {
  TraceRequest request;
  Scene& scene = request.scene;
  Material material;
  material.name = "rubber";
  material.E = 10.0;
  material.nu = 0.3;
  scene.materials = {material};
  const int steps = nodes_per_element == 8 ? 2 : 1;
  const auto name = [](int i, int j) { return "n" + std::to_string(i) + "_" + std::to_string(j); };
  for (int j = 0; j <= steps * rows; ++j)
    for (int i = 0; i <= steps * columns; ++i)
      if (steps == 1 || i % 2 == 0 || j % 2 == 0)
        scene.nodes.push_back({name(i, j), 2.0 * i / (steps * columns), 1.0 * j / (steps * rows), i == 0});
  Solid solid;
  solid.name = "block";
  solid.material = "rubber";
  solid.nodes_per_element = nodes_per_element;
  for (int j = 0; j < steps * rows; j += steps)
    for (int i = 0; i < steps * columns; i += steps) {
      for (const auto& [di, dj] : {std::pair(0, 0), std::pair(steps, 0), std::pair(steps, steps), std::pair(0, steps)})
        solid.nodes.push_back(name(i + di, j + dj));
      if (steps == 2)
        for (const auto& [di, dj] : {std::pair(1, 0), std::pair(2, 1), std::pair(1, 2), std::pair(0, 1)})
          solid.nodes.push_back(name(i + di, j + dj));
    }
  scene.solids = {solid};
  BoundarySurface top;
  top.name = "top";
  for (int i = 0; i <= steps * columns; ++i) top.nodes.push_back(name(i, steps * rows));
  scene.surfaces = {top};
  Load load;
  load.surface = "top";
  load.py = -1.0;
  scene.loads = {load};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}};
  for (int i = 0; i <= steps * columns; ++i) {
    ContactCandidate contact;
    contact.node = name(i, 0);
    contact.obstacle = "floor";
    scene.contacts.push_back(contact);
  }
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
      const TracedPath path = TraceIncrements(PressedBlock(columns, 2, nodes));
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
  TraceRequest request = PressedBlock(4, 2, 4);
  request.options.record.clear();
  request.options.stop = {{"n2_0@floor.pressure", ">", 0.5}, {"load_factor", ">", 1.0}};
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

}  // namespace
}  // namespace contact_path::contact_pressure_test
