// Points along surfaces, for pictures.
#ifndef CONTACT_PATH_GEOMETRY_OUTLINE_H_
#define CONTACT_PATH_GEOMETRY_OUTLINE_H_

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "contact_path/geometry/surface.h"

namespace contact_path {

struct OutlinePoint {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  // of length 1, towards the admissible side
  double xi = 0.0;                                   // arc coordinate [length]
};

struct OutlineSteps {
  int parts = 32;  // of a patch that is bent, of equal length, >= 1
  // Largest turn from point to point [rad], > 0: parts that turn by more are divided evenly.
  double turn = std::numeric_limits<double>::infinity();
};

// The points of a curve of finite length, in the order of xi; a straight patch has its ends alone. A closed curve ends
// where it begins.
std::vector<OutlinePoint> Outline(const Surface& surface, const OutlineSteps& steps);

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_OUTLINE_H_
