#include "contact_path/scene/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contact_path::scene_test {
namespace {

TEST(SceneTest, ZeroOptionsStandForTheirDefaults) {
  TraceOptions options;
  EXPECT_EQ(options.MaxIncrements(0), 1000U);
  EXPECT_EQ(options.MaxIncrements(3), 3000U);
  EXPECT_EQ(options.Direction(), 1.0);
  options.max_increments = 7;
  options.direction = -0.5;
  EXPECT_EQ(options.MaxIncrements(3), 7U);
  EXPECT_EQ(options.Direction(), -1.0);
  options.direction = 3.0;
  EXPECT_EQ(options.Direction(), 1.0);
}

}  // namespace
}  // namespace contact_path::scene_test
