#include "contact_path/geometry/point_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "support/surface_checks.h"

namespace contact_path::spline_test {
namespace {

using Eigen::Vector2d;

constexpr double kRounding = 1e-14;
const double kPi = std::acos(-1.0);

const PlanePoints kWave = {{0.0, 0.0}, {1.0, 0.4}, {2.2, -0.1}, {3.0, 0.3}, {4.5, 0.0}};
const PlanePoints kCam = {{0.0, 1.3}, {1.0, 0.3}, {0.8, -0.9}, {-0.6, -1.1}, {-1.2, 0.1}};  // clockwise

TEST(Spline, HasFeetDerivativesAndContinuousCurvature) {
  for (const bool closed : {false, true}) {
    const auto curve = MakeSpline(closed ? kCam : kWave, closed);
    EXPECT_EQ(curve->NumPatches(), closed ? 5 : 4);
    ExpectFeet(*curve, 0.05, 1e-13);
    ExpectContinuity(*curve, true, 1e-13);
    ExpectDerivatives(*curve, 0.1, 0.02, 1e-7);
  }
}

// Where centres of circles are that touch it, as far as hollows admit.
TEST(Spline, AtADistanceHasFeetAndDerivatives) {
  for (const bool closed : {false, true}) {
    const PlanePoints& points = closed ? kCam : kWave;
    const auto curve = MakeSpline(points, closed);
    const std::optional<Hollow> hollow = HollowOfSpline(points, closed);
    for (const double share : {0.1, 0.7}) {
      const double distance = share * (hollow ? hollow->radius : 1.0);
      const auto beside = MakeSpline(points, closed, distance);
      const int ends = closed ? 0 : 1;
      EXPECT_EQ(beside->NumPatches(), curve->NumPatches() + 2 * ends);
      ExpectFeet(*beside, 0.02, 1e-12);
      ExpectContinuity(*beside, false, 1e-12);
      ExpectDerivatives(*beside, 0.02, 0.005, 1e-5);
      for (int patch = 0; patch < curve->NumPatches(); ++patch) {
        const Vector2d x = BesidePatch(*curve, patch, 0.3, distance + 0.02);
        const Projection at = curve->Project(x, patch), here = beside->Project(x, patch + ends);
        EXPECT_NEAR(here.gap, 0.02, 1e-13);
        EXPECT_NEAR((here.normal - at.normal).norm(), 0.0, 1e-13);
        EXPECT_NEAR(here.curvature * (1.0 - distance * at.curvature), at.curvature, 1e-12);
      }
    }
  }
}

// Curvature of y = h (3 tau - tau^3) / 2, half of the spline through three points, and of its mirror image.
TEST(Spline, FindsItsSharpestHollow) {
  const auto hollow = HollowOfSpline({{-1.0, 0.5}, {0.0, 0.0}, {1.0, 0.5}, {2.0, 1.0}}, false);
  ASSERT_TRUE(hollow);
  EXPECT_LE(hollow->point, 1U);
  const auto valley = HollowOfSpline({{-1.0, 0.5}, {0.0, 0.0}, {1.0, 0.5}}, false);
  ASSERT_TRUE(valley);
  EXPECT_NEAR(valley->radius, 1.0 / 1.5, 1e-9);
  // But for rounding at its ends, which are straight.
  const auto hill = HollowOfSpline({{-1.0, 0.0}, {0.0, 0.5}, {1.0, 0.0}}, false);
  EXPECT_TRUE(!hill || hill->radius > 1e12);
}

TEST(Spline, GoesThroughItsPoints) {
  const auto wave = MakeSpline(kWave, false);
  for (const Vector2d& point : kWave) EXPECT_NEAR(wave->Nearest(point).distance, 0.0, kRounding);
  EXPECT_EQ(wave->PointAt(0.0), kWave.front());
  EXPECT_NEAR((wave->PointAt(wave->Length()) - kWave.back()).norm(), 0.0, kRounding);
  const auto cam = MakeSpline(kCam, true);
  for (const Vector2d& point : kCam) EXPECT_NEAR(cam->Nearest(point).distance, 0.0, kRounding);
  // Clockwise: the admissible side is outside.
  EXPECT_GT(cam->ProjectOnNearest({0.0, 2.0}).gap, 0.5);
  EXPECT_LT(cam->ProjectOnNearest({0.0, 0.5}).gap, -0.5);
}

TEST(Spline, IsStraightAtOpenEnds) {
  const auto wave = MakeSpline(kWave, false);
  EXPECT_NEAR(wave->Project(kWave.front(), 0).curvature, 0.0, kRounding);
  EXPECT_NEAR(wave->Project(kWave.back(), 3).curvature, 0.0, kRounding);
  const auto line = MakeSpline({{1.0, 1.0}, {4.0, 5.0}}, false);
  EXPECT_NEAR(line->Length(), 5.0, kRounding);
  EXPECT_NEAR(line->ProjectOnNearest({2.5, 3.0}).gap, 0.0, kRounding);
}

TEST(Spline, XiGrowsByItsLengthEachRound) {
  const auto cam = MakeSpline(kCam, true);
  const Vector2d x = BesidePatch(*cam, 2, 0.3, 0.1);
  for (const int rounds : {-2, -1, 1, 3}) {
    const Projection at = cam->Project(x, 2 + 5 * rounds), here = cam->Project(x, 2);
    EXPECT_NEAR(at.xi - here.xi, rounds * cam->Length(), 1e-13);
    EXPECT_EQ(at.gap, here.gap);
    EXPECT_EQ(at.curvature, here.curvature);
  }
  EXPECT_NEAR(cam->RangeOf(7).begin - cam->RangeOf(2).begin, cam->Length(), 1e-13);
}

// Of the fourth order in the distance of the points.
TEST(Spline, ThroughPointsOfACircleConvergesToIt) {
  double previous = 0.0;
  for (const int count : {16, 32, 64}) {
    PlanePoints points;
    for (int i = 0; i < count; ++i)
      points.push_back({std::sin(2.0 * kPi * i / count), std::cos(2.0 * kPi * i / count)});
    const auto circle = MakeSpline(points, true);
    const double error = std::abs(circle->Length() - 2.0 * kPi);
    if (previous > 0.0) {
      EXPECT_LT(error, previous / 14.0);
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-5);
}

}  // namespace
}  // namespace contact_path::spline_test
