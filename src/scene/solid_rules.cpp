#include "scene/rules.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "contact_path/scene/cell.h"
#include "contact_path/scene/solid_parts.h"

namespace contact_path {
namespace {

// "element 2 [a, b, c]", counted from 1.
std::string ElementText(std::size_t number, const std::vector<std::string>& nodes) {
  return "element " + std::to_string(number) + " " + ListText(nodes);
}

// Young's modulus and Poisson's ratio, or Lame's parameters. False after adding a violation.
bool CheckConstants(const KeyPath& path, const Material& material, Checker* checker) {
  const auto fault = [&](std::string_view key, double value, const char* rule) {
    checker->Add(path.Key(key), NumberText(value), rule);
    return false;
  };
  if (material.E > 0.0) {
    if (!(material.nu > -1.0 && material.nu < 0.5)) return fault("nu", material.nu, "must be > -1 and < 0.5");
    if (material.lambda != 0.0) return fault("lambda", material.lambda, "must be 0 where E is given");
    return material.mu == 0.0 || fault("mu", material.mu, "must be 0 where E is given");
  }
  if (material.mu == 0.0) return fault("E", 0.0, "must be > 0 where mu is not given");
  if (material.nu != 0.0) return fault("nu", material.nu, "must be 0 where lambda and mu are given");
  return 3.0 * material.lambda + 2.0 * material.mu > 0.0 || fault("lambda", material.lambda, "must be > -2/3 mu");
}

// Of ciarlet_geymonat: within its bounds the energy is polyconvex.
void CheckShare(const KeyPath& path, const Material& material, Checker* checker) {
  const KeyPath key = path.Key("a");
  if (material.model != MaterialModel::kCiarletGeymonat) {
    if (material.a != 0.0) checker->Add(key, NumberText(material.a), "must be 0 unless the model is ciarlet_geymonat");
    return;
  }
  const auto [lambda, mu] = LameOf(material);
  if (lambda < 0.0)
    return checker->Add(path.Key(material.E > 0.0 ? "nu" : "lambda"),
                        NumberText(material.E > 0.0 ? material.nu : lambda),
                        "must be >= 0 where the model is ciarlet_geymonat");
  const double least = std::max(0.0, 0.5 * mu - 0.25 * lambda), most = 0.5 * mu;
  if (material.a < least || material.a > most)
    checker->Add(key, NumberText(material.a),
                 "must be from max(0, mu/2 - lambda/4) to mu/2: from " + NumberText(least) + " to " + NumberText(most));
}

// x0, y0, x1, ... of nodes that the scene has.
std::vector<double> PositionsOf(const std::vector<std::string>& nodes, const Checker& checker) {
  std::vector<double> positions;
  for (const std::string& name : nodes) {
    const Node& node = *checker.KnownNode(name);
    positions.insert(positions.end(), {node.x, node.y});
  }
  return positions;
}

// Largest square of a distance from the first node.
double ExtentSquared(const std::vector<double>& positions) {
  double extent = 0.0;
  for (std::size_t i = 0; i < positions.size(); i += 2)
    extent = std::max(extent, std::pow(positions[i] - positions[0], 2) + std::pow(positions[i + 1] - positions[1], 2));
  return extent;
}

// What is wrong with the shape of an element; empty: nothing.
std::string FindShapeFault(const std::vector<double>& positions) {
  const double none = kCancelled * ExtentSquared(positions);
  std::size_t unsound = 0;
  double area = 0.0;
  const std::vector<PlacedPoint> points = PlacePoints(positions);
  for (const PlacedPoint& point : points) {
    area += point.area;
    if (!(point.area > none)) ++unsound;
  }
  if (unsound == 0) return {};
  if (std::abs(area) <= none || std::isnan(area)) return "must have an area";
  if (area < 0.0) return "must have its corners counterclockwise";
  return "must be less distorted: its Jacobian must be positive at all integration points";
}

void CheckElements(const KeyPath& key, const Solid& solid, Checker* checker) {
  const std::size_t count = solid.NodesPerElement();
  std::string first_element, first_fault;
  std::size_t faults = 0;
  for (std::size_t first = 0; first < solid.nodes.size(); first += count) {
    const auto begin = solid.nodes.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<std::string> nodes(begin, begin + static_cast<std::ptrdiff_t>(count));
    const bool repeats = std::unordered_set<std::string>(nodes.begin(), nodes.end()).size() < count;
    const std::string fault = repeats ? "must not repeat a node" : FindShapeFault(PositionsOf(nodes, *checker));
    if (fault.empty()) continue;
    if (faults++ > 0) continue;
    first_element = ElementText(first / count + 1, nodes);
    first_fault = fault;
  }
  if (faults == 0) return;
  if (faults > 1) first_fault += " (elements at fault: " + std::to_string(faults) + ")";
  checker->Add(key, first_element, first_fault);
}

}  // namespace

void CheckMaterials(Checker* checker) {
  const std::vector<Material>& materials = checker->GetScene().materials;
  checker->CheckList(kScene.Key("materials"), materials,
                     [&](const KeyPath& path, const Material& material, bool sound) {
                       if (sound && CheckConstants(path, material, checker)) CheckShare(path, material, checker);
                     });
}

void CheckSolid(const KeyPath& path, const Solid& solid, bool sound, Checker* checker) {
  const KeyPath nodes = path.Key("nodes");
  if (solid.nodes_per_element != 0 && (solid.nodes_per_element < 0 || !IsCellShape(solid.NodesPerElement())))
    return checker->Add(path.Key("nodes_per_element"), std::to_string(solid.nodes_per_element),
                        "must be 3, 4, 6 or 8 (0 = 3)");
  if (solid.nodes.empty()) return checker->Add(nodes, "[]", "at least one element is needed");
  if (solid.nodes.size() % solid.NodesPerElement() != 0)
    return checker->Add(nodes, std::to_string(solid.nodes.size()) + " entries",
                        "must have " + std::to_string(solid.NodesPerElement()) + " entries for each element");
  if (sound) CheckElements(nodes, solid, checker);
}

}  // namespace contact_path
