#include "contact_path/path/model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mixed_scene.h"
#include "support/reference_cases.h"

namespace contact_path::model_test {
namespace {

constexpr double kRounding = 1e-13;  // of positions and forces of order 10 that were scaled and scaled back

TEST(Model, InitialPointIsTheSceneAtRest) {
  const Scene scene = sliding_bar::MakeScene();
  const Model model(scene, CharacteristicScales(scene));
  const PathPoint point = model.InitialPoint();
  EXPECT_EQ(point.s, 0.0);
  EXPECT_EQ(point.rn, Eigen::VectorXd::Zero(1));
  EXPECT_EQ(point.rt, Eigen::VectorXd::Zero(1));
  const CheckedState state = model.InSceneUnits(point);
  const std::vector<double> expected = {0.0, 5.0, -5.0, 0.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(state.positions[i], expected[i], kRounding);
  EXPECT_LE(model.Check(point, point).equilibrium, kRounding);
  EXPECT_LE(model.Check(point, point).Contact(), kRounding);
}

TEST(Model, CandidatesThatTouchStickOrAreClosed) {
  Scene scene = MixedScene();
  const Model apart(scene, CharacteristicScales(scene));
  EXPECT_EQ(apart.InitialPoint().states, std::vector<ContactState>(6, ContactState::kOpen));
  // Boundaries through b, whichever way the normals look, and through d.
  scene.obstacles[0].px = scene.obstacles[1].px = scene.nodes[1].x;
  scene.obstacles[0].py = scene.obstacles[1].py = scene.nodes[1].y;
  scene.obstacles[2].py = scene.nodes[3].y;
  const Model touching(scene, CharacteristicScales(scene));
  const std::vector<ContactState> states = touching.InitialPoint().states;
  EXPECT_EQ(states[0], ContactState::kStick);
  EXPECT_EQ(states[1], ContactState::kClosed);
  EXPECT_EQ(states[3], ContactState::kStick);
  EXPECT_EQ(states[5], ContactState::kOpen);
}

// The closed form of the sliding bar, put in and taken out in scaled quantities, in two systems of units.
TEST(Model, ScaledPointsComeOutInTheUnitsOfTheScene) {
  for (const double length : {1.0, 1e-3}) {
    for (const double force : {1.0, 1e6}) {
      Scene scene = sliding_bar::MakeScene();
      for (Node& node : scene.nodes) {
        node.x *= length;
        node.y *= length;
      }
      scene.bars[0].EA *= force;
      const Model model(scene, CharacteristicScales(scene));
      const double x = -2.0;
      PathPoint point = model.InitialPoint();
      point.u = Eigen::Vector2d(x * length, 0.0) / model.scaling.length;
      point.s = sliding_bar::LoadFactor(x) * force / model.scaling.load_factor;
      point.rn[0] = sliding_bar::NormalReaction(x) * force / model.scaling.force;
      point.rt = -sliding_bar::kFriction * point.rn;
      const CheckedState state = model.InSceneUnits(point);
      EXPECT_NEAR(state.load_factor / force, sliding_bar::LoadFactor(x), kRounding);
      EXPECT_NEAR(state.positions[2] / length, x, kRounding);
      EXPECT_NEAR(state.rn[0] / force, sliding_bar::NormalReaction(x), kRounding);
      EXPECT_NEAR(state.rt[0] / force, -sliding_bar::kFriction * sliding_bar::NormalReaction(x), kRounding);
      EXPECT_LE(model.Check(model.InitialPoint(), point).equilibrium, kRounding);
      EXPECT_LE(model.Check(model.InitialPoint(), point).Contact(), kRounding);
      point.rt = -point.rt;
      EXPECT_GT(model.Check(model.InitialPoint(), point).equilibrium, 0.01);
    }
  }
}

TEST(Model, FixedComponentsAreThoseOfTheSceneToTheLastBit) {
  Scene scene = sliding_bar::MakeScene();
  scene.nodes[0].x = 0.1;  // which no scaling and back would keep
  scene.nodes[0].y = 5.3;
  const Model model(scene, CharacteristicScales(scene));
  const CheckedState state = model.InSceneUnits(model.InitialPoint());
  EXPECT_EQ(state.positions[0], 0.1);
  EXPECT_EQ(state.positions[1], 5.3);
}

TEST(Model, StructureAndContactsAreOfTheScaledScene) {
  const Scene scene = sliding_bar::MakeScene();
  const Model model(scene, CharacteristicScales(scene));
  EXPECT_NEAR(model.structure.ReferenceLoad().norm(), 1.0, kRounding);
  const PathPoint point = model.InitialPoint();
  EXPECT_NEAR(point.u[0], -std::sqrt(0.5), kRounding);  // -5 over the length of the bar
  Eigen::VectorXd lifted = point.u;
  lifted[1] += 1.0;
  EXPECT_NEAR(model.contacts[0]->Gap(lifted, 0.0, 0), 1.0, kRounding);
}

}  // namespace
}  // namespace contact_path::model_test
