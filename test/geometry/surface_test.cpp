#include "contact_path/geometry/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "support/curved_surfaces.h"
#include "support/random.h"

namespace contact_path::surface_test {
namespace {

constexpr double kRounding = 1e-14;

std::vector<std::shared_ptr<const Surface>> Surfaces() {
  return {std::make_shared<HalfPlane>(Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(30.0, 40.0)),
          std::make_shared<DiscOutside>(Eigen::Vector2d(0.1, -2.0), 1.7), std::make_shared<Spiral>(0.3, -0.4, 0.5)};
}

// Along the normal only the gap changes; the foot is where the gap is zero.
TEST(Surface, TheFootIsTheNearestPoint) {
  Random random(3);
  for (const auto& surface : Surfaces()) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d x = random.Vector(2, -0.3, 0.3);
      const Projection at = surface->Project(x, 0);
      EXPECT_NEAR(at.normal.norm(), 1.0, kRounding);
      const Projection foot = surface->Project(x - at.gap * at.normal, 0);
      EXPECT_NEAR(foot.gap, 0.0, kRounding);
      EXPECT_NEAR(foot.xi, at.xi, kRounding);
      EXPECT_NEAR((foot.normal - at.normal).norm(), 0.0, kRounding);
    }
  }
}

// On the surface xi is arc length towards t = (n_y, -n_x), and t' = curvature n.
TEST(Surface, XiIsArcLengthAndTheCurvatureTurnsTheTangentTowardsTheNormal) {
  constexpr double kStep = 1e-4, kDifference = 1e-7;
  for (const auto& surface : Surfaces()) {
    const Projection at = surface->Project({0.2, -0.1}, 0);
    const Eigen::Vector2d foot = Eigen::Vector2d(0.2, -0.1) - at.gap * at.normal;
    const Eigen::Vector2d t(at.normal.y(), -at.normal.x());
    const Projection ahead = surface->Project(foot + kStep * t, 0), behind = surface->Project(foot - kStep * t, 0);
    EXPECT_NEAR((ahead.xi - behind.xi) / (2.0 * kStep), 1.0, kDifference);
    const Eigen::Vector2d turn = (ahead.normal - behind.normal) / (2.0 * kStep);  // n' = -curvature t
    EXPECT_NEAR((turn + at.curvature * t).norm(), 0.0, kDifference);
    EXPECT_NEAR((ahead.curvature - behind.curvature) / (2.0 * kStep), at.curvature_first, kDifference);
    EXPECT_NEAR((ahead.curvature_first - behind.curvature_first) / (2.0 * kStep), at.curvature_second, kDifference);
    EXPECT_EQ(surface->Flat(), at.curvature == 0.0);
  }
}

TEST(HalfPlane, IsOnePatchWithoutEnds) {
  const HalfPlane floor({5.0, 2.0}, {0.0, 3.0});
  EXPECT_FALSE(floor.Closed());
  EXPECT_TRUE(floor.HasPatch(0));
  EXPECT_FALSE(floor.HasPatch(1));
  EXPECT_FALSE(floor.HasPatch(-1));
  EXPECT_TRUE(std::isinf(floor.RangeOf(0).begin) && std::isinf(floor.RangeOf(0).end));
  const NearestFoot below = floor.Nearest({7.0, 1.5});
  EXPECT_EQ(below.patch, 0);
  EXPECT_EQ(below.distance, 0.5);
  EXPECT_FALSE(below.is_end);
}

TEST(HalfPlane, AdmissibleSideIsWhereTheNormalPoints) {
  const HalfPlane floor({5.0, 2.0}, {0.0, 3.0});
  EXPECT_EQ(floor.Project({7.0, 2.5}, 0).gap, 0.5);
  EXPECT_EQ(floor.Project({7.0, 2.5}, 0).xi, 7.0);
  const HalfPlane ceiling({5.0, 2.0}, {0.0, -1.0});
  EXPECT_EQ(ceiling.Project({7.0, 2.5}, 0).gap, -0.5);
  EXPECT_EQ(ceiling.Project({7.0, 2.5}, 0).xi, -7.0);
}

}  // namespace
}  // namespace contact_path::surface_test
