// Work and dissipation between two increments, computed anew from their states alone.
#ifndef CONTACT_PATH_SRC_VERIFY_TRAPEZOID_WORK_H_
#define CONTACT_PATH_SRC_VERIFY_TRAPEZOID_WORK_H_

#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "verify/verified_contacts.h"

namespace contact_path {

// The scene of a stage, and what is known of it.
struct VerifiedStage {
  const Scene& scene;
  const SceneIndex& index;
  const ResidualCheck& check;
  const Scaling& scaling;
  const std::vector<VerifiedContact>& contacts;
  bool total_law;  // of friction
  bool located;    // increments end where contacts change their states
};

// All over F L.
struct TrapezoidWork {
  double work = 0.0;         // of loads, moving supports and obstacles
  double dissipation = 0.0;  // by the total law of friction work against it, of either sign
  double open_work = 0.0;    // what the trapezoid leaves open of the work, to either side
  double open_dissipation = 0.0;
};

// Work by the trapezoidal rule: the mean of two products of the motion, with the force at the begin and with the force
// at the end. open_work and open_dissipation bound the error of the rule: half the difference of both products, what
// forces may bend inside the increment, and a force that first goes on as it changed from `earlier` to `before`.
// earlier: may be null. All increments must have positions and contacts.
TrapezoidWork WorkBetween(const VerifiedStage& stage, const Increment* earlier, const Increment& before,
                          const Increment& increment);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_TRAPEZOID_WORK_H_
