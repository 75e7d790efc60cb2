#include "contact_path/geometry/rolled_span.h"

#include <algorithm>
#include <cmath>

#include "contact_path/geometry/plane.h"

namespace contact_path {

RolledSpan::RolledSpan(double rho_1, double rho_2, const Eigen::Vector2d& start, double arcs)
    : delta_(rho_2 - rho_1), arcs_(arcs) {
  direction_ = start.normalized();  // where delta is 0
  direction_ = Of(start, 0.0).tangent.normalized();
}

RolledSpan::At RolledSpan::Of(const Eigen::Vector2d& d, double least) const {
  if (delta_ == 0.0) return {d, arcs_};
  const double square = d.squaredNorm(), free = std::max(square - delta_ * delta_, least * least),
               length = std::sqrt(free);
  // d turned by -asin(delta / |d|)
  const Eigen::Vector2d tangent = length / square * (length * d - delta_ * LeftOf(d));
  return {tangent, arcs_ - delta_ * Turned(tangent)};
}

Eigen::Vector2d RolledSpan::TangentChange(const Eigen::Vector2d& tangent, const Eigen::Vector2d& v) const {
  if (delta_ == 0.0) return v;
  const double length = tangent.norm();
  const Eigen::Vector2d along = tangent / length, across = LeftOf(along);
  const double turn = across.dot(v);  // times l
  return (along.dot(v) + delta_ / length * turn) * along + turn * across;
}

double RolledSpan::Turned(const Eigen::Vector2d& tangent) const {
  return std::atan2(Cross(direction_, tangent), direction_.dot(tangent));
}

}  // namespace contact_path
