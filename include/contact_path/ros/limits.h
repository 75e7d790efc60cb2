// What the node admits, so that one request cannot take the machine.
#ifndef CONTACT_PATH_ROS_LIMITS_H_
#define CONTACT_PATH_ROS_LIMITS_H_

#include <string>
#include <vector>

#include "contact_path/ros/messages.h"

namespace contact_path {

struct TraceLimits {
  int max_nodes = 100000;        // nodes, > 0
  int max_elements = 1000000;    // bars; entries of all stiffness matrices; loads; each > 0
  int max_contacts = 100000;     // contact candidates; obstacles; stop criteria; branch choices; each > 0
  int max_increments = 1000000;  // increments of a trace, > 0
  double max_seconds = 86400.0;  // wall time of a trace [s]; 0 = no limit
  int max_memory = 8192;         // of the node [MB], >= 0; 0 = no limit
  int keep_free = 16;            // on the file system of the bags [MB], > 0

  // Throws std::invalid_argument naming the parameter and its value.
  void Validate() const;
};

// One line naming what exceeds a limit, its value and the limit; empty where all is admitted. Allocates nothing that
// grows with the request.
std::string ExceededLimit(const contact_path_msgs::Scene& scene, const contact_path_msgs::TraceOptions& options,
                          const std::vector<contact_path_msgs::Stage>& program, const TraceLimits& limits);

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_LIMITS_H_
