#include "contact_path/contact/scene_contacts.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "contact_path/contact/deformable_pair.h"
#include "contact_path/contact/rigid_pair.h"
#include "contact_path/contact/tendon_eye.h"
#include "contact_path/scene/boundary_curve.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/surface.h"
#include "contact_path/scene/tendon_route.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

NodePlace PlaceOf(const Structure& structure, int node) {
  return {{structure.Dof(node, 0), structure.Dof(node, 1)}, structure.StartPosition(node)};
}

struct PlacedBoundary {
  std::shared_ptr<const DeformableBoundary> boundary;
  std::vector<Eigen::Vector2d> initial;  // places of its nodes in the scene, in any stage of a program
  std::array<int, 2> across = {-1, -1};  // SymmetryAxes()
};

PlacedBoundary MakeBoundary(const BoundarySurface& surface, const Scene& scene, const SceneIndex& index,
                            const Structure& structure) {
  PlacedBoundary placed;
  std::vector<NodePlace> nodes;
  std::vector<Eigen::Vector2d> start;
  for (const std::string& name : surface.nodes) {
    const std::size_t node = index.Node(name);
    nodes.push_back(PlaceOf(structure, static_cast<int>(node)));
    start.push_back(nodes.back().held);
    placed.initial.emplace_back(scene.nodes[node].x, scene.nodes[node].y);
  }
  std::vector<std::vector<MovingPlace>> elements;
  if (!surface.closed)
    for (const std::vector<std::string_view>& element : ElementsBehind(surface, scene)) {
      elements.emplace_back();
      for (const std::string_view node : element)
        elements.back().emplace_back(structure.PointOf(static_cast<int>(index.Node(node))));
    }
  const auto boundary = std::make_shared<DeformableBoundary>(std::move(nodes), start, surface.closed, surface.radius);
  boundary->SetSolid(std::move(elements));
  placed.across = SymmetryAxes(surface, scene,
                               [&](const std::string& name) -> const Node& { return scene.nodes[index.Node(name)]; });
  boundary->SetMirroredEnds(placed.across);
  placed.boundary = boundary;
  return placed;
}

}  // namespace

ContactPairs BuildContacts(const Scene& scene, const Structure& structure) {
  return BuildContacts(scene, SceneIndex(scene), structure);
}

ContactPairs BuildContacts(const Scene& scene, const SceneIndex& index, const Structure& structure,
                           const std::vector<double>& slip_origins) {
  struct Placed {
    std::shared_ptr<const Surface> surface;
    MovingFrame frame;
    double friction_rate = 0.0;
  };
  std::vector<Placed> obstacles;
  for (const Obstacle& obstacle : scene.obstacles) obstacles.push_back({MakeSurface(obstacle), {}});
  for (const ObstacleMotion& motion : scene.obstacle_motions) {
    MovingFrame& of = obstacles[index.Obstacle(motion.obstacle)].frame;
    of.origin[0].rate = motion.dx;
    of.origin[1].rate = motion.dy;
    of.angle.rate = motion.turn;
    if (motion.turn != 0.0) of.about = of.start = {motion.about_x, motion.about_y};
  }
  for (std::size_t i = 0; i < obstacles.size(); ++i)
    if (const std::string& body = scene.obstacles[i].body; !body.empty())
      obstacles[i].frame = structure.FrameOfBody(static_cast<int>(index.Node(body)));

  for (const FrictionChange& change : scene.friction_changes)
    obstacles[index.Obstacle(change.obstacle)].friction_rate = change.rate;

  std::vector<PlacedBoundary> boundaries(scene.surfaces.size());
  const Eigen::VectorXd force_bounds = structure.ForceBounds();
  ContactPairs contacts;
  for (const ContactCandidate& candidate : scene.contacts) {
    const auto node = static_cast<int>(index.Node(candidate.node));
    const BroughtOn overlap = {candidate.overlap_at_0, candidate.overlap_rate};
    if (candidate.OnSurface()) {
      const BoundarySurface& surface = scene.surfaces[index.Surface(candidate.surface)];
      PlacedBoundary& on = boundaries[index.Surface(candidate.surface)];
      if (on.boundary == nullptr) on = MakeBoundary(surface, scene, index, structure);
      contacts.push_back(std::make_unique<DeformablePair>(
          on.boundary, PatchesFor(candidate.node, surface, on.initial, on.across), PlaceOf(structure, node),
          candidate.friction, force_bounds, overlap, candidate.twin_of.empty() ? 0.0 : tolerances::kRootOfRounding));
      continue;
    }
    if (candidate.at_eye) {
      const Tendon &before = PieceAtEye(scene, candidate.node, 1), &behind = PieceAtEye(scene, candidate.node, 0);
      TendonEye::Roller roller;
      if (const double rho = SignedRadius(before, 1); rho != 0.0)
        roller = {rho > 0.0 ? 1.0 : -1.0, before.wrapped[1] + behind.wrapped[0]};
      contacts.push_back(std::make_unique<TendonEye>(
          MakeSpan(before, scene, index, structure), MakeSpan(behind, scene, index, structure),
          Coordinate{structure.Dof(node, 0), scene.nodes[static_cast<std::size_t>(node)].x}, candidate.friction,
          roller));
      continue;
    }
    const std::size_t at = index.Obstacle(candidate.obstacle);
    const Obstacle& obstacle = scene.obstacles[at];
    const MovingFrame& frame = obstacles[at].frame;
    const bool is_body = IsBody(scene.nodes[static_cast<std::size_t>(node)]);
    const FixedPoint point = is_body ? FixedPoint{structure.FrameOfBody(node)} : structure.PointOf(node);
    const Obstacle* const circle = RollingCircle(candidate, scene);
    const bool of_body = circle != nullptr || structure.AttachmentOf(node) != nullptr || !obstacle.body.empty();
    const bool turns = of_body || point.frame.angle.dof >= 0;
    const bool can_slide = CanSlide(turns || point.frame.origin[0].dof >= 0, turns || point.frame.origin[1].dof >= 0,
                                    obstacle, frame.angle.rate != 0.0);
    std::optional<Eigen::Vector2d> slip_origin;
    if (const std::size_t k = 2 * contacts.size(); can_slide && !slip_origins.empty())
      slip_origin = Eigen::Vector2d(slip_origins[k], slip_origins[k + 1]);
    Rolling rolls;
    std::shared_ptr<const Surface> surface = obstacles[at].surface;
    if (circle != nullptr) {
      rolls = {circle->radius, point.frame.angle, frame.angle};
      surface = MakeSurface(obstacle, circle->radius);
    }
    contacts.push_back(std::make_unique<RigidPair>(std::move(surface), MovingPlace::SeenFrom(frame, point),
                                                   can_slide ? candidate.FrictionWith(obstacle) : 0.0, force_bounds,
                                                   slip_origin, of_body ? tolerances::kRootOfRounding : 0.0, rolls,
                                                   obstacles[at].friction_rate, overlap));
  }
  return contacts;
}

}  // namespace contact_path
