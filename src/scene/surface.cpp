#include "contact_path/scene/surface.h"

#include <cmath>

namespace contact_path {
namespace {

constexpr double kSmallest = 1e-100;  // length of a normal: what is formed of it stays in the range of double

}  // namespace

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
