// Work of friction and of the loads along a jump.
#ifndef CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_
#define CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/structure/structure.h"
#include "stability/motion_step.h"

namespace contact_path {

// Work along a way so far.
struct Work {
  explicit Work(std::size_t contacts) : slides(contacts) {}

  // Of a candidate that slides.
  struct Slide {
    double slope = 0.0;   // how its friction force has fallen with its slip in the last step
    double length = 0.0;  // its slip in the last step, if that is a line of which both ends are known; else 0
    // Slip since it has closed, or another has, for which the force at its end alone is known, or none. Drag makes
    // reactions of an impact there; the curve through those behind it leads back.
    double owed = 0.0;
    // What was owed behind the last step, of which nothing of how the curve bends has been counted.
    std::optional<double> behind;
  };
  double friction = 0.0, loads = 0.0;
  std::vector<Slide> slides;
  bool after_impact = false;
};

// Of friction by a parabola through the force at the ends of two steps, of loads, which are linear, by the trapezoidal
// rule. What moves with s does no work: the setting rests, and a machine drives nothing but loads.
class WorkOfMotion {
 public:
  // Both must outlive the rule.
  WorkOfMotion(const Structure& structure, const ContactPairs& contacts) : structure_(structure), contacts_(contacts) {}

  // pushed: the step has the disturbance; drag makes reactions of it as of an impact.
  void Add(const PathPoint& from, const MotionStep& step, bool pushed, Work* work) const;

 private:
  double OfContact(std::size_t i, const PathPoint& from, const MotionStep& step, bool impact, Work* work) const;

  const Structure& structure_;
  const ContactPairs& contacts_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_
