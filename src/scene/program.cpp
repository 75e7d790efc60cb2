#include "contact_path/scene/program.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace contact_path {
namespace {

// Of a list of the scene, by name.
template <typename Part>
std::unordered_map<std::string_view, Part*> IndexByName(std::vector<Part>* parts) {
  std::unordered_map<std::string_view, Part*> index;
  for (Part& part : *parts) index.emplace(part.name, &part);
  return index;
}

// What elements take from the initial positions of their nodes.
void FillInRest(const std::unordered_map<std::string_view, Node*>& nodes, Scene* scene) {
  for (Bar& bar : scene->bars) {
    if (bar.rest_length > 0.0) continue;
    const Node &a = *nodes.at(bar.nodes[0]), &b = *nodes.at(bar.nodes[1]);
    bar.rest_length = std::hypot(b.x - a.x, b.y - a.y);
  }
  for (Superelement& part : scene->superelements) {
    if (!part.rest_positions.empty()) continue;
    for (const std::string& name : part.nodes) {
      const Node& node = *nodes.at(name);
      part.rest_positions.insert(part.rest_positions.end(), {node.x, node.y});
    }
  }
}

// Leaves `scene` as it is after the first `count` stages. Names are looked up once, however many stages there are.
void BringOn(const std::vector<Stage>& program, std::size_t count, Scene* scene) {
  const auto last = program.begin() + static_cast<std::ptrdiff_t>(count);
  const auto nodes = IndexByName(&scene->nodes);
  const auto obstacles = IndexByName(&scene->obstacles);
  if (std::any_of(program.begin(), last, [](const Stage& stage) { return !stage.support_motions.empty(); }))
    FillInRest(nodes, scene);
  for (auto stage = program.begin(); stage != last; ++stage) {
    const double target = stage->Target();
    for (const Load& load : stage->loads) scene->loads.push_back({load.node, target * load.fx, target * load.fy, true});
    for (const SupportMotion& motion : stage->support_motions) {
      Node& node = *nodes.at(motion.node);
      node.x += target * motion.dx;
      node.y += target * motion.dy;
    }
    for (const ObstacleMotion& motion : stage->obstacle_motions) {
      Obstacle& obstacle = *obstacles.at(motion.obstacle);
      obstacle.px += target * motion.dx;
      obstacle.py += target * motion.dy;
    }
  }
}

}  // namespace

std::size_t NumStages(const TraceRequest& request) { return std::max<std::size_t>(1, request.program.size()); }

Scene StageScene(const TraceRequest& request, std::size_t stage) {
  Scene scene = request.scene;
  if (request.program.empty()) return scene;
  if (stage > 0) BringOn(request.program, stage, &scene);
  const Stage& now = request.program[stage];
  scene.loads.insert(scene.loads.end(), now.loads.begin(), now.loads.end());
  scene.support_motions = now.support_motions;
  scene.obstacle_motions = now.obstacle_motions;
  return scene;
}

Scaling StageScales(const TraceRequest& request, std::size_t stage) {
  Scaling scaling = CharacteristicScales(StageScene(request, 0));
  if (stage > 0) scaling.load_factor = LoadFactorScale(StageScene(request, stage), scaling.length, scaling.force);
  return scaling;
}

}  // namespace contact_path
