#include "contact_path/contact/scene_contacts.h"

#include <array>
#include <memory>
#include <string>
#include <unordered_map>

#include "contact_path/contact/rigid_pair.h"
#include "contact_path/contact/surface.h"
#include "contact_path/scene/can_slide.h"

namespace contact_path {
namespace {

std::shared_ptr<const Surface> MakeSurface(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane: break;
  }
  return std::make_shared<HalfPlane>(Eigen::Vector2d(obstacle.px, obstacle.py),
                                     Eigen::Vector2d(obstacle.nx, obstacle.ny));
}

}  // namespace

ContactPairs BuildContacts(const Scene& scene, const Structure& structure) {
  struct Placed {
    const Obstacle* obstacle = nullptr;
    std::shared_ptr<const Surface> surface;
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  };
  std::unordered_map<std::string, Placed> obstacles;
  for (const Obstacle& obstacle : scene.obstacles)
    obstacles[obstacle.name] = {&obstacle, MakeSurface(obstacle), Eigen::Vector2d::Zero()};
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    obstacles.at(motion.obstacle).velocity = {motion.dx, motion.dy};

  ContactPairs contacts;
  for (const ContactCandidate& candidate : scene.contacts) {
    const Placed& placed = obstacles.at(candidate.obstacle);
    const int node = structure.NodeIndex(candidate.node);
    const NodeMotion motion = {
        {structure.Dof(node, 0), structure.Dof(node, 1)}, structure.StartPosition(node), placed.velocity};
    const bool can_slide = CanSlide(motion.dofs[0] >= 0, motion.dofs[1] >= 0, *placed.obstacle);
    contacts.push_back(
        std::make_unique<RigidPair>(placed.surface, motion, can_slide ? placed.obstacle->friction : 0.0));
  }
  return contacts;
}

}  // namespace contact_path
