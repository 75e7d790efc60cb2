#include "check/contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace contact_path::check {

std::vector<std::array<double, 5>> Sections(const std::vector<std::unique_ptr<const Element>>& elements,
                                            const std::vector<double>& values, std::size_t num_positions) {
  std::vector<std::array<double, 5>> sections;
  std::vector<Real> forces(values.size(), 0.0L);
  for (const auto& element : elements) {
    if (const std::optional<Real> tension = element->Tension(values)) {  // the same all along
      sections.insert(sections.end(), element->NumPieces(), {static_cast<double>(*tension), 0.0, 0.0, 0.0, 0.0});
      continue;
    }
    if (element->GetKind() != Element::Kind::kBar && element->GetKind() != Element::Kind::kSegment) continue;
    element->AddForce(values, &forces);
    const std::size_t first = element->Nodes()[0], second = element->Nodes()[1];
    const Vector chord = NodePosition(values, second) - NodePosition(values, first);
    const Vector at_second{forces[2 * second], forces[2 * second + 1]};
    const Real length = Length(chord);
    Real N = 0.0L, Q = 0.0L, M1 = 0.0L, M2 = 0.0L;
    if (length > 0.0L) {
      N = Dot(chord, at_second) / length;
      Q = Cross(chord, at_second) / length;
    }
    if (values.size() > num_positions) {
      M1 = -forces[num_positions + first];
      M2 = forces[num_positions + second];
    }
    const std::array<Real, 5> of = {N, Q, (M1 + M2) / 2.0L, M1, M2};
    std::array<double, 5>& section = sections.emplace_back();
    std::transform(of.begin(), of.end(), section.begin(), [](Real number) { return static_cast<double>(number); });
    for (const std::size_t node : {first, second}) {
      forces[2 * node] = forces[2 * node + 1] = 0.0L;
      if (values.size() > num_positions) forces[num_positions + node] = 0.0L;
    }
  }
  return sections;
}

std::vector<ContactEdge> ContactEdges(const std::vector<std::unique_ptr<const Element>>& elements,
                                      const std::vector<std::unique_ptr<const Contact>>& contacts,
                                      const std::vector<std::size_t>& boundary_of) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> contact_of;  // by boundary and node
  const std::set<std::size_t> boundaries(boundary_of.begin(), boundary_of.end());
  std::set<std::size_t> touching;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contact_of.emplace(std::pair(boundary_of[i], contacts[i]->Node()), i);
    touching.insert(contacts[i]->Node());
  }
  std::vector<std::vector<std::size_t>> edges_of_beams;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::vector<std::size_t>>> sides;  // by their ends
  for (const auto& element : elements) {
    const std::vector<std::size_t>& nodes = element->Nodes();
    if (element->GetKind() == Element::Kind::kSegment) edges_of_beams.push_back(nodes);
    if (element->GetKind() != Element::Kind::kSolid) continue;
    const std::size_t corners = nodes.size() > 4 ? nodes.size() / 2 : nodes.size();
    for (std::size_t side = 0; side < corners; ++side) {
      const std::size_t a = nodes[side], b = nodes[(side + 1) % corners];
      if (touching.count(a) == 0 || touching.count(b) == 0) continue;
      std::vector<std::size_t> edge = {a, b};
      if (nodes.size() > 4) edge.insert(edge.begin() + 1, nodes[corners + side]);
      sides[std::minmax(a, b)].push_back(std::move(edge));
    }
  }
  std::vector<ContactEdge> edges;
  const auto add = [&](const std::vector<std::size_t>& nodes) {
    for (const std::size_t boundary : boundaries) {
      ContactEdge edge{nodes, {}};
      for (const std::size_t node : nodes)
        if (const auto found = contact_of.find({boundary, node}); found != contact_of.end())
          edge.contacts.push_back(found->second);
      if (edge.contacts.size() == nodes.size()) edges.push_back(std::move(edge));
    }
  };
  for (const std::vector<std::size_t>& nodes : edges_of_beams) add(nodes);
  for (const auto& [ends, of_elements] : sides)
    if (of_elements.size() == 1) add(of_elements[0]);
  return edges;
}

std::vector<double> ContactLengths(const std::vector<ContactEdge>& edges, std::size_t num_contacts,
                                   const std::vector<double>& positions) {
  const Real at = std::sqrt(0.6L);
  std::vector<Real> lengths(num_contacts, 0.0L);
  for (const ContactEdge& edge : edges) {
    const Vector a = NodePosition(positions, edge.nodes.front()), b = NodePosition(positions, edge.nodes.back());
    if (edge.nodes.size() == 2) {
      for (const std::size_t contact : edge.contacts) lengths[contact] += Length(b - a) / 2.0L;
      continue;
    }
    const Vector middle = NodePosition(positions, edge.nodes[1]);
    // x(t) = middle + t (b - a) / 2 + t^2 (a + b - 2 middle) / 2, t from -1 to 1.
    const Vector to_a = a - middle, to_b = b - middle, across = b - a;
    for (const auto& [t, weight] :
         {std::pair(-at, 5.0L / 9.0L), std::pair(0.0L, 8.0L / 9.0L), std::pair(at, 5.0L / 9.0L)}) {
      const Real speed = Length(0.5L * across + t * (to_a + to_b));
      const std::array<Real, 3> shapes = {t * (t - 1.0L) / 2.0L, 1.0L - t * t, t * (t + 1.0L) / 2.0L};
      for (std::size_t i = 0; i < 3; ++i) lengths[edge.contacts[i]] += weight * speed * shapes[i];
    }
  }
  return {lengths.begin(), lengths.end()};
}

}  // namespace contact_path::check
