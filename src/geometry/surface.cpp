#include "contact_path/geometry/surface.h"

#include <cmath>

namespace contact_path {

int PatchBeside(const Surface& surface, const Eigen::Vector2d& x) {
  const NearestFoot nearest = surface.Nearest(x);
  if (nearest.is_away) return surface.NumPatches() + 1;
  if (!nearest.is_end) return nearest.patch;
  const int before = nearest.patch - 1, after = nearest.patch + 1;
  if (surface.HasPatch(after)) return before;
  if (surface.HasPatch(before)) return after;
  const XiRange range = surface.RangeOf(nearest.patch);
  return surface.Project(x, nearest.patch).xi < 0.5 * (range.begin + range.end) ? before : after;
}

int PatchBeside(const Surface& surface, const Eigen::Vector2d& x, int from) {
  const int patch = PatchBeside(surface, x);
  if (!surface.Closed() || patch == from) return patch;
  const int round = surface.NumPatches();
  const double length = surface.RangeOf(round).begin - surface.RangeOf(0).begin;
  // By xi, and not by the numbers: of a circle, the patches before and after one are the same place.
  double xi = surface.Project(x, from).xi;
  const XiRange range = surface.RangeOf(from);
  if (!std::isfinite(xi)) xi = 0.5 * (range.begin + range.end);
  return patch + round * static_cast<int>(std::lround((xi - surface.Project(x, patch).xi) / length));
}

XiRange RangeBeside(const Surface& surface, int patch) {
  if (surface.HasPatch(patch)) return surface.RangeOf(patch);
  XiRange range;
  if (surface.HasPatch(patch - 1)) range.begin = surface.RangeOf(patch - 1).end;
  if (surface.HasPatch(patch + 1)) range.end = surface.RangeOf(patch + 1).begin;
  return range;
}

double GapBeside(const Surface& surface, const Eigen::Vector2d& x, int patch) {
  return surface.HasPatch(patch) ? surface.Project(x, patch).gap : surface.Nearest(x).distance;
}

HalfPlane::HalfPlane(const Eigen::Vector2d& point, const Eigen::Vector2d& normal)
    : normal_(normal / std::hypot(normal.x(), normal.y())),
      offset_(normal_.x() * point.x() + normal_.y() * point.y()) {}

NearestFoot HalfPlane::Nearest(const Eigen::Vector2d& x) const { return {0, std::abs(Project(x, 0).gap), false}; }

Projection HalfPlane::Project(const Eigen::Vector2d& x, int /*patch*/) const {
  Projection projection;
  projection.normal = normal_;
  projection.gap = normal_.x() * x.x() + normal_.y() * x.y() - offset_;
  projection.xi = normal_.y() * x.x() - normal_.x() * x.y();
  return projection;
}

}  // namespace contact_path
