#include "contact_path/geometry/point_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "support/curved_obstacles.h"
#include "support/surface_checks.h"

namespace contact_path::polyline_test {
namespace {

using Eigen::Vector2d;

constexpr double kRounding = 1e-14;
const double kPi = std::acos(-1.0);

// An edge to the right, a corner to the right and one to the left.
const PlanePoints kSteps = {{0.0, 1.0}, {2.0, 1.0}, {2.5, -0.5}, {5.0, 0.0}};
// Counterclockwise: the inside of a box, and clockwise its outside.
const PlanePoints kBox = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}, {0.0, 2.0}};
const PlanePoints kBlock = {{0.0, 0.0}, {0.0, 2.0}, {3.0, 2.0}, {3.0, 0.0}};

TEST(Polyline, HasFeetBesideItsEdgesAndFillets) {
  const auto open = RoundedPolyline(kSteps, false, 0.3);
  EXPECT_EQ(open->NumPatches(), 5);
  ExpectFeet(*open, 0.2, 1e-13);
  ExpectContinuity(*open, false, kRounding);
  ExpectDerivatives(*open, 0.1, 0.02);
  for (const PlanePoints& points : {kBox, kBlock}) {
    const auto closed = RoundedPolyline(points, true, 0.25);
    EXPECT_EQ(closed->NumPatches(), 8);
    ExpectFeet(*closed, 0.2, 1e-13);
    ExpectContinuity(*closed, false, kRounding);
    ExpectDerivatives(*closed, 0.1, 0.02);
    EXPECT_NEAR(closed->Length(), 10.0 - 8.0 * 0.25 + 2.0 * kPi * 0.25, 10.0 * kRounding);
  }
}

// Where centres of circles are that touch it: at corners about the same points, and round open ends.
TEST(Polyline, AtADistanceHasOtherFilletsAndRoundEnds) {
  constexpr double kDistance = 0.2, kFillet = 0.3;
  for (const PlanePoints& points : {kSteps, kBox, kBlock}) {
    const bool closed = points != kSteps;
    const std::vector<double> fillets(points.size(), kFillet);
    const auto curve = MakePolyline(points, closed, fillets), beside = MakePolyline(points, closed, fillets, kDistance);
    const int ends = closed ? 0 : 1;
    EXPECT_EQ(beside->NumPatches(), curve->NumPatches() + 2 * ends);
    ExpectFeet(*beside, 0.05, 1e-13);
    ExpectContinuity(*beside, false, kRounding);
    ExpectDerivatives(*beside, 0.05, 0.02);
    for (int patch = 0; patch < curve->NumPatches(); ++patch) {
      const Vector2d x = BesidePatch(*curve, patch, 0.3, 0.25);
      const Projection at = curve->Project(x, patch), here = beside->Project(x, patch + ends);
      EXPECT_NEAR(here.gap, at.gap - kDistance, kRounding);
      EXPECT_NEAR((here.normal - at.normal).norm(), 0.0, 10.0 * kRounding);
      EXPECT_NEAR(here.curvature * (1.0 - kDistance * at.curvature), at.curvature, 1e-12);
    }
    // Corners to the right are longer by what those to the left are shorter.
    const double turn = points == kBox ? 2.0 * kPi : points == kBlock ? -2.0 * kPi : 0.0;
    if (closed) {
      EXPECT_NEAR(beside->Length(), curve->Length() - kDistance * turn, 1e-13);
    }
  }
  const auto open = MakePolyline(kSteps, false, std::vector<double>(4, kFillet), kDistance);
  const Projection ahead = open->ProjectOnNearest(kSteps.front() - Vector2d(0.5, 0.0));
  EXPECT_NEAR(ahead.gap, 0.5 - kDistance, kRounding);
  EXPECT_NEAR((ahead.normal - Vector2d(-1.0, 0.0)).norm(), 0.0, kRounding);
  EXPECT_NEAR(ahead.xi, -0.5 * kPi * kDistance, kRounding);
  EXPECT_NEAR(open->PointAt(0.0).y(), 1.0 + kDistance, kRounding);
}

TEST(Polyline, FindsItsSharpestHollow) {
  EXPECT_EQ(HollowOfPolyline(kSteps, false, {0.1, 0.2, 0.3, 0.05})->point, 2U);
  EXPECT_EQ(HollowOfPolyline(kSteps, false, {0.1, 0.2, 0.3, 0.05})->radius, 0.3);
  EXPECT_EQ(HollowOfPolyline(kBox, true, {0.4, 0.2, 0.3, 0.5})->point, 1U);
  EXPECT_FALSE(HollowOfPolyline(kBlock, true, {0.4, 0.2, 0.3, 0.5}));
}

TEST(Polyline, TurnsItsAdmissibleSideToTheLeft) {
  EXPECT_NEAR(RoundedPolyline(kBox, true, 0.1)->ProjectOnNearest({1.5, 0.5}).gap, 0.5, kRounding);
  EXPECT_NEAR(RoundedPolyline(kBlock, true, 0.1)->ProjectOnNearest({1.5, 0.5}).gap, -0.5, kRounding);
  EXPECT_NEAR(RoundedPolyline(kSteps, false, 0.1)->ProjectOnNearest({1.0, 1.5}).gap, 0.5, kRounding);
  // A corner to the right is convex, one to the left hollow.
  const auto steps = RoundedPolyline(kSteps, false, 0.1);
  EXPECT_NEAR(steps->Project({2.0, 1.0}, 1).curvature, -10.0, 1e-12);
  EXPECT_NEAR(steps->Project({2.5, -0.5}, 3).curvature, 10.0, 1e-12);
}

TEST(Polyline, EndsAtItsFirstAndLastPoint) {
  const auto open = RoundedPolyline(kSteps, false, 0.3);
  EXPECT_EQ(open->PointAt(0.0), kSteps.front());
  EXPECT_NEAR((open->PointAt(open->Length()) - kSteps.back()).norm(), 0.0, kRounding);
  const NearestFoot before = open->Nearest({-0.3, 1.4}), past = open->Nearest({5.3, 0.4});
  EXPECT_TRUE(before.is_end && past.is_end);
  EXPECT_NEAR(before.distance, 0.5, kRounding);
  EXPECT_EQ(before.patch, 0);
  EXPECT_EQ(past.patch, 4);
}

TEST(Polyline, PointsInLineNeedNoFillet) {
  const auto straight = RoundedPolyline({{0.0, 0.0}, {1.0, 0.0}, {4.0, 0.0}}, false, 100.0);
  EXPECT_EQ(straight->NumPatches(), 2);
  EXPECT_EQ(LargestFillet({{0.0, 0.0}, {1.0, 0.0}, {4.0, 0.0}}, false), std::numeric_limits<double>::infinity());
}

// A regular polygon with the largest fillet is its inscribed circle.
TEST(Polyline, TheLargestFilletUsesUpItsEdges) {
  constexpr int kCorners = 12;
  PlanePoints points;
  for (int i = 0; i < kCorners; ++i)
    points.push_back({std::sin(2.0 * kPi * i / kCorners), std::cos(2.0 * kPi * i / kCorners)});
  const double inscribed = std::cos(kPi / kCorners);
  EXPECT_NEAR(LargestFillet(points, true), inscribed, 1e-13);
  const auto circle = RoundedPolyline(points, true, LargestFillet(points, true));
  EXPECT_NEAR(circle->Length(), 2.0 * kPi * inscribed, 1e-12);
  for (double angle = 0.0; angle < 6.0; angle += 0.1)
    EXPECT_NEAR(circle->ProjectOnNearest({2.0 * std::sin(angle), 2.0 * std::cos(angle)}).gap, 2.0 - inscribed, 1e-13);
  // Of an open one the outer edges have one fillet only.
  EXPECT_NEAR(LargestFillet({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}}, false), 1.0, kRounding);
  EXPECT_NEAR(LargestFillet({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}, {9.0, 3.0}}, false), 1.0, kRounding);
  EXPECT_EQ(LargestFillet({{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.0}}, false), 0.0);
}

TEST(Polyline, FilletsOfAlmostStraightCornersAreContinuous) {
  for (const double turn : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const auto bent = RoundedPolyline({{0.0, 0.0}, {1.0, 0.0}, {2.0, turn}}, false, 0.1);
    EXPECT_EQ(bent->NumPatches(), 3);
    ExpectContinuity(*bent, false, kRounding);
  }
}

// The place of a point is known to rounding, and so is its direction from the centre of a small fillet.
TEST(Polyline, SmallFilletsAreAsExactAsThePlaceOfAPoint) {
  for (const double fillet : {1e-9, 1e-6, 1e-3})
    ExpectContinuity(*RoundedPolyline(kSteps, false, fillet), false, 0.1 * kRounding / fillet);
}

TEST(Polyline, EqualPointsAreFound) {
  EXPECT_FALSE(FindEqualPoints(kBox, true));
  EXPECT_EQ(FindEqualPoints({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}}, false), 1u);
  EXPECT_EQ(FindEqualPoints({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}}, true), 2u);
  EXPECT_FALSE(FindEqualPoints({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}}, false));
}

TEST(Polyline, CrossingsOfAClosedOneAreFound) {
  EXPECT_FALSE(FindCrossing(kBox));
  EXPECT_FALSE(FindCrossing(kBlock));
  using Pair = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(FindCrossing({{0.0, 0.0}, {2.0, 2.0}, {2.0, 0.0}, {0.0, 2.0}}), Pair(0, 2));
  // A corner on another edge, an edge that leads straight back, and edges in line that overlap.
  EXPECT_TRUE(FindCrossing({{0.0, 0.0}, {4.0, 0.0}, {4.0, 2.0}, {2.0, 0.0}, {0.0, 2.0}}));
  EXPECT_TRUE(FindCrossing({{0.0, 0.0}, {4.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}}));
  EXPECT_TRUE(FindCrossing({{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {5.0, 1.0}, {5.0, 0.0}, {3.0, 0.0}, {3.0, -2.0}}));
}

}  // namespace
}  // namespace contact_path::polyline_test
