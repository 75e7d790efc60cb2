// The boundaries of obstacles as the check sees them: written from their definitions (scene/scene.h), apart from
// scene/surface.h.
#ifndef CONTACT_PATH_SRC_CHECK_SURFACES_H_
#define CONTACT_PATH_SRC_CHECK_SURFACES_H_

#include <memory>

#include "check/plane.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// Points are as the obstacle sees them, before it has moved.
class Surface {
 public:
  virtual ~Surface() = default;

  // Signed distance [length], >= 0 on the admissible side.
  virtual Real Gap(const Vector& x) const = 0;
  // At the foot of x, of length 1, towards the admissible side. The tangent is t = (n_y, -n_x).
  virtual Vector Normal(const Vector& x) const = 0;
  // Length of the boundary between the feet of two points, along t [length].
  virtual Real Slip(const Vector& from, const Vector& to) const = 0;
  // True: Gap(x) > 0, told at once of most points that are far away. False tells nothing.
  virtual bool SurelyOpen(const Vector&) const { return false; }
};

// for_circles: at an end of an open curve the normal leads to the point, as the end is a corner for a circle about it.
std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle, bool for_circles = false);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_SURFACES_H_
