// What the node is started with.
#ifndef CONTACT_PATH_ROS_NODE_PARAMETERS_H_
#define CONTACT_PATH_ROS_NODE_PARAMETERS_H_

#include <string>

#include <ros/node_handle.h>

#include "contact_path/ros/limits.h"

namespace contact_path {

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
