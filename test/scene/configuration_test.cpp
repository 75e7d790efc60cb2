#include "contact_path/scene/configuration.h"

#include <gtest/gtest.h>

#include "support/mixed_scene.h"

namespace contact_path::configuration_test {
namespace {

TEST(Configuration, OfASceneIsWhereItsNodesAre) {
  const Configuration configuration = Configuration::Of(MixedScene());
  const std::vector<double> expected = {0.0, 0.1, 1.1, 0.3, 1.4, 1.2, 0.2, 1.3, 0.7, 0.9};
  EXPECT_EQ(configuration.reference, expected);
  EXPECT_EQ(configuration.start, expected);
}

TEST(Configuration, OverALengthBothShapesAreScaled) {
  Configuration configuration;
  configuration.reference = {2.0, 4.0};
  configuration.start = {6.0, 8.0};
  const Configuration scaled = configuration.Over(2.0);
  EXPECT_EQ(scaled.reference, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(scaled.start, (std::vector<double>{3.0, 4.0}));
}

}  // namespace
}  // namespace contact_path::configuration_test
