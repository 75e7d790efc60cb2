#include "scene/expansion_steps.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {
namespace {

// Nodes that turn with a body, or that something turns.
std::unordered_set<std::string> TurnedNodes(const TraceRequest& request) {
  const Scene& scene = request.scene;
  std::unordered_set<std::string> turned;
  ForEachElementList(scene, [&](std::string_view, const auto& elements) {
    for (const auto& element : elements) turned.insert(element.nodes.begin(), element.nodes.end());
  });
  for (const Node& node : scene.nodes)
    if (IsAttached(node)) turned.insert(node.body);
  const auto moments = [&](const auto& loading) {
    for (const Load& load : loading.loads)
      if (load.moment != 0.0) turned.insert(load.node);
    for (const SupportMotion& motion : loading.support_motions)
      if (motion.rotation != 0.0) turned.insert(motion.node);
  };
  moments(scene);
  for (const Stage& stage : request.program) moments(stage);
  return turned;
}

}  // namespace

void FixIdleRotations(TraceRequest* request) {
  Scene& scene = request->scene;
  const auto changes = [](const Stage& stage) { return !stage.friction_changes.empty(); };
  if (std::none_of(scene.nodes.begin(), scene.nodes.end(), IsBody) || !scene.friction_changes.empty() ||
      std::any_of(request->program.begin(), request->program.end(), changes))
    return;
  std::unordered_set<std::string> turned = TurnedNodes(*request);
  const auto nodes = PlacesByName(scene.nodes), obstacles = PlacesByName(scene.obstacles);
  for (const Obstacle& obstacle : scene.obstacles) {
    const auto at = nodes.find(obstacle.body);
    if (at == nodes.end()) continue;
    const Node& body = scene.nodes[at->second];
    const bool round = obstacle.shape == ObstacleShape::kCircle && obstacle.px == body.x && obstacle.py == body.y;
    if (!round) turned.insert(obstacle.body);
  }
  for (const ContactCandidate& contact : scene.contacts) {
    const auto touched = obstacles.find(contact.Rolls() ? contact.obstacles.back() : contact.obstacle);
    if (touched == obstacles.end()) continue;
    const Obstacle& obstacle = scene.obstacles[touched->second];
    if (contact.FrictionWith(obstacle) == 0.0) continue;
    turned.insert(obstacle.body);
    turned.insert(contact.node);
    if (const Obstacle* const circle = RollingCircle(contact, scene)) turned.insert(circle->body);
  }
  for (Node& node : scene.nodes)
    if (IsBody(node) && turned.count(node.name) == 0) node.fixed_rotation = true;
}

}  // namespace contact_path
