#include "contact_path/response/contact_pressure.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "contact_path/scene/cell.h"

namespace contact_path {
namespace {

using Nodes = std::vector<std::size_t>;  // of an edge: its ends, and the node in its middle where there is one

// Edges of solids that belong to one element, and segments of beams.
std::vector<Nodes> BoundaryEdges(const Scene& scene, const SceneIndex& index) {
  std::vector<Nodes> edges;
  for (const Beam& beam : scene.beams)
    for (std::size_t i = 0; i + 1 < beam.nodes.size(); ++i)
      edges.push_back({index.Node(beam.nodes[i]), index.Node(beam.nodes[i + 1])});
  std::map<std::pair<std::size_t, std::size_t>, std::pair<int, Nodes>> of_solids;  // by ends: elements, nodes
  for (const Solid& solid : scene.solids) {
    const std::size_t size = solid.NodesPerElement(), per_edge = size > 4 ? 2 : 1;
    const std::vector<std::size_t>& walk = CellBoundary(size);
    for (std::size_t first = 0; first < solid.nodes.size(); first += size)
      for (std::size_t i = 0; i < walk.size(); i += per_edge) {
        const auto node = [&](std::size_t k) { return index.Node(solid.nodes[first + walk[k % walk.size()]]); };
        Nodes nodes = {node(i), node(i + per_edge)};
        if (per_edge == 2) nodes.push_back(node(i + 1));
        auto& [elements, known] = of_solids[std::minmax(nodes[0], nodes[1])];
        ++elements;
        known = std::move(nodes);
      }
  }
  for (auto& [ends, of] : of_solids)
    if (of.first == 1) edges.push_back(std::move(of.second));
  return edges;
}

}  // namespace

PressureProblem::PressureProblem(const Scene& scene, const SceneIndex& index, const DofMap& dofs,
                                 const Scaling& scaling)
    : scaling_(scaling) {
  const std::vector<TouchedBoundary> boundaries = TouchedBoundaries(scene);
  num_boundaries_ = boundaries.size();
  boundary_of_ = BoundaryOfContacts(scene, boundaries);
  std::vector<std::map<std::size_t, std::size_t>> contact_at(boundaries.size() + 1);  // node -> contact
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    contact_at[boundary_of_[i]].emplace(index.Node(scene.contacts[i].node), i);
  for (const Nodes& nodes : BoundaryEdges(scene, index))
    for (const std::map<std::size_t, std::size_t>& contacts : contact_at) {
      Edge edge;
      for (const std::size_t node : nodes) {
        const auto contact = contacts.find(node);
        if (contact == contacts.end()) break;
        edge.contacts.push_back(contact->second);
        edge.x.push_back(dofs.Index(static_cast<int>(node), Field::kPosition, 0));
        edge.y.push_back(dofs.Index(static_cast<int>(node), Field::kPosition, 1));
      }
      if (edge.contacts.size() == nodes.size()) edges_.push_back(std::move(edge));
    }
}

Pressures PressureProblem::At(const Eigen::VectorXd& values, const PathPoint& point,
                              const std::vector<double>& rt) const {
  Pressures pressures;
  pressures.contacts.resize(boundary_of_.size());
  pressures.widths.resize(num_boundaries_);
  for (const Edge& edge : edges_) {
    std::vector<std::array<double, 2>> places;
    for (std::size_t i = 0; i < edge.contacts.size(); ++i) places.push_back({values[edge.x[i]], values[edge.y[i]]});
    if (places.size() == 3) {
      const std::array<double, 3> lengths = ShapeLengths(places[0], places[2], places[1]);
      for (const auto& [end, k] : {std::pair(0, 0), std::pair(1, 2), std::pair(2, 1)})
        pressures.contacts[edge.contacts[static_cast<std::size_t>(end)]].length +=
            scaling_.length * lengths[static_cast<std::size_t>(k)];
    } else {
      const double length = std::hypot(places[1][0] - places[0][0], places[1][1] - places[0][1]);
      for (const std::size_t contact : edge.contacts)
        pressures.contacts[contact].length += 0.5 * scaling_.length * length;
    }
  }
  for (std::size_t i = 0; i < boundary_of_.size(); ++i) {
    ContactPressure& of = pressures.contacts[i];
    if (!(of.length > 0.0)) continue;
    of.pressure = scaling_.force * NormalReaction(point, i) / of.length;
    of.traction = scaling_.force * rt[i] / of.length;
    if (StateOf(point, i) != ContactState::kOpen) pressures.widths[boundary_of_[i]] += of.length;
  }
  return pressures;
}

}  // namespace contact_path
