#include "contact_path/scene/can_slide.h"

#include <cmath>

#include "contact_path/tolerances.h"

namespace contact_path {

bool CanSlide(bool x_moves, bool y_moves, const Obstacle& obstacle, bool turns) {
  if (turns || obstacle.shape != ObstacleShape::kHalfPlane) return x_moves || y_moves;        // its tangent turns
  const double share = std::hypot(x_moves ? obstacle.ny : 0.0, y_moves ? obstacle.nx : 0.0);  // t = (n_y, -n_x)
  return share > tolerances::kEqual * std::hypot(obstacle.nx, obstacle.ny);
}

}  // namespace contact_path
