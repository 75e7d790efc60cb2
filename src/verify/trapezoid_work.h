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
};

// All over F L.
struct TrapezoidWork {
  double work = 0.0;         // of loads, moving supports and obstacles
  double dissipation = 0.0;  // by the total law of friction work against it, of either sign
  double open_work = 0.0;    // what the trapezoid leaves open of the work, to either side
  double open_dissipation = 0.0;
};

// By trapezoids, which are in the middle between the products with the smallest and with the largest force. Where a
// path turns in between, as much again may be open; so may what a force of moving supports and obstacles does that
// goes on at first as it changed on the increment before, from `earlier` on, which may be null. All must have their
// state.
TrapezoidWork WorkBetween(const VerifiedStage& stage, const Increment* earlier, const Increment& before,
                          const Increment& increment);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_TRAPEZOID_WORK_H_
