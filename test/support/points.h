// Points and frames for tests without a scene.
#ifndef CONTACT_PATH_TEST_SUPPORT_POINTS_H_
#define CONTACT_PATH_TEST_SUPPORT_POINTS_H_

#include <Eigen/Core>

#include "contact_path/structure/place.h"

namespace contact_path {

// A node with these dofs, or held where they are -1.
inline FixedPoint PointOfNode(int dof_x, int dof_y, const Eigen::Vector2d& held = Eigen::Vector2d::Zero()) {
  return {{{Coordinate{dof_x, held.x()}, Coordinate{dof_y, held.y()}}}};
}

// An obstacle that turns about a point by `turn` and moves by `velocity`, both per unit of the load factor.
inline MovingFrame MovedFrame(const Eigen::Vector2d& velocity, double turn = 0.0,
                              const Eigen::Vector2d& about = Eigen::Vector2d::Zero()) {
  return {{Coordinate{-1, 0.0, velocity.x()}, Coordinate{-1, 0.0, velocity.y()}}, {-1, 0.0, turn}, about, about};
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_POINTS_H_
