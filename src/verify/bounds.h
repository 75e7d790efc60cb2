// What rounding leaves of quantities that are recorded or computed anew.
#ifndef CONTACT_PATH_SRC_VERIFY_BOUNDS_H_
#define CONTACT_PATH_SRC_VERIFY_BOUNDS_H_

#include <algorithm>

namespace contact_path {

inline constexpr double kExact = 1e-9;      // residuals of an exact increment, and all that is located, scaled
inline constexpr double kRecorded = 1e-11;  // recorded numbers against those computed anew, scaled
// A place that forces tell to second order, as next to a singular point, or against soft parts, scaled.
inline constexpr double kSingular = 1e-7;
// Of the force of a part for a motion of L: residuals and reactions are measured in no less, and the rounding of
// coordinates makes so much of it.
inline constexpr double kStiff = 1e-4;
inline constexpr double kRoundingOfParts = 1e-14;

// Over F: what residuals are measured in. stiffest: force of the stiffest node for a motion of L, over F.
inline double ResidualUnit(double stiffest) { return std::max(1.0, kStiff * stiffest); }

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_BOUNDS_H_
