// When an inequality counts as zero: weakly active.
#ifndef CONTACT_PATH_BRANCH_ACTIVE_SET_TOLERANCE_H_
#define CONTACT_PATH_BRANCH_ACTIVE_SET_TOLERANCE_H_

#include <algorithm>
#include <cmath>

#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// Scaled values up to which gaps, and reactions and margins to the friction cone, count as zero. Points are exact to
// about 1e-14, next to singular ones to about 1e-10.
struct ActiveSetTolerance {
  double gap = tolerances::kActive;
  double force = tolerances::kActive;

  // Where the reactions of the path are far below the characteristic force, as in soft parts beside stiff ones, the
  // tolerance follows the reactions down to rounding. largest_reaction: of the path so far; load_factor: now, for the
  // rounding that its loads leave. Both scaled.
  static ActiveSetTolerance For(double largest_reaction, double load_factor) {
    ActiveSetTolerance tolerance;
    const double rounding = tolerances::kRounding * std::max(1.0, std::abs(load_factor));
    tolerance.force =
        std::min(tolerance.force, std::max(tolerances::kActiveShareOfReactions * largest_reaction, rounding));
    return tolerance;
  }
};

// Whether the rate of the constraint counts at x. The slip rate always does.
inline bool IsWeaklyActive(const FixedStateSystem& system, const Constraint& constraint, const Eigen::VectorXd& x,
                           const ActiveSetTolerance& tolerance) {
  if (constraint.inequality == Inequality::kSlip) return true;
  const double largest = IsMotion(constraint.inequality) ? tolerance.gap : tolerance.force;
  return system.Value(constraint, x) <= largest * system.UnitOf(constraint);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_ACTIVE_SET_TOLERANCE_H_
