// The boundaries of the rigid obstacles of a scene, and whether friction can act along them.
#ifndef CONTACT_PATH_SCENE_SURFACE_H_
#define CONTACT_PATH_SCENE_SURFACE_H_

#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "contact_path/geometry/surface.h"
#include "contact_path/scene/scene.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// What does not fit the shape of its obstacle.
struct ShapeFault {
  std::string_view field;  // of the obstacle; empty: there is no fault
  std::string rule;        // what must hold
  std::string value;       // that breaks it
};

// Of numbers that keep the rules of their fields.
ShapeFault FindShapeFault(const Obstacle& obstacle);

// The surface of an obstacle without a fault. An obstacle is placed by its point (px, py). A surface that is not flat
// has a finite length, so that it can be drawn. radius: of a circle that rolls or slides on it [length]: the surface is
// that on which its centre moves, at this distance. The circle fits: FindMisfit().
std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle, double radius = 0.0);

// Which rule a circle of this radius breaks, since it cannot reach the bottom of a hollow of the obstacle, which has no
// fault; empty: it fits.
std::string FindMisfit(const Obstacle& obstacle, double radius);

// Whether a node can move along an obstacle: one of its components that move, being free or moved as a support, has a
// share in the tangent by more than rounding. A contact that cannot slide is frictionless, whatever its coefficient.
// turns: the obstacle does, and its tangent with it.
inline bool CanSlide(bool x_moves, bool y_moves, const Obstacle& obstacle, bool turns = false) {
  if (turns || obstacle.shape != ObstacleShape::kHalfPlane) return x_moves || y_moves;        // its tangent turns
  const double share = std::hypot(x_moves ? obstacle.ny : 0.0, y_moves ? obstacle.nx : 0.0);  // t = (n_y, -n_x)
  return share > tolerances::kEqual * std::hypot(obstacle.nx, obstacle.ny);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SURFACE_H_
