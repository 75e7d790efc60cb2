// The machine that loads the structure.
#ifndef CONTACT_PATH_STABILITY_MACHINE_H_
#define CONTACT_PATH_STABILITY_MACHINE_H_

#include <Eigen/Core>
#include <cmath>

#include "contact_path/structure/structure.h"

namespace contact_path {

// s = k (Q - f . u): f the reference load, Q the setting of the machine. Scaled.
struct Machine {
  // k >= 0. 0: dead loads, s stays with the setting. Infinite: f . u does.
  double stiffness = 0.0;

  bool IsDead() const { return stiffness == 0.0; }
  double Compliance() const { return 1.0 / stiffness; }
  // row . (u, s) is the setting times a number > 0, NumDofs() + 1 entries: with the displacement in units in which f
  // has norm 1, k becomes k |f|.
  Eigen::VectorXd Row(const Structure& structure) const {
    const Eigen::Index nd = structure.NumDofs();
    Eigen::VectorXd row = Eigen::VectorXd::Unit(nd + 1, nd);
    const double size = structure.Loads().Reference().norm(), k = stiffness * size;
    if (!(k > 0.0)) return row;
    row[nd] = std::isinf(k) ? 0.0 : 1.0 / (1.0 + k);
    row.head(nd) = (std::isinf(k) ? 1.0 : k / (1.0 + k)) / size * structure.Loads().Reference();
    return row;
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_MACHINE_H_
