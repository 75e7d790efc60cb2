#include "contact_path/scene/scene_index.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace contact_path::reacting_parts_test {
namespace {

// Nodes of a beam turn; the others do not.
TEST(SupportedNodes, HaveTheComponentsThatAreFixed) {
  Scene scene;
  scene.nodes = {{"free"},
                 {"x", 0.0, 0.0, true},
                 {"turns", 1.0, 0.0, false, false, true},
                 {"tip", 2.0, 0.0},
                 {"does_not_turn", 3.0, 0.0, false, true, true},
                 {"rotation_alone", 4.0, 0.0, false, false, true}};
  scene.beams = {{"", {"turns", "tip"}}};
  const std::vector<SupportedNode> supports = SupportedNodes(scene);
  ASSERT_EQ(supports.size(), 3U);
  EXPECT_EQ(supports[0].node, 1U);
  EXPECT_TRUE(supports[0].x && !supports[0].y && !supports[0].rotation);
  EXPECT_EQ(supports[1].node, 2U);
  EXPECT_TRUE(!supports[1].x && !supports[1].y && supports[1].rotation);
  EXPECT_EQ(supports[2].node, 4U);
  EXPECT_TRUE(!supports[2].x && supports[2].y && !supports[2].rotation);
}

TEST(TouchedBoundaries, HaveCandidates) {
  Scene scene;
  scene.nodes = {{"a"}, {"b"}, {"c"}};
  scene.obstacles = {{"far"}, {"floor"}, {"wall"}};
  BoundarySurface surface;
  surface.name = "floor";  // of an obstacle, too
  scene.surfaces = {surface};
  ContactCandidate on_surface;
  on_surface.node = "c";
  on_surface.surface = "floor";
  scene.contacts = {{"b", "wall"}, on_surface, {"a", "floor"}, {"a", "wall"}};
  const std::vector<TouchedBoundary> boundaries = TouchedBoundaries(scene);
  ASSERT_EQ(boundaries.size(), 3U);
  EXPECT_EQ(boundaries[0].name, "floor");
  EXPECT_FALSE(boundaries[0].is_surface);
  EXPECT_EQ(boundaries[0].place, 1U);
  EXPECT_EQ(boundaries[1].name, "wall");
  EXPECT_EQ(boundaries[2].name, "floor");
  EXPECT_TRUE(boundaries[2].is_surface);
  EXPECT_EQ(boundaries[2].place, 0U);
  EXPECT_EQ(BoundaryOfContacts(scene, boundaries), (std::vector<std::size_t>{1, 2, 0, 1}));
}

}  // namespace
}  // namespace contact_path::reacting_parts_test
