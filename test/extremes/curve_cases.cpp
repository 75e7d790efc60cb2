// Curved obstacles far smaller and far larger than the part, and corners that are rounded by next to nothing.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "extremes/extreme_case.h"

namespace contact_path {
namespace {

constexpr double kFriction = 0.3;
// The exact paths go on over any curve. Below, slip on a disc that coordinates resolve counts as rest; on a fillet, in
// the midst of coordinates of the order of 1, their rounding turns the reaction by more than equilibrium admits. The
// tests of diagnosis have the texts.
constexpr double kSmallestDisc = 5e-9, kSmallestFillet = 5e-7;

// A node on springs that 1 presses down onto the obstacle at the origin, and the load factor pushes to the right.
Scene PressedNode(const Obstacle& obstacle) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 1.0, 0.0}, {"p", 0.0, -1.0, true}};
  scene.obstacles = {obstacle};
  scene.contacts = {{"p", obstacle.name}};
  return scene;
}

// Of an increment whose node stands where the surface falls by `slope` [rad]: from the load factor with which it slides
// there, or from rest at the origin, where it sticks.
double LoadError(const Increment& increment, double slope) {
  const double x = increment.positions[0], y = increment.positions[1];
  if (increment.contacts[0].state == ContactState::kStick) return Largest({x, y});
  const double sliding = x + (1.0 + y) * std::tan(std::atan(kFriction) - slope);
  return std::abs(increment.load_factor - sliding) / std::max(1.0, std::abs(sliding));
}

// A case of the pressed node, until its x is `until`. length: what the case is about, in lengths of the part.
ExtremeCase CaseOf(const std::string& group, double length, Obstacle obstacle, double until) {
  obstacle.friction = kFriction;
  ExtremeCase extreme{group, Text(length) + " of the part's length"};
  extreme.request = Until(PressedNode(obstacle), "p.x", ">", until);
  extreme.exact = "closed form";
  return extreme;
}

// On top of a disc, until it has gone half of the way to its side, or 0.5.
ExtremeCase DiscOfRadius(double radius) {
  Obstacle disc;
  disc.name = "disc";
  disc.shape = ObstacleShape::kCircle;
  disc.py = -radius;
  disc.radius = radius;
  ExtremeCase extreme = CaseOf("radius of a disc", radius, disc, 0.5 * std::min(radius, 1.0));
  extreme.error = [radius](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[0], y = increment.positions[1];
    const double drop = -x * x / (radius + std::sqrt(radius * radius - x * x));
    return Largest({LoadError(increment, std::asin(x / radius)), y - drop});
  };
  if (radius < kSmallestDisc) extreme.ends = {"not_determined", "numerical_failure"};
  return extreme;
}

// Over the rounded edge of a table, down a slope of 30 degrees.
ExtremeCase EdgeRoundedBy(double fillet) {
  const double slope = std::acos(-1.0) / 6.0, edge = 0.2;
  Obstacle table;
  table.name = "table";
  table.shape = ObstacleShape::kPolyline;
  table.points = {-1.0, 0.0, edge, 0.0, edge + std::cos(slope), -std::sin(slope)};
  table.fillet = fillet;
  ExtremeCase extreme = CaseOf("fillet of an edge", fillet, table, 0.5);
  extreme.error = [slope, edge, fillet](const TraceRequest&, const Increment& increment) {
    const double cut = fillet * std::tan(0.5 * slope), along = (increment.positions[0] - edge) / std::cos(slope);
    if (increment.positions[0] <= edge - cut) return Largest({LoadError(increment, 0.0), increment.positions[1]});
    if (along >= cut) return Largest({LoadError(increment, slope), increment.positions[1] + along * std::sin(slope)});
    const double angle = std::asin((increment.positions[0] - (edge - cut)) / fillet);
    return Largest(
        {LoadError(increment, angle), increment.positions[1] + 2.0 * fillet * std::pow(std::sin(0.5 * angle), 2)});
  };
  if (fillet < kSmallestFillet) extreme.ends = {"step_too_small", "not_determined", "numerical_failure"};
  return extreme;
}

}  // namespace

void AddCurveCases(std::vector<ExtremeCase>* cases) {
  for (const double radius : {1e-10, 1e-8, 1e-6, 1e-3, 1.0, 1e3, 1e6}) cases->push_back(DiscOfRadius(radius));
  for (const double fillet : {1e-9, 1e-7, 1e-6, 1e-3, 0.1}) cases->push_back(EdgeRoundedBy(fillet));
}

}  // namespace contact_path
