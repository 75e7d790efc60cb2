#include "contact_path/contact/scene_contacts.h"

#include <cstddef>
#include <memory>
#include <vector>

#include "contact_path/contact/rigid_pair.h"
#include "contact_path/scene/can_slide.h"
#include "contact_path/scene/surface.h"

namespace contact_path {

ContactPairs BuildContacts(const Scene& scene, const Structure& structure) {
  return BuildContacts(scene, SceneIndex(scene), structure);
}

ContactPairs BuildContacts(const Scene& scene, const SceneIndex& index, const Structure& structure) {
  struct Placed {
    std::shared_ptr<const Surface> surface;
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  };
  std::vector<Placed> obstacles;
  for (const Obstacle& obstacle : scene.obstacles)
    obstacles.push_back({MakeSurface(obstacle), Eigen::Vector2d::Zero()});
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    obstacles[index.Obstacle(motion.obstacle)].velocity = {motion.dx, motion.dy};

  const Eigen::VectorXd force_bounds = structure.ForceBounds();
  ContactPairs contacts;
  for (const ContactCandidate& candidate : scene.contacts) {
    const std::size_t at = index.Obstacle(candidate.obstacle);
    const Obstacle& obstacle = scene.obstacles[at];
    const auto node = static_cast<int>(index.Node(candidate.node));
    const NodeMotion motion = {
        {structure.Dof(node, 0), structure.Dof(node, 1)}, structure.StartPosition(node), obstacles[at].velocity};
    const bool can_slide = CanSlide(motion.dofs[0] >= 0, motion.dofs[1] >= 0, obstacle);
    contacts.push_back(
        std::make_unique<RigidPair>(obstacles[at].surface, motion, can_slide ? obstacle.friction : 0.0, force_bounds));
  }
  return contacts;
}

}  // namespace contact_path
