#include "contact_path/contact/scene_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/derivative_checker.h"
#include "support/kinematics.h"
#include "support/mixed_scene.h"

namespace contact_path::scene_contacts_test {
namespace {

constexpr double kRounding = 1e-15;
const Eigen::VectorXd kAnywhere = Eigen::Vector2d(0.2, -3.0);

// A node at (0.3, 0.7) against one obstacle through (1, 2).
class OneNode : public testing::Test {
 protected:
  const ContactPair& Against(double nx, double ny) {
    scene_.nodes = {{"p", 0.3, 0.7, fixed_x_, fixed_y_}};
    scene_.obstacles = {{"o", ObstacleShape::kHalfPlane, 1.0, 2.0, nx, ny, 0.5}};
    scene_.contacts = {{"p", "o"}};
    structure_ = std::make_unique<Structure>(scene_);
    contacts_ = BuildContacts(scene_, *structure_);
    return *contacts_.at(0);
  }

  bool fixed_x_ = false, fixed_y_ = false;
  Scene scene_;
  std::unique_ptr<Structure> structure_;
  ContactPairs contacts_;
};

TEST_F(OneNode, FrictionNeedsRoomToSlide) {
  fixed_x_ = true;
  EXPECT_FALSE(Against(0.0, 1.0).Frictional());
  EXPECT_FALSE(Against(6e-17, 1.0).Frictional());
  fixed_x_ = false;
  EXPECT_TRUE(Against(0.0, 1.0).Frictional());
  fixed_y_ = true;
  EXPECT_FALSE(Against(1.0, 0.0).Frictional());
}

TEST(SceneContacts, FollowTheOrderOfTheScene) {
  const Scene scene = MixedScene();
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const std::vector<double> friction = {0.3, 0.0, 0.3, 0.6, 0.3, 0.0};
  ASSERT_EQ(contacts.size(), friction.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) EXPECT_EQ(contacts[i]->Friction(), friction[i]) << i;
  for (const auto& contact : contacts) EXPECT_GT(contact->Gap(structure.Start(), 0.0, 0), 0.0);
}

// A node on a part that is softer across the floor than along it.
double ForceUnitOf(double along, double across, bool beside_a_bar = false, double load = 0.0) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}, {"q", 1.0, 0.0, true, true}};
  scene.superelements = {{{"p"}, {along, 0.0, 0.0, across}}};
  if (beside_a_bar) scene.bars = {{{"p", "q"}, 1.0}};
  scene.loads = {{"p", 0.0, load}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  scene.contacts = {{"p", "floor"}};
  const Structure structure(scene);
  return BuildContacts(scene, structure).at(0)->ForceUnit();
}

TEST(ForceUnit, FollowsForcesAcrossTheSurfaceDown) {
  EXPECT_EQ(ForceUnitOf(1.0, 1.0), 1.0);
  EXPECT_EQ(ForceUnitOf(1.0, 5e3), 1.0);
  EXPECT_EQ(ForceUnitOf(1.0, 2e-6), 1.0);
  EXPECT_EQ(ForceUnitOf(1.0, 1e-10), std::ldexp(1.0, -20));
  EXPECT_EQ(ForceUnitOf(1.0, 1e-13), std::ldexp(1.0, -40));
  EXPECT_EQ(ForceUnitOf(1e-10, 1.0), 1.0);
}

// Coordinates are known to 1e-16: forces of 1e9 times that are rounding, and tolerances of 1e-11 must lie above them.
TEST(ForceUnit, GrowsWithTheRoundingOfStiffParts) {
  EXPECT_EQ(ForceUnitOf(1.0, 2e4), 2.0);
  EXPECT_EQ(ForceUnitOf(1.0, 1e9), std::ldexp(1.0, 17));
}

// A bar turns: it may come to act across, too.
TEST(ForceUnit, CountsBarsInAllDirectionsAndLoads) {
  EXPECT_EQ(ForceUnitOf(1.0, 1e-10, true), 1.0);
  EXPECT_EQ(ForceUnitOf(1.0, 1e-10, false, -0.1), 1.0);
}

}  // namespace
}  // namespace contact_path::scene_contacts_test
