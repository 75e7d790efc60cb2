// The scenes of this package.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "contact_path/scene/read_scene.h"
#include "support/traced_path.h"

namespace contact_path::scenes_test {
namespace {

TEST(ScenesTest, AreSoundAndNamedAsTheirFiles) {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CONTACT_PATH_SCENES)) {
    if (entry.path().extension() != ".yaml") continue;
    ++scenes;
    EXPECT_NO_THROW({
      const TraceRequest request = ReadTraceRequestFile(entry.path().string());
      EXPECT_EQ(request.scene.name, entry.path().stem().string());
      EXPECT_FALSE(request.options.stop.empty() && request.program.empty() &&
                   request.options.at_limit != AtLimit::kStop)
          << entry.path();
    }) << entry.path();
  }
  EXPECT_GE(scenes, 6U);
}

TEST(ScenesTest, ArchIsItsOwnMirrorImage) {
  const Scene scene = ReadExample("arch19").scene;
  ASSERT_EQ(scene.nodes.size(), 11U);
  ASSERT_EQ(scene.bars.size(), 19U);
  const double degree = std::acos(-1.0) / 180.0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const Node& mirrored = scene.nodes[scene.nodes.size() - 1 - i];
    EXPECT_EQ(node.x, -mirrored.x);  // exactly
    EXPECT_EQ(node.y, mirrored.y);
    // The strip goes from 60 to -60 degrees by 12, on radii 6 and 5 in turn; a, at 48 degrees, has y = 0.
    const double angle = (60.0 - 12.0 * static_cast<double>(i)) * degree;
    const double radius = i % 2 == 0 ? 6.0 : 5.0;
    EXPECT_NEAR(node.x, radius * std::sin(angle), 1e-15 * radius);
    EXPECT_NEAR(node.y, radius * std::cos(angle) - 5.0 * std::cos(48.0 * degree), 1e-15 * radius);
  }
  std::map<std::string, Node> nodes;
  for (const Node& node : scene.nodes) nodes[node.name] = node;
  EXPECT_EQ(nodes.at("f").y, scene.obstacles.at(0).py);  // in contact at the start, exactly
  for (const char* pair : {"ag", "bh", "di", "ej", "fk", "cc"}) {
    EXPECT_EQ(nodes.at(std::string(1, pair[0])).x, -nodes.at(std::string(1, pair[1])).x) << pair;
  }
}

}  // namespace
}  // namespace contact_path::scenes_test
