#include "ros/drawn_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

#include "contact_path/path/stop.h"
#include "contact_path/scene/cell.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/elasticity.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/one_line.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/structure/scene_elements.h"
#include "ros/marker_style.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;
using Eigen::Vector2d;

constexpr double kRounding = 1e-6;  // of sums of unit vectors

// Where an element holds its first node; at the start, unless its description tells.
template <typename Part>
Vector2d RestOfFirstNode(const Part&, const Vector2d& start) {
  return start;
}
Vector2d RestOfFirstNode(const Superelement& element, const Vector2d& start) {
  const std::vector<double>& rest = element.rest_positions;
  return rest.empty() ? start : Vector2d(rest[0], rest[1]);
}

}  // namespace

Vector2d MiddleOf(const std::vector<std::size_t>& nodes, const NodePlaces& places) {
  Vector2d sum = Vector2d::Zero();
  for (const std::size_t node : nodes) sum += places[node];
  return sum / static_cast<double>(nodes.size());
}

NodePlaces DrawnSurface::PlacesIn(const NodePlaces& places) const {
  NodePlaces own;
  for (const std::size_t node : nodes) own.push_back(places[node]);
  return own;
}

BoundaryCurve DrawnSurface::At(const NodePlaces& places) const { return {PlacesIn(places), closed, radius, across}; }

DrawnScene::DrawnScene(const TraceRequest& request_given) : name(OneLine(request_given.scene.name)) {
  const ExpandedRequest expanded(request_given);
  const TraceRequest& request = expanded.Get();
  const Scene& scene = request.scene;
  const SceneIndex index(scene);
  for (const Node& node : scene.nodes) {
    initial.emplace_back(node.x, node.y);
    box.extend(initial.back());
  }
  inner.assign(initial.size(), false);
  AddElements(scene, index);
  FindSupports(scene);
  reacting = SupportedNodes(scene);
  AddContacts(scene, index);
  has_program = !request.program.empty();
  num_stages = NumStages(request);
  stages_ = std::make_unique<const DrawnStages>(request);
  ExtendBoxBySupports(request, index);

  const Scaling scales = StageScales(request, index, 0, ProgramScales(request, index));
  ExtendBoxByStops(request, index, kStyle.farthest_stop * std::max(box.diagonal().norm(), scales.length));
  const double diagonal = box.diagonal().norm();
  size = diagonal > 0.0 ? diagonal : scales.length;
  detail = std::min(0.025 * size, bars.empty() && segments.empty() ? size : 0.12 * scales.length);
  if (!cells.empty()) detail = std::min(detail, 0.12 * CellSize());
  least_force = 1e-3 * scales.force;
}

void DrawnScene::AddContacts(const Scene& scene, const SceneIndex& index) {
  std::map<std::size_t, std::size_t> drawn;  // surfaces of the scene
  for (const ContactCandidate& contact : scene.contacts) {
    const std::size_t node = index.Node(contact.node);
    if (!contact.OnSurface()) {
      const std::size_t obstacle = index.Obstacle(contact.obstacle);
      contacts.push_back({node, false, obstacle, scene.obstacles[obstacle].friction});
      continue;
    }
    const BoundarySurface& surface = scene.surfaces[index.Surface(contact.surface)];
    const auto [at, is_new] = drawn.try_emplace(index.Surface(contact.surface), surfaces.size());
    if (is_new) {
      const auto node_of = [&](const std::string& of) -> const Node& { return scene.nodes[index.Node(of)]; };
      surfaces.push_back({{}, surface.closed, surface.radius, SymmetryAxes(surface, scene, node_of)});
      for (const std::string& node_name : surface.nodes) surfaces.back().nodes.push_back(index.Node(node_name));
    }
    const NodePlaces places = surfaces[at->second].PlacesIn(initial);
    contacts.push_back({node, true, at->second, contact.friction,
                        PatchesFor(contact.node, surface, places, surfaces[at->second].across)});
  }
}

void DrawnScene::AddElements(const Scene& scene, const SceneIndex& index) {
  ForEachElementList(scene, [&](std::string_view, const auto& elements) {
    using Part = typename std::decay_t<decltype(elements)>::value_type;
    for (const Part& element : elements) {
      if constexpr (std::is_same_v<Part, Solid>) {
        AddMesh(element, scene, index);
      } else if constexpr (std::is_same_v<Part, Beam>) {
        AddBeam(element, index);
      } else if constexpr (Fields<Part>::kNodes == 2) {
        bars.push_back({index.Node(element.nodes[0]), index.Node(element.nodes[1])});
      } else {
        std::vector<std::size_t>& members = stars.emplace_back();
        for (const std::string& node : element.nodes) members.push_back(index.Node(node));
        rest.push_back(RestOfFirstNode(element, initial[members[0]]));
      }
    }
  });
}

void DrawnScene::AddBeam(const Beam& beam, const SceneIndex& index) {
  const std::size_t count = beam.nodes.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    DrawnSegment& segment = segments.emplace_back();
    segment.nodes = {index.Node(beam.nodes[i]), index.Node(beam.nodes[i + 1])};
    segment.chord = initial[segment.nodes[1]] - initial[segment.nodes[0]];
    segment.turn = beam.angle / static_cast<double>(count);
    segment.hinged = {!TurnsNode(beam, i), !TurnsNode(beam, i + 1)};
    if (i > 0) inner[segment.nodes[0]] = true;
  }
}

void DrawnScene::AddMesh(const Solid& solid, const Scene& scene, const SceneIndex& index) {
  const double modulus = YoungModulus(LameOf(scene.materials[index.Material(solid.material)]));
  for (PlacedSolidElement& placed : MakeSolidElements(solid, scene, index, Configuration::Of(scene).reference)) {
    DrawnCell cell;
    cell.nodes.assign(placed.nodes.begin(), placed.nodes.end());
    for (const std::size_t local : CellBoundary(cell.nodes.size())) cell.boundary.push_back(cell.nodes[local]);
    std::vector<double> positions;
    for (const std::size_t node : cell.nodes) positions.insert(positions.end(), {initial[node].x(), initial[node].y()});
    for (const PlacedPoint& point : PlacePoints(positions)) cell.area += point.area;
    cell.element = std::move(placed.element);
    cell.full_energy = kStyle.full_energy * modulus * cell.area * solid.Thickness();
    cells.push_back(std::move(cell));
  }
}

double DrawnScene::CellSize() const {
  double area = 0.0;
  for (const DrawnCell& cell : cells) area += cell.area;
  return std::sqrt(area / static_cast<double>(cells.size()));
}

void DrawnScene::ExtendBoxBySupports(const TraceRequest& request, const SceneIndex& index) {
  std::map<std::size_t, Vector2d> moved;  // by node: how far
  for (const Stage& stage : request.program) {
    // Back towards where the supports were at first: the box knows these places.
    if (stage.unload)
      for (auto& [node, by] : moved) by *= 1.0 - stage.Target();
    for (const SupportMotion& motion : stage.support_motions) {
      const std::size_t node = index.Node(motion.node);
      Vector2d& by = moved.try_emplace(node, Vector2d::Zero()).first->second;
      by += stage.Target() * Vector2d(motion.dx, motion.dy);
      box.extend(initial[node] + by);
    }
  }
}

// The ground is where no bars are, as far as the fixed components let it be.
void DrawnScene::FindSupports(const Scene& scene) {
  NodePlaces inwards(initial.size(), Vector2d::Zero());
  const auto join = [&](std::size_t a, std::size_t b) {
    const Vector2d along = (initial[b] - initial[a]).stableNormalized();
    inwards[a] += along;
    inwards[b] -= along;
  };
  for (const auto& [a, b] : bars) join(a, b);
  for (const DrawnSegment& segment : segments) join(segment.nodes[0], segment.nodes[1]);
  for (const DrawnCell& cell : cells) {
    const Vector2d middle = MiddleOf(cell.nodes, initial);
    for (const std::size_t node : cell.nodes) inwards[node] += (middle - initial[node]).stableNormalized();
  }
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!node.fixed_x && !node.fixed_y) continue;
    NodePlaces directions;
    if (node.fixed_y) directions = {{0.0, -1.0}, {0.0, 1.0}};
    if (node.fixed_x) directions.insert(directions.end(), {{-1.0, 0.0}, {1.0, 0.0}});
    Vector2d ground = directions.front();
    for (const Vector2d& direction : directions) {
      if (direction.dot(inwards[i]) < ground.dot(inwards[i]) - kRounding) ground = direction;
    }
    supports.push_back({i, ground, !(node.fixed_x && node.fixed_y)});
  }
}

// By the places that nodes are to reach: where stop criteria lie, unless that is farther than `reach` from the start.
void DrawnScene::ExtendBoxByStops(const TraceRequest& request, const SceneIndex& index, double reach) {
  const std::vector<Quantity> quantities = StopQuantities(request, index);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Quantity& quantity = quantities[i];
    if (!quantity.IsOfNode()) continue;
    const Vector2d& start = initial[quantity.part];
    Vector2d place = start;
    (quantity.kind == Quantity::Kind::kX ? place.x() : place.y()) = request.options.stop[i].value;
    if ((place - start).norm() <= reach) box.extend(place);
  }
}

std::shared_ptr<const DrawnStage> DrawnScene::StageOf(const msgs::Increment& increment) const {
  return stages_->At(has_program ? increment.stage - 1 : 0);
}

bool DrawnScene::Fits(const msgs::Increment& increment) const {
  const bool of_a_stage = has_program ? increment.stage >= 1 && increment.stage <= num_stages : increment.stage == 0;
  return of_a_stage && increment.x.size() == initial.size() && increment.y.size() == initial.size() &&
         (segments.empty() || increment.rotation.size() == initial.size()) &&
         increment.contacts.size() == contacts.size() &&
         (increment.supports.empty() || increment.supports.size() == reacting.size());
}

double DrawnScene::LargestForce(const msgs::Increment& increment) const {
  double largest = 0.0;
  const std::shared_ptr<const DrawnStage> stage = StageOf(increment);
  for (const DrawnLoad& load : stage->loads) {
    const double share = std::abs(load.Share(increment.load_factor));
    largest = std::max({largest, share * load.force.norm(), share * std::abs(load.moment) / size});
  }
  for (const msgs::ContactState& contact : increment.contacts)
    largest = std::max(largest, std::hypot(contact.rn, contact.rt));
  for (const msgs::Resultant& reaction : increment.supports)
    largest = std::max({largest, std::hypot(reaction.rx, reaction.ry), std::abs(reaction.rm) / size});
  return largest;
}

msgs::Increment DrawnScene::Initial() const {
  msgs::Increment increment;
  increment.stage = has_program ? 1 : 0;
  for (const Vector2d& place : initial) {
    increment.x.push_back(place.x());
    increment.y.push_back(place.y());
  }
  increment.rotation.resize(segments.empty() ? 0 : initial.size());
  increment.contacts.resize(contacts.size());
  return increment;
}

}  // namespace contact_path
