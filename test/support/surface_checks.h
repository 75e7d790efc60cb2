// What every surface must keep, whatever its shape.
#ifndef CONTACT_PATH_TEST_SUPPORT_SURFACE_CHECKS_H_
#define CONTACT_PATH_TEST_SUPPORT_SURFACE_CHECKS_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact_path/geometry/curve.h"
#include "support/derivative_checker.h"

namespace contact_path {

// A point beside a patch: at `share` of its length, at the distance `gap` on the admissible side.
inline Eigen::Vector2d BesidePatch(const Curve& curve, int patch, double share, double gap) {
  const XiRange range = curve.RangeOf(patch);
  const Eigen::Vector2d foot = curve.PointAt(range.begin + share * (range.end - range.begin));
  return foot + gap * curve.Project(foot, patch).normal;
}

// The foot of points beside each patch is where they were put; the patch is found as the nearest one. gap: less than
// half of the distance between parts of the curve.
inline void ExpectFeet(const Curve& curve, double gap, double tolerance) {
  for (int patch = 0; patch < curve.NumPatches(); ++patch) {
    const XiRange range = curve.RangeOf(patch);
    for (const double share : {0.05, 0.4, 0.75, 0.95}) {
      for (const double side : {gap, 0.0, -gap}) {
        const Eigen::Vector2d x = BesidePatch(curve, patch, share, side);
        const Projection at = curve.Project(x, patch);
        EXPECT_NEAR(at.gap, side, tolerance);
        EXPECT_NEAR(at.xi, range.begin + share * (range.end - range.begin), tolerance);
        EXPECT_NEAR(at.normal.norm(), 1.0, tolerance);
        const NearestFoot nearest = curve.Nearest(x);
        EXPECT_EQ(nearest.patch, patch);
        EXPECT_NEAR(nearest.distance, std::abs(side), tolerance);
        EXPECT_FALSE(nearest.is_end);
        for (int near = 0; near < curve.NumPatches(); ++near) {
          const NearestFoot found = curve.NearestFrom(x, near);
          EXPECT_EQ(found.patch, nearest.patch);
          EXPECT_EQ(found.distance, nearest.distance);
        }
      }
    }
  }
}

// Patches meet in place and direction, with an arc coordinate that runs on; curvature: also in curvature.
inline void ExpectContinuity(const Curve& curve, bool curvature, double tolerance) {
  const int last = curve.Closed() ? 2 * curve.NumPatches() : curve.NumPatches() - 1;
  for (int patch = curve.Closed() ? -curve.NumPatches() : 0; patch < last; ++patch) {
    ASSERT_TRUE(curve.HasPatch(patch + 1));
    EXPECT_NEAR(curve.RangeOf(patch).end, curve.RangeOf(patch + 1).begin, tolerance);
    const int n = curve.NumPatches(), in_round = (patch % n + n) % n;
    const Eigen::Vector2d joint = BesidePatch(curve, in_round, 1.0, 0.0);
    const Projection before = curve.Project(joint, patch), after = curve.Project(joint, patch + 1);
    EXPECT_NEAR(before.gap, 0.0, tolerance);
    EXPECT_NEAR(after.gap, 0.0, tolerance);
    EXPECT_NEAR(before.xi, curve.RangeOf(patch).end, tolerance);
    EXPECT_NEAR(after.xi, before.xi, tolerance);
    EXPECT_NEAR((after.normal - before.normal).norm(), 0.0, tolerance);
    if (curvature) {
      EXPECT_NEAR(after.curvature, before.curvature, 100.0 * tolerance * (1.0 + std::abs(after.curvature)));
    }
  }
}

// xi is arc length, the normal turns as the curvature says, and its derivatives are those by xi. All derivatives of gap
// and xi by x follow from these, as projection_test shows; here they are held against differences once more.
inline void ExpectDerivatives(const Curve& curve, double gap, double step, double tolerance = kDerivativeTolerance) {
  for (int patch = 0; patch < curve.NumPatches(); ++patch) {
    const XiRange range = curve.RangeOf(patch);
    const double length = range.end - range.begin, middle = 0.5 * length + range.begin;
    const double h = std::min(step, 0.3 * length);
    const auto along = [&](const Eigen::VectorXd& xi) {
      const Eigen::Vector2d point = curve.PointAt(xi[0]);
      const Projection at = curve.Project(point, patch);
      Eigen::VectorXd values(6);
      values << point, at.normal, at.curvature, at.curvature_first;
      return values;
    };
    const Projection at = curve.Project(curve.PointAt(middle), patch);
    const Eigen::Vector2d t = TangentOf(at.normal);
    Eigen::VectorXd rates(6);
    rates << t, -at.curvature * t, at.curvature_first, at.curvature_second;
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Constant(1, middle), rates, tolerance, h)) << patch;

    const Eigen::Vector2d x = BesidePatch(curve, patch, 0.5, gap), v(0.8, -0.5);
    const auto project = [&](const Eigen::VectorXd& to) { return curve.Project(to, patch); };
    const auto values = [&](const Eigen::VectorXd& to) { return Eigen::Vector2d(project(to).gap, project(to).xi); };
    const auto gradients = [&](const Eigen::VectorXd& to) {
      Eigen::VectorXd both(4);
      both << project(to).normal, XiGradient(project(to));
      return both;
    };
    const auto hessians = [&](const Eigen::VectorXd& to) {
      Eigen::VectorXd both(8);
      both << Entries(GapHessian(project(x + to[0] * v))), Entries(XiHessian(project(x + to[0] * v)));
      return both;
    };
    const Projection beside = project(x);
    Eigen::Matrix2d first;
    first << beside.normal.transpose(), XiGradient(beside).transpose();
    Eigen::MatrixXd second(4, 2), third(8, 1);
    second << GapHessian(beside), XiHessian(beside);
    third << Entries(GapHessianChange(beside, v)), Entries(XiHessianChange(beside, v));
    EXPECT_TRUE(IsJacobian(values, x, first, tolerance, h)) << patch;
    EXPECT_TRUE(IsJacobian(gradients, x, second, tolerance, h)) << patch;
    EXPECT_TRUE(IsJacobian(hessians, Eigen::VectorXd::Zero(1), third, tolerance, h)) << patch;
  }
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_SURFACE_CHECKS_H_
