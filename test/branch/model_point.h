// From the rows of a path back to what the solvers work on.
#ifndef CONTACT_PATH_TEST_BRANCH_MODEL_POINT_H_
#define CONTACT_PATH_TEST_BRANCH_MODEL_POINT_H_

#include <cstddef>
#include <vector>

#include "contact_path/contact/path_point.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/model.h"

namespace contact_path {

// The row as a point of the scaled model.
inline PathPoint PointOf(const Model& model, const Increment& row) {
  PathPoint point = model.InitialPoint();
  for (std::size_t i = 0; i < row.positions.size(); ++i) {
    const int dof = model.structure.Dof(static_cast<int>(i / 2), static_cast<int>(i % 2));
    if (dof >= 0) point.u[dof] = row.positions[i] / model.scaling.length;
  }
  point.s = row.load_factor / model.scaling.load_factor;
  for (std::size_t i = 0; i < row.contacts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    point.rn[k] = row.contacts[i].rn / model.scaling.force;
    point.rt[k] = row.contacts[i].rt / model.scaling.force;
    point.states[i] = row.contacts[i].state;
  }
  return point;
}

inline Model MakeModel(const Scene& scene) { return {scene, CharacteristicScales(scene)}; }

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_BRANCH_MODEL_POINT_H_
