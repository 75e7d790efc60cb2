// Vectors of the plane.
#ifndef CONTACT_PATH_GEOMETRY_PLANE_H_
#define CONTACT_PATH_GEOMETRY_PLANE_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace contact_path {

// a_x b_y - a_y b_x: > 0 where b is on the left of a.
inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// A vector turned by a right angle to the left.
inline Eigen::Vector2d LeftOf(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

// Whether x is inside; a corner is not.
inline bool IsInside(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& x) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if (a == x) return false;
    if ((a.y() > x.y()) == (b.y() > x.y())) continue;
    // Where the edge crosses the ray from x along the axis x.
    const double crossing = a.x() + (b.x() - a.x()) * ((x.y() - a.y()) / (b.y() - a.y()));
    if (crossing > x.x()) inside = !inside;
  }
  return inside;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_PLANE_H_
