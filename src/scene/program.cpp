#include "contact_path/scene/program.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace contact_path {
namespace {

// Nodes by name; of several with one name the first.
class NodesByName {
 public:
  explicit NodesByName(std::vector<Node>* nodes) {
    for (Node& node : *nodes) nodes_.emplace(node.name, &node);
  }
  Node& operator[](const std::string& name) const { return *nodes_.at(name); }

 private:
  std::unordered_map<std::string_view, Node*> nodes_;
};

// What elements take from the initial positions of their nodes.
void FillInRest(const NodesByName& nodes, Scene* scene) {
  for (Bar& bar : scene->bars) {
    if (bar.rest_length > 0.0) continue;
    const Node &a = nodes[bar.nodes[0]], &b = nodes[bar.nodes[1]];
    bar.rest_length = std::hypot(b.x - a.x, b.y - a.y);
  }
  for (Superelement& part : scene->superelements) {
    if (!part.rest_positions.empty()) continue;
    for (const std::string& name : part.nodes)
      part.rest_positions.insert(part.rest_positions.end(), {nodes[name].x, nodes[name].y});
  }
}

// All stages before `stage`.
void BringOn(const std::vector<Stage>& program, std::size_t stage, Scene* scene) {
  const NodesByName nodes(&scene->nodes);
  std::unordered_map<std::string_view, Obstacle*> obstacles;
  for (Obstacle& obstacle : scene->obstacles) obstacles.emplace(obstacle.name, &obstacle);
  bool supports_moved = false;
  for (std::size_t i = 0; i < stage; ++i) {
    const double target = program[i].Target();
    for (const Load& load : program[i].loads)
      scene->loads.push_back({load.node, target * load.fx, target * load.fy, true});
    if (!program[i].support_motions.empty() && !supports_moved) {
      FillInRest(nodes, scene);
      supports_moved = true;
    }
    for (const SupportMotion& motion : program[i].support_motions) {
      Node& node = nodes[motion.node];
      node.x += target * motion.dx;
      node.y += target * motion.dy;
    }
    for (const ObstacleMotion& motion : program[i].obstacle_motions) {
      Obstacle& obstacle = *obstacles.at(motion.obstacle);
      obstacle.px += target * motion.dx;
      obstacle.py += target * motion.dy;
    }
  }
}

// Of a scene with superelements only, whose loads and motions are those of one stage at its target.
Scene LoadedAtTarget(const Stage& stage, Scene scene) {
  const double target = stage.Target();
  scene.loads = stage.loads;
  scene.support_motions = stage.support_motions;
  scene.obstacle_motions = stage.obstacle_motions;
  for (Load& load : scene.loads) {
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
  BringOn(request.program, stage, &scene);
  const Stage& now = request.program[stage];
  scene.loads.insert(scene.loads.end(), now.loads.begin(), now.loads.end());
  scene.support_motions = now.support_motions;
  scene.obstacle_motions = now.obstacle_motions;
  return scene;
}

Scaling ProgramScales(const TraceRequest& request) {
  if (!request.scene.bars.empty() || request.program.empty()) return CharacteristicScales(StageScene(request, 0));
  Scaling largest;
  largest.force = 0.0;
  for (const Stage& stage : request.program) {
    const Scaling scaling = CharacteristicScales(LoadedAtTarget(stage, request.scene));
    if (scaling.force > largest.force) largest = scaling;
  }
  return largest;
}

Scaling StageScales(const TraceRequest& request, std::size_t stage, const Scaling& of_program) {
  Scaling scaling = of_program;
  if (request.program.empty()) return scaling;
  Scene scene = request.scene;
  const Stage& now = request.program[stage];
  scene.loads = now.loads;
  scene.support_motions = now.support_motions;
  scene.obstacle_motions = now.obstacle_motions;
  scaling.load_factor = LoadFactorScale(scene, scaling.length, scaling.force);
  return scaling;
}

Scaling StageScales(const TraceRequest& request, std::size_t stage) {
  return StageScales(request, stage, ProgramScales(request));
}

}  // namespace contact_path
