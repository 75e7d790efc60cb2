#include "scene/rules.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "contact_path/geometry/plane.h"
#include "contact_path/scene/cell.h"

namespace contact_path {
namespace {

constexpr double kStraightBack = 1e-6;  // [rad], far above the rounding of coordinates

const KeyPath kSurfaces = kScene.Key("surfaces");

bool CanMove(const Node& node) { return !node.fixed_x || !node.fixed_y; }

Eigen::Vector2d Between(const Node& a, const Node& b) { return {b.x - a.x, b.y - a.y}; }

// Whether the edge `after` leads straight back along the edge `before`.
bool LeadsBack(const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  return std::abs(std::atan2(Cross(before, after), -before.dot(after))) <= kStraightBack;
}

// The smallest radius of curvature of the spline between the middles of two edges, where it bends to the left; infinite
// where it does not. There y' goes straight from one edge to the other, and y' x y'' is their product.
double RadiusToTheLeft(const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  const double product = Cross(before, after);
  if (!(product > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d change = after - before,
                        nearest = before + std::clamp(-before.dot(change) / change.squaredNorm(), 0.0, 1.0) * change;
  return std::pow(std::hypot(nearest.x(), nearest.y()), 3) / product;
}

}  // namespace

void BoundaryRules::CheckContact(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                                 const BoundarySurface& surface, double length) {
  const Judged& judged = Judge(surface);
  if (!judged.sound) return;
  const AdmissiblePatches patches = PatchesFor(node.name, surface, judged.places, judged.across);
  if (patches.None())
    return checker_.Add(path.Key("node"), node.name,
                        "a node of surface " + surface.name +
                            " itself must have some of it farther along it than two nodes and pi times its radius");
  if (!CanMove(node) && !judged.can_move)
    return checker_.Add(path.Key("node"), node.name,
                        "must be free to move, or a node of surface " + surface.name + " must be");
  const BoundaryCurve::Foot foot = judged.curve->Nearest({node.x, node.y}, patches);
  if (!foot.is_end && Refuses(contact, foot.gap, length) && !IsAway(node, surface, foot))
    checker_.Add(path, contact.Name(), "initial position penetrates the surface by " + NumberText(-foot.gap));
}

bool BoundaryRules::IsAway(const Node& node, const BoundarySurface& surface, const BoundaryCurve::Foot& foot) const {
  if (surface.closed || !(-foot.gap > DepthBehind(surface.radius, foot.edge))) return false;
  const std::vector<std::vector<std::string_view>> elements = ElementsBehind(surface, scene_);
  return std::none_of(elements.begin(), elements.end(), [&](const std::vector<std::string_view>& element) {
    std::vector<Eigen::Vector2d> corners;
    for (const std::string_view name : element)
      if (const Node* const corner = checker_.KnownNode(std::string(name))) corners.emplace_back(corner->x, corner->y);
    return IsInside(corners, {node.x, node.y});
  });
}

const BoundaryRules::Judged& BoundaryRules::Judge(const BoundarySurface& surface) {
  const auto [at, is_new] = judged_.try_emplace(&surface);
  Judged& judged = at->second;
  if (!is_new) return judged;
  judged.can_move = std::any_of(surface.nodes.begin(), surface.nodes.end(),
                                [&](const std::string& name) { return CanMove(*checker_.KnownNode(name)); });
  const KeyPath path = kSurfaces[static_cast<std::size_t>(&surface - scene_.surfaces.data())];
  judged.sound = CheckEdges(path, surface) && CheckBends(path, surface);
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    if (const Node& node = *checker_.KnownNode(surface.nodes[i]); IsAttached(node)) {
      judged.sound = false;
      checker_.Add(path.Key("nodes")[i], node.name, "must not move with a body where contacts touch the surface");
    }
  for (const std::string& name : surface.nodes) {
    const Node& node = *checker_.KnownNode(name);
    judged.places.emplace_back(node.x, node.y);
  }
  judged.across =
      SymmetryAxes(surface, scene_, [&](const std::string& name) -> const Node& { return *checker_.KnownNode(name); });
  judged.curve.emplace(judged.places, surface.closed, surface.radius, judged.across);
  return judged;
}

bool BoundaryRules::CheckEdges(const KeyPath& path, const BoundarySurface& surface) {
  FindEdges();
  const KeyPath nodes = path.Key("nodes");
  const std::size_t count = surface.nodes.size();
  bool sound = true;
  for (std::size_t i = 0; i < (surface.closed ? count : count - 1); ++i) {
    const std::string &from = surface.nodes[i], &to = surface.nodes[(i + 1) % count];
    std::string fault = FaultOf({from, to});
    const Eigen::Vector2d edge = Between(*checker_.KnownNode(from), *checker_.KnownNode(to));
    if (fault.empty() && std::hypot(edge.x(), edge.y()) < kSmallestInput)
      fault = "must not be at the same point as the next node, " + to;
    if (fault.empty()) continue;
    sound = false;
    checker_.Add(nodes[i], from, fault);
  }
  return sound;
}

bool BoundaryRules::CheckBends(const KeyPath& path, const BoundarySurface& surface) {
  const KeyPath nodes = path.Key("nodes");
  const std::size_t count = surface.nodes.size();
  const auto node = [&](std::size_t i) -> const Node& { return *checker_.KnownNode(surface.nodes[i % count]); };
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = surface.closed ? 0 : 1; i < (surface.closed ? count : count - 1); ++i) {
    const Eigen::Vector2d before = Between(node(i + count - 1), node(i)), after = Between(node(i), node(i + 1));
    if (LeadsBack(before, after)) {
      checker_.Add(nodes[i], node(i).name, "the surface must not lead straight back here");
      return false;
    }
    smallest = std::min(smallest, RadiusToTheLeft(before, after));
  }
  if (surface.radius < smallest) return true;
  checker_.Add(
      path.Key("radius"), NumberText(surface.radius),
      "must be less than the radius of the curve where it bends to its admissible side, " + NumberText(smallest));
  return false;
}

std::string BoundaryRules::FaultOf(const Edge& edge) const {
  const bool left = of_solids_.count(edge) > 0, right = of_solids_.count({edge.second, edge.first}) > 0;
  const std::string to(edge.second);
  if (left && right) return "the edge to " + to + " must be on a boundary: there is material on both of its sides";
  if (right || of_lines_.count(edge) > 0) return {};
  if (left) return "the edge to " + to + " must have the material on its right: list the nodes in the other order";
  return "the edge to " + to + " must be on a boundary: no solid, beam or bar has it";
}

void BoundaryRules::FindEdges() {
  if (edges_are_known_) return;
  edges_are_known_ = true;
  for (const Solid& solid : scene_.solids) {
    const std::size_t count = solid.NodesPerElement();
    if (!IsCellShape(count)) continue;
    const std::vector<std::size_t>& boundary = CellBoundary(count);
    for (std::size_t first = 0; first + count <= solid.nodes.size(); first += count)
      for (std::size_t i = 0; i < count; ++i)
        of_solids_.emplace(solid.nodes[first + boundary[i]], solid.nodes[first + boundary[(i + 1) % count]]);
  }
  const auto add_line = [this](const std::vector<std::string>& nodes) {
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      of_lines_.emplace(nodes[i - 1], nodes[i]);
      of_lines_.emplace(nodes[i], nodes[i - 1]);
    }
  };
  for (const Bar& bar : scene_.bars) add_line(bar.nodes);
  for (const Beam& beam : scene_.beams) add_line(beam.nodes);
}

}  // namespace contact_path
