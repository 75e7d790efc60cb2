// Bars through zero length, flat arches, singular starts, mechanisms.
#include <cmath>

#include "branch/example_scenes.h"
#include "extremes/extreme_case.h"
#include "support/reference_cases.h"

namespace contact_path {
namespace {

// A bar from a to b is pushed through a: x from 1 to -1.2. Only with Green-Lagrange strain is its force smooth there.
ExtremeCase ThroughZero(StrainMeasure strain) {
  ExtremeCase extreme{"bar through zero length", std::string(ToString(strain))};
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, true}};
  scene.bars = {{{"a", "b"}, 1.0, 0.0, strain}};
  scene.loads = {{"b", -1.0, 0.0}};
  extreme.exact = "closed form";
  if (strain == StrainMeasure::kLogarithmic) {
    extreme.request = Until(scene, "load_factor", ">", 1e12, 0.0, 3000);  // the load grows without bounds
  } else {
    extreme.request = Until(scene, "b.x", "<", -1.2, 0.0, 3000);
  }
  if (strain == StrainMeasure::kBiot)
    extreme.ends = {"step_too_small", "path_end", "not_determined", "numerical_failure"};
  extreme.error = [strain](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[2];
    if (strain == StrainMeasure::kGreenLagrange) return std::abs(increment.load_factor - 0.5 * x * (1.0 - x * x));
    if (!(x > 0.0)) return HUGE_VAL;
    const double load = strain == StrainMeasure::kBiot ? 1.0 - x : -std::log(x) / x;
    return std::abs(increment.load_factor - load) / std::max(1.0, load);
  };
  return extreme;
}

// A truss of half span 1, held at its apex but for up and down. Its limit load falls with the cube of its rise.
Scene Arch(double rise) {
  Scene scene;
  scene.nodes = {{"left", -1.0, 0.0, true, true}, {"right", 1.0, 0.0, true, true}, {"apex", 0.0, rise, true, false}};
  scene.bars = {{{"left", "apex"}, 1.0}, {{"apex", "right"}, 1.0}};
  scene.loads = {{"apex", 0.0, -1.0}};
  return scene;
}

ExtremeCase FlatArch(double rise) {
  ExtremeCase extreme{"flat arch, relative to its limit load", "rise " + Text(rise) + " of the half span"};
  extreme.request = Until(Arch(rise), "apex.y", "<", -1.1 * rise, std::min(0.02, 0.05 * rise), 3000);
  extreme.exact = "closed form";
  const double limit = von_mises::BiotLimit(1.0, rise);
  // Strains of rise^2 from lengths of 1: this is what rounding leaves of the load.
  extreme.allowed = std::max(1e-9, 1e-14 / (rise * rise));
  extreme.error = [rise, limit](const TraceRequest&, const Increment& increment) {
    // From the difference of the squares of the lengths, which does not cancel.
    const double y = increment.positions[5], l = std::hypot(1.0, y), l0 = std::hypot(1.0, rise);
    const double load = 2.0 * y * (rise - y) * (rise + y) / (l * l0 * (l + l0));
    return std::abs(increment.load_factor - load) / limit;
  };
  return extreme;
}

// Two bars in one line: no stiffness at the start, s = 2 y (1 - 1/l) then.
ExtremeCase Straight() {
  ExtremeCase extreme{"singular start", "two bars in one line"};
  extreme.request = Until(Arch(0.0), "apex.y", "<", -0.5);
  extreme.exact = "closed form";
  extreme.ends = {"path_end", "not_determined", "numerical_failure", "step_too_small"};
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    const double y = -increment.positions[5];
    return std::abs(increment.load_factor - 2.0 * y * (1.0 - 1.0 / std::hypot(1.0, y)));
  };
  return extreme;
}

// A constant load next to the limit load: the path begins close to a singular point.
ExtremeCase NextToLimit(double below) {
  ExtremeCase extreme{"nearly singular start", "constant load " + Text(below) + " below the limit load"};
  Scene scene = Arch(0.5);
  const double constant = (1.0 - below) * von_mises::BiotLimit(1.0, 0.5);
  scene.loads.push_back({"apex", 0.0, -constant, true});
  extreme.request = Until(scene, "apex.y", "<", -0.4);
  extreme.exact = "closed form";
  extreme.error = [constant](const TraceRequest&, const Increment& increment) {
    return std::abs(increment.load_factor + constant - von_mises::BiotLoad(1.0, 0.5, increment.positions[5]));
  };
  if (below < 0.0) extreme.ends = {"path_end"};
  return extreme;
}

// Nothing holds the node across the bar.
ExtremeCase Mechanism() {
  ExtremeCase extreme{"mechanism", "a bar that nothing keeps from turning"};
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}};
  scene.bars = {{{"a", "b"}, 1.0}};
  scene.loads = {{"b", 0.0, 1.0}};
  extreme.request = Until(scene, "load_factor", ">", 1.0);
  extreme.ends = {"path_end"};
  return extreme;
}

// Nothing holds the truss: its feet rest on a smooth floor.
ExtremeCase WithoutSupports() {
  ExtremeCase extreme{"mechanism", "a truss without supports on a smooth floor"};
  Scene scene;
  scene.nodes = {{"left", -1.0, 0.0}, {"right", 1.0, 0.0}, {"apex", 0.0, 0.5}};
  scene.bars = {{{"left", "apex"}, 1.0}, {{"apex", "right"}, 1.0}};
  scene.loads = {{"apex", 0.0, -1.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}};
  scene.contacts = {{"left", "floor"}, {"right", "floor"}};
  extreme.request = Until(scene, "load_factor", ">", 1.0);
  extreme.ends = {"path_end"};
  return extreme;
}

// A node that passes under the top of a circle, without load, and a ceiling as high as that.
ExtremeCase Tangential(double clearance, double friction) {
  ExtremeCase extreme{"obstacle tangential to the way of the node",
                      "clearance " + Text(clearance) + ", mu = " + Text(friction)};
  extreme.request = Until(swing::MakeScene(clearance, friction), "apex.y", "<", 0.7);
  extreme.exact = "closed form";
  // A ceiling that is lower than the top presses with that much.
  extreme.allowed = 1e-9 + 10.0 * std::max(0.0, -clearance);
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[8] - swing::kCentreX, y = increment.positions[9] - swing::kCentreY;
    return Largest({increment.load_factor - von_mises::BiotLoad(1.0, 1.0, increment.positions[3]),
                    std::hypot(x, y) - swing::kRadius, increment.contacts[0].rn});
  };
  return extreme;
}

}  // namespace

void AddGeometryCases(std::vector<ExtremeCase>* cases) {
  for (const StrainMeasure strain : {StrainMeasure::kGreenLagrange, StrainMeasure::kBiot, StrainMeasure::kLogarithmic})
    cases->push_back(ThroughZero(strain));
  for (const double rise : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) cases->push_back(FlatArch(rise));
  cases->push_back(Straight());
  for (const double below : {1e-2, 1e-6, 1e-9, -1e-6}) cases->push_back(NextToLimit(below));
  cases->push_back(Mechanism());
  cases->push_back(WithoutSupports());
  for (const double clearance : {-1e-12, 0.0, 1e-12, 1e-9, 1e-6})
    for (const double friction : {0.0, 0.5}) cases->push_back(Tangential(clearance, friction));
}

}  // namespace contact_path
