#include "contact_path/scene/configuration.h"
#include "contact_path/tolerances.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contact_path {
namespace {

// positions: x0, y0, x1, y1, ...
void Subtract(const Origin& origin, std::vector<double>* positions) {
  for (std::size_t i = 0; i < positions->size(); ++i) (*positions)[i] -= origin[i % 2];
}

}  // namespace

Configuration Configuration::Of(const Scene& scene) {
  Configuration configuration;
  for (const Node& node : scene.nodes) configuration.reference.insert(configuration.reference.end(), {node.x, node.y});
  configuration.start = configuration.reference;
  configuration.start_rotations.assign(scene.nodes.size(), 0.0);
  return configuration;
}

Configuration Configuration::Over(double length) const {
  Configuration scaled = *this;
  for (std::vector<double>* const positions : {&scaled.reference, &scaled.start, &scaled.slip_origins})
    for (double& position : *positions) position /= length;
  return scaled;
}

Origin OriginOf(const Scene& scene, double length) {
  if (scene.nodes.empty()) return {};
  const Node& first = scene.nodes.front();
  Origin least = {first.x, first.y}, most = least;
  double farthest = 0.0;
  for (const Node& node : scene.nodes) {
    least = {std::min(least[0], node.x), std::min(least[1], node.y)};
    most = {std::max(most[0], node.x), std::max(most[1], node.y)};
    farthest = std::max({farthest, std::abs(node.x), std::abs(node.y)});
  }
  const double extent = std::max({most[0] - least[0], most[1] - least[1], length});
  // Nearer, the rounding of coordinates is below kNoMove.
  return farthest > tolerances::kNoMove / tolerances::kLastDigits * extent ? least : Origin{};
}

Scene CountedFrom(const Origin& origin, Scene scene) {
  for (Node& node : scene.nodes) {
    node.x -= origin[0];
    node.y -= origin[1];
  }
  for (Superelement& part : scene.superelements) Subtract(origin, &part.rest_positions);
  for (Obstacle& obstacle : scene.obstacles) {
    obstacle.px -= origin[0];
    obstacle.py -= origin[1];
  }
  for (ObstacleMotion& motion : scene.obstacle_motions) {
    motion.about_x -= origin[0];
    motion.about_y -= origin[1];
  }
  return scene;
}

Configuration CountedFrom(const Origin& origin, Configuration configuration) {
  Subtract(origin, &configuration.reference);
  Subtract(origin, &configuration.start);
  Subtract(origin, &configuration.slip_origins);
  return configuration;
}

}  // namespace contact_path
