// From the increments of a path back to what the solvers work on.
#ifndef CONTACT_PATH_TEST_BRANCH_MODEL_POINT_H_
#define CONTACT_PATH_TEST_BRANCH_MODEL_POINT_H_

#include <cstddef>
#include <vector>

#include "contact_path/contact/path_point.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/model.h"

namespace contact_path {

// The increment as a point of the scaled model.
inline PathPoint PointOf(const Model& model, const Increment& increment) {
  PathPoint point = model.InitialPoint();
  for (std::size_t i = 0; i < increment.positions.size(); ++i) {
    const int dof = model.structure.Dof(static_cast<int>(i / 2), static_cast<int>(i % 2));
    if (dof >= 0) point.u[dof] = increment.positions[i] / model.scaling.length;
  }
  point.s = increment.load_factor / model.scaling.load_factor;
  for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    point.rn[k] = increment.contacts[i].rn / model.scaling.force;
    point.rt[k] = increment.contacts[i].rt / model.scaling.force;
    point.states[i] = increment.contacts[i].state;
  }
  return point;
}

inline Model MakeModel(const Scene& scene) { return {scene, CharacteristicScales(scene)}; }

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_BRANCH_MODEL_POINT_H_
