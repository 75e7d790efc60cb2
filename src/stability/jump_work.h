// Work of friction and of the loads along a jump.
#ifndef CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_
#define CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_

#include <cstddef>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/structure/structure.h"
#include "stability/motion_step.h"

namespace contact_path {

// Work along a way so far.
struct Work {
  explicit Work(std::size_t contacts) : slopes(contacts, 0.0), owed(contacts, 0.0) {}

  double friction = 0.0, loads = 0.0;
  std::vector<double> slopes;  // by candidate: how its friction force has fallen with its slip
  // By candidate: slip since it has closed, or another has, for which the force at its end alone is known, or none.
  // Drag makes reactions of an impact there; the line through those behind it leads back.
  std::vector<double> owed;
  bool after_impact = false;
};

// By the trapezoidal rule.
class WorkOfMotion {
 public:
  // Both must outlive the rule.
  WorkOfMotion(const Structure& structure, const ContactPairs& contacts)
      : structure_(structure), contacts_(contacts), driving_(structure, contacts) {}

  // pushed: the step has the disturbance; drag makes reactions of it as of an impact.
  void Add(const PathPoint& from, const MotionStep& step, bool pushed, Work* work);

 private:
  double OfContact(std::size_t i, const PathPoint& from, const MotionStep& step, bool impact, Work* work) const;
  // Of moving supports and obstacles, along their motion with s.
  double DrivingForce(const PathPoint& at);

  const Structure& structure_;
  const ContactPairs& contacts_;
  FixedStateSystem driving_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_STABILITY_JUMP_WORK_H_
