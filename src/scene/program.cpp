#include "contact_path/scene/program.h"

#include <algorithm>
#include <cmath>

namespace contact_path {
namespace {

Node& Find(const std::string& name, std::vector<Node>* nodes) {
  return *std::find_if(nodes->begin(), nodes->end(), [&](const Node& node) { return node.name == name; });
}

// What elements take from the initial positions of their nodes.
void FillInRest(Scene* scene) {
  for (Bar& bar : scene->bars) {
    if (bar.rest_length > 0.0) continue;
    const Node &a = Find(bar.nodes[0], &scene->nodes), &b = Find(bar.nodes[1], &scene->nodes);
    bar.rest_length = std::hypot(b.x - a.x, b.y - a.y);
  }
  for (Superelement& part : scene->superelements) {
    if (!part.rest_positions.empty()) continue;
    for (const std::string& name : part.nodes) {
      const Node& node = Find(name, &scene->nodes);
      part.rest_positions.insert(part.rest_positions.end(), {node.x, node.y});
    }
  }
}

void BringOn(const Stage& stage, Scene* scene) {
  const double target = stage.Target();
  for (const Load& load : stage.loads) scene->loads.push_back({load.node, target * load.fx, target * load.fy, true});
  if (!stage.support_motions.empty()) FillInRest(scene);
  for (const SupportMotion& motion : stage.support_motions) {
    Node& node = Find(motion.node, &scene->nodes);
    node.x += target * motion.dx;
    node.y += target * motion.dy;
  }
  for (const ObstacleMotion& motion : stage.obstacle_motions)
    for (Obstacle& obstacle : scene->obstacles) {
      if (obstacle.name != motion.obstacle) continue;
      obstacle.px += target * motion.dx;
      obstacle.py += target * motion.dy;
    }
}

// With the loads and motions that the load factor scales as large as at this load factor.
Scene AtTarget(Scene scene, double target) {
  for (Load& load : scene.loads) {
    if (load.constant) continue;
    load.fx *= target;
    load.fy *= target;
  }
  for (SupportMotion& motion : scene.support_motions) {
    motion.dx *= target;
    motion.dy *= target;
  }
  for (ObstacleMotion& motion : scene.obstacle_motions) {
    motion.dx *= target;
    motion.dy *= target;
  }
  return scene;
}

}  // namespace

std::size_t NumStages(const TraceRequest& request) { return std::max<std::size_t>(1, request.program.size()); }

Scene StageScene(const TraceRequest& request, std::size_t stage) {
  Scene scene = request.scene;
  if (request.program.empty()) return scene;
  for (std::size_t i = 0; i < stage; ++i) BringOn(request.program[i], &scene);
  const Stage& now = request.program[stage];
  scene.loads.insert(scene.loads.end(), now.loads.begin(), now.loads.end());
  scene.support_motions = now.support_motions;
  scene.obstacle_motions = now.obstacle_motions;
  return scene;
}

Scaling StageScales(const TraceRequest& request, std::size_t stage) {
  Scaling scaling = CharacteristicScales(StageScene(request, 0));
  if (request.scene.bars.empty() && !request.program.empty()) {
    scaling.force = 0.0;
    for (std::size_t i = 0; i < request.program.size(); ++i) {
      const Scaling of_stage = CharacteristicScales(AtTarget(StageScene(request, i), request.program[i].Target()));
      if (of_stage.force > scaling.force) scaling = of_stage;
    }
  }
  if (!request.program.empty())
    scaling.load_factor = LoadFactorScale(StageScene(request, stage), scaling.length, scaling.force);
  return scaling;
}

}  // namespace contact_path
