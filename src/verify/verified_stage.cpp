#include "verify/verified_stage.h"

#include <algorithm>
#include <cmath>

#include "contact_path/scene/program.h"

namespace contact_path {

VerifiedStage::VerifiedStage(const TraceRequest& request, const SceneIndex& index_given, const Scaling& of_program,
                             std::size_t stage, double largest_load)
    : index(index_given),
      scene(StageScene(request, index, stage)),
      configuration(StageConfiguration(request, index, stage)),
      scaling(StageScales(request, index, stage, of_program)),
      check(scene, configuration, scaling),
      located(request.options.LocatesEvents()),
      rates(2 * scene.nodes.size()),
      turn_rates(scene.nodes.size()),
      stiffest(check.LargestStiffness() * scaling.length / scaling.force) {
  double farthest = 0.0;
  for (const double coordinate : configuration.start) farthest = std::max(farthest, std::abs(coordinate));
  // What moves takes nodes along, and lengths of arc are of the load factor, too.
  for (const SupportMotion& motion : scene.support_motions) {
    const std::size_t node = index.Node(motion.node);
    farthest += largest_load * std::hypot(motion.dx, motion.dy);
    rates[2 * node] = motion.dx;
    rates[2 * node + 1] = motion.dy;
    turn_rates[node] = motion.rotation;
  }
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    farthest += largest_load * std::hypot(motion.dx, motion.dy);
  for (const Obstacle& obstacle : scene.obstacles) {
    farthest = std::max({farthest, std::abs(obstacle.px), std::abs(obstacle.py), obstacle.radius});
    for (const double number : obstacle.points) farthest = std::max(farthest, std::abs(number));
  }
  rounding = kRecorded + kRoundingOfParts * (farthest / scaling.length + largest_load / scaling.load_factor);
  contacts = VerifiedContacts(scene, index, check, configuration, scaling, rates, largest_load);
}

}  // namespace contact_path
