#include "scene/expand_tendon.h"

#include <cmath>
#include <utility>
#include <vector>

#include "contact_path/scene/expand.h"
#include "scene/input_bounds.h"

namespace contact_path {

void ExpandTendon(std::size_t place, const std::unordered_map<std::string, std::size_t>& nodes, Scene* scene) {
  const Tendon tendon = scene->tendons[place];
  std::vector<std::pair<double, double>> at;
  std::vector<double> lengths;
  double length = 0.0;
  for (const std::string& node : tendon.nodes) {
    const auto known = nodes.find(node);
    if (known == nodes.end()) return;
    at.emplace_back(scene->nodes[known->second].x, scene->nodes[known->second].y);
    if (at.size() == 1) continue;
    const auto& [x, y] = at[at.size() - 2];
    lengths.push_back(std::hypot(at.back().first - x, at.back().second - y));
    if (!(lengths.back() > 0.0)) return;
    length += lengths.back();
  }
  const std::string name = TendonName(tendon, place);
  const double rest = tendon.rest_length > 0.0 ? tendon.rest_length : length, stiffness = tendon.EA / rest;
  if (!(stiffness > kSmallestInput)) return;
  std::string before;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const std::string piece_name = name + "/" + std::to_string(i + 1),
                      slid = i + 1 == lengths.size() ? std::string() : piece_name;
    Tendon piece;
    piece.name = piece_name;
    piece.nodes = {tendon.nodes[i], tendon.nodes[i + 1]};
    piece.EA = tendon.EA;
    piece.rest_length = lengths[i] / length * rest;
    piece.slides = {std::exchange(before, slid), slid};
    if (i == 0)
      scene->tendons[place] = std::move(piece);
    else
      scene->tendons.push_back(std::move(piece));
    if (slid.empty()) break;
    scene->nodes.push_back({slid, at[i + 1].first, at[i + 1].second});
    scene->superelements.push_back({{slid}, {0.0, 0.0, 0.0, stiffness}});
    ContactCandidate eye;
    eye.node = slid;
    eye.obstacle = tendon.nodes[i + 1];
    eye.friction = tendon.friction;
    eye.at_eye = true;
    scene->contacts.push_back(std::move(eye));
  }
}

}  // namespace contact_path
