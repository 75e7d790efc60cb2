#include "contact_path/geometry/nodal_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/random.h"

namespace contact_path::nodal_spline_test {
namespace {

constexpr double kRounding = 1e-14;

Parabola ParabolaOf(const SplinePatch& patch, const std::vector<Eigen::Vector2d>& nodes) {
  std::array<Eigen::Vector2d, 3> places;
  for (std::size_t k = 0; k < 3; ++k)
    places[k] = patch.nodes[k] >= 0 ? nodes[static_cast<std::size_t>(patch.nodes[k])] : Eigen::Vector2d::Zero();
  return {patch, places};
}

std::vector<Eigen::Vector2d> RandomNodes(int count, Random* random) {
  std::vector<Eigen::Vector2d> nodes;
  for (int i = 0; i < count; ++i) nodes.emplace_back(0.5 * i + random->Number(-0.2, 0.2), random->Number(-0.3, 0.3));
  return nodes;
}

TEST(NodalSpline, TouchesItsEdgesInTheirMiddlesWithOneSlope) {
  Random random(1);
  for (const bool closed : {false, true})
    for (const int count : {2, 3, 5}) {
      if (closed && count == 2) continue;
      const std::vector<Eigen::Vector2d> nodes = RandomNodes(count, &random);
      const NodalSpline spline(count, closed);
      for (int i = 0; i + 1 < count || (closed && i < count); ++i) {
        const Eigen::Vector2d &a = nodes[static_cast<std::size_t>(i)],
                              &b = nodes[static_cast<std::size_t>((i + 1) % count)];
        const SplinePatch before = spline.Patch(i), after = spline.Patch(i + 1);
        const Parabola to = ParabolaOf(before, nodes), from = ParabolaOf(after, nodes);
        EXPECT_NEAR(before.knot + before.end, after.knot, kRounding);
        EXPECT_LE((to.At(before.end) - 0.5 * (a + b)).norm(), kRounding);
        EXPECT_LE((from.a - 0.5 * (a + b)).norm(), kRounding);
        EXPECT_LE((to.b + 2.0 * before.end * to.c - (b - a)).norm(), kRounding);
        EXPECT_LE((from.b - (b - a)).norm(), kRounding);
      }
      if (closed) continue;
      EXPECT_LE((ParabolaOf(spline.Patch(0), nodes).a - nodes.front()).norm(), kRounding);
      const SplinePatch last = spline.Patch(count - 1);
      EXPECT_LE((ParabolaOf(last, nodes).At(last.end) - nodes.back()).norm(), kRounding);
    }
}

// The half of a curve that is its own mirror image is the curve that ends on the axis.
TEST(NodalSpline, GoesOnAsItsMirrorImage) {
  Random random(3);
  std::vector<Eigen::Vector2d> half = RandomNodes(4, &random);
  std::vector<Eigen::Vector2d> whole(half.rbegin(), half.rend() - 1);
  for (Eigen::Vector2d& place : whole) place.x() = 2.0 * half[0].x() - place.x();
  whole.insert(whole.end(), half.begin(), half.end());
  const auto with_images = [](std::vector<Eigen::Vector2d> nodes, double axis) {
    const Eigen::Vector2d second = nodes[1], last_but_one = nodes[nodes.size() - 2];
    for (const Eigen::Vector2d& of : {second, last_but_one}) nodes.emplace_back(2.0 * axis - of.x(), of.y());
    return nodes;
  };
  const double axis = half[0].x();
  const NodalSpline of_whole(7, false), from(4, false, {true, false}), to(4, false, {false, true});
  const Parabola middle = ParabolaOf(of_whole.Patch(3), whole);
  const std::vector<Eigen::Vector2d> left(whole.begin(), whole.begin() + 4);
  const Parabola first = ParabolaOf(from.Patch(0), with_images(half, axis)),
                 last = ParabolaOf(to.Patch(3), with_images(left, axis));
  EXPECT_EQ(from.Patch(0).knot, 0.0);
  EXPECT_EQ(to.Patch(3).knot + to.Patch(3).end, 3.0);
  for (const double tau : {0.0, 0.2, 0.5}) {
    EXPECT_LE((first.At(tau) - middle.At(0.5 + tau)).norm(), kRounding);
    EXPECT_LE((last.At(tau) - middle.At(tau)).norm(), kRounding);
  }
  EXPECT_NEAR(first.b.y(), 0.0, kRounding);
}

// y = (tau, tau^2) is nearest to (0, 5) at tau^2 = 4.5, on both sides.
TEST(Parabola, FindsTheFootThatIsNearerToWhereItIsLookedFor) {
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Parabola curve(NodalSpline(3, true).Patch(1), {origin, origin, origin});
  curve.b = {1.0, 0.0};
  curve.c = {0.0, 1.0};
  const double infinity = std::numeric_limits<double>::infinity(), far = std::sqrt(4.5);
  const Eigen::Vector2d x(0.0, 5.0);
  EXPECT_NEAR(curve.FootOf(x, 0.0, 1.0), far, kRounding);
  EXPECT_NEAR(curve.FootOf(x, 1.0, infinity), far, kRounding);
  EXPECT_NEAR(curve.FootOf(x, -infinity, 0.0), -far, kRounding);
  EXPECT_NEAR(curve.FootOf({0.3, 0.4}, -infinity, 0.0), curve.FootOf({0.3, 0.4}, 0.0, 1.0), kRounding);  // the only one
}

TEST(NodalSpline, OfAClosedCurveAnyNumberIsAPatch) {
  const NodalSpline spline(4, true);
  for (const int patch : {-9, -1, 0, 3, 4, 11}) {
    EXPECT_EQ(spline.Patch(patch).knot, patch - 0.5);
    EXPECT_EQ(spline.Patch(patch).nodes, spline.Patch(spline.Within(patch)).nodes);
  }
  EXPECT_EQ(spline.Within(-9), 3);
  EXPECT_EQ(spline.Within(11), 3);
}

// Against the nearest of many points.
TEST(Parabola, FootIsWhereTheDistanceIsLeast) {
  Random random(2);
  const NodalSpline spline(3, false);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<Eigen::Vector2d> nodes = RandomNodes(3, &random);
    const SplinePatch patch = spline.Patch(1);
    const Parabola curve = ParabolaOf(patch, nodes);
    const Eigen::Vector2d x(random.Number(-0.2, 1.2), random.Number(-1.0, 1.0));
    const double foot = curve.FootOf(x, patch.begin, patch.end);
    EXPECT_NEAR((x - curve.At(foot)).dot(curve.b + 2.0 * foot * curve.c), 0.0, 1e-13);
    double least = std::numeric_limits<double>::infinity(), where = 0.0;
    for (int k = 0; k <= 1000; ++k) {
      const double tau = 1e-3 * k, distance = (x - curve.At(tau)).norm();
      if (distance < least) where = tau;
      least = std::min(least, distance);
    }
    if (where == 0.0 || where == 1.0) continue;
    ++inside;
    EXPECT_NEAR(foot, where, 1e-3);
    EXPECT_LE((x - curve.At(foot)).norm(), least + kRounding);
  }
  EXPECT_GT(inside, 100);
}

// Where three nodes are in line, and where the second edge is longer.
TEST(Parabola, FootOnAStraightLineIsExact) {
  const NodalSpline spline(3, false);
  for (const double length : {1.0, 3.0}) {
    const std::vector<Eigen::Vector2d> nodes = {{0.0, 0.0}, {1.0, 0.0}, {1.0 + length, 0.0}};
    for (const double x : {0.6, 1.0, 1.4}) {
      const SplinePatch patch = spline.Patch(1);
      const Parabola curve = ParabolaOf(patch, nodes);
      EXPECT_NEAR(curve.At(curve.FootOf({x, 0.7}, patch.begin, patch.end)).x(), x, kRounding);
    }
  }
}

}  // namespace
}  // namespace contact_path::nodal_spline_test
