#ifndef CONTACT_PATH_STABILITY_JUMP_H_
#define CONTACT_PATH_STABILITY_JUMP_H_
#include <Eigen/Core>
#include <functional>
#include <optional>
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/stability/device.h"
namespace contact_path {
struct Landing {
  PathPoint point;
  double friction = 0.0, loads = 0.0, stored = 0.0;
  double energy_released() const { return loads - friction - stored; }
};
struct JumpResult {
  std::optional<Landing> landing;
  bool robust = false;
  double followed = 0.0;
  bool came_back = false;
  bool cancelled = false;
};
inline JumpResult Jump(const Structure&, const ContactPairs&, const PathPoint&, const Eigen::VectorXd&, const Device&,
                const std::function<bool()>&) { return {}; }
}  // namespace contact_path
#endif
