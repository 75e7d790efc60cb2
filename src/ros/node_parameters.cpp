#include "contact_path/ros/node_parameters.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

// Leaves `value` as it is where the parameter is not set. Throws std::invalid_argument where it is not `type`, in
// words.
template <typename Value>
void ReadParameter(const ros::NodeHandle& private_node, const char* name, const char* type, Value* value) {
  if (private_node.hasParam(name) && !private_node.getParam(name, *value)) {
    throw std::invalid_argument("~" + std::string(name) + ": must be " + type);
  }
}

// `path` with a leading ~ replaced by the home directory.
std::string ExpandHome(const std::string& path) {
  const char* const home = std::getenv("HOME");
  const bool at_home = path == "~" || path.rfind("~/", 0) == 0;
  return at_home && home != nullptr ? home + path.substr(1) : path;
}

void Require(bool holds, const std::string& name, const std::string& value, const std::string& rule) {
  if (!holds) throw std::invalid_argument("~" + name + " = " + value + ": must " + rule);
}

}  // namespace

NodeParameters ReadParameters(const ros::NodeHandle& private_node) {
  NodeParameters parameters;
  ReadParameter(private_node, names::kBagDirectory, "a string", &parameters.bag_directory);
  ReadParameter(private_node, names::kIncrementsQueue, "an integer", &parameters.increments_queue);
  ReadParameter(private_node, names::kIncrementsMegabytes, "an integer", &parameters.increments_megabytes);
  ReadParameter(private_node, names::kIncrementsPerSecond, "a number", &parameters.increments_per_second);
  ReadParameter(private_node, names::kIncrementsMegabytesPerSecond, "a number",
                &parameters.increments_megabytes_per_second);
  ReadParameter(private_node, names::kMaxNodes, "an integer", &parameters.limits.max_nodes);
  ReadParameter(private_node, names::kMaxElements, "an integer", &parameters.limits.max_elements);
  ReadParameter(private_node, names::kMaxContacts, "an integer", &parameters.limits.max_contacts);
  ReadParameter(private_node, names::kMaxIncrements, "an integer", &parameters.limits.max_increments);
  ReadParameter(private_node, names::kMaxSeconds, "a number", &parameters.limits.max_seconds);
  ReadParameter(private_node, names::kMaxMemory, "an integer", &parameters.limits.max_memory);
  ReadParameter(private_node, names::kKeepFree, "an integer", &parameters.limits.keep_free);

  Require(!parameters.bag_directory.empty(), names::kBagDirectory, "\"\"", "not be empty");
  parameters.bag_directory = std::filesystem::absolute(ExpandHome(parameters.bag_directory)).string();
  for (const auto& [name, value] : {std::pair(names::kIncrementsQueue, parameters.increments_queue),
                                    std::pair(names::kIncrementsMegabytes, parameters.increments_megabytes)})
    Require(value > 0, name, std::to_string(value), "be > 0");
  for (const auto& [name, value] :
       {std::pair(names::kIncrementsPerSecond, parameters.increments_per_second),
        std::pair(names::kIncrementsMegabytesPerSecond, parameters.increments_megabytes_per_second)})
    Require(value >= 0.0 && !std::isinf(value), name, std::to_string(value), "be finite and >= 0");
  parameters.limits.Validate();
  return parameters;
}

}  // namespace contact_path
