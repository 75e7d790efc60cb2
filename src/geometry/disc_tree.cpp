#include "contact_path/geometry/disc_tree.h"

#include <algorithm>

namespace contact_path {

DiscTree::DiscTree(const std::vector<Disc>& leaves) : num_leaves_(leaves.size()), discs_(2 * leaves.size() - 1) {
  Fill({0, 0, num_leaves_}, leaves);
}

void DiscTree::Fill(const Node& node, const std::vector<Disc>& leaves) {
  if (node.end - node.begin == 1) {
    discs_[node.disc] = leaves[node.begin];
    return;
  }
  const Node first = node.First(), second = node.Second();
  Fill(first, leaves);
  Fill(second, leaves);
  const Disc &a = discs_[first.disc], &b = discs_[second.disc];
  Disc& around = discs_[node.disc];
  around.centre = 0.5 * (a.centre + b.centre);
  around.radius = std::max((a.centre - around.centre).norm() + a.radius, (b.centre - around.centre).norm() + b.radius);
}

}  // namespace contact_path
