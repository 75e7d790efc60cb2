#include "contact_path/ros/node_parameters.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <unordered_map>

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

void RequireWithin(const std::string& what, std::size_t value, const Bound& limit) {
  if (value > static_cast<std::size_t>(limit.value))
    throw LimitExceeded(what + ": " + std::to_string(value) + ", but the node admits " + std::to_string(limit.value) +
                        " (~" + limit.name + ")");
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
void CheckList(const std::string& list, const Messages& parts, const TraceLimits& limits) {
  using Message = typename Messages::value_type;
  RequireWithin(list, parts.size(), LimitOf<Part>(limits));
  ForEachFieldPair<Part, Message>([&](const auto& core_field, const auto& field) {
    using Value = typename std::decay_t<decltype(core_field)>::Value;
    if constexpr (std::is_same_v<Value, std::vector<double>> || std::is_same_v<Value, std::vector<std::string>>) {
      std::size_t entries = 0;
      for (const Message& part : parts) {
        const std::size_t size = (part.*field.member).size();
        // The two nodes of a bar are no more than it.
        entries += std::is_same_v<Value, std::vector<double>> ? size : size - std::min<std::size_t>(size, 2);
      }
      RequireWithin(std::string(field.name) + " entries of " + list, entries,
                    {names::kMaxElements, limits.max_elements});
    }
  });
}

// What beams and groups stand for.
void CheckExpansion(const contact_path_msgs::Scene& scene, const TraceLimits& limits) {
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
  RequireWithin("segments of scene.beams", segments, {names::kMaxElements, limits.max_elements});
  RequireWithin("nodes of the scene and its beams", scene.nodes.size() + segments, LimitOf<Node>(limits));
  RequireWithin("contacts of all nodes of groups", contacts, LimitOf<ContactCandidate>(limits));
}

std::size_t IncrementsWanted(const contact_path_msgs::TraceOptions& options, std::size_t stages) {
  TraceOptions core_options;
  core_options.max_increments = std::max(options.max_increments, 0);
  return options.max_increments < 0 ? 0 : core_options.MaxIncrements(stages);
}

}  // namespace

void CheckLimits(const contact_path_msgs::TraceRequest& request, const TraceLimits& limits) {
  const auto& [scene, options, program] = std::tie(request.scene, request.options, request.program);
  if (scene.name.size() > kLongestName)
    throw LimitExceeded("scene.name: " + std::to_string(scene.name.size()) + " bytes, but the node admits " +
                        std::to_string(kLongestName));
  std::size_t bytes = ros::serialization::serializationLength(scene) + ros::serialization::serializationLength(options);
  for (const contact_path_msgs::Stage& stage : program) bytes += ros::serialization::serializationLength(stage);
  if (bytes > kMostBytes)
    throw LimitExceeded("the request has " + std::to_string(bytes) + " bytes, but the node admits " +
                        std::to_string(kMostBytes));
  ForEachFieldPair<Scene, contact_path_msgs::Scene>([&](const auto& core_field, const auto& field) {
    using List = typename std::decay_t<decltype(core_field)>::Value;
    if constexpr (kIsPartList<List>)
      CheckList<typename List::value_type>("scene." + std::string(field.name), request.scene.*field.member, limits);
  });
  CheckExpansion(scene, limits);
  const Bound elements{names::kMaxElements, limits.max_elements}, contacts{names::kMaxContacts, limits.max_contacts};
  RequireWithin("loads and motions of program", ProgramEntries(program), elements);
  RequireWithin("loads of all stages of program", LoadsOfAllStages(scene, program), elements);
  RequireWithin("obstacles of all stages of program", program.size() * scene.obstacles.size(), elements);
  RequireWithin("options.stop", options.stop.size(), contacts);
  RequireWithin("options.branch_choices", options.branch_choices.size(), contacts);
  RequireWithin("options.max_increments", IncrementsWanted(options, program.size()),
                {names::kMaxIncrements, limits.max_increments});
}

}  // namespace contact_path
