#include "contact_path/contact/contact_geometry.h"

#include <gtest/gtest.h>

#include "support/derivative_checker.h"
#include "support/mixed_scene.h"

namespace contact_path {
namespace {

constexpr double kRounding = 1e-15;

// A node at (0.3, 0.7) against one obstacle through (1, 2).
class OneNode : public testing::Test {
 protected:
  ContactGeometry Against(double nx, double ny) {
    scene_.nodes = {{"p", 0.3, 0.7, fixed_x_, fixed_y_}};
    scene_.obstacles = {{"o", ObstacleShape::kHalfPlane, 1.0, 2.0, nx, ny, 0.5}};
    scene_.contacts = {{"p", "o"}};
    structure_ = std::make_unique<Structure>(scene_);
    return BuildContacts(scene_, *structure_).at(0);
  }

  bool fixed_x_ = false, fixed_y_ = false;
  Scene scene_;
  std::unique_ptr<Structure> structure_;
};

TEST_F(OneNode, FloorHasItsTangentAlongX) {
  const ContactGeometry contact = Against(0.0, 3.0);
  const Eigen::VectorXd u = Eigen::Vector2d(0.3, 2.25);
  EXPECT_NEAR(contact.gap.Value(u, 0.0), 0.25, kRounding);
  EXPECT_EQ(contact.gap.Rate(Eigen::Vector2d(7.0, 2.0), 0.0), 2.0);
  EXPECT_EQ(contact.tangential.Value(u, 0.0), 0.3);
  EXPECT_EQ(contact.tangential.Rate(Eigen::Vector2d(7.0, 2.0), 0.0), 7.0);
}

TEST_F(OneNode, CeilingHasItsTangentAgainstX) {
  const ContactGeometry contact = Against(0.0, -1.0);
  const Eigen::VectorXd u = Eigen::Vector2d(0.3, 2.25);
  EXPECT_NEAR(contact.gap.Value(u, 0.0), -0.25, kRounding);
  EXPECT_EQ(contact.tangential.Rate(Eigen::Vector2d(7.0, 2.0), 0.0), -7.0);
}

TEST_F(OneNode, WallHasItsTangentDownwards) {
  const ContactGeometry contact = Against(1.0, 0.0);
  EXPECT_NEAR(contact.gap.Value(Eigen::Vector2d(1.5, 9.0), 0.0), 0.5, kRounding);
  EXPECT_EQ(contact.tangential.Rate(Eigen::Vector2d(7.0, 2.0), 0.0), -2.0);
}

TEST_F(OneNode, NormalOfAnyLengthGivesLengths) {
  const ContactGeometry contact = Against(30.0, 40.0);  // n = (0.6, 0.8), t = (0.8, -0.6)
  const Eigen::VectorXd u = Eigen::Vector2d(1.0 + 0.6 * 2.0 + 0.8 * 3.0, 2.0 + 0.8 * 2.0 - 0.6 * 3.0);
  EXPECT_NEAR(contact.gap.Value(u, 0.0), 2.0, 4.0 * kRounding);
  EXPECT_NEAR(contact.tangential.Rate(Eigen::Vector2d(0.8, -0.6), 0.0), 1.0, kRounding);
  EXPECT_NEAR(contact.tangential.Rate(Eigen::Vector2d(0.6, 0.8), 0.0), 0.0, kRounding);
}

TEST_F(OneNode, FixedComponentsAreInTheOffset) {
  fixed_x_ = true;
  const ContactGeometry contact = Against(0.6, 0.8);
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, 4.0);
  EXPECT_NEAR(contact.gap.Value(u, 0.0), 0.6 * (0.3 - 1.0) + 0.8 * (4.0 - 2.0), 4.0 * kRounding);
  EXPECT_NEAR(contact.tangential.Value(u, 0.0), 0.8 * 0.3 - 0.6 * 4.0, 4.0 * kRounding);
  EXPECT_EQ(contact.friction, 0.5);
  EXPECT_TRUE(contact.Frictional());
}

TEST_F(OneNode, FrictionNeedsAWayToSlide) {
  fixed_x_ = true;
  EXPECT_FALSE(Against(0.0, 1.0).Frictional());
  fixed_x_ = false;
  EXPECT_TRUE(Against(0.0, 1.0).Frictional());
  fixed_y_ = true;
  EXPECT_FALSE(Against(1.0, 0.0).Frictional());
}

TEST(ContactGeometry, GradientsAreThoseOfTheValues) {
  const Scene scene = MixedScene();
  const Structure structure(scene);
  const std::vector<ContactGeometry> contacts = BuildContacts(scene, structure);
  ASSERT_EQ(contacts.size(), 6u);
  for (const ContactGeometry& contact : contacts) {
    for (const SparseLinear* function : {&contact.gap, &contact.tangential}) {
      Eigen::VectorXd gradient = Eigen::VectorXd::Constant(structure.NumDofs(), 0.5);
      function->AddGradient(2.0, &gradient);
      const Eigen::MatrixXd expected = (0.5 * (gradient.array() - 0.5)).matrix().transpose();
      const auto value = [&](const Eigen::VectorXd& u) {
        return Eigen::VectorXd::Constant(1, function->Value(u, 0.0));
      };
      EXPECT_TRUE(IsJacobian(value, structure.InitialPositions(), expected));
      const Eigen::VectorXd du = Eigen::VectorXd::LinSpaced(structure.NumDofs(), -1.0, 1.0);
      EXPECT_NEAR(function->Rate(du, 0.0), (expected * du)[0], kRounding);
    }
  }
}

TEST(ContactGeometry, FollowsTheOrderOfTheScene) {
  Scene scene = MixedScene();
  const Structure structure(scene);
  const std::vector<ContactGeometry> contacts = BuildContacts(scene, structure);
  const std::vector<double> friction = {0.3, 0.0, 0.3, 0.6, 0.3, 0.0};
  for (std::size_t i = 0; i < contacts.size(); ++i) EXPECT_EQ(contacts[i].friction, friction[i]) << i;
  for (const ContactGeometry& contact : contacts) EXPECT_GT(contact.gap.Value(structure.InitialPositions(), 0.0), 0.0);
}

}  // namespace
}  // namespace contact_path
