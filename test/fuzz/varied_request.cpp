#include "fuzz/varied_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/boundary_curve.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/validate.h"
#include "support/curved_obstacles.h"
#include "support/decisions.h"
#include "support/random.h"
#include "support/random_bodies.h"
#include "support/random_scene.h"
#include "support/transformations.h"

namespace contact_path {
namespace {

class Variation {
 public:
  Variation(std::function<std::uint64_t()> bits, bool quick)
      : quick_(quick),
        random_(std::move(bits)),
        request_(quick ? RandomRequest(&random_, "varied", 5, 2) : RandomRequest(&random_, "varied")) {}

  TraceRequest Build() {
    Try(0.3, &Variation::SnapToGrid);
    Try(0.2, &Variation::ChangeFriction);
    Try(0.2, &Variation::SpreadStiffness);
    Try(0.2, &Variation::AddSuperelement);
    Try(0.2, &Variation::AddObstacleForContact);
    Try(0.15, &Variation::ChangeLoads);
    Try(0.15, &Variation::MoveObstacle);
    Try(0.15, &Variation::MoveSupport);
    Try(0.2, &Variation::MakeProgram);
    Try(0.2, &Variation::ChangeUnits);
    Try(0.5, &Variation::ChangeOptions);
    TraceOptions& options = request_.options;
    const bool mpec = options.method == Method::kMpec;
    options.max_increments = static_cast<int>(1 + random_.Index(quick_ ? (mpec ? 3 : 15) : (mpec ? 12 : 60)));
    if (quick_ && options.step > 0.0) options.step = std::max(options.step, 1e-3);
    // New choices stand last: those above stay what they were.
    Try(0.3, &Variation::AddBeam);
    Try(0.2, &Variation::AddSolid);
    Try(0.3, &Variation::LoadParts);
    Try(0.2, &Variation::TouchWithParts);
    Try(0.4, &Variation::BendObstacles);
    Try(0.2, &Variation::TurnObstacles);
    Try(0.4, &Variation::TouchSurface);
    switch (random_.Index(9)) {
      case 1: Try(1.0, &Variation::TakeTotalLaw); break;
      case 2: Try(1.0, &Variation::TakeBodies); break;
      default: break;
    }
    return std::move(request_);
  }

 private:
  // Takes a change back that breaks a rule.
  void Try(double probability, void (Variation::*change)()) {
    if (!random_.Chance(probability)) return;
    TraceRequest before = request_;
    (this->*change)();
    if (!Validate(request_).empty()) request_ = std::move(before);
  }

  Scene& scene() { return request_.scene; }

  void SnapToGrid() {
    const double cell = random_.OneOf(std::array<double, 3>{0.125, 0.25, 0.5});
    const auto snap = [cell](double* x) { *x = cell * std::round(*x / cell); };
    for (Node& node : scene().nodes) {
      snap(&node.x);
      snap(&node.y);
    }
    for (Obstacle& obstacle : scene().obstacles) {
      const double quarter = std::atan(1.0);  // normals along the axes and diagonals
      const double angle = quarter * std::round(std::atan2(obstacle.ny, obstacle.nx) / quarter);
      obstacle.nx = std::round(2.0 * std::cos(angle));
      obstacle.ny = std::round(2.0 * std::sin(angle));
      snap(&obstacle.px);
      snap(&obstacle.py);
    }
    for (Load& load : scene().loads) {
      snap(&load.fx);
      snap(&load.fy);
    }
  }

  void ChangeFriction() {
    for (Obstacle& obstacle : scene().obstacles)
      if (random_.Chance(0.7))
        obstacle.friction = random_.OneOf(std::array<double, 7>{0, 1e-12, 1e-3, 1, 10, 1e3, 1e6});
  }

  void SpreadStiffness() {
    const double decades = random_.OneOf(std::array<double, 3>{1.0, 3.0, 6.0});
    for (Bar& bar : scene().bars) bar.EA *= std::pow(10.0, random_.Number(-decades, decades));
  }

  // A spring to the ground, at times of no or of negative stiffness in one direction.
  void AddSuperelement() {
    const double angle = random_.Number(0.0, 3.2), c = std::cos(angle), s = std::sin(angle);
    const double k1 = random_.OneOf(std::array<double, 3>{0.1, 1.0, 10.0});
    const double k2 = random_.OneOf(std::array<double, 4>{0.0, 1.0, -0.05, 1e4});
    const double xy = (k1 - k2) * c * s;
    scene().superelements.push_back(
        {{random_.OneOf(scene().nodes).name}, {k1 * c * c + k2 * s * s, xy, xy, k1 * s * s + k2 * c * c}, {}});
  }

  // For a node that has one: the same once more, a wall opposite to it without clearance, or the other side of a
  // corner.
  void AddObstacleForContact() {
    const ContactCandidate contact = random_.OneOf(scene().contacts);
    const auto is_its = [&](const Obstacle& obstacle) { return obstacle.name == contact.obstacle; };
    Obstacle other = *std::find_if(scene().obstacles.begin(), scene().obstacles.end(), is_its);
    const auto is_node = [&](const Node& node) { return node.name == contact.node; };
    const Node& node = *std::find_if(scene().nodes.begin(), scene().nodes.end(), is_node);
    other.name += "_too";
    switch (random_.Index(3)) {
      case 0: break;
      case 1:
        other.nx = -other.nx;
        other.ny = -other.ny;
        other.px = node.x;
        other.py = node.y;
        break;
      default:
        std::swap(other.nx, other.ny);
        other.px = node.x;
        other.py = node.y;
    }
    scene().contacts.push_back({contact.node, other.name});
    scene().obstacles.push_back(std::move(other));
  }

  void ChangeLoads() {
    if (random_.Chance(0.5)) {
      const double factor = random_.OneOf(std::array<double, 4>{1e-9, 1e-3, 1e3, 1e9});
      for (Load& load : scene().loads) {
        load.fx *= factor;
        load.fy *= factor;
      }
      return;
    }
    Load opposite = random_.OneOf(scene().loads);
    const double nearly = random_.OneOf(std::array<double, 3>{1.0, 1.0 - 1e-3, 1.0 - 1e-9});
    opposite.fx *= -nearly;
    opposite.fy *= -nearly;
    scene().loads.push_back(std::move(opposite));
  }

  ObstacleMotion AnyObstacleMotion() {
    const std::string& obstacle = random_.OneOf(scene().obstacles).name;
    return {obstacle, random_.Number(-0.3, 0.3), random_.Number(-0.3, 0.3)};
  }
  SupportMotion AnySupportMotion() {
    const Node& node = random_.OneOf(scene().nodes);
    return {node.name, node.fixed_x ? random_.Number(-0.3, 0.3) : 0.0, node.fixed_y ? random_.Number(-0.3, 0.3) : 0.0};
  }

  void MoveObstacle() { scene().obstacle_motions.push_back(AnyObstacleMotion()); }
  void MoveSupport() { scene().support_motions.push_back(AnySupportMotion()); }

  // The scaled loads and the motions of the scene as a first stage, and others.
  void MakeProgram() {
    Stage first;
    first.name = "first";
    for (Load& load : scene().loads)
      if (!load.constant) first.loads.push_back(load);
    const auto scaled = [](const Load& load) { return !load.constant; };
    scene().loads.erase(std::remove_if(scene().loads.begin(), scene().loads.end(), scaled), scene().loads.end());
    first.support_motions = std::move(scene().support_motions);
    first.obstacle_motions = std::move(scene().obstacle_motions);
    scene().support_motions.clear();
    scene().obstacle_motions.clear();
    request_.options.direction = 0.0;
    request_.options.stop.clear();
    request_.program.push_back(std::move(first));
    const std::size_t stages = 1 + random_.Index(3);
    while (request_.program.size() < stages) {
      Stage stage;
      switch (random_.Index(3)) {
        case 0: stage.loads = request_.program.front().loads; break;
        case 1: stage.obstacle_motions = {AnyObstacleMotion()}; break;
        default: stage.support_motions = {AnySupportMotion()};
      }
      request_.program.push_back(std::move(stage));
    }
    for (Stage& stage : request_.program)
      stage.target = random_.OneOf(std::array<double, 6>{0.0, 0.02, -0.02, 0.2, -1.0, 1e-9});
  }

  void ChangeUnits() {
    const auto unit = [&] { return std::pow(10.0, std::round(random_.Number(-9.0, 9.0))); };
    const double length = unit();
    request_ = contact_path::ChangeUnits(std::move(request_), length, unit());
  }

  void ChangeOptions() {
    TraceOptions& options = request_.options;
    if (random_.Chance(quick_ ? 0.01 : 0.3)) options.method = Method::kMpec;
    options.accuracy =
        random_.OneOf(std::array<Accuracy, 3>{Accuracy::kFast, Accuracy::kBalanced, Accuracy::kAccurate});
    // Of long increments, mpec says itself that they cut corners.
    const bool branch = options.method == Method::kBranch;
    options.step = random_.OneOf(std::array<double, 6>{0.0, 0.0, 1e-6, 1e-3, branch ? 0.2 : 0.01, branch ? 1.0 : 0.05});
    if (request_.program.empty()) options.direction = random_.OneOf(std::array<double, 3>{0.0, 1.0, -1.0});
    options.full_state_every = static_cast<int>(random_.Index(4));
    if (random_.Chance(0.3)) {
      const Node& node = random_.OneOf(scene().nodes);
      options.stop.push_back({node.name + ".x", random_.Chance(0.5) ? ">" : "<", node.x + random_.Number(-0.2, 0.2)});
    }
    if (branch && random_.Chance(0.5)) {
      const bool event = random_.Chance(0.7);
      const auto number = static_cast<int>(random_.Index(4));
      options.branch_choices.push_back(
          {event ? number + 1 : 0, event ? 0 : number, static_cast<int>(random_.Index(4))});
    }
  }

  // Beside a bar, or between any two nodes, of about the stiffness of that bar.
  void AddBeam() {
    const Bar bar = random_.OneOf(scene().bars);
    Beam beam;
    beam.name = "beam";
    beam.nodes = random_.Chance(0.5)
                     ? bar.nodes
                     : std::vector<std::string>{random_.OneOf(scene().nodes).name, random_.OneOf(scene().nodes).name};
    const Node &first = NodeOf(beam.nodes[0]), &second = NodeOf(beam.nodes[1]);
    const double length = std::hypot(second.x - first.x, second.y - first.y);
    beam.EA = bar.EA;
    beam.EI = bar.EA * length * length * random_.OneOf(std::array<double, 4>{1e-1, 1e-2, 1e-4, 1e-6});
    if (random_.Chance(0.3)) beam.GA = 0.3 * beam.EA;
    beam.segments = static_cast<int>(1 + random_.Index(4));
    if (random_.Chance(0.5)) beam.angle = random_.Number(-3.0, 3.0);
    if (random_.Chance(0.3)) beam.hinged = {random_.Chance(0.5), random_.Chance(0.5)};
    scene().beams.push_back(std::move(beam));
  }

  // One or two triangles, or a quadrilateral, on one side of a bar.
  void AddSolid() {
    const Bar bar = random_.OneOf(scene().bars);
    const Node first = NodeOf(bar.nodes[0]), second = NodeOf(bar.nodes[1]);
    const double dx = second.x - first.x, dy = second.y - first.y, height = random_.Number(0.2, 0.8);
    Material material;
    material.name = "stuff";
    material.model = random_.OneOf(std::array<MaterialModel, 3>{
        MaterialModel::kNeoHookean, MaterialModel::kStVenantKirchhoff, MaterialModel::kLinear});
    Solid solid;
    solid.name = "solid";
    solid.material = material.name;
    solid.plane = random_.Chance(0.5) ? PlaneState::kStrain : PlaneState::kStress;
    solid.thickness = std::hypot(dx, dy);
    material.E = bar.EA / (solid.thickness * solid.thickness) * random_.OneOf(std::array<double, 3>{1e-2, 1.0, 1e2});
    material.nu = random_.OneOf(std::array<double, 4>{0.0, 0.3, 0.45, -0.3});
    const auto add = [&](const char* name, double along) {
      scene().nodes.push_back({name, first.x + along * dx - height * dy, first.y + along * dy + height * dx});
    };
    if (random_.Chance(0.5)) {
      solid.nodes_per_element = 4;
      add("s1", random_.Number(0.7, 1.1));
      add("s2", random_.Number(-0.1, 0.3));
      solid.nodes = {first.name, second.name, "s1", "s2"};
    } else {
      add("s1", random_.Number(0.2, 0.8));
      solid.nodes = {first.name, second.name, "s1"};
    }
    scene().surfaces.push_back({"edge", {"s1", second.name}});
    scene().materials.push_back(std::move(material));
    scene().solids.push_back(std::move(solid));
  }

  // A moment and a traction on the beam, a traction on the solid; of the size of a load that is there.
  void LoadParts() {
    const Load like = random_.OneOf(request_.program.empty() ? scene().loads : request_.program.front().loads);
    const double size = std::hypot(like.fx, like.fy);
    Load load;
    load.constant = !request_.program.empty();
    const auto length_of = [&](const std::vector<std::string>& nodes) {
      const Node &first = NodeOf(nodes[0]), &second = NodeOf(nodes[1]);
      return std::hypot(second.x - first.x, second.y - first.y);
    };
    if (!scene().beams.empty()) {
      const Beam& beam = scene().beams.back();
      load.node = beam.nodes[1];
      load.moment = random_.Number(-0.2, 0.2) * size * length_of(beam.nodes);
      scene().loads.push_back(load);
      load.node.clear();
      load.moment = 0.0;
      load.group = beam.name;
      load.py = random_.Number(-0.3, 0.3) * size / length_of(beam.nodes);
      scene().loads.push_back(load);
      load.group.clear();
      load.py = 0.0;
    }
    if (scene().surfaces.empty()) return;
    load.surface = scene().surfaces.back().name;
    load.px = random_.Number(-0.3, 0.3) * size / length_of(scene().surfaces.back().nodes);
    scene().loads.push_back(load);
  }

  // All nodes of the beam, or those that the solid added, against an obstacle.
  void TouchWithParts() {
    std::string group;
    if (!scene().beams.empty()) {
      group = scene().beams.back().name;
    } else if (!scene().solids.empty()) {
      group = "added";
      scene().groups.push_back({group, {scene().solids.back().nodes.back()}});
    } else {
      return;
    }
    scene().contacts.push_back({"", random_.OneOf(scene().obstacles).name, group});
  }

  // Half planes that a single node may touch become curves.
  void BendObstacles() {
    Random random(static_cast<unsigned>(random_.Index(1U << 20U)));
    double size = 0.0;
    for (const Node& node : scene().nodes)
      size = std::max(size, std::hypot(node.x - scene().nodes[0].x, node.y - scene().nodes[0].y));
    for (Obstacle& obstacle : scene().obstacles) {
      const auto touches = [&](const ContactCandidate& contact) { return contact.obstacle == obstacle.name; };
      const auto& contacts = scene().contacts;
      const auto contact = std::find_if(contacts.begin(), contacts.end(), touches);
      if (contact == contacts.end() || contact->node.empty() || !random_.Chance(0.7)) continue;
      MakeCurve(NodeOf(contact->node), 0.5 * size, &random, &obstacle);
    }
  }

  void TurnObstacles() {
    const double turn = random_.OneOf(std::array<double, 4>{0.1, -0.3, 1.0, 7.0});
    const auto turn_all = [&](std::vector<ObstacleMotion>* motions) {
      for (ObstacleMotion& motion : *motions) motion.turn = turn;
    };
    turn_all(&scene().obstacle_motions);
    for (Stage& stage : request_.program) turn_all(&stage.obstacle_motions);
  }

  // Any node against an edge of the solid, or one side of the beam, so thick that the node is near to it.
  void TouchSurface() {
    if (scene().surfaces.empty() && scene().beams.empty()) return;
    if (scene().surfaces.empty() || (!scene().beams.empty() && random_.Chance(0.5))) {
      const Beam& beam = scene().beams.back();
      BoundarySurface side;
      side.name = "side";
      side.nodes.push_back(beam.nodes[0]);
      for (int i = 1; i < beam.segments; ++i) side.nodes.push_back(beam.name + "/" + std::to_string(i));
      side.nodes.push_back(beam.nodes[1]);
      if (random_.Chance(0.5)) std::reverse(side.nodes.begin(), side.nodes.end());
      scene().surfaces.push_back(std::move(side));
    }
    ContactCandidate contact;
    contact.node = random_.OneOf(scene().nodes).name;
    contact.surface = scene().surfaces.back().name;
    contact.friction = random_.OneOf(std::array<double, 4>{0.0, 0.3, 1.0, 10.0});
    Scene expanded = scene();
    ExpandParts(&expanded);
    BoundarySurface& surface = scene().surfaces.back();
    std::vector<Eigen::Vector2d> places;
    for (const std::string& name : surface.nodes) {
      const Node& at = NodeOf(expanded, name);
      places.emplace_back(at.x, at.y);
    }
    const Node& node = NodeOf(contact.node);
    const double gap = BoundaryCurve(places, false, 0.0).Nearest({node.x, node.y}).gap;
    surface.radius = std::max(0.0, gap) * random_.OneOf(std::array<double, 4>{0.0, 0.9, 0.999, 1.0 - 1e-12});
    scene().contacts.push_back(std::move(contact));
  }

  void TakeTotalLaw() { request_.options.friction_law = FrictionLaw::kTotal; }

  // Two bodies on each other in place of the scene and its program.
  void TakeBodies() {
    TraceRequest bodies = RandomBodies(&random_, "bodies");
    if (random_.Chance(0.2)) {
      const auto unit = [&] { return std::pow(10.0, std::round(random_.Number(-9.0, 9.0))); };
      const double length = unit();
      bodies = contact_path::ChangeUnits(std::move(bodies), length, unit());
    }
    if (random_.Chance(0.2))
      for (ContactCandidate& contact : bodies.scene.contacts)
        contact.friction = random_.OneOf(std::array<double, 5>{0.0, 1e-12, 1e-3, 10.0, 1e6});
    request_.scene = std::move(bodies.scene);
    request_.program = std::move(bodies.program);
    request_.options.direction = 0.0;
    request_.options.stop.clear();
  }

  const Node& NodeOf(const std::string& name) { return NodeOf(scene(), name); }
  static const Node& NodeOf(const Scene& of, const std::string& name) {
    return *std::find_if(of.nodes.begin(), of.nodes.end(), [&](const Node& node) { return node.name == name; });
  }

  const bool quick_;
  Decisions random_;
  TraceRequest request_;
};

}  // namespace

std::function<std::uint64_t()> BitsOf(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> bytes(data, data + size);
  std::uint64_t hash = size;
  for (const std::uint8_t byte : bytes) hash = SplitMix64::Mix(hash ^ byte);
  return [bytes, at = std::size_t{0}, rest = SplitMix64(hash)]() mutable {
    if (at + 2 > bytes.size()) return rest();
    const std::uint64_t two = (std::uint64_t{bytes[at]} << 8U) | bytes[at + 1];
    at += 2;
    // The largest bits decide numbers, the smallest ones indices.
    return (two << 48U) | (SplitMix64::Mix(two) & 0xFFFFFFFFU);
  };
}

TraceRequest VariedRequest(std::function<std::uint64_t()> bits, bool quick) {
  return Variation(std::move(bits), quick).Build();
}

}  // namespace contact_path
