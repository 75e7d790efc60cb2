// Surfaces of nodes: far from the origin, stiff beside soft, thin and thick, on meshes that differ, with gaps at the
// tolerance.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "extremes/extreme_case.h"
#include "support/plank.h"
#include "support/solid_grid.h"

namespace contact_path {
namespace {

constexpr double kFriction = 0.3;
// Beyond these, coordinates do not tell gaps to the tolerance of residuals, or their rounding turns the reaction; steps
// over patches of which one is that much longer than the next do not come to their joint.
constexpr double kFarthest = 1e8, kLargestRadius = 1e5, kLeastRoom = 1e-5, kMostUneven = 1e3;

// Of fixed nodes, which bars join.
void AddSurface(const std::vector<Eigen::Vector2d>& places, double radius, Scene* scene) {
  BoundarySurface surface;
  surface.name = "surface";
  surface.radius = radius;
  for (const Eigen::Vector2d& place : places) {
    surface.nodes.push_back("g" + std::to_string(surface.nodes.size()));
    scene->nodes.push_back({surface.nodes.back(), place.x(), place.y(), true, true});
    if (surface.nodes.size() > 1) scene->bars.push_back({{surface.nodes.end()[-2], surface.nodes.back()}, 1.0});
  }
  scene->surfaces.push_back(std::move(surface));
}

ContactCandidate Touching(const std::string& node, double friction) {
  ContactCandidate contact;
  contact.node = node;
  contact.surface = "surface";
  contact.friction = friction;
  return contact;
}

// ----- fixed surfaces -----

// A node on springs above a fixed surface, which 1 presses down, and the load factor pushes to the right.
struct PressedNode {
  std::vector<double> edges = std::vector<double>(6, 0.25);  // of the surface, along x from -0.3 on
  double friction = kFriction, radius = 0.0, gap = 0.0;

  ExtremeCase Case(const std::string& group, const std::string& value) const {
    Scene scene;
    scene.nodes = {{"p", 0.0, radius + gap}};
    scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
    scene.loads = {{"p", 1.0, 0.0}, {"p", 0.0, -1.0, true}};
    std::vector<Eigen::Vector2d> places = {{-0.3, 0.0}};
    for (const double edge : edges) places.emplace_back(places.back() + Eigen::Vector2d(edge, 0.0));
    AddSurface(places, radius, &scene);
    scene.contacts = {Touching("p", friction)};
    ExtremeCase extreme;
    extreme.group = "surface, " + group;
    extreme.value = value;
    extreme.request = Until(std::move(scene), "p.x", ">", 0.5);
    extreme.exact = "closed form";
    extreme.error = [*this](const TraceRequest&, const Increment& increment) {
      const double x = increment.positions[0], y = increment.positions[1] - radius;
      if (increment.contacts[0].state == ContactState::kStick) return Largest({x, y});
      const double sliding = x + friction * (1.0 - gap);
      return Largest({y, (increment.load_factor - sliding) / std::max(1.0, sliding)});
    };
    return extreme;
  }
};

// The same in a valley whose radius of curvature at its bottom is 1, the line y = 1/8 + x^2 / 2 up to x = 0.5.
ExtremeCase InValley(double room) {
  const double radius = 1.0 - room, bottom = 0.125 + radius;
  Scene scene;
  scene.nodes = {{"p", 0.0, bottom}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 1.0, 0.0}, {"p", 0.0, -1.0, true}};
  AddSurface({{-1.0, 0.5}, {0.0, 0.0}, {1.0, 0.5}}, radius, &scene);
  scene.contacts = {Touching("p", kFriction)};
  ExtremeCase extreme{"surface, radius below that of its bend", "by " + Text(room) + " of it"};
  extreme.request = Until(std::move(scene), "load_factor", ">", 0.75);
  extreme.exact = "closed form";
  extreme.error = [radius, bottom](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[0], y = increment.positions[1];
    if (increment.contacts[0].state == ContactState::kStick) return Largest({x, y - bottom});
    // The node is at the distance of the radius from its foot, and knows its height better than its place along x.
    double foot = 0.4;
    for (int i = 0; i < 100; ++i) {
      const double root = std::sqrt(1.0 + foot * foot);
      foot -= (0.5 * foot * foot + radius / root - (y - 0.125)) / (foot * (1.0 - radius / (root * root * root)));
    }
    const double root = std::sqrt(1.0 + foot * foot);
    const double sliding = x + (1.0 + y - bottom) * std::tan(std::atan(kFriction) + std::atan(foot));
    return Largest({x - foot * (1.0 - radius / root), increment.load_factor - sliding});
  };
  extreme.allowed = std::max(1e-9, 1e-13 / room);  // as the rounding of coordinates turns the reaction
  if (room < kLeastRoom) extreme.ends = {"step_too_small", "not_determined", "numerical_failure"};
  return extreme;
}

// ----- a plank on springs -----

ExtremeCase OnPlank(const Plank& plank, const std::string& group, const std::string& value) {
  ExtremeCase extreme{"surface, " + group, value};
  extreme.request = Until(plank.MakeScene(), "load_factor", ">", 1.0);
  extreme.exact = "closed form";
  extreme.error = [plank](const TraceRequest&, const Increment& increment) { return plank.Error(increment); };
  return extreme;
}

// ----- two blocks -----

// A block of as many columns on another one of as many, both 0.3 high, which is pressed down by 0.05 and moved aside by
// 0.1.
ExtremeCase Blocks(int lower, int upper) {
  ExtremeCase extreme;
  Scene scene;
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3)};
  const auto add = [&](char name, int columns, double x, double y, double width) {
    Solid solid;
    solid.name = std::string(1, name);
    solid.material = "rubber";
    solid.nodes_per_element = 4;
    AddNamedGrid(
        &scene, solid.name, columns, 1, [&](double i, double j) { return Eigen::Vector2d(x + width * i, y + 0.3 * j); },
        solid);
  };
  add('l', lower, 0.0, 0.0, 1.0);
  add('u', upper, 0.2, 0.31, 0.5);
  BoundarySurface surface;
  surface.name = "surface";
  for (int i = 0; i <= lower; ++i) surface.nodes.push_back("l" + std::to_string(2 * i) + "_2");
  scene.surfaces = {surface};
  for (int i = 0; i <= upper; ++i) {
    const std::string column = "u" + std::to_string(2 * i);
    scene.contacts.push_back(Touching(column + "_0", kFriction));
    scene.support_motions.push_back({column + "_2", 0.1, -0.05});
  }
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.y == 0.0 || node.y > 0.6;
  extreme.group = "surface, columns of a block and of the block on it";
  extreme.value = std::to_string(lower) + " and " + std::to_string(upper);
  extreme.long_run = true;
  extreme.request = Until(std::move(scene), "load_factor", ">", 1.0);
  return extreme;
}

// `count` edges of 0.1 and of 0.1 / ratio in turn.
std::vector<double> UnevenEdges(int count, double ratio) {
  std::vector<double> edges;
  for (int i = 0; i < count; ++i) {
    edges.push_back(0.1);
    edges.push_back(0.1 / ratio);
  }
  return edges;
}

}  // namespace

void AddDeformableCases(std::vector<ExtremeCase>* cases) {
  for (const double distance : {1e3, 1e6, 1e9}) {
    Plank plank;
    plank.from_origin = distance;
    ExtremeCase extreme = OnPlank(plank, "distance from the origin", Text(distance) + " of its length");
    extreme.allowed = std::max(1e-9, 1e-14 * distance);  // coordinates are rounded
    if (distance > kFarthest) extreme.ends = {"not_determined", "numerical_failure"};
    cases->push_back(std::move(extreme));
  }
  for (const double stiffness : {1e3, 1e8}) {
    Plank plank;
    plank.springs = 10.0 * stiffness;
    plank.EA = stiffness;
    cases->push_back(OnPlank(plank, "stiffness of a plank, of the spring of the node on it", Text(stiffness)));
  }
  for (const double stiffness : {1e3, 1e8}) {
    Plank plank;
    plank.spring = stiffness;
    plank.push = 0.6 * stiffness;
    cases->push_back(OnPlank(plank, "stiffness of a plank, of the spring of the node on it", Text(1.0 / stiffness)));
  }
  for (const double radius : {1e-9, 1e-3, 1.0, 1e3, 1e6}) {
    PressedNode pressed;
    pressed.radius = radius;
    ExtremeCase extreme = pressed.Case("radius", Text(4.0 * radius) + " of the spacing of its nodes");
    if (radius > kLargestRadius) extreme.ends = {"not_determined", "numerical_failure"};
    cases->push_back(std::move(extreme));
  }
  for (const double room : {0.1, 1e-3, 1e-6, 1e-9}) cases->push_back(InValley(room));
  for (const double ratio : {50.0, 1e4}) {
    PressedNode pressed;
    pressed.edges = UnevenEdges(12, ratio);
    ExtremeCase extreme = pressed.Case("edges in turn", "1 and " + Text(1.0 / ratio));
    if (ratio > kMostUneven) extreme.ends = {"step_too_small", "not_determined"};
    cases->push_back(std::move(extreme));
  }
  for (const double friction : {1e-6, 1e3, 1e6}) {
    PressedNode pressed;
    pressed.friction = friction;
    cases->push_back(pressed.Case("coefficient of friction", "mu = " + Text(friction)));
  }
  for (const double gap : {1e-12, 1e-10, 1e-9, 2e-9, 1e-8, 1e-6}) {
    PressedNode pressed;
    pressed.gap = gap;
    cases->push_back(pressed.Case("gap", Text(gap) + " of the part's length"));
  }
  for (const auto& [lower, upper] : {std::pair(50, 1), std::pair(1, 50)}) cases->push_back(Blocks(lower, upper));
}

}  // namespace contact_path
