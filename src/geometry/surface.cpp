#include "contact_path/geometry/surface.h"

#include <cmath>

namespace contact_path {

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
