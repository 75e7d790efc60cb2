#include "contact_path/path/diagnosis.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace contact_path {
namespace {

Scene TwoBars() {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 2.0, 0.0, false, false}, {"c", 2.0, 1.0, false, false}};
  Bar first, second;
  first.nodes = {"a", "b"};
  second.nodes = {"b", "c"};
  first.EA = second.EA = 1.0;
  scene.bars = {first, second};
  return scene;
}

std::string Collapsed(const std::vector<double>& positions) {
  const Scene scene = TwoBars();
  return CollapsedBar(scene, SceneIndex(scene), positions);
}

TEST(CollapsedBar, NamesTheOneThatHasShrunkMost) {
  EXPECT_EQ(Collapsed({0.0, 0.0, 0.015, 0.0, 0.015, 1e-3}), "bar 1 (b, c) has shrunk to 0.001 of its initial length");
  EXPECT_EQ(Collapsed({0.0, 0.0, 0.0, 1e-7, 0.0, 1e-3}), "bar 0 (a, b) has shrunk to 5e-08 of its initial length");
}

TEST(CollapsedBar, SaysNothingOfLongOnes) { EXPECT_EQ(Collapsed({0.0, 0.0, 0.1, 0.0, 0.1, 0.1}), ""); }

// A soft bar with a contact and a stiff one without: F = 1e4.
TEST(ContactTooSoft, NamesTheContact) {
  Scene scene = TwoBars();
  scene.nodes[2].fixed_x = scene.nodes[2].fixed_y = true;
  scene.bars[0].EA = 1e-4;
  scene.bars[1] = {{"a", "c"}, 1e12};
  scene.loads = {{"b", 1.0, 0.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  scene.contacts = {{"b", "floor"}};
  const Model model(scene, CharacteristicScales(scene));
  const PathPoint point = model.InitialPoint();
  EXPECT_EQ(
      ContactTooSoft(model, point, 1e-7),
      "the parts at node b are 9.4e+07 times softer than the characteristic stiffness: reactions of contact b@floor "
      "cannot be told from rounding");
  EXPECT_EQ(ContactTooSoft(model, point, 1e-9), "");
}

}  // namespace
}  // namespace contact_path
