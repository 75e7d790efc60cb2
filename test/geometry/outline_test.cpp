#include "contact_path/geometry/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact_path/geometry/curve.h"
#include "contact_path/geometry/point_curves.h"
#include "support/curved_obstacles.h"

namespace contact_path::outline_test {
namespace {

using Eigen::Vector2d;

constexpr double kRounding = 1e-13;
const double kPi = std::acos(-1.0);

double LargestTurn(const std::vector<OutlinePoint>& points) {
  double largest = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k)
    largest = std::max(largest, std::acos(std::min(points[k].normal.dot(points[k - 1].normal), 1.0)));
  return largest;
}

TEST(Outline, IsOnACircleWithSmallTurns) {
  const Vector2d centre(1.0, -2.0);
  const auto circle = MakeCircle(centre, 3.0, false);
  const std::vector<OutlinePoint> points = Outline(*circle, {4, kPi / 90.0});
  EXPECT_NEAR(points.back().xi - points.front().xi, 6.0 * kPi, kRounding);
  EXPECT_NEAR((points.back().place - points.front().place).norm(), 0.0, kRounding);
  for (const OutlinePoint& point : points) {
    EXPECT_NEAR((point.place - centre - 3.0 * point.normal).norm(), 0.0, kRounding);
    // Clockwise, from the top on.
    EXPECT_NEAR((point.normal - Vector2d(std::sin(point.xi / 3.0), std::cos(point.xi / 3.0))).norm(), 0.0, kRounding);
  }
  EXPECT_EQ(points.size(), 1U + 8U * 23U);  // a part turns by 45 degrees
  EXPECT_LE(LargestTurn(points), kPi / 90.0);
}

TEST(Outline, HasTheEndsOfEdgesAlone) {
  const PlanePoints corner = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}};
  const auto polyline = RoundedPolyline(corner, false, 0.5);
  const std::vector<OutlinePoint> points = Outline(*polyline, {8});
  ASSERT_EQ(points.size(), 11U);
  EXPECT_EQ(points.front().place, corner.front());
  EXPECT_NEAR((points[1].place - Vector2d(1.5, 0.0)).norm(), 0.0, kRounding);
  EXPECT_NEAR((points[9].place - Vector2d(2.0, 0.5)).norm(), 0.0, kRounding);
  EXPECT_NEAR((points.back().place - corner.back()).norm(), 0.0, kRounding);
  EXPECT_NEAR(points.back().xi, 1.5 + 0.25 * kPi + 2.5, kRounding);
  // Fillets that leave nothing of the edge between them.
  const auto bend = RoundedPolyline({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}}, false, 0.5);
  for (const OutlinePoint& point : Outline(*bend, {8}))
    EXPECT_TRUE(point.place.x() <= 1.5 || (point.place - Vector2d(1.5, 0.5)).norm() < 0.5 + kRounding);
  EXPECT_EQ(Outline(*bend, {8}).size(), 1U + 1U + 8U + 8U + 1U);
}

TEST(Outline, OfASplineHasItsArcLength) {
  const PlanePoints wave = {{0.0, 0.0}, {1.0, 1.0}, {2.0, -1.0}, {3.0, 0.0}};
  const auto spline = MakeSpline(wave, false);
  const std::vector<OutlinePoint> points = Outline(*spline, {32, kPi / 360.0});
  double length = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k].place - points[k - 1].place).norm();
  EXPECT_NEAR(length, points.back().xi, 1e-4);
  EXPECT_LT(LargestTurn(points), 1.5 * kPi / 360.0);  // a part turns nearly evenly
}

}  // namespace
}  // namespace contact_path::outline_test
