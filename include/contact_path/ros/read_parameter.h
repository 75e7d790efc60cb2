// Parameters of nodes.
#ifndef CONTACT_PATH_ROS_READ_PARAMETER_H_
#define CONTACT_PATH_ROS_READ_PARAMETER_H_

#include <stdexcept>
#include <string>

#include <ros/node_handle.h>

namespace contact_path {

// Leaves `value` as it is where the parameter is not set. Throws std::invalid_argument where it is not `type`, in
// words.
template <typename Value>
void ReadParameter(const ros::NodeHandle& private_node, const char* name, const char* type, Value* value) {
  if (private_node.hasParam(name) && !private_node.getParam(name, *value)) {
    throw std::invalid_argument("~" + std::string(name) + ": must be " + type);
  }
}

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_READ_PARAMETER_H_
