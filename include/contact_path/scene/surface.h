// Boundaries of rigid obstacles: where a point stands relative to one.
#ifndef CONTACT_PATH_SCENE_SURFACE_H_
#define CONTACT_PATH_SCENE_SURFACE_H_

#include <Eigen/Core>
#include <memory>
#include <string_view>

#include "contact_path/scene/scene.h"

namespace contact_path {

// The foot of a point x on a curve c(xi) of unit speed, x = c(xi) + gap n(xi). Along the curve the tangent t = c' and
// the normal n, on the left of t, turn by t' = curvature n and n' = -curvature t: a hollow has positive curvature, the
// outside of a disc negative curvature. Every derivative of gap and xi by x follows from these numbers.
struct Projection {
  double gap = 0.0;                                   // signed distance [length], >= 0 on the admissible side
  double xi = 0.0;                                    // arc coordinate of the foot [length]
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  // at the foot, towards the admissible side; t = (n_y, -n_x)
  double curvature = 0.0;                             // [1/length]
  double curvature_first = 0.0;                       // its derivatives by xi [1/length^2, 1/length^3]
  double curvature_second = 0.0;
};

// A smooth curve that bounds the admissible points.
class Surface {
 public:
  virtual ~Surface() = default;

  // Whether the curvature is zero everywhere: then gap and xi are affine in x.
  virtual bool Flat() const = 0;
  // x: as seen by the obstacle, before it has moved.
  virtual Projection Project(const Eigen::Vector2d& x) const = 0;
};

// Admissible side: n . (x - p) >= 0; xi = t . x.
class HalfPlane : public Surface {
 public:
  // normal: of any length > 0.
  HalfPlane(const Eigen::Vector2d& point, const Eigen::Vector2d& normal);

  bool Flat() const override { return true; }
  Projection Project(const Eigen::Vector2d& x) const override;

 private:
  Eigen::Vector2d normal_;
  double offset_;  // n . p
};

// A number that does not fit the shape of its obstacle.
struct ShapeFault {
  std::string_view field;  // of the obstacle; empty: there is no fault
  std::string_view rule;   // what must hold
};

// Of numbers that keep the rules of their fields.
ShapeFault FindShapeFault(const Obstacle& obstacle);

// The surface of an obstacle without a fault. An obstacle moves, and is placed, by its point (px, py).
std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SURFACE_H_
