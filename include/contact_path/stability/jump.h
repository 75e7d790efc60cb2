// The motion of the structure from an equilibrium that is not held any more to the next equilibrium.
#ifndef CONTACT_PATH_STABILITY_JUMP_H_
#define CONTACT_PATH_STABILITY_JUMP_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "contact_path/law/laws.h"
#include "contact_path/stability/machine.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// What resists the motion. A node has one coefficient for all directions of its position, which makes velocities unique
// for every ratio of ports that follow.
enum class Drag {
  kUniform,    // C = 1 for every unknown
  kStiffness,  // C = the largest diagonal stiffness of the node at the start, over the largest of all nodes
  kInertia,    // mass 1 for every unknown, and light uniform drag
};

// Scaled. The work of the loads is stored, dissipated by what slides, and released: taken by drag.
struct Landing {
  // Newton's method has converged on the equations of equilibrium; it is stable under the machine, or where that is not
  // proved, small disturbances come back.
  PathPoint point;
  double dissipated = 0.0;  // by what slides along the way [force length]; unless a law is holonomic >= 0
  double loads = 0.0;       // of all loads, constant and scaled
  double stored = 0.0;      // strain energy gained

  double energy_released() const { return std::max(0.0, loads - dissipated - stored); }
};

struct JumpResult {
  std::optional<Landing> landing;                  // by Drag::kUniform
  std::array<std::optional<Landing>, 3> landings;  // by Drag; without a landing by kUniform, all are empty
  bool robust = false;                             // checked, and all three land on one equilibrium
  double largest_difference = 0.0;                 // of an unknown between any two landings that there are
  double followed = 0.0;   // largest distance of an unknown from the start on the way by Drag::kUniform
  bool came_back = false;  // pushed either way, the structure returns: it is held
  bool cancelled = false;
};

// push: the direction (u) in which the structure is disturbed, NumDofs(); its length does not matter. Both signs are
// tried, + first. checked: the other drags are tried, too.
JumpResult Jump(const Structure& structure, const Laws& laws, const PathPoint& from, const Eigen::VectorXd& push,
                const Machine& machine, bool checked, const std::function<bool()>& cancelled);

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_JUMP_H_
