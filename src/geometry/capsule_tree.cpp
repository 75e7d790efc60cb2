#include "contact_path/geometry/capsule_tree.h"

#include <cmath>

namespace contact_path {

CapsuleTree::CapsuleTree(const std::vector<Capsule>& leaves)
    : num_leaves_(leaves.size()), parts_(2 * leaves.size() - 1) {
  Fill({0, 0, num_leaves_}, leaves);
}

Capsule CapsuleTree::Fill(const Node& node, const std::vector<Capsule>& leaves) {
  const bool is_leaf = node.end - node.begin == 1;
  std::vector<Capsule> within;
  if (is_leaf)
    within = {leaves[node.begin]};
  else
    within = {Fill(node.First(), leaves), Fill(node.Second(), leaves)};
  Capsule around = {within.front().begin, within.back().end, 0.0};
  Part& part = parts_[node.capsule];
  part.begin = around.begin;
  part.along = around.end - around.begin;
  part.factor = 1.0 / part.along.squaredNorm();
  if (!std::isfinite(part.factor)) part.factor = 0.0;
  // The distance from a straight line between two points is convex: on another such line it is largest at an end.
  for (const Capsule& inner : within)
    for (const Eigen::Vector2d& end : {inner.begin, inner.end})
      around.radius =
          std::max(around.radius, (1.0 + tolerances::kEqual) * std::sqrt(part.SquaredDistance(end)) + inner.radius);
  part.radius = around.radius;
  return around;
}

}  // namespace contact_path
