#include "contact_path/geometry/surface.h"

#include <cmath>

namespace contact_path {
namespace {

struct PlaneDerivatives {
  explicit PlaneDerivatives(const Projection& at)
      : n(at.normal), t(TangentOf(at.normal)), m(1.0 - at.curvature * at.gap) {}

  Eigen::Vector2d n, t;
  double m;
};

// Along x + h v the foot moves by dxi = t . v / m and the gap by n . v; the frame turns by k dxi.
struct Change {
  Change(const Projection& at, const Eigen::Vector2d& v) {
    const PlaneDerivatives d(at);
    const double dxi = d.t.dot(v) / d.m;
    gap = d.n.dot(v);
    curvature = at.curvature_first * dxi;
    curvature_first = at.curvature_second * dxi;
    m = -curvature * at.gap - at.curvature * gap;
    t = at.curvature * dxi * d.n;
    n = -at.curvature * dxi * d.t;
  }

  double gap, curvature, curvature_first, m;
  Eigen::Vector2d t, n;
};

Eigen::Matrix2d Symmetric(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a * b.transpose() + b * a.transpose();
}

// In the first round.
int PatchNearest(const Surface& surface, const Eigen::Vector2d& x) {
  const NearestFoot nearest = surface.Nearest(x);
  if (nearest.is_away) return surface.NumPatches() + 1;
  if (!nearest.is_end) return nearest.patch;
  const int before = nearest.patch - 1, after = nearest.patch + 1;
  if (surface.HasPatch(after)) return before;
  if (surface.HasPatch(before)) return after;
  const XiRange range = surface.RangeOf(nearest.patch);
  return surface.Project(x, nearest.patch).xi < 0.5 * (range.begin + range.end) ? before : after;
}

}  // namespace

Eigen::Vector2d XiGradient(const Projection& at) {
  const PlaneDerivatives d(at);
  return d.t / d.m;
}

Eigen::Matrix2d GapHessian(const Projection& at) {
  const PlaneDerivatives d(at);
  return -at.curvature / d.m * d.t * d.t.transpose();
}

Eigen::Matrix2d XiHessian(const Projection& at) {
  const PlaneDerivatives d(at);
  return at.curvature / (d.m * d.m) * Symmetric(d.n, d.t) +
         at.curvature_first * at.gap / (d.m * d.m * d.m) * d.t * d.t.transpose();
}

Eigen::Matrix2d GapHessianChange(const Projection& at, const Eigen::Vector2d& v) {
  const PlaneDerivatives d(at);
  const Change change(at, v);
  const double factor = -(change.curvature - at.curvature * change.m / d.m) / d.m;
  return factor * d.t * d.t.transpose() - at.curvature / d.m * Symmetric(change.t, d.t);
}

Eigen::Matrix2d XiHessianChange(const Projection& at, const Eigen::Vector2d& v) {
  const PlaneDerivatives d(at);
  const Change change(at, v);
  const double m2 = d.m * d.m, m3 = m2 * d.m;
  const double mixed = at.curvature / m2, mixed_change = change.curvature / m2 - 2.0 * mixed * change.m / d.m;
  const double bend = at.curvature_first * at.gap / m3;
  const double bend_change =
      (change.curvature_first * at.gap + at.curvature_first * change.gap) / m3 - 3.0 * bend * change.m / d.m;
  return mixed_change * Symmetric(d.n, d.t) + mixed * (Symmetric(change.n, d.t) + Symmetric(d.n, change.t)) +
         bend_change * d.t * d.t.transpose() + bend * Symmetric(change.t, d.t);
}

int PatchBeside(const Surface& surface, const Eigen::Vector2d& x, int from) {
  const int patch = PatchNearest(surface, x);
  if (!surface.Closed() || patch == from || from == kNearestPatch) return patch;
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

Projection HalfPlane::Project(const Eigen::Vector2d& x, int /*patch*/) const {
  Projection projection;
  projection.normal = normal_;
  projection.gap = normal_.x() * x.x() + normal_.y() * x.y() - offset_;
  projection.xi = normal_.y() * x.x() - normal_.x() * x.y();
  return projection;
}

}  // namespace contact_path
