// Stiffnesses, units and loads of very different size.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/scaling.h"
#include "extremes/extreme_case.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path {
namespace {

// A soft and a stiff bar in a row press a node onto a wall.
ExtremeCase Chain(double soft, double stiff) {
  static constexpr double kGap = 0.05;
  ExtremeCase extreme{"stiffnesses in a row", "EA = " + Text(soft) + " and " + Text(stiff)};
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, true}, {"c", 2.0, 0.0, false, true}};
  scene.bars = {{{"a", "b"}, soft}, {{"b", "c"}, stiff}};
  scene.loads = {{"c", 1.0, 0.0}};
  scene.obstacles = {{"wall", ObstacleShape::kHalfPlane, 2.0 + kGap, 0.0, -1.0, 0.0, 0.0}};
  scene.contacts = {{"c", "wall"}};
  const double compliance = 1.0 / soft + 1.0 / stiff, at_wall = kGap / compliance;
  extreme.request = Until(scene, "load_factor", ">", 3.0 * at_wall);
  extreme.ends = {"step_too_small", "not_determined", "numerical_failure"};
  // The force of the stiff bar is known to the rounding of its length, and that of the soft one is as small as it is.
  extreme.allowed = std::max(1e-9, 10.0 * std::numeric_limits<double>::epsilon() * stiff / at_wall);
  extreme.allowed_regularised = std::max(extreme.allowed_regularised, extreme.allowed);
  extreme.exact = "closed form";
  extreme.error = [compliance, at_wall](const TraceRequest&, const Increment& increment) {
    const double s = increment.load_factor, moved = std::min(s * compliance, kGap);
    const double reaction = std::max(0.0, s - at_wall);
    return Largest({increment.positions[4] - 2.0 - moved, (increment.contacts[0].rn - reaction) / at_wall});
  };
  return extreme;
}

// scenes/two_dof_friction.yaml, with a bar of another stiffness that stands beside it and does nothing.
ExtremeCase BesideABar(double stiffness) {
  ExtremeCase extreme{"stiffness beside, sticking and sliding", "EA / k = " + Text(stiffness)};
  TraceRequest example = ReadExample("two_dof_friction");
  Scene scene = example.scene;
  scene.nodes.push_back({"beside", 5.0, 0.0, true, true});
  scene.nodes.push_back({"beside_too", 6.0, 0.0, false, true});
  scene.bars = {{{"beside", "beside_too"}, stiffness}};
  const std::size_t node = 2 * NodeNumber(scene, scene.contacts[0].node);
  const double x0 = scene.nodes[node / 2].x;
  extreme.request = example;
  extreme.request.scene = scene;
  extreme.request.options = {};
  extreme.request.options.stop = {{scene.contacts[0].node + ".x", ">", x0 + 1.0}};
  extreme.exact = "closed form";
  extreme.ends = {"not_determined", "numerical_failure", "step_too_small"};
  extreme.error = [node, x0](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[node] - x0, y = increment.positions[node + 1], s = increment.load_factor;
    switch (increment.contacts[0].state) {
      case ContactState::kStick: return Largest({x, y, std::max(0.0, s - 1.0)});
      case ContactState::kSlipPlus: return Largest({s - (1.0 - 0.5 * x), y, std::max(0.0, x - 2.0 / 3.0)});
      case ContactState::kOpen: return Largest({s - 2.0 / 3.0 - 0.4375 * (x - 2.0 / 3.0)});
      default: return HUGE_VAL;
    }
  };
  extreme.allowed = 1e-8;
  return extreme;
}

// scenes/rough_truss.yaml on the same load as a stiff truss of its own.
ExtremeCase TrussBesideABar(double stiffness) {
  ExtremeCase extreme{"stiffness beside, corner limit point", "EA ratio " + Text(stiffness)};
  TraceRequest example = ReadExample("rough_truss");
  Scene scene = example.scene;
  scene.nodes.push_back({"beside", 5.0, 0.0, true, true});
  scene.nodes.push_back({"beside_too", 6.0, 0.0, false, true});
  scene.bars.push_back({{"beside", "beside_too"}, stiffness});
  const std::size_t foot = 2 * NodeNumber(scene, scene.contacts[0].node);
  const std::size_t apex = 2 * NodeNumber(scene, scene.loads[0].node);
  extreme.request = example;
  extreme.request.scene = scene;
  extreme.request.options = {};
  extreme.request.options.stop = {{scene.contacts[0].node + ".x", ">", 1.15}};
  extreme.request.options.max_increments = 20000;
  extreme.exact = "closed form";
  extreme.ends = {"not_determined", "numerical_failure"};
  extreme.error = [foot, apex](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[foot];
    if (increment.contacts[0].state == ContactState::kSlipPlus)
      return std::abs(increment.load_factor - rough_truss::SlidingLoad(x));
    if (increment.contacts[0].state != ContactState::kStick) return HUGE_VAL;
    return Largest({increment.load_factor - rough_truss::StickingLoad(increment.positions[apex + 1]), x - 1.0});
  };
  extreme.allowed = 1e-8;
  return extreme;
}

// What scenes in other units are compared with: traced once for all of them.
const TracedPath& Reference(const std::string& name, const TraceRequest& request) {
  static std::map<std::string, TracedPath> paths;
  const TraceOptions& options = request.options;
  const std::string key =
      name + ' ' + std::string(ToString(options.method)) + ' ' + std::string(ToString(options.accuracy));
  const auto found = paths.find(key);
  return found != paths.end() ? found->second : paths.emplace(key, TraceIncrements(request)).first->second;
}

// The increment of the path at this arc length, or null.
const Increment* AtArcLength(const std::vector<Increment>& path, double arc_length) {
  const auto found = std::find_if(path.begin(), path.end(), [&](const Increment& increment) {
    return std::abs(increment.arc_length - arc_length) <= 1e-9;
  });
  return found != path.end() ? &*found : nullptr;
}

// A scene in other units has the path of the scene in units of order 1, increment by increment. By mpec, rounding
// decides whether Ipopt solves a step that goes over a corner, and with it where the increments of the second half lie
// on that path: an increment without a counterpart at its arc length has to pass the check, as all have.
ExtremeCase Units(const std::string& name, double length, double force) {
  ExtremeCase extreme{"units", name + ", lengths x " + Text(length) + ", forces x " + Text(force)};
  TraceRequest request = ReadExample(name);
  request.options.max_increments = 150;
  extreme.request = ChangeUnits(request, length, force);
  extreme.exact = "the path in units of order 1";
  extreme.error = [name, request, length, force](const TraceRequest& as_run, const Increment& increment) {
    TraceRequest same = request;
    same.options.method = as_run.options.method;
    same.options.accuracy = as_run.options.accuracy;
    const Scaling scales = CharacteristicScales(Expand(request).request.scene);
    const std::vector<Increment>& reference = Reference(name, same).increments;
    const auto index = static_cast<std::size_t>(increment.index);
    const Increment* counterpart = index < reference.size() ? &reference[index] : nullptr;
    if (same.options.method == Method::kMpec && 2 * increment.index >= reference.back().index) {
      counterpart = AtArcLength(reference, increment.arc_length);
      if (counterpart == nullptr) return 0.0;
    }
    if (counterpart == nullptr) return HUGE_VAL;
    const Increment& other = *counterpart;
    double error = std::abs(increment.load_factor - other.load_factor) / scales.load_factor;
    for (std::size_t i = 0; i < increment.positions.size(); ++i)
      error = Largest({error, (increment.positions[i] / length - other.positions[i]) / scales.length});
    for (std::size_t i = 0; i < increment.rotations.size(); ++i)
      error = Largest({error, increment.rotations[i] - other.rotations[i]});
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      error = Largest({error, (increment.contacts[i].rn / force - other.contacts[i].rn) / scales.force});
      if (increment.contacts[i].state != other.contacts[i].state) error = HUGE_VAL;
    }
    return error;
  };
  return extreme;
}

// Two loads at one node that all but cancel, and a load factor as large as that makes it: k x = s p up to a stop.
ExtremeCase Cancelling(double difference) {
  ExtremeCase extreme{"loads that nearly cancel",
                      "difference " + Text(difference) + ", s up to " + Text(2.0 / difference)};
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 1.0 + difference, 0.0}, {"p", -1.0, 0.0}};
  scene.obstacles = {{"stop", ObstacleShape::kHalfPlane, 1.0, 0.0, -1.0, 0.0, 0.5}};
  scene.contacts = {{"p", "stop"}};
  const double load = (1.0 + difference) - 1.0;
  // L is the sum of the loads over k, and at least 1e-4 of the way to the stop.
  extreme.request = Until(scene, "load_factor", ">", 2.0 / difference, 0.1 / std::max(difference, 1e-4));
  extreme.exact = "closed form";
  extreme.error = [load](const TraceRequest&, const Increment& increment) {
    const double force = load * increment.load_factor;
    return Largest(
        {increment.positions[0] - std::min(force, 1.0), increment.contacts[0].rn - std::max(0.0, force - 1.0)});
  };
  return extreme;
}

}  // namespace

void AddNumberCases(std::vector<ExtremeCase>* cases) {
  for (const double ratio : {1.0, 1e6, 1e12}) cases->push_back(Chain(1.0 / std::sqrt(ratio), std::sqrt(ratio)));
  for (const double stiffness : {1e-12, 1e-6, 1.0, 1e3, 1e6, 1e9, 1e12}) cases->push_back(BesideABar(stiffness));
  for (const double stiffness : {1e-12, 1e-6, 1e6, 1e12}) cases->push_back(TrussBesideABar(stiffness));
  for (const char* const name : {"sliding_bar", "rough_truss", "arch19"})
    for (const auto& [length, force] : {std::pair<double, double>{1e-9, 1e9}, {1e9, 1e-9}, {1e9, 1e9}, {1e-9, 1e-9}})
      cases->push_back(Units(name, length, force));
  for (const char* const name : {"lee_frame", "portal_frame", "cantilever_block"})
    for (const auto& [length, force] : {std::pair<double, double>{1e3, 1.0}, {1e-9, 1e9}, {1e9, 1e-9}})
      cases->push_back(Units(name, length, force));
  for (const double difference : {1e-3, 1e-9, 1e-12}) cases->push_back(Cancelling(difference));
}

}  // namespace contact_path
