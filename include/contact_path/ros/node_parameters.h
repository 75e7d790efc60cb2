// What the node is started with, and the limits of what it admits.
#ifndef CONTACT_PATH_ROS_NODE_PARAMETERS_H_
#define CONTACT_PATH_ROS_NODE_PARAMETERS_H_

#include <stdexcept>
#include <string>

#include <ros/node_handle.h>

#include "contact_path/ros/messages.h"

namespace contact_path {

// Limits of the requests, by their names in names.h.
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

// what() is one line naming what exceeds a limit, its value and the limit.
class LimitExceeded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws LimitExceeded. Allocates nothing that grows with the request.
void CheckLimits(const contact_path_msgs::TraceRequest& request, const TraceLimits& limits);

// Parameters of the node, by their names in names.h.
struct NodeParameters {
  std::string bag_directory = "~/.ros/contact_path";  // a leading ~ is the home directory; absolute once it is read
  int increments_queue = 100000;         // increments kept for a subscriber that is slower than they are sent, > 0
  int increments_megabytes = 256;        // of increments that wait for subscribers [MB], > 0
  double increments_per_second = 500.0;  // sent at most, >= 0; 0: no bound
  double increments_megabytes_per_second = 32.0;  // sent at most [MB/s], >= 0; 0: no bound
  TraceLimits limits;                             // max_nodes, max_elements, ..., keep_free_megabytes
};

// Throws std::invalid_argument naming the parameter that has a wrong type or value.
NodeParameters ReadParameters(const ros::NodeHandle& private_node);

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_NODE_PARAMETERS_H_
