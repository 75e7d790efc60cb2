// The foot of a point on a curve of the plane, and what follows from it.
#ifndef CONTACT_PATH_GEOMETRY_PROJECTION_H_
#define CONTACT_PATH_GEOMETRY_PROJECTION_H_

#include <Eigen/Core>

namespace contact_path {

// The foot of a point x on a curve c(xi) of unit speed, x = c(xi) + gap n(xi). Along the curve the tangent t = c' and
// the normal n, on the left of t, turn by t' = curvature n and n' = -curvature t: a hollow has positive curvature, the
// outside of a disc negative curvature. Every derivative of gap and xi by x follows from these numbers. Not finite
// where a point has no foot, as the centre of a circle.
struct Projection {
  double gap = 0.0;                                   // signed distance [length], >= 0 on the admissible side
  double xi = 0.0;                                    // arc coordinate of the foot [length]
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  // at the foot, towards the admissible side; t = (n_y, -n_x)
  double curvature = 0.0;                             // [1/length]
  double curvature_first = 0.0;                       // its derivatives by xi [1/length^2, 1/length^3]
  double curvature_second = 0.0;
};

// Steps of Newton's method for a foot on one piece of a curve, at most.
inline constexpr int kFootIterations = 60;

// t of a normal n: n is on the left of t.
inline Eigen::Vector2d TangentOf(const Eigen::Vector2d& normal) { return {normal.y(), -normal.x()}; }

// Derivatives of gap and xi by x, with m = 1 - curvature gap and k, k' for the curvature and its derivative:
//   grad gap = n, grad xi = t / m, hess gap = -k t t' / m,
//   hess xi = (k / m^2) (n t' + t n') + (k' gap / m^3) t t'.
Eigen::Vector2d XiGradient(const Projection& at);
Eigen::Matrix2d GapHessian(const Projection& at);
Eigen::Matrix2d XiHessian(const Projection& at);
// d/dh of both Hessians along x + h v at h = 0.
Eigen::Matrix2d GapHessianChange(const Projection& at, const Eigen::Vector2d& v);
Eigen::Matrix2d XiHessianChange(const Projection& at, const Eigen::Vector2d& v);

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_PROJECTION_H_
