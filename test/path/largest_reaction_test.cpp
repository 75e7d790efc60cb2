#include "contact_path/path/return_detector.h"

#include <gtest/gtest.h>

#include "contact_path/path/model.h"

namespace contact_path::largest_reaction_test {
namespace {

// A node on springs of 1 above a floor.
Scene NodeOnFloor() {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0, false, false}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 1.0, 0.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  scene.contacts = {{"p", "floor"}};
  return scene;
}

TEST(LargestReactionSoFar, IsThatOfTheTraceAndOfTheStage) {
  const Scene scene = NodeOnFloor();
  const Model model(scene, CharacteristicScales(scene));
  const double unit = model.contacts[0]->ForceUnit();
  PathPoint point = model.InitialPoint();
  LargestReactionSoFar largest;
  point.forces[0] = 2.0;
  point.forces[1] = -3.0;
  largest.Note(model.laws, point);
  EXPECT_EQ(largest.of_stage, 3.0 / unit);
  largest.of_stage = 0.0;
  point.forces[0] = -1.0;
  point.forces[1] = 0.5;
  largest.Note(model.laws, point);
  EXPECT_EQ(largest.of_stage, 1.0 / unit);
  EXPECT_EQ(largest.of_trace, 3.0 / unit);
}

}  // namespace
}  // namespace contact_path::largest_reaction_test
