// Vectors of the plane.
#ifndef CONTACT_PATH_GEOMETRY_PLANE_H_
#define CONTACT_PATH_GEOMETRY_PLANE_H_

#include <Eigen/Core>

namespace contact_path {

// a_x b_y - a_y b_x: > 0 where b is on the left of a.
inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// A vector turned by a right angle to the left.
inline Eigen::Vector2d LeftOf(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_PLANE_H_
