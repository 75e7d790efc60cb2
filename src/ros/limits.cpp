#include "contact_path/ros/node_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "contact_path/ros/names.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/scene.h"

namespace contact_path {
namespace {

constexpr std::size_t kLongestName = std::size_t{1} << 17U;  // of a scene: it comes with each status
constexpr std::size_t kMostBytes = std::size_t{1} << 28U;    // some times as many are taken while it is checked

// Entries of all lists of a program, and its stages.
std::size_t ProgramEntries(const std::vector<contact_path_msgs::Stage>& program) {
  std::size_t entries = program.size();
  for (const contact_path_msgs::Stage& stage : program)
    entries += stage.loads.size() + stage.support_motions.size() + stage.obstacle_motions.size() +
               stage.friction_changes.size();
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

struct Bound {
  const char* name;
  int value;
};

// A line if `value` exceeds the limit.
std::string Exceeded(const std::string& what, std::size_t value, const Bound& limit) {
  if (value <= static_cast<std::size_t>(limit.value)) return {};
  return what + ": " + std::to_string(value) + ", but the node admits " + std::to_string(limit.value) + " (~" +
         limit.name + ")";
}

// The limit for a list of parts of the core.
template <typename Part>
Bound LimitOf(const TraceLimits& limits) {
  if constexpr (std::is_same_v<Part, Node>) return {names::kMaxNodes, limits.max_nodes};
  if constexpr (std::is_same_v<Part, Obstacle> || std::is_same_v<Part, ObstacleMotion> ||
                std::is_same_v<Part, FrictionChange> || std::is_same_v<Part, ContactCandidate>)
    return {names::kMaxContacts, limits.max_contacts};
  return {names::kMaxElements, limits.max_elements};
}

// A list of parts of the scene, and the numbers and names in the lists of these parts. Part: of the core.
template <typename Part, typename Messages>
std::string ExceededByList(const std::string& list, const Messages& parts, const TraceLimits& limits) {
  using Message = typename Messages::value_type;
  std::string exceeded = Exceeded(list, parts.size(), LimitOf<Part>(limits));
  ForEachFieldPair<Part, Message>([&](const auto& core_field, const auto& field) {
    using Value = typename std::decay_t<decltype(core_field)>::Value;
    if constexpr (std::is_same_v<Value, std::vector<double>> || std::is_same_v<Value, std::vector<std::string>>) {
      std::size_t entries = 0;
      for (const Message& part : parts) {
        const std::size_t size = (part.*field.member).size();
        // The two nodes of a bar are no more than it.
        entries += std::is_same_v<Value, std::vector<double>> ? size : size - std::min<std::size_t>(size, 2);
      }
      if (exceeded.empty())
        exceeded = Exceeded(std::string(field.name) + " entries of " + list, entries,
                            {names::kMaxElements, limits.max_elements});
    }
  });
  return exceeded;
}

// What beams and groups stand for.
std::string ExceededByExpansion(const contact_path_msgs::Scene& scene, const TraceLimits& limits) {
  std::size_t segments = 0, contacts = 0;
  std::unordered_map<std::string, std::size_t> groups;  // numbers of nodes
  for (std::size_t i = 0; i < scene.beams.size(); ++i) {
    Beam beam;
    beam.name = scene.beams[i].name;
    beam.segments = scene.beams[i].segments;
    const auto count = static_cast<std::size_t>(BeamSegments(beam));
    segments += count;
    groups.emplace(BeamName(beam, i), count + 1);
  }
  for (const contact_path_msgs::Group& group : scene.groups) groups.emplace(group.name, group.nodes.size());
  for (const contact_path_msgs::Contact& contact : scene.contacts) {
    const auto group = groups.find(contact.group);
    contacts += group == groups.end() ? 1 : group->second;
  }
  std::string exceeded = Exceeded("segments of scene.beams", segments, {names::kMaxElements, limits.max_elements});
  if (exceeded.empty())
    exceeded = Exceeded("nodes of the scene and its beams", scene.nodes.size() + segments, LimitOf<Node>(limits));
  if (exceeded.empty())
    exceeded = Exceeded("contacts of all nodes of groups", contacts, LimitOf<ContactCandidate>(limits));
  return exceeded;
}

std::string ExceededByScene(const contact_path_msgs::Scene& scene, const TraceLimits& limits) {
  std::string exceeded;
  ForEachFieldPair<Scene, contact_path_msgs::Scene>([&](const auto& core_field, const auto& field) {
    using List = typename std::decay_t<decltype(core_field)>::Value;
    if constexpr (kIsPartList<List>)
      if (exceeded.empty())
        exceeded =
            ExceededByList<typename List::value_type>("scene." + std::string(field.name), scene.*field.member, limits);
  });
  return exceeded.empty() ? ExceededByExpansion(scene, limits) : exceeded;
}

std::size_t IncrementsWanted(const contact_path_msgs::TraceOptions& options, std::size_t stages) {
  TraceOptions core_options;
  core_options.max_increments = std::max(options.max_increments, 0);
  return options.max_increments < 0 ? 0 : core_options.MaxIncrements(stages);
}

}  // namespace

void TraceLimits::Validate() const {
  const auto require = [](const char* name, auto value, bool holds, const char* rule) {
    if (!holds)
      throw std::invalid_argument("~" + std::string(name) + " = " + std::to_string(value) + ": must be " + rule);
  };
  for (const auto& [name, value] :
       {std::pair(names::kMaxNodes, max_nodes), std::pair(names::kMaxElements, max_elements),
        std::pair(names::kMaxContacts, max_contacts), std::pair(names::kMaxIncrements, max_increments),
        std::pair(names::kKeepFree, keep_free)})
    require(name, value, value > 0, "> 0");
  require(names::kMaxSeconds, max_seconds, max_seconds >= 0.0 && !std::isinf(max_seconds), "finite and >= 0");
  require(names::kMaxMemory, max_memory, max_memory >= 0, ">= 0");
}

std::string ExceededLimit(const contact_path_msgs::Scene& scene, const contact_path_msgs::TraceOptions& options,
                          const std::vector<contact_path_msgs::Stage>& program, const TraceLimits& limits) {
  if (scene.name.size() > kLongestName) {
    return "scene.name: " + std::to_string(scene.name.size()) + " bytes, but the node admits " +
           std::to_string(kLongestName);
  }
  std::size_t bytes = ros::serialization::serializationLength(scene) + ros::serialization::serializationLength(options);
  for (const contact_path_msgs::Stage& stage : program) bytes += ros::serialization::serializationLength(stage);
  if (bytes > kMostBytes)
    return "the request has " + std::to_string(bytes) + " bytes, but the node admits " + std::to_string(kMostBytes);
  const Bound elements{names::kMaxElements, limits.max_elements}, contacts{names::kMaxContacts, limits.max_contacts};
  std::string exceeded = ExceededByScene(scene, limits);
  const auto check = [&](const char* name, std::size_t value, const Bound& limit) {
    if (exceeded.empty()) exceeded = Exceeded(name, value, limit);
  };
  check("loads and motions of program", ProgramEntries(program), elements);
  check("loads of all stages of program", LoadsOfAllStages(scene, program), elements);
  check("obstacles of all stages of program", program.size() * scene.obstacles.size(), elements);
  check("options.stop", options.stop.size(), contacts);
  check("options.branch_choices", options.branch_choices.size(), contacts);
  check("options.max_increments", IncrementsWanted(options, program.size()),
        {names::kMaxIncrements, limits.max_increments});
  return exceeded;
}

}  // namespace contact_path
