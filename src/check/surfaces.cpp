#include "check/surfaces.h"

namespace contact_path::check {
namespace {

// n . (x - p) >= 0.
class HalfPlane : public Surface {
 public:
  explicit HalfPlane(const Obstacle& obstacle) : point_{obstacle.px, obstacle.py} {
    const Vector along{obstacle.nx, obstacle.ny};
    const Real length = Length(along);
    normal_ = {along.x / length, along.y / length};
    tangent_ = {normal_.y, -normal_.x};
  }

  Real Gap(const Vector& x) const override { return Dot(normal_, x - point_); }
  Vector Normal(const Vector&) const override { return normal_; }
  Real Slip(const Vector& from, const Vector& to) const override { return Dot(tangent_, to - from); }

 private:
  Vector point_, normal_, tangent_;
};

}  // namespace

std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane: break;
  }
  return std::make_unique<HalfPlane>(obstacle);
}

}  // namespace contact_path::check
