#include "contact_path/scene/surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contact_path::can_slide_test {
namespace {

Obstacle WithNormal(double nx, double ny) { return {"o", ObstacleShape::kHalfPlane, 0.0, 0.0, nx, ny, 0.5}; }

TEST(CanSlide, WhereAComponentThatMovesHasAShareInTheTangent) {
  EXPECT_TRUE(CanSlide(true, true, WithNormal(0.0, 1.0)));
  EXPECT_TRUE(CanSlide(true, false, WithNormal(0.0, 1.0)));
  EXPECT_FALSE(CanSlide(false, true, WithNormal(0.0, 1.0)));
  EXPECT_FALSE(CanSlide(true, false, WithNormal(-1.0, 0.0)));
  EXPECT_TRUE(CanSlide(false, true, WithNormal(0.6, 0.8)));
  EXPECT_FALSE(CanSlide(false, false, WithNormal(0.6, 0.8)));
}

// A floor whose normal was computed from an angle, of any length.
TEST(CanSlide, NotByTheRoundingOfANormal) {
  const double angle = std::acos(0.0);
  ASSERT_NE(std::cos(angle), 0.0);
  for (const double length : {1e-8, 1.0, 1e8})
    EXPECT_FALSE(CanSlide(false, true, WithNormal(length * std::cos(angle), length * std::sin(angle)))) << length;
  EXPECT_TRUE(CanSlide(false, true, WithNormal(1e-9, 1.0)));
}

}  // namespace
}  // namespace contact_path::can_slide_test
