#include "contact_path/ros/node_parameters.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

// Call visit(name, value, whether it may be 0) for each number.
template <typename Limits, typename Visit>
void ForEachLimit(Limits& limits, Visit visit) {
  visit(names::kMaxNodes, limits.max_nodes, false);
  visit(names::kMaxElements, limits.max_elements, false);
  visit(names::kMaxContacts, limits.max_contacts, false);
  visit(names::kMaxIncrements, limits.max_increments, false);
  visit(names::kKeepFree, limits.keep_free, false);
  visit(names::kMaxSeconds, limits.max_seconds, true);
  visit(names::kMaxMemory, limits.max_memory, true);
}
template <typename Visit>
void ForEachNumber(NodeParameters& parameters, Visit visit) {
  visit(names::kIncrementsQueue, parameters.increments_queue, false);
  visit(names::kIncrementsMegabytes, parameters.increments_megabytes, false);
  visit(names::kIncrementsPerSecond, parameters.increments_per_second, true);
  visit(names::kIncrementsMegabytesPerSecond, parameters.increments_megabytes_per_second, true);
  ForEachLimit(parameters.limits, visit);
}

template <typename Number>
void Require(const char* name, Number value, bool may_be_zero) {
  if (std::isfinite(value) && (value > 0 || (may_be_zero && value == 0))) return;
  throw std::invalid_argument("~" + std::string(name) + " = " + std::to_string(value) + ": must be " +
                              (std::is_same_v<Number, double> ? "finite and " : "") + (may_be_zero ? ">= 0" : "> 0"));
}

// Leaves `value` as it is where the parameter is not set. Throws std::invalid_argument where it is not `type`, in
// words.
template <typename Value>
void ReadParameter(const ros::NodeHandle& private_node, const char* name, const char* type, Value* value) {
  if (private_node.hasParam(name) && !private_node.getParam(name, *value))
    throw std::invalid_argument("~" + std::string(name) + ": must be " + type);
}

// `path` with a leading ~ replaced by the home directory.
std::string ExpandHome(const std::string& path) {
  const char* const home = std::getenv("HOME");
  const bool at_home = path == "~" || path.rfind("~/", 0) == 0;
  return at_home && home != nullptr ? home + path.substr(1) : path;
}

}  // namespace

void TraceLimits::Validate() const {
  ForEachLimit(*this, [](const char* name, auto value, bool may_be_zero) { Require(name, value, may_be_zero); });
}

NodeParameters ReadParameters(const ros::NodeHandle& private_node) {
  NodeParameters parameters;
  ReadParameter(private_node, names::kBagDirectory, "a string", &parameters.bag_directory);
  ForEachNumber(parameters, [&](const char* name, auto& value, bool) {
    const bool whole = std::is_same_v<decltype(value), int&>;
    ReadParameter(private_node, name, whole ? "an integer" : "a number", &value);
  });
  if (parameters.bag_directory.empty())
    throw std::invalid_argument("~" + std::string(names::kBagDirectory) + " = \"\": must not be empty");
  parameters.bag_directory = std::filesystem::absolute(ExpandHome(parameters.bag_directory)).string();
  ForEachNumber(parameters, [](const char* name, auto value, bool may_be_zero) { Require(name, value, may_be_zero); });
  return parameters;
}

}  // namespace contact_path
