// Plane solids: nearly incompressible, soft beside stiff, of thin elements, pressed to nothing.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "extremes/extreme_case.h"
#include "support/solid_grid.h"

namespace contact_path {
namespace {

constexpr double kShear = 1.0;  // shear modulus
// To which places of corners are known where an element is pressed to nothing, of its size.
constexpr double kPlaces = 1e-10;

Material MaterialOf(const std::string& name, MaterialModel model, double mu, double nu) {
  Material material;
  material.name = name;
  material.model = model;
  material.mu = mu;
  material.lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
  return material;
}

// A block of cells on a smooth floor.
Scene Block(int columns, int rows, double width, double height, int nodes_per_element, const Material& material) {
  Scene scene;
  scene.materials = {material};
  Solid solid;
  solid.name = "block";
  solid.material = material.name;
  solid.nodes_per_element = nodes_per_element;
  AddGrid(
      &scene, columns, rows, [&](double x, double y) { return Eigen::Vector2d(width * x, height * y); }, solid);
  for (Node& node : scene.nodes) {
    node.fixed_y = node.y == 0.0;
    node.fixed_x = node.fixed_y && node.x == 0.0;
  }
  return scene;
}

// The traction 1 on the upper side of the block, in its whole force `width`.
void PullUp(int columns, int rows, Scene* scene) {
  BoundarySurface top;
  top.name = "top";
  for (int i = 0; i <= 2 * columns; ++i)
    if (HasGridNode(*scene, i, 2 * rows)) top.nodes.push_back(GridNode(scene, i, 2 * rows).name);
  scene->surfaces = {top};
  Load load;
  load.surface = "top";
  load.py = 1.0;
  scene->loads = {load};
}

std::size_t GridNumber(const Scene& scene, int i, int j) {
  const std::string name = std::to_string(i) + "_" + std::to_string(j);
  std::size_t number = 0;
  while (scene.nodes[number].name != name) ++number;
  return number;
}

// The stretch across, where no stress acts, of the neo-Hookean material stretched by l.
double Across(double l, double mu, double lambda) {
  constexpr int kIterations = 100;
  double k = 1.0;
  for (int i = 0; i < kIterations; ++i)
    k -= (mu * (k * k - 1.0) + lambda * std::log(l * k)) / (2.0 * mu * k + lambda / k);
  return k;
}

// A block is pulled to the double of its height: uniaxial stress in plane strain.
ExtremeCase Pulled(const std::string& group, const std::string& value, int nodes_per_element, double nu, double width,
                   double height) {
  constexpr int kCells = 2;
  ExtremeCase extreme{group, value};
  const Material material = MaterialOf("m", MaterialModel::kNeoHookean, kShear, nu);
  Scene scene = Block(kCells, kCells, width, height, nodes_per_element, material);
  PullUp(kCells, kCells, &scene);
  const std::size_t corner = GridNumber(scene, 2 * kCells, 2 * kCells);
  extreme.request = Until(scene, scene.nodes[corner].name + ".y", ">", 2.0 * height);
  extreme.exact = "closed form";
  extreme.error = [=](const TraceRequest&, const Increment& increment) {
    const double l = increment.positions[2 * corner + 1] / height;
    const double k = Across(l, kShear, material.lambda);
    const double stress = (kShear * (l * l - 1.0) + material.lambda * std::log(l * k)) / l;
    return Largest({increment.load_factor - stress, increment.positions[2 * corner] / width - k});
  };
  return extreme;
}

ExtremeCase NearlyIncompressible(int nodes_per_element, double nu) {
  return Pulled("Poisson's ratio near 1/2", "1/2 - nu = " + Text(0.5 - nu) + ", " + Text(nodes_per_element) + " nodes",
                nodes_per_element, nu, 1.0, 1.0);
}

ExtremeCase ThinElements(int nodes_per_element, double aspect) {
  ExtremeCase extreme =
      Pulled("thin elements", "width / height = " + Text(aspect) + ", " + Text(nodes_per_element) + " nodes",
             nodes_per_element, 0.3, std::sqrt(aspect), 1.0 / std::sqrt(aspect));
  // Stiffnesses of eight nodes differ by the fourth power of it.
  if (nodes_per_element == 8 && std::abs(std::log10(aspect)) > 3.0) extreme.ends = {"step_too_small", "not_determined"};
  return extreme;
}

// Two layers of very different stiffness, of a material that does not contract, pulled with the same force.
ExtremeCase Layers(double ratio) {
  const double moduli[2] = {std::sqrt(ratio), 1.0 / std::sqrt(ratio)};
  ExtremeCase extreme{"layers of different E", "ratio " + Text(ratio)};
  Scene scene = Block(1, 2, 1.0, 1.0, 4, MaterialOf("stiff", MaterialModel::kNeoHookean, moduli[0], 0.0));
  scene.materials.push_back(MaterialOf("soft", MaterialModel::kNeoHookean, moduli[1], 0.0));
  Solid upper = scene.solids[0];
  upper.material = "soft";
  upper.nodes.erase(upper.nodes.begin(), upper.nodes.begin() + 4);
  scene.solids[0].nodes.resize(4);
  scene.solids.push_back(upper);
  PullUp(1, 2, &scene);
  scene.loads[0].py = moduli[1];
  const std::size_t middle = GridNumber(scene, 2, 2), top = GridNumber(scene, 2, 4);
  extreme.request = Until(scene, "load_factor", ">", 2.0);
  extreme.exact = "closed form";
  extreme.allowed = std::max(1e-9, 1e-15 * ratio);
  extreme.allowed_regularised = std::max(1e-3, extreme.allowed);
  if (ratio > 1e5) extreme.ends = {"step_too_small", "not_determined", "numerical_failure"};
  extreme.error = [=](const TraceRequest&, const Increment& increment) {
    // mu (l^2 - 1) / l is the force in each.
    const auto stretch = [&](double mu) {
      const double force = moduli[1] * increment.load_factor / mu;
      return 0.5 * (force + std::hypot(force, 2.0));
    };
    const double below = 0.5 * stretch(moduli[0]), above = 0.5 * stretch(moduli[1]);
    return Largest({increment.positions[2 * middle + 1] - below, increment.positions[2 * top + 1] - below - above,
                    increment.positions[2 * top] - 1.0});
  };
  return extreme;
}

// A cantilever of four long elements of eight nodes, bent by a load across its end.
ExtremeCase LongElements(double aspect) {
  constexpr int kElements = 4;
  const double height = 1.0 / (kElements * aspect);
  ExtremeCase extreme{"long elements that bend", "length / height = " + Text(aspect)};
  Scene scene = Block(kElements, 1, 1.0, height, 8, MaterialOf("m", MaterialModel::kNeoHookean, kShear, 0.0));
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.x == 0.0;
  // EI / L^2 of a beam, with E = 2 mu.
  scene.loads = {{scene.nodes[GridNumber(scene, 2 * kElements, 1)].name, 0.0, kShear * std::pow(height, 3) / 6.0}};
  extreme.request = Until(scene, "load_factor", ">", 2.0);
  // Bending is softer than stretching by the square of L / h, near rounding: some motions then look like free ones.
  if (aspect > 9e2) extreme.ends = {"step_too_small", "path_end"};
  return extreme;
}

// St. Venant-Kirchhoff's material has no resistance to being pressed to nothing: s = mu l (1 - l^2) with nu = 0.
ExtremeCase PressedToNothing(int nodes_per_element) {
  ExtremeCase extreme{"element that turns inside out", "pressed to nothing, " + Text(nodes_per_element) + " nodes"};
  Scene scene =
      Block(1, 1, 1.0, 1.0, nodes_per_element, MaterialOf("m", MaterialModel::kStVenantKirchhoff, kShear, 0.0));
  for (Node& node : scene.nodes) node.fixed_x = true;
  PullUp(1, 1, &scene);
  scene.loads[0].py = -1.0;
  const std::size_t corner = GridNumber(scene, 2, 2);
  extreme.request = Until(scene, scene.nodes[corner].name + ".y", "<", -0.5);
  extreme.exact = "closed form";
  extreme.ends = {"element_inverted"};
  extreme.error = [corner](const TraceRequest&, const Increment& increment) {
    const double l = increment.positions[2 * corner + 1];
    return l > -kPlaces ? std::abs(increment.load_factor - kShear * l * (1.0 - l * l)) : HUGE_VAL;
  };
  return extreme;
}

// A corner of an element is pushed through the opposite one.
ExtremeCase CornerPushedThrough(MaterialModel model) {
  ExtremeCase extreme{"element that turns inside out, by a corner", std::string(ToString(model))};
  Scene scene = Block(1, 1, 1.0, 1.0, 4, MaterialOf("m", model, kShear, 0.3));
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = true;
  const std::size_t corner = GridNumber(scene, 2, 2);
  scene.support_motions = {{scene.nodes[corner].name, -1.0, -1.0}};
  Node& free = scene.nodes[GridNumber(scene, 2, 0)];
  free.fixed_x = false;
  extreme.request = Until(scene, "load_factor", ">", 2.0);
  // The neo-Hookean material resists, and the free corner gives way for ever.
  if (model == MaterialModel::kStVenantKirchhoff) extreme.ends = {"element_inverted"};
  return extreme;
}

}  // namespace

void AddSolidCases(std::vector<ExtremeCase>* cases) {
  for (const double nu : {0.49, 0.4999, 0.499999, 0.49999999})
    for (const int nodes : {4, 8}) cases->push_back(NearlyIncompressible(nodes, nu));
  for (const double aspect : {1e-4, 1e-2, 1e2, 1e4})
    for (const int nodes : {4, 8}) cases->push_back(ThinElements(nodes, aspect));
  for (const double ratio : {1.0, 1e4, 1e8, 1e12}) cases->push_back(Layers(ratio));
  for (const double aspect : {1e1, 1e2, 1e3, 1e4}) cases->push_back(LongElements(aspect));
  for (const int nodes : {4, 8}) cases->push_back(PressedToNothing(nodes));
  for (const MaterialModel model : {MaterialModel::kStVenantKirchhoff, MaterialModel::kNeoHookean})
    cases->push_back(CornerPushedThrough(model));
}

}  // namespace contact_path
