#include "contact_path/scene/scene_index.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace contact_path::scene_index_test {
namespace {

TEST(SceneIndexTest, NamesAreTheirPlaces) {
  Scene scene;
  scene.nodes = {{"a"}, {"b"}, {"c"}};
  scene.obstacles = {{"b"}, {"floor"}};
  scene.contacts = {{"c", "floor"}, {"a", "b"}};
  const SceneIndex index(scene);
  EXPECT_EQ(index.Node("a"), 0U);
  EXPECT_EQ(index.Node("b"), 1U);
  EXPECT_EQ(index.FindNode("c"), 2U);
  EXPECT_EQ(index.FindNode("floor"), std::nullopt);
  EXPECT_THROW(index.Node("floor"), std::out_of_range);
  EXPECT_EQ(index.Obstacle("b"), 0U);
  EXPECT_EQ(index.FindObstacle("floor"), 1U);
  EXPECT_EQ(index.FindObstacle("a"), std::nullopt);
  EXPECT_THROW(index.Obstacle("a"), std::out_of_range);
  EXPECT_EQ(index.FindContact("a@b"), 1U);
  EXPECT_EQ(index.FindContact("a@floor"), std::nullopt);
}

TEST(SceneIndexTest, OfEqualNamesTheFirstIsKnown) {
  Scene scene;
  scene.nodes = {{"a"}, {"a"}, {"b"}};
  const SceneIndex index(scene);
  EXPECT_EQ(index.Node("a"), 0U);
  EXPECT_EQ(index.Node("b"), 2U);
}

}  // namespace
}  // namespace contact_path::scene_index_test
