#include "contact_path/path/return_detector.h"

#include <gtest/gtest.h>

#include "contact_path/path/model.h"
#include "support/parts.h"

namespace contact_path::largest_reaction_test {
namespace {

TEST(LargestReactionSoFar, IsThatOfTheTraceAndOfTheStage) {
  Scene scene = NodeOnFloor("p", 1.0, 0.5);
  scene.loads = {{"p", 1.0, 0.0}};
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
