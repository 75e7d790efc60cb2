// A scene as the check evaluates it.
#ifndef CONTACT_PATH_SRC_CHECK_PREPARED_SCENE_H_
#define CONTACT_PATH_SRC_CHECK_PREPARED_SCENE_H_

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "check/attached.h"
#include "check/boundary.h"
#include "check/contacts.h"
#include "check/elements.h"
#include "check/plane.h"
#include "contact_path/check/residuals.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

namespace check {

// Force, of the stiffness at a node times L: the rounding of coordinates makes forces of 1e-11 of it.
inline constexpr Real kStiffForce = 1e-4L;

// Contacts of rigid bodies and pins in loops give way, so that reactions are unique: by this motion over L per force
// over F.
inline constexpr Real kGive = 1e-8L;
// Force over F: the rounding of coordinates makes forces of 1e-9 of it where they give way so little.
inline constexpr Real kForceOfGive = 1e-15L / kGive / 1e-9L;

inline void RequireSize(const std::vector<double>& values, std::size_t size, const char* name) {
  if (values.size() == size) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(values.size()) + " entries: must be " +
                              std::to_string(size));
}

}  // namespace check

// The scene with all names resolved; vectors in the order of the scene's lists.
struct ResidualCheck::Prepared {
  struct PreparedLoad {
    std::size_t node = 0;
    check::Real fx = 0.0L, fy = 0.0L, moment = 0.0L;
    bool constant = false;
  };
  struct PreparedPin {
    std::size_t first, second;  // nodes
    check::Vector apart;        // first less second: what rounding has left of that where they are written
    bool gives;                 // way to its force, as one that is in a loop
  };
  Prepared(const Scene& scene, const Configuration& configuration, const Scaling& scaling_in)
      : scaling(scaling_in), num_positions(configuration.start.size()), start(configuration.start) {
    check::NodeNumbers index;
    for (const Node& node : scene.nodes) {
      index.emplace(node.name, index.size());
      free.push_back(!node.fixed_x);
      free.push_back(!node.fixed_y);
    }
    attached.emplace(scene, index);
    if (HasRotations(scene)) {
      const std::vector<bool> turn = NodesThatTurn(scene);
      for (std::size_t i = 0; i < turn.size(); ++i) free.push_back(turn[i] && !scene.nodes[i].fixed_rotation);
      start.insert(start.end(), configuration.start_rotations.begin(), configuration.start_rotations.end());
    }
    elements = check::MakeElements(scene, index, configuration.reference);
    const std::vector<bool> in_loops = PinsInLoops(scene);
    for (const Pin& pin : scene.pins) {
      pins.push_back({index.at(pin.nodes.at(0)), index.at(pin.nodes.at(1)), {}, in_loops[pins.size()]});
      pins.back().apart = Apart(pins.back(), configuration.reference);
    }
    // Coordinates are rounded relative to their size.
    check::Real size = scaling.length;
    for (const double coordinate : configuration.start) size = std::max<check::Real>(size, std::abs(coordinate));
    std::vector<check::Real> stiffness(scene.nodes.size(), 0.0L);
    const auto body_of = [&](std::size_t node) -> const std::string& { return TurnsWith(scene.nodes[node]); };
    for (const auto& element : elements) {
      const auto& nodes = element->Nodes();
      if (element->GetKind() != check::Element::Kind::kLinearPart &&
          std::all_of(nodes.begin(), nodes.end(), [&](std::size_t node) { return body_of(node) == body_of(nodes[0]); }))
        continue;  // a body holds it rigid
      for (const std::size_t node : nodes) stiffness[node] += element->Stiffness();
    }
    attached->Share(&stiffness);
    for (const check::Real at_node : stiffness) largest_stiffness = std::max(largest_stiffness, at_node);
    for (const check::Real at_node : stiffness)
      units.push_back(std::max<check::Real>(scaling.force, check::kStiffForce * at_node * size));
    // Summed by node, so that what cancels does so before the load factor makes it large.
    std::map<std::pair<std::size_t, bool>, std::size_t> sums;
    for (const Load& load : scene.loads) {
      const auto [at, is_new] = sums.try_emplace({index.at(load.node), load.constant}, loads.size());
      if (is_new) loads.push_back({index.at(load.node), 0.0L, 0.0L, 0.0L, load.constant});
      loads[at->second].fx += load.fx;
      loads[at->second].fy += load.fy;
      loads[at->second].moment += load.moment;
    }
    rates.resize(start.size());
    for (const SupportMotion& motion : scene.support_motions) {
      rates[2 * index.at(motion.node)] = motion.dx;
      rates[2 * index.at(motion.node) + 1] = motion.dy;
      if (motion.rotation != 0.0) rates.at(num_positions + index.at(motion.node)) = motion.rotation;
    }
    supports = SupportedNodes(scene);
    const std::vector<TouchedBoundary> touched = TouchedBoundaries(scene);
    num_touched = touched.size();
    touched_by = BoundaryOfContacts(scene, touched);
    contacts = check::MakeContacts(scene, index, configuration.slip_origins, size);
    contact_edges = check::ContactEdges(elements, contacts, touched_by);
    if (std::any_of(contacts.begin(), contacts.end(), [](const auto& contact) { return contact->TouchedSurface(); }))
      boundaries = check::MakeBoundaries(scene, index);
    const std::vector<check::Real> of_surfaces =
        LargestOnSurfaces<check::Real>([&](std::size_t node) { return units[node]; });
    for (const auto& contact : contacts) {
      const std::optional<std::size_t> surface = contact->TouchedSurface();
      contact_units.push_back(surface ? std::max(units[contact->Node()], of_surfaces[*surface])
                                      : units[contact->Node()]);
      const bool pinned = !scene.nodes[contact->Node()].twin_of.empty();
      if (contact->Gives() || pinned)
        contact_units.back() = std::max(contact_units.back(), check::kForceOfGive * scaling.force);
    }
  }

  // By surface that contacts may touch, the largest of the values >= 0 of its nodes.
  template <typename Value, typename ValueOf>
  std::vector<Value> LargestOnSurfaces(ValueOf value_of) const {
    std::vector<Value> largest;
    for (const check::Boundary& boundary : boundaries) {
      largest.push_back(0);
      for (const check::BoundaryPatch& patch : boundary.Patches())
        for (const std::size_t node : patch.nodes) largest.back() = std::max(largest.back(), value_of(node));
    }
    return largest;
  }

  // Of what gives way: motion per force [length/force].
  double Give() const { return static_cast<double>(check::kGive) * scaling.length / scaling.force; }

  check::PlacedState Placed(const CheckedState& state) const { return {state, boundaries}; }

  // From the second node of a pin to the first one.
  static check::Vector Apart(const PreparedPin& pin, const std::vector<double>& positions) {
    return check::NodePosition(positions, pin.first) - check::NodePosition(positions, pin.second) - pin.apart;
  }

  // phi - T r on each component: internal forces less loads less reactions. What acts on an attached node acts on its
  // body.
  std::vector<check::Real> Unbalance(const CheckedState& given) const {
    const CheckedState state = attached->Settled(given);
    const std::vector<double> values = check::ValuesOf(state.positions, state.rotations);
    std::vector<check::Real> forces(values.size(), 0.0L);
    for (const auto& element : elements) element->AddForce(values, &forces);
    for (const PreparedLoad& load : loads) {
      const check::Real factor = load.constant ? 1.0L : static_cast<check::Real>(state.load_factor);
      forces[2 * load.node] -= factor * load.fx;
      forces[2 * load.node + 1] -= factor * load.fy;
      if (load.moment != 0.0L) forces.at(num_positions + load.node) -= factor * load.moment;
    }
    const check::PlacedState placed = Placed(state);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (state.rn[i] == 0.0 && state.rt[i] == 0.0) continue;
      contacts[i]->AddForces(placed, state.rn[i], state.rt[i], -1.0L, &forces);
    }
    for (std::size_t k = 0; k < pins.size(); ++k) {
      const check::Vector force{state.pins[2 * k], state.pins[2 * k + 1]};
      check::AddTo(&forces, pins[k].first, -1.0L * force);
      check::AddTo(&forces, pins[k].second, force);
    }
    attached->GiveToBodies(values, &forces);
    return forces;
  }

  void RequireSizes(const CheckedState& state) const {
    check::RequireSize(state.positions, num_positions, "positions");
    check::RequireSize(state.rotations, start.size() - num_positions, "rotations");
    check::RequireSize(state.rn, contacts.size(), "rn");
    check::RequireSize(state.rt, contacts.size(), "rt");
    check::RequireSize(state.pins, 2 * pins.size(), "pins");
  }

  Scaling scaling;
  std::size_t num_positions;  // the first values, x0, y0, x1, ...; rotations by node follow where there are beams
  std::vector<double> start;  // values at load factor 0
  std::vector<bool> free;     // the same components
  std::optional<const check::AttachedNodes> attached;
  std::vector<check::Real> units;        // by node: what unbalanced forces are measured in
  check::Real largest_stiffness = 0.0L;  // of all nodes, as LargestStiffness()
  std::vector<double> rates;             // of the fixed ones, per unit of the load factor
  std::vector<std::unique_ptr<const check::Element>> elements;
  std::vector<PreparedPin> pins;
  std::vector<PreparedLoad> loads;
  std::vector<std::unique_ptr<const check::Contact>> contacts;
  std::vector<check::Real> contact_units;
  std::vector<SupportedNode> supports;
  std::vector<std::size_t> touched_by;  // by contact: which of TouchedBoundaries()
  std::size_t num_touched = 0;
  std::vector<check::ContactEdge> contact_edges;
  std::vector<check::Boundary> boundaries;  // by surface of the scene; empty where no contact touches one
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_CHECK_PREPARED_SCENE_H_
