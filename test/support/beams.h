// Beams of scenes that tests make.
#ifndef CONTACT_PATH_TEST_SUPPORT_BEAMS_H_
#define CONTACT_PATH_TEST_SUPPORT_BEAMS_H_

#include <cmath>
#include <string>

#include "contact_path/scene/scene.h"

namespace contact_path {

inline Beam Between(const std::string& name, const std::string& first, const std::string& second, double EA, double EI,
                    int segments, double angle = 0.0) {
  return {name, {first, second}, EA, EI, 0.0, segments, angle};
}

// H / V of a circular arch of this half angle without stretch whose ends are held, by linear theory
// (docs/cases/rough_arch.md).
inline double ThrustOfArch(double a) {
  const double s = std::sin(a), c = std::cos(a);
  return (s * s / 2.0 - a * s * c + c * (1.0 - c)) / (a / 2.0 + std::sin(2.0 * a) / 4.0 - 2.0 * s * c + a * c * c);
}

// An arch of the radius 1 and EI = 1 of two beams rests with both ends on a rough floor, and is loaded at its crown.
inline TraceRequest RestingArch(double half_angle, double friction, double EA, int segments) {
  TraceRequest request;
  const double x = std::sin(half_angle);
  request.scene.nodes = {{"left", -x, 0.0}, {"crown", 0.0, 1.0 - std::cos(half_angle), true}, {"right", x, 0.0}};
  request.scene.beams = {Between("l", "left", "crown", EA, 1.0, segments, -half_angle),
                         Between("r", "crown", "right", EA, 1.0, segments, -half_angle)};
  request.scene.loads = {{"crown", 0.0, -1.0}};
  request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  request.scene.contacts = {{"left", "floor"}, {"right", "floor"}};
  request.options.max_increments = 3;
  return request;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_BEAMS_H_
