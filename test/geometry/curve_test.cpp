#include "contact_path/geometry/curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/curved_surfaces.h"
#include "support/random.h"
#include "support/surface_checks.h"

namespace contact_path::curve_test {
namespace {

using Eigen::Vector2d;

constexpr double kRounding = 1e-14;
const double kPi = std::acos(-1.0);

TEST(Circle, HasFeetAllRoundAndIsContinuous) {
  for (const bool inside : {false, true}) {
    const auto circle = MakeCircle({0.3, -0.8}, 1.4, inside);
    ExpectFeet(*circle, 0.5, kRounding);
    ExpectContinuity(*circle, true, kRounding);
    ExpectDerivatives(*circle, 0.3, 0.02);
  }
}

// As the disc that the tests of pairs have had before.
TEST(Circle, FromOutsideIsADisc) {
  const Vector2d centre(0.3, -0.8);
  const auto circle = MakeCircle(centre, 1.4, false);
  const DiscOutside disc(centre, 1.4);
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vector2d x = random.Vector(2, -3.0, 3.0);
    const Projection at = disc.Project(x, 0), here = circle->ProjectOnNearest(x);
    EXPECT_NEAR(here.gap, at.gap, kRounding);
    EXPECT_NEAR(std::remainder(here.xi - at.xi, circle->Length()), 0.0, kRounding);
    EXPECT_NEAR((here.normal - at.normal).norm(), 0.0, kRounding);
    EXPECT_EQ(here.curvature, at.curvature);
  }
}

TEST(Circle, AdmitsInsideWhatItDoesNotAdmitOutside) {
  const auto outside = MakeCircle({1.0, 2.0}, 2.0, false), inside = MakeCircle({1.0, 2.0}, 2.0, true);
  const Vector2d x(1.5, 2.5);
  EXPECT_NEAR(outside->ProjectOnNearest(x).gap, std::sqrt(0.5) - 2.0, kRounding);
  EXPECT_NEAR(inside->ProjectOnNearest(x).gap, 2.0 - std::sqrt(0.5), kRounding);
  // Outside clockwise, from the top; inside counterclockwise, from the bottom.
  EXPECT_NEAR(outside->Project({4.0, 2.0}, 0).xi, 0.5 * kPi * 2.0, kRounding);
  EXPECT_NEAR(inside->Project({2.0, 2.0}, 0).xi, 0.5 * kPi * 2.0, kRounding);
  EXPECT_NEAR((outside->Project({1.0, 5.0}, 0).normal - Vector2d(0.0, 1.0)).norm(), 0.0, kRounding);
  EXPECT_NEAR((inside->Project({1.0, 0.5}, 0).normal - Vector2d(0.0, 1.0)).norm(), 0.0, kRounding);
}

// A walk round the circle, three times on and once back, from patch to patch.
TEST(Circle, XiGrowsByItsLengthEachRound) {
  const auto circle = MakeCircle({0.0, 0.0}, 0.5, false);
  EXPECT_NEAR(circle->Length(), kPi, kRounding);
  int patch = 0;
  const auto xi_at = [&](double angle) {
    const Vector2d x(0.6 * std::sin(angle), 0.6 * std::cos(angle));
    Projection at = circle->Project(x, patch);
    while (at.xi > circle->RangeOf(patch).end) at = circle->Project(x, ++patch);
    while (at.xi < circle->RangeOf(patch).begin) at = circle->Project(x, --patch);
    return at.xi;
  };
  for (double angle = 0.0; angle < 6.0 * kPi; angle += 0.1) EXPECT_NEAR(xi_at(angle), 0.5 * angle, 10.0 * kRounding);
  EXPECT_EQ(patch, 6);
  for (double angle = 6.0 * kPi; angle > -2.0 * kPi; angle -= 0.1)
    EXPECT_NEAR(xi_at(angle), 0.5 * angle, 10.0 * kRounding);
  EXPECT_EQ(patch, -2);
}

// Relative to the gap and to xi, and not to the radius.
TEST(Circle, GapAndXiAreExactHoweverLargeItIs) {
  for (const double radius : {1e3, 1e6, 1e9}) {
    const auto circle = MakeCircle({0.0, -radius}, radius, false);
    for (const double x : {1e-3, 0.1, 1.0}) {
      // sqrt(x^2 + (y + R)^2) - R, without cancellation.
      const double y = 0.25, excess = x * x + y * y + 2.0 * y * radius;
      EXPECT_NEAR(circle->ProjectOnNearest({x, y}).gap, excess / (std::hypot(x, y + radius) + radius), kRounding);
      EXPECT_NEAR(circle->ProjectOnNearest({x, 0.0}).gap, x * x / (std::hypot(x, radius) + radius), 1e-30);
      EXPECT_NEAR(circle->ProjectOnNearest({x, 0.0}).xi, radius * std::atan2(x, radius), kRounding);
    }
  }
}

TEST(Circle, HasNoFootForItsCentre) {
  const auto circle = MakeCircle({1.0, 2.0}, 3.0, true);
  EXPECT_FALSE(circle->Project({1.0, 2.0}, 0).normal.allFinite());
  EXPECT_NEAR(circle->Nearest({1.0, 2.0}).distance, 3.0, kRounding);
}

// An open arc that begins at the angle `begin` from the x axis and turns by `turn`.
std::unique_ptr<const Curve> MakeArc(const Vector2d& centre, double radius, double begin, double turn) {
  const auto side = turn > 0.0 ? ArcPiece::Side::kInside : ArcPiece::Side::kOutside;
  const int patches = std::abs(turn) > M_PI ? 2 : 1;
  std::vector<std::unique_ptr<const CurvePiece>> pieces;
  for (int i = 0; i < patches; ++i) {
    const double middle = begin + turn * (i + 0.5) / patches;
    pieces.push_back(std::make_unique<ArcPiece>(centre, radius, Vector2d(std::cos(middle), std::sin(middle)),
                                                std::abs(turn) / patches, side));
  }
  return std::make_unique<Curve>(std::move(pieces), false);
}

TEST(Arc, EndsWhereItsTurnIsComplete) {
  for (const double turn : {-5.0, -2.0, 1.0, 4.0}) {
    const auto arc = MakeArc({0.2, 0.1}, 0.7, 0.4, turn);
    ExpectFeet(*arc, 0.2, kRounding);
    ExpectContinuity(*arc, true, kRounding);
    EXPECT_NEAR(arc->Length(), 0.7 * std::abs(turn), kRounding);
    EXPECT_FALSE(arc->Closed());
    EXPECT_FALSE(arc->HasPatch(arc->NumPatches()));
    const Vector2d begin(0.2 + 0.7 * std::cos(0.4), 0.1 + 0.7 * std::sin(0.4));
    const Vector2d end(0.2 + 0.7 * std::cos(0.4 + turn), 0.1 + 0.7 * std::sin(0.4 + turn));
    EXPECT_NEAR((arc->PointAt(0.0) - begin).norm(), 0.0, kRounding);
    EXPECT_NEAR((arc->PointAt(arc->Length()) - end).norm(), 0.0, kRounding);
    // Past its end the end itself is nearest.
    const Vector2d beyond = end + 0.05 * TangentOf(arc->ProjectOnNearest(end).normal);
    const NearestFoot nearest = arc->Nearest(beyond);
    EXPECT_TRUE(nearest.is_end);
    EXPECT_EQ(nearest.patch, arc->NumPatches() - 1);
    EXPECT_NEAR(nearest.distance, 0.05, kRounding);
    EXPECT_GT(arc->Project(beyond, nearest.patch).xi, arc->Length());
  }
}

TEST(CubicPiece, OfALineOrAParabolaHasTheClosedForm) {
  const CubicPiece line({1.0, 2.0}, {3.0, 4.0}, {0.0, 0.0}, {0.0, 0.0});
  EXPECT_NEAR(line.Length(), 5.0, kRounding);
  const Projection beside = line.Project(Vector2d(1.0, 2.0) + 0.3 * Vector2d(3.0, 4.0) + 0.1 * Vector2d(-4.0, 3.0));
  EXPECT_NEAR(beside.gap, 0.5, kRounding);
  EXPECT_NEAR(beside.xi, 1.5, kRounding);
  EXPECT_EQ(beside.curvature, 0.0);
  // y = x^2 from 0 to 1.
  const CubicPiece parabola({0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0});
  EXPECT_NEAR(parabola.Length(), 0.5 * std::sqrt(5.0) + 0.25 * std::asinh(2.0), kRounding);
  EXPECT_NEAR(parabola.Project({0.0, 0.2}).curvature, 2.0, kRounding);
  EXPECT_NEAR(parabola.Project({0.0, 0.2}).gap, 0.2, kRounding);
}

// Behind a sharp bend the speed changes by orders of magnitude, and the quadrature has to follow it.
TEST(CubicPiece, ArcLengthIsExactWhereTheSpeedNearlyVanishes) {
  const double small = 1e-3;  // y' = small, x' = tau - 1/2
  const CubicPiece bend({0.0, 0.0}, {-0.5, small}, {0.5, 0.0}, {0.0, 0.0});
  const double a = 0.5;
  EXPECT_NEAR(bend.Length(), a * std::hypot(a, small) + small * small * std::asinh(a / small), 1e-15);
}

}  // namespace
}  // namespace contact_path::curve_test
