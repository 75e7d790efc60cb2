#include "contact_path/geometry/projection.h"

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

}  // namespace contact_path
