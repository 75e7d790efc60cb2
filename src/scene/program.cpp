#include "contact_path/scene/program.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace contact_path {
namespace {

// Loads and obstacle motions of all stages before `stage`.
void BringOn(const std::vector<Stage>& program, std::size_t stage, Scene* scene) {
  std::unordered_map<std::string_view, Obstacle*> obstacles;
  for (Obstacle& obstacle : scene->obstacles) obstacles.emplace(obstacle.name, &obstacle);
  for (std::size_t i = 0; i < stage; ++i) {
    const double target = program[i].Target();
    for (const Load& load : program[i].loads)
      scene->loads.push_back({load.node, target * load.fx, target * load.fy, true});
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

Configuration StageConfiguration(const TraceRequest& request, std::size_t stage) {
  Configuration configuration = Configuration::Of(request.scene);
  std::unordered_map<std::string_view, std::size_t> numbers;
  for (const Node& node : request.scene.nodes) numbers.emplace(node.name, numbers.size());
  for (std::size_t i = 0; i < std::min(stage, request.program.size()); ++i) {
    const double target = request.program[i].Target();
    for (const SupportMotion& motion : request.program[i].support_motions) {
      const std::size_t node = numbers.at(motion.node);
      configuration.start[2 * node] += target * motion.dx;
      configuration.start[2 * node + 1] += target * motion.dy;
    }
  }
  return configuration;
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
