#include "ros/drawn_stage.h"

#include "contact_path/scene/one_line.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/surface.h"

namespace contact_path {

using Eigen::Vector2d;

DrawnStages::DrawnStages(const TraceRequest& request)
    : request_(request), index_(request_.scene), moves_(request_.scene.obstacles.size(), false) {
  const auto note = [this](const std::vector<ObstacleMotion>& motions) {
    for (const ObstacleMotion& motion : motions)
      if (motion.dx != 0.0 || motion.dy != 0.0 || motion.turn != 0.0) moves_[index_.Obstacle(motion.obstacle)] = true;
  };
  note(request_.scene.obstacle_motions);
  for (const Stage& stage : request_.program) note(stage.obstacle_motions);
}

std::shared_ptr<const DrawnStage> DrawnStages::At(std::size_t stage) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!last_made_ || last_ != stage) {
    last_made_ = std::make_shared<const DrawnStage>(Make(stage));
    last_ = stage;
  }
  return last_made_;
}

DrawnStage DrawnStages::Make(std::size_t stage) const {
  DrawnStage parts;
  bool unloads = false;
  if (!request_.program.empty()) {
    const Stage& given = request_.program[stage];
    parts.title = given.name.empty() ? "stage " + std::to_string(stage + 1) : OneLine(given.name);
    unloads = given.unload;
  }
  const Scene begin = StageScene(request_, index_, stage);
  // Loads that are taken back are drawn as less of what the stages before have left, not as loads of their own.
  for (std::size_t k = 0; k < begin.loads.size(); ++k) {
    const Load& load = begin.loads[k];
    const bool of_program = k >= request_.scene.loads.size();
    if (unloads && of_program && !load.constant) continue;
    parts.loads.push_back(
        {index_.Node(load.node), Vector2d(load.fx, load.fy), load.moment, load.constant, unloads && of_program});
  }
  for (std::size_t i = 0; i < begin.obstacles.size(); ++i) {
    const Obstacle& obstacle = begin.obstacles[i];
    DrawnObstacle& drawn = parts.obstacles.emplace_back();
    drawn.surface = MakeSurface(obstacle);
    drawn.point = {obstacle.px, obstacle.py};
    drawn.moves = moves_[i];
  }
  for (const ObstacleMotion& motion : begin.obstacle_motions) {
    DrawnObstacle& drawn = parts.obstacles[index_.Obstacle(motion.obstacle)];
    drawn.motion = {motion.dx, motion.dy};
    drawn.turn = motion.turn;
    drawn.about = {motion.about_x, motion.about_y};
  }
  return parts;
}

}  // namespace contact_path
