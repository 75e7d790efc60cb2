#include "scene/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact_path/geometry/plane.h"
#include "contact_path/scene/boundary_curve.h"
#include "contact_path/scene/surface.h"

namespace contact_path {
namespace {

constexpr double kStraightBack = 1e-6;  // [rad], far above the rounding of coordinates

const KeyPath kSurfaces = kScene.Key("surfaces");

// Parts have the node of a body, the surface its twin.
const std::string& NameInParts(const Node& node) { return node.twin_of.empty() ? node.name : node.twin_of; }

bool CanMove(const Node& node) { return !node.fixed_x || !node.fixed_y; }

Eigen::Vector2d Between(const Node& a, const Node& b) { return {b.x - a.x, b.y - a.y}; }

// Whether the edge `after` leads straight back along the edge `before`.
bool LeadsBack(const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  return std::abs(std::atan2(Cross(before, after), -before.dot(after))) <= kStraightBack;
}

// The smallest radius of curvature of the spline between the middles of two edges, where it bends to the left; infinite
// where it does not. There y' goes straight from one edge to the other, and y' x y'' is their product.
double RadiusToTheLeft(const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  const double product = Cross(before, after);
  if (!(product > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d change = after - before,
                        nearest = before + std::clamp(-before.dot(change) / change.squaredNorm(), 0.0, 1.0) * change;
  return std::pow(std::hypot(nearest.x(), nearest.y()), 3) / product;
}

// Whether all its numbers are finite and not too large.
bool HasSoundNumbers(const Obstacle& obstacle) {
  bool sound = true;
  ForEachField<Obstacle>([&](const auto& field) {
    if constexpr (std::is_same_v<typename std::decay_t<decltype(field)>::Value, double>)
      sound = sound && std::abs(obstacle.*field.member) <= kLargestInput;
  });
  return sound;
}

// Where a node stands, of a half plane to the precision of its distance from the point of the obstacle.
Projection ProjectNode(const Node& node, Obstacle obstacle) {
  obstacle.px -= node.x;
  obstacle.py -= node.y;
  return MakeSurface(obstacle)->ProjectOnNearest(Eigen::Vector2d::Zero());
}

class BoundaryRules {
 public:
  explicit BoundaryRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {
    for (const Solid& solid : scene_.solids)
      for (const std::vector<std::string_view>& element : NodesRoundElements(solid))
        for (std::size_t i = 0; i < element.size(); ++i)
          of_solids_.emplace(element[i], element[(i + 1) % element.size()]);
    const auto add_lines = [this](const auto& parts) {
      for (const auto& part : parts)
        for (std::size_t i = 1; i < part.nodes.size(); ++i) {
          of_lines_.emplace(part.nodes[i - 1], part.nodes[i]);
          of_lines_.emplace(part.nodes[i], part.nodes[i - 1]);
        }
    };
    add_lines(scene_.bars);
    add_lines(scene_.beams);
  }

  // length: the characteristic length, 0 where it is not known.
  void CheckContact(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                    const BoundarySurface& surface, double length) {
    const Judged& judged = Judge(surface);
    if (!judged.sound) return;
    const AdmissiblePatches patches = PatchesFor(node.name, surface, judged.places, judged.across);
    if (patches.None())
      return checker_.Add(path.Key("node"), node.name,
                          "a node of surface " + surface.name +
                              " itself must have some of it farther along it than two nodes and pi times its radius");
    if (!CanMove(node) && !judged.can_move)
      return checker_.Add(path.Key("node"), node.name,
                          "must be free to move, or a node of surface " + surface.name + " must be");
    const BoundaryCurve::Foot foot = judged.curve->Nearest({node.x, node.y}, patches);
    if (!foot.is_end && Refuses(contact, foot.gap, length) && !IsAway(node, surface, foot))
      checker_.Add(path, contact.Name(), "initial position penetrates the surface by " + NumberText(-foot.gap));
  }

 private:
  using Edge = std::pair<std::string_view, std::string_view>;  // from a node to a node

  // A surface that a contact names is judged once.
  struct Judged {
    bool sound = false;
    bool can_move = false;                 // one of its nodes can
    std::vector<Eigen::Vector2d> places;   // of its nodes
    std::array<int, 2> across = {-1, -1};  // SymmetryAxes()
    std::optional<BoundaryCurve> curve;
  };
  const Judged& Judge(const BoundarySurface& surface) {
    const auto [at, is_new] = judged_.try_emplace(&surface);
    Judged& judged = at->second;
    if (!is_new) return judged;
    const auto node_of = [this](const std::string& name) -> const Node& { return *checker_.KnownNode(name); };
    const KeyPath path = kSurfaces[static_cast<std::size_t>(&surface - scene_.surfaces.data())];
    judged.sound = CheckEdges(path, surface) && CheckBends(path, surface);
    for (const std::string& name : surface.nodes) {
      const Node& node = node_of(name);
      judged.places.emplace_back(node.x, node.y);
      judged.can_move = judged.can_move || CanMove(node);
    }
    judged.across = SymmetryAxes(surface, scene_, node_of);
    judged.curve.emplace(judged.places, surface.closed, surface.radius, judged.across);
    return judged;
  }

  // Whether it is a boundary.
  bool CheckEdges(const KeyPath& path, const BoundarySurface& surface) {
    const KeyPath nodes = path.Key("nodes");
    const std::size_t count = surface.nodes.size();
    bool sound = true;
    for (std::size_t i = 0; i < (surface.closed ? count : count - 1); ++i) {
      const Node &start = *checker_.KnownNode(surface.nodes[i]),
                 &end = *checker_.KnownNode(surface.nodes[(i + 1) % count]);
      const std::string &from = NameInParts(start), &to = NameInParts(end);
      std::string fault = FaultOf({from, to});
      const Eigen::Vector2d edge = Between(start, end);
      if (fault.empty() && std::hypot(edge.x(), edge.y()) < kSmallestInput)
        fault = "must not be at the same point as the next node, " + to;
      if (fault.empty()) continue;
      sound = false;
      checker_.Add(nodes[i], from, fault);
    }
    return sound;
  }

  // Whether its curve, and that at the distance of its radius, are smooth at the start.
  bool CheckBends(const KeyPath& path, const BoundarySurface& surface) {
    const KeyPath nodes = path.Key("nodes");
    const std::size_t count = surface.nodes.size();
    const auto node = [&](std::size_t i) -> const Node& { return *checker_.KnownNode(surface.nodes[i % count]); };
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = surface.closed ? 0 : 1; i < (surface.closed ? count : count - 1); ++i) {
      const Eigen::Vector2d before = Between(node(i + count - 1), node(i)), after = Between(node(i), node(i + 1));
      if (LeadsBack(before, after)) {
        checker_.Add(nodes[i], NameInParts(node(i)), "the surface must not lead straight back here");
        return false;
      }
      smallest = std::min(smallest, RadiusToTheLeft(before, after));
    }
    if (surface.radius < smallest) return true;
    checker_.Add(
        path.Key("radius"), NumberText(surface.radius),
        "must be less than the radius of the curve where it bends to its admissible side, " + NumberText(smallest));
    return false;
  }

  // Whether a node behind an open surface is deeper than its part reaches.
  bool IsAway(const Node& node, const BoundarySurface& surface, const BoundaryCurve::Foot& foot) const {
    if (surface.closed || !(-foot.gap > DepthBehind(surface.radius, foot.edge))) return false;
    const std::vector<std::vector<std::string_view>> elements = ElementsBehind(surface, scene_);
    return std::none_of(elements.begin(), elements.end(), [&](const std::vector<std::string_view>& element) {
      std::vector<Eigen::Vector2d> corners;
      for (const std::string_view name : element)
        if (const Node* const corner = checker_.KnownNode(name)) corners.emplace_back(corner->x, corner->y);
      return IsInside(corners, {node.x, node.y});
    });
  }

  // What is wrong with an edge of a surface, or nothing.
  std::string FaultOf(const Edge& edge) const {
    const bool left = of_solids_.count(edge) > 0, right = of_solids_.count({edge.second, edge.first}) > 0;
    const std::string to(edge.second);
    if (left && right) return "the edge to " + to + " must be on a boundary: there is material on both of its sides";
    if (right || of_lines_.count(edge) > 0) return {};
    if (left) return "the edge to " + to + " must have the material on its right: list the nodes in the other order";
    return "the edge to " + to + " must be on a boundary: no solid, beam or bar has it";
  }

  Checker& checker_;
  const Scene& scene_;
  std::set<Edge> of_solids_;  // counterclockwise round the elements
  std::set<Edge> of_lines_;   // of bars and beams, in both directions
  std::unordered_map<const BoundarySurface*, Judged> judged_;
};

class ContactRules {
 public:
  // length: the characteristic length, 0 where it is not known.
  ContactRules(const UsableObstacles& usable, double length, Checker* checker)
      : checker_(*checker), scene_(checker->GetScene()), usable_(usable), length_(length) {}

  void Check() {
    const KeyPath list = kScene.Key("contacts");
    std::optional<BoundaryRules> boundaries;
    std::set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
      const ContactCandidate& contact = scene_.contacts[i];
      if ((contact.Rolls() && contact.obstacle.empty()) || contact.at_eye) continue;  // known to be wrong, or sound
      const KeyPath path = list[checker_.ContactPlace(i)];
      checker_.CheckFields(path, contact);
      CheckPartner(path, contact);
      const Node* const node = checker_.KnownNode(contact.node);
      const Obstacle* const obstacle = checker_.KnownObstacle(contact.obstacle);
      const BoundarySurface* const surface = checker_.KnownSurface(contact.surface);
      if (node != nullptr && obstacle != nullptr && !obstacle->body.empty() && node->body == obstacle->body)
        checker_.Add(path.Key("node"), contact.node, "must not move with the body that carries the obstacle");
      if (!earlier.insert(contact.Name()).second) {
        checker_.Add(path, contact.Name(), "must not be repeated");
      } else if (node != nullptr && surface != nullptr) {
        if (!boundaries) boundaries.emplace(&checker_);
        boundaries->CheckContact(path, contact, *node, *surface, length_);
      } else if (const auto usable = usable_.find(obstacle); usable != usable_.end()) {
        if (const Obstacle* const circle = RollingCircle(contact, scene_))
          CheckRolling(path, contact, *circle, *obstacle, *usable->second);
        else if (node != nullptr && obstacle->shape == ObstacleShape::kHalfPlane)
          CheckOnHalfPlane(path, contact, *node, *obstacle);
        else if (node != nullptr)
          CheckOnCurve(path, contact, *node, *obstacle, *usable->second);
      }
    }
  }

 private:
  // Which of its fields a contact has.
  void CheckPartner(const KeyPath& path, const ContactCandidate& contact) {
    if (!contact.OnSurface()) {
      if (contact.obstacle.empty())
        checker_.Add(path.Key("obstacle"), TextOrQuotes(contact.obstacle),
                     "must name an obstacle of the scene where there is no surface");
      return;
    }
    if (!contact.obstacle.empty())
      checker_.Add(path.Key("obstacle"), contact.obstacle, "must be left out where there is a surface");
    if (contact.friction < 0.0) checker_.Add(path.Key("friction"), NumberText(contact.friction), "must be >= 0");
  }

  void CheckOnHalfPlane(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                        const Obstacle& obstacle) {
    const Projection at = ProjectNode(node, obstacle);
    const double free_part = std::hypot(node.fixed_x ? 0.0 : at.normal.x(), node.fixed_y ? 0.0 : at.normal.y());
    if (free_part <= kCancelled)
      checker_.Add(path.Key("node"), contact.node, "must be free to move along the normal of the obstacle");
    if (Refuses(contact, at.gap, length_))
      checker_.Add(path, contact.Name(),
                   "initial position penetrates the obstacle by " + NumberText(-at.gap) +
                       "; its normal points to the side where nodes may be");
  }

  void CheckRolling(const KeyPath& path, const ContactCandidate& contact, const Obstacle& circle,
                    const Obstacle& obstacle, const Surface& surface) {
    if (const std::string misfit = FindMisfit(obstacle, circle.radius); !misfit.empty())
      return checker_.Add(path.Key("obstacles")[0], circle.name, misfit);
    const Eigen::Vector2d centre(circle.px, circle.py);
    const NearestFoot nearest = surface.Nearest(centre);
    const double distance = nearest.is_end ? nearest.distance : surface.Project(centre, nearest.patch).gap;
    if (const double gap = distance - circle.radius; Refuses(contact, gap, length_))
      checker_.Add(path, contact.Name(), "the circle penetrates the obstacle at the start by " + NumberText(-gap));
  }

  // Past the ends of an open curve there is nothing to penetrate.
  void CheckOnCurve(const KeyPath& path, const ContactCandidate& contact, const Node& node, const Obstacle& obstacle,
                    const Surface& surface) {
    if (!CanMove(node))
      checker_.Add(path.Key("node"), contact.node, "must be free to move along the normal of the obstacle");
    const Eigen::Vector2d x(node.x, node.y);
    const NearestFoot nearest = surface.Nearest(x);
    const double gap = surface.Project(x, nearest.patch).gap;
    if (!nearest.is_end && Refuses(contact, gap, length_))
      checker_.Add(path, contact.Name(),
                   "initial position penetrates the obstacle by " + NumberText(-gap) +
                       (obstacle.shape == ObstacleShape::kCircle
                            ? std::string("; nodes may be ") + (obstacle.inside ? "inside" : "outside")
                            : "; nodes may be on the left of the curve"));
  }

  Checker& checker_;
  const Scene& scene_;
  const UsableObstacles& usable_;
  const double length_;
};

}  // namespace

UsableObstacles CheckObstacles(Checker* checker) {
  UsableObstacles usable;
  const std::vector<Obstacle>& obstacles = checker->GetScene().obstacles;
  checker->CheckList(kScene.Key("obstacles"), obstacles,
                     [&](const KeyPath& path, const Obstacle& obstacle, bool sound) {
                       checker->CheckBody(path, obstacle.body);
                       const ShapeFault fault = FindShapeFault(obstacle);
                       if (fault.field.empty()) {
                         if (HasSoundNumbers(obstacle)) usable.emplace(&obstacle, MakeSurface(obstacle));
                       } else if (sound || obstacle.shape == ObstacleShape::kHalfPlane) {
                         checker->Add(path.Key(fault.field), fault.value, fault.rule);
                       }
                     });
  return usable;
}

void CheckContacts(const UsableObstacles& usable, double length, Checker* checker) {
  ContactRules(usable, length, checker).Check();
}

}  // namespace contact_path
