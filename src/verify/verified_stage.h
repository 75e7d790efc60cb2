// The scene of a stage, and what the verification knows of it.
#ifndef CONTACT_PATH_SRC_VERIFY_VERIFIED_STAGE_H_
#define CONTACT_PATH_SRC_VERIFY_VERIFIED_STAGE_H_

#include <cstddef>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "verify/bounds.h"
#include "verify/verified_contacts.h"

namespace contact_path {

struct VerifiedStage {
  // index: of the scene of the request; of_program: the scales of the program; largest_load: the largest load factor
  // that the increments of the stage have.
  VerifiedStage(const TraceRequest& request, const SceneIndex& index, const Scaling& of_program, std::size_t stage,
                double largest_load);

  double Energy() const { return scaling.force * scaling.length; }  // characteristic [force length]

  bool Driven() const { return !scene.support_motions.empty() || !scene.obstacle_motions.empty(); }

  const SceneIndex& index;
  const Scene scene;
  const Configuration configuration;
  const Scaling scaling;
  const ResidualCheck check;
  const bool located;                     // increments end where contacts change their states
  std::vector<double> rates;              // x, y by node: of the fixed components [length], per unit of the load factor
  std::vector<double> turn_rates;         // by node: of the fixed rotations [rad], per unit of the load factor
  double rounding = 0.0;                  // of recorded motions over L, and of forces over F
  double stiffest = 0.0;                  // force of the stiffest node for a motion of L, over F
  std::vector<VerifiedContact> contacts;  // in the order of the scene
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_VERIFIED_STAGE_H_
