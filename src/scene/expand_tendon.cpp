#include "scene/expansion_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/tendon_route.h"
#include "scene/input_bounds.h"

namespace contact_path {

void ExpandTendon(std::size_t place, const std::unordered_map<std::string, std::size_t>& nodes, Scene* scene) {
  const Tendon tendon = scene->tendons[place];
  const auto is_radius = [](double radius) { return radius >= 0.0 && std::isfinite(radius); };
  if (FindRollerFault(tendon) || !std::all_of(tendon.radii.begin(), tendon.radii.end(), is_radius)) return;
  std::vector<Eigen::Vector2d> at;
  for (const std::string& node : tendon.nodes) {
    const auto known = nodes.find(node);
    if (known == nodes.end()) return;
    at.emplace_back(scene->nodes[known->second].x, scene->nodes[known->second].y);
    if (at.size() > 1 && !(SpanIsSound(tendon, at.size() - 2, at.back() - at[at.size() - 2]))) return;
  }
  const TendonRoute route = RouteOf(tendon, at);
  const std::string name = TendonName(tendon, place);
  const double rest = tendon.rest_length > 0.0 ? tendon.rest_length : route.length, stiffness = tendon.EA / rest;
  if (!(stiffness > kSmallestInput)) return;
  std::string before;
  const auto wrapped = [&](std::size_t i) { return (i == 0 || i + 1 == at.size() ? 1.0 : 0.5) * route.wrapped[i]; };
  for (std::size_t i = 0; i < route.spans.size(); ++i) {
    const std::string piece_name = name + "/" + std::to_string(i + 1),
                      slid = i + 1 == route.spans.size() ? std::string() : piece_name;
    Tendon piece;
    piece.name = piece_name;
    piece.nodes = {tendon.nodes[i], tendon.nodes[i + 1]};
    piece.EA = tendon.EA;
    const RolledSpan::At span = route.spans[i].Of(at[i + 1] - at[i], 0.0);
    piece.rest_length = (span.tangent.norm() + span.arcs) / route.length * rest;
    if (!tendon.radii.empty()) {
      piece.radii = {tendon.radii[i], tendon.radii[i + 1]};
      piece.turns = {tendon.turns[i], tendon.turns[i + 1]};
      piece.wrapped = {wrapped(i), wrapped(i + 1)};
    }
    piece.slides = {std::exchange(before, slid), slid};
    if (i == 0)
      scene->tendons[place] = std::move(piece);
    else
      scene->tendons.push_back(std::move(piece));
    if (slid.empty()) break;
    scene->nodes.push_back({slid, at[i + 1].x(), at[i + 1].y()});
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
