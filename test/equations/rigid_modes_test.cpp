#include "contact_path/equations/rigid_modes.h"

#include <gtest/gtest.h>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/path/model.h"
#include "support/contact_points.h"

namespace contact_path::rigid_modes_test {
namespace {

constexpr double kRounding = 1e-13;

// A triangle of bars over a floor that its two lower nodes touch.
Scene Triangle(double friction) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}, {"c", 0.4, 0.9}};
  scene.bars = {{{"a", "b"}, 1e6}, {{"b", "c"}, 1.0}, {{"c", "a"}, 20.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.contacts = {{"a", "floor"}, {"b", "floor"}};
  scene.loads = {{"c", 0.0, -1.0}};
  return scene;
}

Eigen::MatrixXd ModesAtStart(const Scene& scene, const std::vector<ContactState>& states) {
  const Model model(scene, Scaling());
  const PathPoint point = model.InitialPoint();
  FixedModeSystem system(model.structure, model.laws);
  system.SetModes(ModesOf(states), model.laws.ReferencesAt(point));
  const Eigen::SparseMatrix<double>& transposed = system.TransposedJacobian(system.Pack(point));
  const Eigen::MatrixXd modes = RigidModes(model.structure).At(point.u, transposed);
  EXPECT_LE((transposed.transpose() * modes).norm(), kRounding * transposed.norm());
  EXPECT_LE((modes.transpose() * modes - Eigen::MatrixXd::Identity(modes.cols(), modes.cols())).norm(), kRounding);
  return modes;
}

TEST(RigidModes, AreWhatContactsLeave) {
  const ContactState open = ContactState::kOpen, stick = ContactState::kStick, plus = ContactState::kSlipPlus,
                     minus = ContactState::kSlipMinus;
  const Scene scene = Triangle(0.5);
  EXPECT_EQ(ModesAtStart(scene, {open, open}).cols(), 3);
  EXPECT_EQ(ModesAtStart(scene, {plus, open}).cols(), 2);
  EXPECT_EQ(ModesAtStart(scene, {stick, open}).cols(), 1);
  EXPECT_EQ(ModesAtStart(scene, {stick, minus}).cols(), 0);
  const Eigen::MatrixXd shift = ModesAtStart(scene, {minus, plus});
  ASSERT_EQ(shift.cols(), 1);
  for (const int dof : {0, 2, 4}) EXPECT_NEAR(std::abs(shift(dof, 0)), 1.0 / std::sqrt(3.0), kRounding);
}

TEST(RigidModes, OfAPartThatTurnsAboutAPin) {
  Scene scene = Triangle(0.0);
  scene.nodes[0].fixed_x = scene.nodes[0].fixed_y = true;
  scene.contacts = {{"b", "floor"}};
  EXPECT_EQ(ModesAtStart(scene, {ContactState::kOpen}).cols(), 1);
  EXPECT_EQ(ModesAtStart(scene, {ContactState::kClosed}).cols(), 0);
}

TEST(RigidModes, NoneWhereSupportsHoldThePart) {
  Scene scene = Triangle(0.0);
  scene.nodes[0].fixed_x = scene.nodes[0].fixed_y = scene.nodes[1].fixed_y = true;
  scene.contacts.clear();
  const Model model(scene, Scaling());
  EXPECT_FALSE(RigidModes(model.structure).Possible());
}

}  // namespace
}  // namespace contact_path::rigid_modes_test
