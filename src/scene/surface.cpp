#include "contact_path/scene/surface.h"

#include <cmath>

namespace contact_path {
namespace {

constexpr double kSmallest = 1e-100;  // length of a normal: what is formed of it stays in the range of double

}  // namespace

HalfPlane::HalfPlane(const Eigen::Vector2d& point, const Eigen::Vector2d& normal)
    : normal_(normal / std::hypot(normal.x(), normal.y())),
      offset_(normal_.x() * point.x() + normal_.y() * point.y()) {}

Projection HalfPlane::Project(const Eigen::Vector2d& x) const {
  Projection projection;
  projection.normal = normal_;
  projection.gap = normal_.x() * x.x() + normal_.y() * x.y() - offset_;
  projection.xi = normal_.y() * x.x() - normal_.x() * x.y();
  return projection;
}

ShapeFault FindShapeFault(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane:
      if (std::hypot(obstacle.nx, obstacle.ny) < kSmallest)  // false for a normal that is not finite
        return {"nx", "the normal (nx, ny) must not be zero (length at least 1e-100)"};
  }
  return {};
}

std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane: break;
  }
  return std::make_unique<HalfPlane>(Eigen::Vector2d(obstacle.px, obstacle.py),
                                     Eigen::Vector2d(obstacle.nx, obstacle.ny));
}

}  // namespace contact_path
