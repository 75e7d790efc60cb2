#include "contact_path/structure/scene_elements.h"

#include <gtest/gtest.h>

#include "contact_path/scene/configuration.h"
#include "support/mixed_scene.h"

namespace contact_path::scene_elements_test {
namespace {

TEST(SceneElements, BarsThenSuperelementsAtTheirNodes) {
  const Scene scene = MixedScene();
  const std::vector<PlacedElement> elements =
      MakeElements(scene, SceneIndex(scene), Configuration::Of(scene).reference);
  ASSERT_EQ(elements.size(), 7u);
  EXPECT_EQ(elements[2].nodes, (std::vector<int>{3, 2}));  // d, c
  EXPECT_EQ(elements[5].nodes, (std::vector<int>{3, 0}));  // d, a
  EXPECT_EQ(elements[6].nodes, std::vector<int>{1});
  for (const PlacedElement& placed : elements) EXPECT_EQ(placed.element->Dofs().size(), 2 * placed.nodes.size());
}

// Where a rest length or rest positions are not given, the element is without force in the reference shape.
TEST(SceneElements, RestIsTakenFromTheReferenceShape) {
  Scene scene = MixedScene();
  scene.bars = {{{"a", "b"}, 1.3, 0.0, StrainMeasure::kBiot}, {{"a", "b"}, 1.3, 2.0, StrainMeasure::kBiot}};
  std::vector<double> reference = Configuration::Of(scene).reference;
  reference[2] += 1.0;  // b
  const std::vector<PlacedElement> elements = MakeElements(scene, SceneIndex(scene), reference);
  const Eigen::Vector4d ends(reference[0], reference[1], reference[2], reference[3]);
  EXPECT_NEAR(elements[0].element->Energy(ends), 0.0, 1e-30);
  EXPECT_GT(elements[1].element->Energy(ends), 1e-3);
  const Eigen::Vector2d b(reference[2], reference[3]);
  EXPECT_EQ(elements[3].element->Energy(b), 0.0);
  EXPECT_GT(elements[3].element->Energy(Eigen::Vector2d(1.1, 0.3)), 1e-3);
}

}  // namespace
}  // namespace contact_path::scene_elements_test
