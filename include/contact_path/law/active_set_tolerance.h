// When a limit counts as zero: weakly active.
#ifndef CONTACT_PATH_LAW_ACTIVE_SET_TOLERANCE_H_
#define CONTACT_PATH_LAW_ACTIVE_SET_TOLERANCE_H_

#include <algorithm>
#include <cmath>

#include "contact_path/tolerances.h"

namespace contact_path {

// Scaled values up to which motions, and forces and margins of forces, count as zero. Points are exact to about 1e-14,
// next to singular ones to about 1e-10.
struct ActiveSetTolerance {
  double motion = tolerances::kActive;
  double force = tolerances::kActive;

  // Of forces in a unit. Above 1 the unit is what rounding of coordinates makes of them: where a limit is located, its
  // value is zero to kResidual units, and counts as zero.
  double ForceOf(double unit) const {
    return unit * (unit > 1.0 ? std::max(force, 2.0 * tolerances::kResidual) : force);
  }

  // Where the forces of the path are far below the characteristic force, as in soft parts beside stiff ones, the
  // tolerance follows the forces down to rounding. largest_force: of the path so far; load_factor: now, for the
  // rounding that its loads leave. Both scaled.
  static ActiveSetTolerance For(double largest_force, double load_factor) {
    ActiveSetTolerance tolerance;
    const double rounding = tolerances::kRounding * std::max(1.0, std::abs(load_factor));
    tolerance.force =
        std::min(tolerance.force, std::max(tolerances::kActiveShareOfReactions * largest_force, rounding));
    return tolerance;
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_ACTIVE_SET_TOLERANCE_H_
