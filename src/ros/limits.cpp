#include "contact_path/ros/limits.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "contact_path/ros/names.h"
#include "contact_path/scene/scene.h"

namespace contact_path {
namespace {

constexpr std::size_t kLongestName = std::size_t{1} << 17U;  // of a scene: it comes with each status
constexpr std::size_t kMostBytes = std::size_t{1} << 28U;    // some times as many are taken while it is checked

void CheckPositive(const std::string& name, int value) {
  if (value <= 0) throw std::invalid_argument("~" + name + " = " + std::to_string(value) + ": must be > 0");
}

std::size_t StiffnessEntries(const contact_path_msgs::Scene& scene) {
  std::size_t entries = 0;
  for (const contact_path_msgs::Superelement& superelement : scene.superelements) {
    entries += superelement.stiffness.size();
  }
  return entries;
}

// Entries of all lists of a program, and its stages.
std::size_t ProgramEntries(const std::vector<contact_path_msgs::Stage>& program) {
  std::size_t entries = program.size();
  for (const contact_path_msgs::Stage& stage : program)
    entries += stage.loads.size() + stage.support_motions.size() + stage.obstacle_motions.size();
  return entries;
}

// Every stage keeps the loads of those before it, and has all obstacles: what a picture of each stage takes.
std::size_t LoadsOfAllStages(const contact_path_msgs::Scene& scene,
                             const std::vector<contact_path_msgs::Stage>& program) {
  std::size_t now = scene.loads.size(), all = 0;
  for (const contact_path_msgs::Stage& stage : program) {
    now += stage.loads.size();
    all += stage.unload != 0 ? 2 * now : now;  // what is left, and what is taken back
  }
  return all;
}

std::size_t RestEntries(const contact_path_msgs::Scene& scene) {
  std::size_t entries = 0;
  for (const contact_path_msgs::Superelement& superelement : scene.superelements)
    entries += superelement.rest_positions.size();
  return entries;
}

std::size_t IncrementsWanted(const contact_path_msgs::TraceOptions& options) {
  TraceOptions core_options;
  core_options.max_increments = options.max_increments;
  return options.max_increments < 0 ? 0 : static_cast<std::size_t>(core_options.MaxIncrements());
}

}  // namespace

void TraceLimits::Validate() const {
  CheckPositive(names::kMaxNodes, max_nodes);
  CheckPositive(names::kMaxElements, max_elements);
  CheckPositive(names::kMaxContacts, max_contacts);
  CheckPositive(names::kMaxIncrements, max_increments);
  if (!(max_seconds >= 0.0) || std::isinf(max_seconds)) {
    throw std::invalid_argument("~" + std::string(names::kMaxSeconds) + " = " + std::to_string(max_seconds) +
                                ": must be finite and >= 0");
  }
  if (max_memory < 0) {
    throw std::invalid_argument("~" + std::string(names::kMaxMemory) + " = " + std::to_string(max_memory) +
                                ": must be >= 0");
  }
  CheckPositive(names::kKeepFree, keep_free);
}

std::string ExceededLimit(const contact_path_msgs::Scene& scene, const contact_path_msgs::TraceOptions& options,
                          const std::vector<contact_path_msgs::Stage>& program, const TraceLimits& limits) {
  struct Increment {
    const char* what;
    std::size_t value;
    const char* limit_name;
    int limit;
  };
  const Increment increments[] = {
      {"scene.nodes", scene.nodes.size(), names::kMaxNodes, limits.max_nodes},
      {"scene.bars", scene.bars.size(), names::kMaxElements, limits.max_elements},
      {"scene.superelements", scene.superelements.size(), names::kMaxElements, limits.max_elements},
      {"stiffness entries of scene.superelements", StiffnessEntries(scene), names::kMaxElements, limits.max_elements},
      {"rest positions of scene.superelements", RestEntries(scene), names::kMaxElements, limits.max_elements},
      {"scene.support_motions", scene.support_motions.size(), names::kMaxElements, limits.max_elements},
      {"scene.obstacle_motions", scene.obstacle_motions.size(), names::kMaxContacts, limits.max_contacts},
      {"loads and motions of program", ProgramEntries(program), names::kMaxElements, limits.max_elements},
      {"loads of all stages of program", LoadsOfAllStages(scene, program), names::kMaxElements, limits.max_elements},
      {"obstacles of all stages of program", program.size() * scene.obstacles.size(), names::kMaxElements,
       limits.max_elements},
      {"scene.loads", scene.loads.size(), names::kMaxElements, limits.max_elements},
      {"scene.obstacles", scene.obstacles.size(), names::kMaxContacts, limits.max_contacts},
      {"scene.contacts", scene.contacts.size(), names::kMaxContacts, limits.max_contacts},
      {"options.stop", options.stop.size(), names::kMaxContacts, limits.max_contacts},
      {"options.branch_choices", options.branch_choices.size(), names::kMaxContacts, limits.max_contacts},
      {"options.max_increments", IncrementsWanted(options), names::kMaxIncrements, limits.max_increments},
  };
  if (scene.name.size() > kLongestName) {
    return "scene.name: " + std::to_string(scene.name.size()) + " bytes, but the node admits " +
           std::to_string(kLongestName);
  }
  std::size_t bytes = ros::serialization::serializationLength(scene) + ros::serialization::serializationLength(options);
  for (const contact_path_msgs::Stage& stage : program) bytes += ros::serialization::serializationLength(stage);
  if (bytes > kMostBytes)
    return "the request has " + std::to_string(bytes) + " bytes, but the node admits " + std::to_string(kMostBytes);
  for (const Increment& increment : increments) {
    if (increment.value > static_cast<std::size_t>(increment.limit)) {
      return std::string(increment.what) + ": " + std::to_string(increment.value) + ", but the node admits " +
             std::to_string(increment.limit) + " (~" + increment.limit_name + ")";
    }
  }
  return "";
}

}  // namespace contact_path
