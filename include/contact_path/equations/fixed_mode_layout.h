// Which unknowns and equations a fixed-mode system has, and where.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_MODE_LAYOUT_H_
#define CONTACT_PATH_EQUATIONS_FIXED_MODE_LAYOUT_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/equations/laws_in_modes.h"
#include "contact_path/equations/mode_limits.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// motion + compliance * force = 0.
struct MotionEquation {
  PortMotion motion;
  Eigen::Index equation;
  double compliance = 0.0;
  Eigen::Index force = -1;  // unknown; -1 where nothing gives way
  double told_by = 0.0;     // a small compliance that alone may tell the force: as here, or Law::ToldBy(); 0: none
};

// Unknowns: u, s, forces of the ports that are held, reactions of the prescribed components. Equations: equilibrium,
// motions of the ports that are held, prescribed components, active limits, load factor.
struct FixedModeLayout {
  FixedModeLayout() = default;
  FixedModeLayout(const Structure& structure, const LawsInModes& laws, const ModeLimits& limits,
                  std::vector<Limit> active, bool load_factor_fixed);

  std::vector<Limit> active;
  bool load_factor_fixed = false;
  std::vector<MotionEquation> motions;
  Eigen::Index first_support = 0;  // unknown: reaction of the first prescribed component
  Eigen::Index num_unknowns = 0;
  Eigen::Index first_support_equation = 0;
  Eigen::Index first_active_equation = 0;
  Eigen::Index num_equations = 0;
  // Of some of the laws in `motions`: as Law says of one; gives: small compliances alone tell their forces.
  bool curved = false, couples = false, gives = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_MODE_LAYOUT_H_
