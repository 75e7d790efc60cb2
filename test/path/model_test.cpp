#include "contact_path/path/model.h"

#include <gtest/gtest.h>

#include "support/mixed_scene.h"
#include "support/reference_cases.h"

namespace contact_path::model_test {
namespace {

TEST(Model, FixedComponentsAreThoseOfTheSceneToTheLastBit) {
  Scene scene = sliding_bar::MakeScene();
  scene.nodes[0].x = 0.1;  // which no scaling and back would keep
  scene.nodes[0].y = 5.3;
  const Model model(scene, CharacteristicScales(scene));
  const CheckedState state = model.InSceneUnits(model.InitialPoint());
  EXPECT_EQ(state.positions[0], 0.1);
  EXPECT_EQ(state.positions[1], 5.3);
}

}  // namespace
}  // namespace contact_path::model_test
