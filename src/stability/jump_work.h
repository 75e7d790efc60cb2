// Work of the laws and of the loads along a jump.
#ifndef CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_
#define CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/law/laws.h"
#include "contact_path/structure/structure.h"
#include "stability/motion_step.h"

namespace contact_path {

// Work along a way so far.
struct Work {
  explicit Work(const Laws& laws) : slides(static_cast<std::size_t>(laws.NumPorts())) {}

  // Of a port that follows.
  struct Slide {
    double slope = 0.0;   // how its force has fallen with its travel in the last step
    double length = 0.0;  // its travel in the last step, if that is a line of which both ends are known; else 0
    // Travel since its law has begun to act, or another has, for which the force at its end alone is known, or none.
    // Drag makes reactions of an impact there; the curve through those behind it leads back.
    double owed = 0.0;
    // What was owed behind the last step, of which nothing of how the curve bends has been counted.
    std::optional<double> behind;
  };
  double dissipation = 0.0, loads = 0.0;
  std::vector<Slide> slides;  // by port
  bool after_impact = false;
};

// Adds the work of a step. Of what slides by a parabola through the force at the ends of two steps, of loads, which are
// linear, by the trapezoidal rule. What moves with s does no work: the setting rests, and a machine drives nothing but
// loads. pushed: the step has the disturbance; drag makes reactions of it as of an impact.
void AddWork(const Structure& structure, const Laws& laws, const PathPoint& from, const MotionStep& step, bool pushed,
             Work* work);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_
