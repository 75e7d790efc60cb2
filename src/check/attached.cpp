#include "check/attached.h"

#include <cmath>
#include <utility>

#include "contact_path/scene/expand.h"

namespace contact_path::check {

AttachedNodes::AttachedNodes(const Scene& scene, const NodeNumbers& numbers) : num_positions_(2 * scene.nodes.size()) {
  const std::vector<bool> turns = NodesThatTurn(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const contact_path::Node& node = scene.nodes[i];
    if (!IsAttached(node)) continue;
    const std::size_t body = numbers.at(node.body);
    const contact_path::Node& at = scene.nodes[body];
    nodes_.push_back({i, body, {static_cast<Real>(node.x) - at.x, static_cast<Real>(node.y) - at.y}, turns[i]});
  }
}

CheckedState AttachedNodes::Settled(CheckedState state) const {
  for (const Node& at : nodes_) {
    const Real turn = state.rotations[at.body], c = std::cos(turn), s = std::sin(turn);
    state.positions[2 * at.node] = static_cast<double>(state.positions[2 * at.body] + c * at.arm.x - s * at.arm.y);
    state.positions[2 * at.node + 1] =
        static_cast<double>(state.positions[2 * at.body + 1] + s * at.arm.x + c * at.arm.y);
    if (at.turns) state.rotations[at.node] = state.rotations[at.body];
  }
  return state;
}

void AttachedNodes::GiveToBodies(const std::vector<double>& values, std::vector<Real>* forces) const {
  std::vector<Real>& all = *forces;
  for (const Node& at : nodes_) {
    const Vector force{std::exchange(all[2 * at.node], 0.0L), std::exchange(all[2 * at.node + 1], 0.0L)},
        arm = NodePosition(values, at.node) - NodePosition(values, at.body);
    AddTo(forces, at.body, force);
    all[num_positions_ + at.body] += Cross(arm, force) + std::exchange(all[num_positions_ + at.node], 0.0L);
  }
}

}  // namespace contact_path::check
