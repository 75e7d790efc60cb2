#include "contact_path/path/trace_end.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/path/free_motion.h"
#include "contact_path/path/sentences.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/surface.h"
#include "contact_path/scene/text.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr std::size_t kListed = 3;    // in a message
constexpr double kDeep = 1e-3;        // of the characteristic length: what is not as deep in an obstacle is not told
constexpr double kWeight = 0.1;       // share of other loads from which on constant ones are no disturbance
constexpr double kExactLoads = 1e-6;  // error of loads, of them, that goes without a remark

bool EndedBeforeItsEnd(EndReason reason) {
  return reason == EndReason::kMaxIncrements || reason == EndReason::kClosedPath;
}

// Nodes that nothing holds: where no branch leads on, and where the path wanders about without a load.
Causes WhatMovesFreely(const EndedTrace& trace) {
  if (trace.model == nullptr) return {};
  const bool stuck = IsStuck(trace.reason);
  const bool wanders =
      EndedBeforeItsEnd(trace.reason) && std::abs(trace.point.s) <= tolerances::kSamePoint * trace.largest_load;
  if (!stuck && !wanders) return {};
  const double force = ActiveSetTolerance::For(trace.largest_reaction, trace.point.s).force;
  const std::string text = stuck && trace.recorder.increments() <= 1
                               ? FreeMotionQuestion(*trace.model, trace.point, force)
                               : FreeMotionText(*trace.model, trace.point, force);
  if (text.empty()) return {};
  return {{wanders ? sentences::kFreeWithoutLoad : sentences::kFreeNodes, text}};
}

// Behind a curve; 0 on its admissible side, and past an end of it.
double DepthIn(const Surface& surface, const Eigen::Vector2d& x) {
  const NearestFoot nearest = surface.Nearest(x);
  return nearest.is_end || nearest.is_away ? 0.0 : std::max(0.0, -surface.Project(x, nearest.patch).gap);
}

// Names the nodes that are deepest in obstacles for which they are no candidates and in which they were not at the
// start.
Causes NodesInObstacles(const EndedTrace& trace) {
  const Scene& start = trace.request.scene;
  if (trace.model == nullptr || trace.reason == EndReason::kMemoryLimit || start.obstacles.empty()) return {};
  const Model& model = *trace.model;
  std::set<std::pair<std::string_view, std::string_view>> candidates;
  std::set<std::string_view> slides;  // no places
  for (const ContactCandidate& contact : model.scene.contacts) {
    candidates.emplace(contact.node, contact.obstacle);
    if (contact.at_eye) slides.insert(contact.node);
  }
  const CheckedState state = model.InSceneUnits(trace.point);
  const auto place_of = [&](std::size_t node) {
    return Eigen::Vector2d(state.positions[2 * node], state.positions[2 * node + 1]);
  };
  const std::vector<Obstacle> now = ObstaclesAt(model.scene, model.index, trace.point.s * model.scaling.load_factor);
  const double least = kDeep * model.scaling.length;
  // By depth in thousandths of the least one: equal depths stay in the order of the scene, whatever rounding makes of
  // them.
  std::vector<std::pair<long long, std::string>> inside;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const std::unique_ptr<const Surface> before = MakeSurface(start.obstacles[k]), after = MakeSurface(now[k]);
    const std::optional<std::size_t> body =
        now[k].body.empty() ? std::nullopt : std::optional(model.index.Node(now[k].body));
    for (std::size_t i = 0; i < start.nodes.size(); ++i) {
      const Node& node = start.nodes[i];
      if (slides.count(node.name) > 0) continue;
      Eigen::Vector2d place = place_of(i);
      if (body)  // as the body sees it, where it was at the start
        place = Eigen::Rotation2D(-state.rotations[*body]) * (place - place_of(*body)) +
                Eigen::Vector2d(start.nodes[*body].x, start.nodes[*body].y);
      const double depth = DepthIn(*after, place);
      if (depth > least && DepthIn(*before, {node.x, node.y}) <= least &&
          candidates.count({node.name, now[k].name}) == 0)
        inside.emplace_back(std::llround(-1e3 * depth / least),
                            node.name + " into " + now[k].name + " by " + RoundedText(depth));
    }
  }
  if (inside.empty()) return {};
  std::stable_sort(inside.begin(), inside.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> deepest;
  deepest.reserve(inside.size());
  for (auto& [depth, text] : inside) deepest.push_back(std::move(text));
  return {{sentences::kInObstacles, Listed(deepest, kListed, ", ")}};
}

// Names the most slender beam, where it is so stiff along its axis that its bending drowns in rounding.
Causes SlenderBeam(const Scene& scene, const SceneIndex& index) {
  double most = 1.0 / tolerances::kRootOfRounding;  // beyond, rounding of the axial force hides the bending
  Causes found;
  for (const Beam& beam : scene.beams) {
    const Node &first = scene.nodes[index.Node(beam.nodes.front())], &last = scene.nodes[index.Node(beam.nodes.back())];
    const double length = std::hypot(last.x - first.x, last.y - first.y);
    const double slender = beam.EA * length * length / beam.EI;
    if (!(slender > most)) continue;
    most = slender;
    found = {{sentences::kSlenderBeam, beam.name, slender}};
  }
  return found;
}

// Where constant loads are a weight, and not a disturbance of others, and rounding of the coordinates of stiff parts
// makes forces that are more than a millionth of them: how large these are.
Causes LightLoads(const Model& model) {
  const double weight = model.structure.Loads().Constant().norm();
  const double rounding = model.structure.NumDofs() > 0 ? model.structure.ForceRounding().maxCoeff() : 0.0;
  if (IsDriven(model.scene) || !(weight * model.scaling.load_factor >= kWeight) || !(rounding > kExactLoads * weight))
    return {};
  return {{sentences::kLightLoads, {}, rounding / weight}};
}

// Parts that are too stiff for the path to be trusted, or to be found.
Causes StiffParts(const EndedTrace& trace) {
  Causes stiff = IsNumerical(trace.reason) ? SlenderBeam(trace.request.scene, trace.index) : Causes();
  Append(LockingSolids(trace.request.scene, trace.index), &stiff);
  if (trace.model != nullptr) Append(LightLoads(*trace.model), &stiff);
  return stiff;
}

// The end that the user had in mind, where the path did not come to it. stage: of the last increment.
Causes MissedEnd(const TraceRequest& request, int stage) {
  const auto stages = static_cast<long>(request.program.size());
  if (stages > 0) return {{sentences::kMissedTarget, {}, stage, stages}};
  std::vector<std::string> criteria;
  for (const StopCriterion& criterion : request.options.stop) criteria.push_back(ToText(criterion));
  if (criteria.empty()) return {{sentences::kNoCriterion}};
  if (criteria.size() > kListed) {
    criteria.resize(kListed);
    criteria.emplace_back("...");
  }
  return {{sentences::kMissedCriteria, Listed(criteria)}};
}

// Choices of branches that the path never came to.
Causes MissedChoices(const EndedTrace& trace) {
  const TraceOptions& options = trace.request.options;
  std::vector<std::string> missed;
  for (const BranchChoice& choice : options.branch_choices)
    if (choice.event > trace.events || (choice.event == 0 && choice.increment >= trace.recorder.increments()))
      missed.push_back(PlaceOf(choice));
  if (missed.empty() || !options.LocatesEvents()) return {};
  return {{sentences::kMissedChoices, Listed(missed)}};
}

// Whether all nodes have moved by one vector, by more than rounding. A part that swings about a support may come round
// to an obstacle again.
bool IsShifted(const Model& model, const PathPoint& before, const PathPoint& now) {
  const std::vector<double> from = model.InSceneUnits(before).positions, to = model.InSceneUnits(now).positions;
  const double rounding = tolerances::kActive * model.scaling.length;
  double apart = 0.0;
  for (std::size_t i = 2; i < to.size(); ++i)
    apart = std::max(apart, std::abs((to[i] - from[i]) - (to[i % 2] - from[i % 2])));
  return apart <= rounding && std::hypot(to[0] - from[0], to[1] - from[1]) > rounding;
}

// Whether a gap has become smaller, by more than rounding.
bool Approaches(const Model& model, const PathPoint& before, const PathPoint& now) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactPair& contact = *model.contacts[i];
    const double gap = contact.Nearest(now.u, now.s).distance;
    if (gap < contact.Nearest(before.u, before.s).distance - tolerances::kActive) return true;
  }
  for (std::size_t i = model.contacts.size(); i < model.laws.size(); ++i)
    if (model.laws[i].Reach(now.u, now.s) < model.laws[i].Reach(before.u, before.s) - tolerances::kActive) return true;
  return false;
}

}  // namespace

std::optional<Cause> Escape(const Model& model, const PathPoint& before, const PathPoint& now,
                            std::optional<double> target, double largest_load, bool may_snap) {
  bool opened = !model.contacts.empty();
  for (std::size_t i = 0; i < model.laws.size(); ++i)
    opened = opened && (model.laws[i].In(now.modes[i]).idle || !model.laws[i].CanBeIdle());
  if (!opened) return std::nullopt;
  // The load of a structure that snaps may come back.
  const bool away = target && now.s * *target < 0.0 && std::abs(now.s) > std::abs(*target) &&
                    std::abs(now.s) > std::abs(before.s) && !may_snap;
  if (away) return Cause{sentences::kOpenBeyondTarget};
  const double unloaded = tolerances::kSamePoint * largest_load;
  const bool drifts = std::abs(before.s) <= unloaded && std::abs(now.s) <= unloaded && IsShifted(model, before, now);
  if (!drifts || Approaches(model, before, now)) return std::nullopt;
  return Cause{sentences::kOpenAndDrifts};
}

Causes RemarksAtEnd(const EndedTrace& trace) {
  Causes all = EndedBeforeItsEnd(trace.reason) ? MissedEnd(trace.request, trace.recorder.increment().stage) : Causes();
  for (const Causes& remarks : {WhatMovesFreely(trace), trace.recorder.Remarks(), trace.of_methods, StiffParts(trace),
                                MissedChoices(trace), NodesInObstacles(trace)})
    Append(remarks, &all);
  return all;
}

}  // namespace contact_path
