#include "contact_path/geometry/outline.h"

#include <algorithm>
#include <cmath>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

double TurnBetween(const Vector2d& a, const Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

}  // namespace

std::vector<OutlinePoint> Outline(const Surface& surface, const XiRange& range, const OutlineSteps& steps) {
  const XiRange whole = surface.Range();
  const double length = whole.end - whole.begin;
  int patch = 0;
  while (surface.HasPatch(patch - 1) && surface.RangeOf(patch).begin > range.begin) --patch;
  while (surface.HasPatch(patch + 1) && surface.RangeOf(patch).end <= range.begin) ++patch;
  const auto point_at = [&](double xi) {
    const double before = surface.Closed() ? std::floor((xi - whole.begin) / length) * length : 0.0;  // whole rounds
    const Vector2d place = surface.PointAt(xi - before);
    return OutlinePoint{place, surface.Project(place, patch).normal, xi};
  };
  std::vector<OutlinePoint> points;
  for (; surface.HasPatch(patch) && surface.RangeOf(patch).begin < range.end; ++patch) {
    const XiRange own = surface.RangeOf(patch);
    const double begin = std::max(own.begin, range.begin), end = std::min(own.end, range.end);
    if (!(end - begin > (std::isfinite(length) ? tolerances::kNoMove * length : 0.0))) continue;
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
