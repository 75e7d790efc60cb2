#include "contact_path/contact/contact_geometry.h"

#include <cmath>
#include <unordered_map>

namespace contact_path {
namespace {

SparseLinear Project(const Scene& scene, const Structure& structure, int node, double cx, double cy) {
  SparseLinear function;
  const Node& position = scene.nodes[static_cast<std::size_t>(node)];
  const std::array<double, 2> coefficients = {cx, cy}, initial = {position.x, position.y};
  for (const int axis : {0, 1}) {
    const auto a = static_cast<std::size_t>(axis);
    const int dof = structure.Dof(node, axis);
    if (dof < 0) {
      function.offset += coefficients[a] * initial[a];
    } else if (coefficients[a] != 0.0) {
      function.dofs[a] = dof;
      function.coefficients[a] = coefficients[a];
    }
  }
  return function;
}

}  // namespace

std::vector<ContactGeometry> BuildContacts(const Scene& scene, const Structure& structure) {
  std::unordered_map<std::string, const Obstacle*> obstacles;
  for (const Obstacle& obstacle : scene.obstacles) obstacles.emplace(obstacle.name, &obstacle);
  std::unordered_map<std::string, const ObstacleMotion*> motions;
  for (const ObstacleMotion& motion : scene.obstacle_motions) motions.emplace(motion.obstacle, &motion);

  std::vector<ContactGeometry> contacts;
  for (const ContactCandidate& candidate : scene.contacts) {
    const Obstacle& obstacle = *obstacles.at(candidate.obstacle);
    const int node = structure.NodeIndex(candidate.node);
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    const double nx = obstacle.nx / norm, ny = obstacle.ny / norm;
    ContactGeometry contact;
    contact.gap = Project(scene, structure, node, nx, ny);
    contact.gap.offset -= nx * obstacle.px + ny * obstacle.py;
    contact.tangential = Project(scene, structure, node, ny, -nx);
    if (const auto motion = motions.find(obstacle.name); motion != motions.end()) {
      contact.gap.load = -(nx * motion->second->dx + ny * motion->second->dy);
      contact.tangential.load = -(ny * motion->second->dx - nx * motion->second->dy);
    }
    const bool can_slide = contact.tangential.dofs[0] >= 0 || contact.tangential.dofs[1] >= 0;
    contact.friction = can_slide ? obstacle.friction : 0.0;
    contacts.push_back(contact);
  }
  return contacts;
}

Eigen::VectorXd TangentialPositions(const std::vector<ContactGeometry>& contacts, const PathPoint& point) {
  Eigen::VectorXd positions(static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    positions[static_cast<Eigen::Index>(i)] = contacts[i].tangential.Value(point.u, point.s);
  return positions;
}

}  // namespace contact_path
