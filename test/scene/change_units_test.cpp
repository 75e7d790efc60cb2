#include "contact_path/scene/change_units.h"

#include <gtest/gtest.h>

#include <vector>

namespace contact_path::change_units_test {
namespace {

// In units of 2 [length], 8 [force] and 32 [load factor], every number of a request is divided by what it is measured
// in.
TEST(ChangeUnitsTest, EveryNumberHasItsUnit) {
  TraceRequest request;
  request.scene.nodes = {{"a", 1.0, 3.0, true, false}};
  request.scene.bars = {{{"a", "b"}, 1.0, 3.0, StrainMeasure::kBiot}};
  request.scene.superelements = {{{"a"}, {1.0, 2.0, 3.0, 4.0}, {5.0, 7.0}}};
  request.scene.loads = {{"a", 1.0, 3.0}, {"a", 1.0, 3.0, true}};
  request.scene.obstacles = {{"o", ObstacleShape::kHalfPlane, 1.0, 3.0, 5.0, 7.0, 0.3}};
  request.scene.support_motions = {{"a", 1.0, 3.0}};
  request.scene.obstacle_motions = {{"o", 1.0, 3.0}};
  request.options.stop = {{"a.x", ">", 5.0}};
  request.options.direction = -1.0;
  request.options.step = 0.25;
  request.options.max_increments = 7;
  Stage stage;
  stage.loads = {{"a", 5.0, 7.0}};
  stage.target = 3.0;
  request.program = {stage};

  ChangeUnits(&request, {2.0, 8.0, 32.0});
  const Scene& scene = request.scene;
  EXPECT_EQ(scene.nodes[0].x, 0.5);
  EXPECT_EQ(scene.nodes[0].y, 1.5);
  EXPECT_EQ(scene.bars[0].EA, 1.0 / 8.0);
  EXPECT_EQ(scene.bars[0].rest_length, 1.5);
  EXPECT_EQ(scene.superelements[0].stiffness, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(scene.superelements[0].rest_positions, (std::vector<double>{2.5, 3.5}));
  // A load per unit of the load factor is larger where that unit is larger; a constant load is none.
  EXPECT_EQ(scene.loads[0].fx, 4.0);
  EXPECT_EQ(scene.loads[0].fy, 12.0);
  EXPECT_EQ(scene.loads[1].fx, 1.0 / 8.0);
  EXPECT_EQ(scene.loads[1].fy, 3.0 / 8.0);
  EXPECT_EQ(scene.obstacles[0].px, 0.5);
  EXPECT_EQ(scene.obstacles[0].py, 1.5);
  EXPECT_EQ(scene.obstacles[0].nx, 5.0);
  EXPECT_EQ(scene.obstacles[0].ny, 7.0);
  EXPECT_EQ(scene.obstacles[0].friction, 0.3);
  EXPECT_EQ(scene.support_motions[0].dx, 16.0);
  EXPECT_EQ(scene.support_motions[0].dy, 48.0);
  EXPECT_EQ(scene.obstacle_motions[0].dx, 16.0);
  EXPECT_EQ(scene.obstacle_motions[0].dy, 48.0);
  EXPECT_EQ(request.program[0].loads[0].fx, 20.0);
  EXPECT_EQ(request.program[0].loads[0].fy, 28.0);
  EXPECT_EQ(request.program[0].target, 3.0 / 32.0);
  EXPECT_EQ(request.options.stop[0].value, 5.0);
  EXPECT_EQ(request.options.direction, -1.0);
  EXPECT_EQ(request.options.step, 0.25);
  EXPECT_EQ(request.options.max_increments, 7);
}

}  // namespace
}  // namespace contact_path::change_units_test
