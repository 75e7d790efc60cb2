#include "contact_path/scene/configuration.h"

#include <gtest/gtest.h>

namespace contact_path::origin_test {
namespace {

Scene SceneAt(double x, double y) {
  Scene scene;
  scene.nodes = {{"a", x, y + 5.0, true, true}, {"b", x - 5.0, y}};
  scene.superelements = {{{"b"}, {1.0, 0.0, 0.0, 1.0}, {x - 4.0, y + 1.0}}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, x, y, 0.0, 1.0, 0.3}};
  return scene;
}

TEST(OriginTest, IsZeroForASceneThatIsNotSmallBesideItsDistance) {
  EXPECT_EQ(OriginOf(SceneAt(0.0, 0.0), 7.0), Origin());
  EXPECT_EQ(OriginOf(SceneAt(4000.0, -4000.0), 7.0), Origin());
  EXPECT_EQ(OriginOf(SceneAt(1e6, 1e6), 1e4), Origin());
  EXPECT_EQ(OriginOf(Scene(), 1.0), Origin());
}

TEST(OriginTest, IsTheCornerOfASceneThatIsFarAway) {
  EXPECT_EQ(OriginOf(SceneAt(1e6, -3e6), 7.0), (Origin{1e6 - 5.0, -3e6}));
  EXPECT_EQ(OriginOf(SceneAt(0.0, 1e6), 7.0), (Origin{-5.0, 1e6}));
}

TEST(OriginTest, AllCoordinatesAreCountedFromIt) {
  const Scene far = SceneAt(1e6, -1e6), near = SceneAt(0.0, 0.0);
  const Origin origin = {1e6, -1e6};
  const Scene counted = CountedFrom(origin, far);
  for (std::size_t i = 0; i < near.nodes.size(); ++i) {
    EXPECT_EQ(counted.nodes[i].x, near.nodes[i].x);
    EXPECT_EQ(counted.nodes[i].y, near.nodes[i].y);
  }
  EXPECT_EQ(counted.superelements[0].rest_positions, near.superelements[0].rest_positions);
  EXPECT_EQ(counted.obstacles[0].px, 0.0);
  EXPECT_EQ(counted.obstacles[0].py, 0.0);
  EXPECT_EQ(counted.obstacles[0].ny, 1.0);
  const Configuration configuration = CountedFrom(origin, Configuration::Of(far));
  EXPECT_EQ(configuration.reference, Configuration::Of(near).reference);
  EXPECT_EQ(configuration.start, Configuration::Of(near).start);
}

}  // namespace
}  // namespace contact_path::origin_test
