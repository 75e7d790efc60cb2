#include "contact_path/scene/boundary_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include "contact_path/scene/cell.h"

namespace contact_path {
namespace {

Eigen::Vector2d SlopeOf(const Parabola& curve, double tau) { return curve.b + 2.0 * tau * curve.c; }

Eigen::Vector2d NormalOf(const Parabola& curve, double tau) {
  const Eigen::Vector2d slope = SlopeOf(curve, tau);
  return Eigen::Vector2d(-slope.y(), slope.x()).stableNormalized();
}

}  // namespace

BoundaryCurve::BoundaryCurve(const std::vector<Eigen::Vector2d>& given, bool closed, double radius,
                             const std::array<int, 2>& across)
    : spline_(static_cast<int>(given.size()), closed, {across[0] >= 0, across[1] >= 0}), radius_(radius) {
  std::vector<Eigen::Vector2d> places = given;
  const auto add_image = [&](int axis, std::size_t end, std::size_t next) {
    places.push_back(given[next]);
    if (axis >= 0) places.back()[axis] = 2.0 * given[end][axis] - given[next][axis];
  };
  add_image(across[0], 0, 1);
  add_image(across[1], given.size() - 1, given.size() - 2);
  for (int i = 0; i < spline_.NumPatches(); ++i) {
    const SplinePatch patch = spline_.Patch(i);
    std::array<Eigen::Vector2d, 3> nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      nodes[k] = patch.nodes[k] < 0 ? Eigen::Vector2d::Zero() : places[static_cast<std::size_t>(patch.nodes[k])];
    patches_.push_back({Parabola(patch, nodes), patch.end});
  }
}

BoundaryCurve::Foot BoundaryCurve::Nearest(const Eigen::Vector2d& x, const AdmissiblePatches& patches) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  double foot = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (!patches.Has(static_cast<int>(i))) continue;
    const double tau = std::clamp(patches_[i].curve.FootOf(x, 0.0, patches_[i].end), 0.0, patches_[i].end);
    const double distance = (x - patches_[i].curve.At(tau)).norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    at = i;
    foot = tau;
  }
  const Patch& patch = patches_[at];
  const Eigen::Vector2d away = x - patch.curve.At(foot), normal = NormalOf(patch.curve, foot);
  const double along = away.dot(SlopeOf(patch.curve, foot));
  const int number = static_cast<int>(at);
  const bool before = !patches.Has(number - 1) && foot == 0.0 && along < 0.0;
  const bool after = !patches.Has(number + 1) && foot == patch.end && along > 0.0;
  const double edge = SlopeOf(patch.curve, foot).norm();
  if (before || after) return {nearest, normal, true, edge};
  return {away.dot(normal) - radius_, normal, false, edge};
}

AdmissiblePatches PatchesFor(const std::string& node, const BoundarySurface& surface,
                             const std::vector<Eigen::Vector2d>& places, const std::array<int, 2>& across) {
  const MirroredEnds ends = {across[0] >= 0, across[1] >= 0};
  const auto own = std::find(surface.nodes.begin(), surface.nodes.end(), node);
  if (own == surface.nodes.end())
    return AdmissiblePatches(NodalSpline(static_cast<int>(surface.nodes.size()), surface.closed, ends));
  return {places, surface.closed, surface.radius, static_cast<int>(own - surface.nodes.begin()), ends};
}

std::array<int, 2> SymmetryAxes(const BoundarySurface& surface, const Scene& scene,
                                const std::function<const Node&(const std::string&)>& node_of) {
  if (surface.closed) return {-1, -1};
  const auto axis = [&](const std::string& at, const std::string& beside) {
    const Node &end = node_of(at), &next = node_of(beside);
    if (end.fixed_x == end.fixed_y) return -1;
    const bool turns = std::none_of(scene.solids.begin(), scene.solids.end(), [&](const Solid& solid) {
      return std::find(solid.nodes.begin(), solid.nodes.end(), at) != solid.nodes.end();
    });
    if (turns && !end.fixed_rotation) return -1;
    const double x = std::abs(next.x - end.x), y = std::abs(next.y - end.y);
    if (!(end.fixed_x ? x > y : y > x)) return -1;
    return end.fixed_x ? 0 : 1;
  };
  const std::size_t count = surface.nodes.size();
  return {axis(surface.nodes[0], surface.nodes[1]), axis(surface.nodes[count - 1], surface.nodes[count - 2])};
}

std::vector<std::vector<std::string_view>> NodesRoundElements(const Solid& solid) {
  const std::size_t count = solid.NodesPerElement();
  std::vector<std::vector<std::string_view>> elements;
  if (!IsCellShape(count)) return elements;
  for (std::size_t first = 0; first + count <= solid.nodes.size(); first += count) {
    elements.emplace_back();
    for (const std::size_t place : CellBoundary(count)) elements.back().push_back(solid.nodes[first + place]);
  }
  return elements;
}

std::vector<std::vector<std::string_view>> ElementsBehind(const BoundarySurface& surface, const Scene& scene) {
  std::unordered_map<std::string_view, std::string_view> twins;
  for (const Node& node : scene.nodes)
    if (!node.twin_of.empty()) twins.emplace(node.name, node.twin_of);
  const auto in_parts = [&](std::string_view node) {
    const auto twin = twins.find(node);
    return twin == twins.end() ? node : twin->second;
  };
  std::set<std::pair<std::string_view, std::string_view>> edges;
  const std::size_t nodes = surface.nodes.size();
  for (std::size_t i = 0; i < (surface.closed ? nodes : nodes - 1); ++i)
    edges.emplace(in_parts(surface.nodes[i]), in_parts(surface.nodes[(i + 1) % nodes]));
  const auto has_edge = [&](const std::vector<std::string_view>& element) {
    for (std::size_t i = 0; i < element.size(); ++i)
      if (edges.count({element[(i + 1) % element.size()], element[i]}) > 0) return true;  // walked the other way
    return false;
  };
  std::vector<std::vector<std::string_view>> behind;
  for (const Solid& solid : scene.solids) {
    const std::vector<std::vector<std::string_view>> elements = NodesRoundElements(solid);
    if (std::any_of(elements.begin(), elements.end(), has_edge))
      behind.insert(behind.end(), elements.begin(), elements.end());
  }
  return behind;
}

}  // namespace contact_path
