#include "check/contacts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "check/surfaces.h"
#include "contact_path/scene/expand.h"

namespace contact_path::check {
namespace {

// An obstacle, which is turned about a point and then moved, both in proportion to the load factor; or which a body
// carries.
struct MovedObstacle {
  Real TurnAt(const PlacedState& state) const { return body ? state.Rotation(*body) : turn * state.LoadFactor(); }

  std::shared_ptr<const Surface> surface;
  Vector point;      // p of the scene
  Vector motion;     // per unit of the load factor
  Real turn = 0.0L;  // before that, about a point
  Vector about;
  Real friction = 0.0L;
  Real friction_rate = 0.0L;        // per unit of the load factor
  std::optional<std::size_t> body;  // node; its reference point is `about` at the start
  Real radius = 0.0L;               // of a circle that rolls on it, about the node
  std::size_t circle = 0;           // the body that carries it
  bool has_corners = false;         // for the circle, at the ends of a curve
};

class ObstacleContact : public Contact {
 public:
  // slip_origin: of the total law of friction, as the obstacle sees it.
  // of_body: a body has the node, which it carries, or the obstacle. size: of coordinates.
  ObstacleContact(std::size_t node, const ContactCandidate& of, MovedObstacle obstacle,
                  std::optional<Vector> slip_origin, bool of_body, Real size)
      : Contact(node, obstacle.friction, of),
        obstacle_(std::move(obstacle)),
        slip_origin_(slip_origin),
        gives_(of_body),
        step_(kStep * size) {}

  Real FrictionIn(const PlacedState& state) const override {
    return obstacle_.friction + obstacle_.friction_rate * state.LoadFactor();
  }
  bool Gives() const override { return gives_; }
  bool SurelyOpen(const PlacedState& state) const override {
    return !Rolls() && obstacle_.surface->SurelyOpen(Position(state));
  }
  // Where the obstacle is now.
  Vector Normal(const PlacedState& state) const override {
    const Vector normal = obstacle_.surface->Normal(Position(state));
    return !Turns() ? normal : Turned(normal, obstacle_.TurnAt(state));
  }
  // The point of a circle that touches goes along by its radius times the turn of the circle against the tangent.
  Real Slip(const PlacedState& from, const PlacedState& to) const override {
    const Vector begin = Position(from), end = Position(to);
    const Real along = obstacle_.surface->Slip(begin, end);
    if (!Rolls()) return along;
    const Real of_circle =
        to.Rotation(obstacle_.circle) - from.Rotation(obstacle_.circle) - obstacle_.TurnAt(to) + obstacle_.TurnAt(from);
    return along + obstacle_.radius * (of_circle - TurnOfTangent(begin, end));
  }
  std::optional<Real> TotalSlip(const PlacedState& state) const override {
    if (!slip_origin_) return std::nullopt;
    return obstacle_.surface->Slip(*slip_origin_, Position(state));
  }
  void AddForces(const PlacedState& state, Real rn, Real rt, Real factor, std::vector<Real>* forces) const override {
    const std::size_t num_positions = state.Positions().size();
    const Vector normal = Normal(state);
    const Vector force = factor * (rn * normal + rt * SlipPerMotion(state, 1.0L) * Right(normal));
    AddTo(forces, Node(), force);
    if (Rolls()) (*forces)[num_positions + obstacle_.circle] += factor * obstacle_.radius * rt;
    if (!obstacle_.body) return;
    AddTo(forces, *obstacle_.body, -1.0L * force);
    const Vector arm = state.Place(Node()) - state.Place(*obstacle_.body);
    (*forces)[num_positions + *obstacle_.body] -= Cross(arm, force) + factor * obstacle_.radius * rt;
  }
  Real Uncertain(const PlacedState& state, Real rt) const override {
    return rt == 0.0L ? 0.0L : std::abs(rt * (SlipPerMotion(state, 1.0L) - SlipPerMotion(state, -1.0L)));
  }
  // The moment as the obstacle sees it.
  OnNode ForceOnNode(const PlacedState& state, Real rn, Real rt) const override {
    const Vector place = Position(state), n = obstacle_.surface->Normal(place), arm = place - obstacle_.point;
    const Vector seen = rn * n + rt * SlipPerMotion(state, 1.0L) * Right(n);
    return {!Turns() ? seen : Turned(seen, obstacle_.TurnAt(state)), Cross(arm, seen) + obstacle_.radius * rt};
  }
  Vector Velocity(const PlacedState& state) const override {
    if (obstacle_.turn == 0.0L) return obstacle_.motion;
    const Vector arm = state.Place(Node()) - obstacle_.radius * Normal(state) - obstacle_.about -
                       state.LoadFactor() * obstacle_.motion;
    return obstacle_.motion + obstacle_.turn * Left(arm);
  }

 private:
  // Along t, where contacts give way, over that where the gap is closed: what rt does work along is slip. sense: to
  // which side.
  Real SlipPerMotion(const PlacedState& state, Real sense) const {
    const Real gap = Distance(state), step = sense * std::max(step_, std::abs(gap));
    if ((!gives_ && !IsBroughtOn()) || gap == 0.0L) return 1.0L;
    const Vector at = Position(state), n = obstacle_.surface->Normal(at), closed = at - gap * n;
    Vector along = step * Right(n);
    // About an end the foot rests, and the way is that of the centre.
    const auto way = [&](const Vector& from) {
      const Real of_foot = obstacle_.surface->Slip(from, from + along);
      return obstacle_.has_corners ? of_foot - obstacle_.radius * TurnOfTangent(from, from + along) : of_foot;
    };
    // At the end of a curve there is the way back alone.
    if (std::abs(way(closed)) < kNoWay * std::abs(step)) along = -1.0L * along;
    return way(at) / way(closed);
  }
  Real TurnOfTangent(const Vector& begin, const Vector& end) const {
    return AngleBetween(obstacle_.surface->Normal(begin), obstacle_.surface->Normal(end));
  }
  Real Distance(const PlacedState& state) const override {
    return obstacle_.surface->Gap(Position(state)) - obstacle_.radius;
  }
  bool Rolls() const { return obstacle_.radius > 0.0L; }
  bool Turns() const { return obstacle_.body || obstacle_.turn != 0.0L; }
  // The node as the obstacle sees it.
  Vector Position(const PlacedState& state) const {
    if (obstacle_.body)
      return obstacle_.about + Turned(state.Place(Node()) - state.Place(*obstacle_.body), -obstacle_.TurnAt(state));
    const Vector moved = state.Place(Node()) - state.LoadFactor() * obstacle_.motion;
    if (obstacle_.turn == 0.0L) return moved;
    return obstacle_.about + Turned(moved - obstacle_.about, -obstacle_.turn * state.LoadFactor());
  }

  // Of coordinates: their rounding over it is far below the residual that is accepted, and the ratio of the two slips
  // differs from its limit by its square times the gap only.
  static constexpr Real kStep = 1e-5L;
  // Of a step: the foot is at the end of a curve. About a circle that is far smaller than the other one it goes
  // farther.
  static constexpr Real kNoWay = 1e-6L;

  MovedObstacle obstacle_;
  std::optional<Vector> slip_origin_;
  bool gives_;
  Real step_;
};

class BoundaryContact : public Contact {
 public:
  // left_out: patches of the surface, where the node is one of its own; empty: none.
  // first_node: of the surface.
  BoundaryContact(std::size_t node, std::size_t surface, std::size_t first_node, const ContactCandidate& of,
                  std::vector<bool> left_out)
      : Contact(node, of.friction, of), surface_(surface), first_node_(first_node), left_out_(std::move(left_out)) {}

  std::optional<std::size_t> TouchedSurface() const override { return surface_; }
  Real GapPastEnd(const PlacedState& state) const override {
    const BoundaryFoot foot = FootIn(state);
    return foot.over_end ? foot.distance : state.Shape(surface_).Gap(state.Place(Node()), foot);
  }
  Vector Normal(const PlacedState& state) const override { return state.Shape(surface_).Normal(FootIn(state)); }
  // The motion of the foot through the material, as long as it is in the mean of both shapes.
  Real Slip(const PlacedState& from, const PlacedState& to) const override {
    const BoundaryShape &before = from.Shape(surface_), &after = to.Shape(surface_);
    const BoundaryFoot begin = FootIn(from), end = FootIn(to);
    return 0.5L * (before.Walked(begin, end) + after.Walked(begin, end));
  }
  void AddForces(const PlacedState& state, Real rn, Real rt, Real factor, std::vector<Real>* forces) const override {
    const BoundaryShape& shape = state.Shape(surface_);
    const BoundaryFoot foot = FootIn(state);
    const BoundaryShape::Forces of = shape.ForcesOf(state.Place(Node()), foot, rn, rt);
    const BoundaryPatch& patch = shape.PatchOf(foot);
    AddTo(forces, Node(), factor * of.on_node);
    for (std::size_t i = 0; i < patch.nodes.size(); ++i)
      AddTo(forces, patch.nodes[i], factor * BoundaryShape::Reflected(patch, i, of.on_patch[i]));
  }
  OnNode ForceOnNode(const PlacedState& state, Real rn, Real rt) const override {
    const Vector place = state.Place(Node()), arm = place - state.Place(first_node_);
    const Vector force = state.Shape(surface_).ForcesOf(place, FootIn(state), rn, rt).on_node;
    return {force, Cross(arm, force)};
  }
  Real Imbalance(const PlacedState& state, Real rn, Real rt, Real length) const override {
    const Vector x = state.Place(Node());
    const BoundaryShape& shape = state.Shape(surface_);
    const BoundaryFoot foot = FootIn(state);
    const BoundaryShape::Forces forces = shape.ForcesOf(x, foot, rn, rt);
    Vector sum = forces.on_node;
    Real moment = 0.0L;
    for (std::size_t i = 0; i < forces.on_patch.size(); ++i) {
      sum += forces.on_patch[i];
      moment += Cross(shape.PlaceOf(shape.PatchOf(foot), i) - x, forces.on_patch[i]);
    }
    return std::max(Length(sum), std::abs(moment) / length);
  }

 private:
  Real Distance(const PlacedState& state) const override {
    return state.Shape(surface_).Gap(state.Place(Node()), FootIn(state));
  }
  BoundaryFoot FootIn(const PlacedState& state) const {
    return state.Shape(surface_).Nearest(state.Place(Node()), left_out_);
  }

  std::size_t surface_, first_node_;
  std::vector<bool> left_out_;
};

// Of a surface for a node of the scene; empty where the surface does not have the node.
std::vector<bool> PatchesLeftOutFor(const std::string& node, const BoundarySurface& surface, const Scene& scene,
                                    const NodeNumbers& numbers) {
  const auto own = std::find(surface.nodes.begin(), surface.nodes.end(), node);
  if (own == surface.nodes.end()) return {};
  std::vector<Vector> places;
  for (const std::string& name : surface.nodes) {
    const Node& of = scene.nodes[numbers.at(name)];
    places.push_back({of.x, of.y});
  }
  return PatchesLeftOut(surface, places, static_cast<std::size_t>(own - surface.nodes.begin()));
}

using NodeLists = std::vector<std::vector<std::size_t>>;

// The nodes round each element of the solids that have two neighbours of a surface, against its sense, in one element.
// nodes: of the surface; solids have the nodes of bodies in place of their twins.
NodeLists ElementsBehind(std::vector<std::size_t> nodes, const Scene& scene, const NodeNumbers& numbers) {
  for (std::size_t& node : nodes)
    if (const std::string& of_solid = scene.nodes[node].twin_of; !of_solid.empty()) node = numbers.at(of_solid);
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t i = 1; i < nodes.size(); ++i) edges.insert({nodes[i], nodes[i - 1]});
  NodeLists behind;
  for (const Solid& solid : scene.solids) {
    const std::size_t size = solid.NodesPerElement(), corners = size > 4 ? size / 2 : size;
    NodeLists elements;
    bool bounded = false;
    for (std::size_t first = 0; first < solid.nodes.size(); first += size) {
      std::vector<std::size_t>& round = elements.emplace_back();
      for (std::size_t i = 0; i < corners; ++i) {
        round.push_back(numbers.at(solid.nodes[first + i]));
        if (size > corners) round.push_back(numbers.at(solid.nodes[first + corners + i]));
      }
      for (std::size_t i = 0; i < round.size(); ++i)
        bounded = bounded || edges.count({round[i], round[(i + 1) % round.size()]}) > 0;
    }
    if (bounded) behind.insert(behind.end(), elements.begin(), elements.end());
  }
  return behind;
}

}  // namespace

std::vector<Boundary> MakeBoundaries(const Scene& scene, const NodeNumbers& numbers) {
  std::vector<Boundary> boundaries;
  for (const BoundarySurface& surface : scene.surfaces) {
    std::vector<std::size_t> nodes;
    for (const std::string& node : surface.nodes) nodes.push_back(numbers.at(node));
    std::array<Axis, 2> axes = {Axis::kNone, Axis::kNone};
    if (const std::size_t n = nodes.size(); !surface.closed)
      axes = {SymmetryOf(scene.nodes[nodes[0]], scene.nodes[nodes[1]], scene),
              SymmetryOf(scene.nodes[nodes[n - 1]], scene.nodes[nodes[n - 2]], scene)};
    boundaries.emplace_back(surface, nodes, axes, surface.closed ? NodeLists() : ElementsBehind(nodes, scene, numbers));
  }
  return boundaries;
}

std::vector<std::unique_ptr<const Contact>> MakeContacts(const Scene& scene, const NodeNumbers& numbers,
                                                         const std::vector<double>& slip_origins, Real size) {
  std::unordered_map<std::string_view, MovedObstacle> obstacles;
  std::unordered_map<std::string_view, const Obstacle*> given;
  for (const Obstacle& obstacle : scene.obstacles) {
    given.emplace(obstacle.name, &obstacle);
    MovedObstacle& of = obstacles[obstacle.name];
    of.surface = MakeSurface(obstacle);
    of.point = {obstacle.px, obstacle.py};
    of.friction = obstacle.friction;
    if (obstacle.body.empty()) continue;
    of.body = numbers.at(obstacle.body);
    of.about = {scene.nodes[*of.body].x, scene.nodes[*of.body].y};
  }
  for (const ObstacleMotion& motion : scene.obstacle_motions) {
    MovedObstacle& moved = obstacles.at(motion.obstacle);
    moved.motion = {motion.dx, motion.dy};
    moved.turn = motion.turn;
    moved.about = {motion.about_x, motion.about_y};
  }
  for (const FrictionChange& change : scene.friction_changes) obstacles.at(change.obstacle).friction_rate = change.rate;
  std::unordered_map<std::string_view, std::size_t> surfaces;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) surfaces.emplace(scene.surfaces[i].name, i);
  std::vector<std::unique_ptr<const Contact>> contacts;
  for (const ContactCandidate& contact : scene.contacts) {
    const std::size_t node = numbers.at(contact.node);
    if (contact.OnSurface()) {
      const std::size_t surface = surfaces.at(contact.surface);
      contacts.push_back(
          std::make_unique<BoundaryContact>(node, surface, numbers.at(scene.surfaces[surface].nodes.front()), contact,
                                            PatchesLeftOutFor(contact.node, scene.surfaces[surface], scene, numbers)));
      continue;
    }
    if (contact.at_eye) {
      contacts.push_back(MakeEye(contact, scene, numbers));
      continue;
    }
    const auto obstacle = obstacles.find(contact.obstacle);
    if (obstacle == obstacles.end()) throw std::invalid_argument("no obstacle has the name " + contact.obstacle);
    std::optional<Vector> origin;
    if (const std::size_t k = 2 * contacts.size(); !slip_origins.empty())
      origin = Vector{slip_origins.at(k), slip_origins.at(k + 1)};
    MovedObstacle partner = obstacle->second;
    if (contact.friction > 0.0) partner.friction = contact.friction;
    if (contact.Rolls()) {
      const Obstacle &circle = *given.at(contact.obstacles.front()), &touched = *given.at(contact.obstacle);
      partner.radius = circle.radius;
      partner.circle = numbers.at(circle.body);
      partner.surface = MakeSurface(touched, true);
      partner.has_corners = !touched.points.empty();
    }
    const bool of_body = contact.Rolls() || partner.body || IsAttached(scene.nodes[node]);
    contacts.push_back(std::make_unique<ObstacleContact>(node, contact, std::move(partner), origin, of_body, size));
  }
  return contacts;
}

}  // namespace contact_path::check
