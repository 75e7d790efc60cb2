#include "contact_path/geometry/outline.h"

#include <algorithm>
#include <cmath>

#include "contact_path/geometry/plane.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

double TurnBetween(const Vector2d& a, const Vector2d& b) { return std::abs(std::atan2(Cross(a, b), a.dot(b))); }

}  // namespace

std::vector<OutlinePoint> Outline(const Surface& surface, const OutlineSteps& steps) {
  const XiRange whole = surface.Range();
  std::vector<OutlinePoint> points;
  for (int patch = 0; surface.HasPatch(patch) && surface.RangeOf(patch).begin < whole.end; ++patch) {
    const auto point_at = [&](double xi) {
      const Vector2d place = surface.PointAt(surface.Closed() && xi >= whole.end ? whole.begin : xi);
      return OutlinePoint{place, surface.Project(place, patch).normal, xi};
    };
    const double begin = surface.RangeOf(patch).begin, end = std::min(surface.RangeOf(patch).end, whole.end);
    if (!(end - begin > tolerances::kNoMove * (whole.end - whole.begin))) continue;
    OutlinePoint before = point_at(begin);
    if (points.empty()) points.push_back(before);
    const bool bent = point_at(0.5 * (begin + end)).normal != before.normal || point_at(end).normal != before.normal;
    const int parts = bent ? steps.parts : 1;
    for (int k = 1; k <= parts; ++k) {
      const OutlinePoint after = point_at(begin + (end - begin) * k / parts);
      const double divisions = std::max(1.0, std::ceil(TurnBetween(before.normal, after.normal) / steps.turn));
      for (double i = 1.0; i < divisions; ++i)
        points.push_back(point_at(before.xi + (after.xi - before.xi) * i / divisions));
      points.push_back(after);
      before = after;
    }
  }
  return points;
}

}  // namespace contact_path
