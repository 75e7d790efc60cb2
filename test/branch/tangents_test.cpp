#include "contact_path/branch/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "branch/example_scenes.h"
#include "contact_path/path/model.h"

namespace contact_path::tangents_test {
namespace {

// At the start of a scene, in its own scales, with these states.
Tangents TangentsAtStart(const Scene& scene, const std::vector<ContactState>& states, const Eigen::VectorXd& arrival) {
  const Model model(scene, Scaling());
  const PathPoint point = model.InitialPoint();
  FixedStateSystem system(model.structure, model.contacts);
  system.SetStates(states, SlipReferences(model.contacts, point));
  TangentSolvers solvers;
  return FindTangents(system.Pack(point), arrival, false, RigidModes(model.structure), &system, &solvers);
}

Eigen::VectorXd Vector(std::vector<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// 2 du_x = ds while it slides freely; stuck, only the load and the reaction change: r_t = -ds.
TEST(Tangents, OfALinearSpring) {
  const Tangents open = TangentsAtStart(SpringAndBlock(), {ContactState::kOpen}, Vector({0.0, 0.0, 1.0}));
  ASSERT_EQ(open.first.size(), 1U);
  EXPECT_LE((open.first[0] - Vector({1.0, 0.0, 2.0}) / std::sqrt(5.0)).norm(), 1e-15);
  EXPECT_LE(open.second.at(0).norm(), 1e-15);
  const Tangents stick = TangentsAtStart(SpringAndBlock(), {ContactState::kStick}, Vector({0.0, 0.0, 1.0}));
  ASSERT_EQ(stick.first.size(), 1U);
  EXPECT_LE((stick.first[0] - Vector({0.0, 0.0, 1.0, 0.0, -1.0})).norm(), 1e-15);
  EXPECT_FALSE(open.mechanism || open.rests || stick.mechanism || stick.rests);
}

// A bar along x turns about its end at no cost: the tangent has nothing of this motion.
TEST(Tangents, WithoutTheRigidModes) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"p", 1.0, 0.0, false, false}};
  scene.bars = {{{"a", "p"}, 1.0, 0.0, StrainMeasure::kBiot}};
  scene.loads = {{"p", 1.0, 0.0, false}};
  const Tangents tangents = TangentsAtStart(scene, {}, Vector({0.0, 0.0, 1.0}));
  ASSERT_EQ(tangents.first.size(), 1U);
  const Eigen::VectorXd expected = Vector({1.0, 0.0, 1.0}) / std::sqrt(2.0);
  EXPECT_NEAR(std::abs(tangents.first[0].dot(expected)), 1.0, 1e-14);
  EXPECT_EQ(tangents.rigid_modes, 0);
  EXPECT_FALSE(tangents.mechanism);
}

// Nothing holds the node, so that the load cannot change and both motions are rigid.
TEST(Tangents, OfAMechanismIsNearestToTheArrival) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0, false, false}};
  scene.superelements = {{{"p"}, {0.0, 0.0, 0.0, 0.0}}};
  scene.loads = {{"p", 1.0, 0.0, false}};
  const Tangents tangents = TangentsAtStart(scene, {}, Vector({0.6, 0.8, 0.0}));
  ASSERT_EQ(tangents.first.size(), 1U);
  EXPECT_TRUE(tangents.mechanism);
  EXPECT_EQ(tangents.rigid_modes, 2);
  EXPECT_LE((tangents.first[0] - Vector({0.6, 0.8, 0.0})).norm(), 1e-12);
}

}  // namespace
}  // namespace contact_path::tangents_test
