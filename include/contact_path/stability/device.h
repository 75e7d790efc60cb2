// The machine that loads the structure.
#ifndef CONTACT_PATH_STABILITY_DEVICE_H_
#define CONTACT_PATH_STABILITY_DEVICE_H_

#include <Eigen/Core>
#include <cmath>

#include "contact_path/structure/structure.h"

namespace contact_path {

// s = k (Q - f . u): f the reference load, Q the setting of the machine. Scaled.
struct Device {
  // k >= 0. 0: dead loads, s stays with the setting. Infinite: f . u does.
  double stiffness = 0.0;

  // Where no load is scaled by s, as where supports or obstacles alone are moved, s is the setting whatever k is.
  static Device Of(const Structure& structure, double stiffness) {
    return {structure.ReferenceLoad().isZero(0.0) ? 0.0 : stiffness};
  }
  bool IsDead() const { return stiffness == 0.0; }
  double Compliance() const { return 1.0 / stiffness; }
  // Of the change of Q along a change (du, ds), the load factor last, or of a multiple > 0 of Q: a row.
  Eigen::VectorXd SettingRow(const Structure& structure) const {
    Eigen::VectorXd row = Eigen::VectorXd::Unit(structure.NumDofs() + 1, structure.NumDofs());
    if (IsDead()) return row;
    row *= Compliance();
    row.head(structure.NumDofs()) = structure.ReferenceLoad();
    return row;
  }
  double SettingRate(const Structure& structure, const Eigen::VectorXd& change) const {
    const Eigen::Index nd = structure.NumDofs();
    if (IsDead()) return change[nd];
    return structure.ReferenceLoad().dot(change.head(nd)) + Compliance() * change[nd];
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_DEVICE_H_
