#include "scene/rules.h"

#include <cmath>

#include "contact_path/scene/surface.h"

namespace contact_path {
namespace {

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

}  // namespace

void ContactRules::CheckObstacles() {
  const KeyPath list = kScene.Key("obstacles");
  std::unordered_set<std::string> earlier;
  for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
    const Obstacle& obstacle = scene_.obstacles[i];
    const bool sound = checker_.CheckFields(list[i], obstacle, &earlier);
    if (const Node* const body = checker_.KnownNode(obstacle.body);
        !obstacle.body.empty() && (body == nullptr || !IsBody(*body)))
      checker_.Add(list[i].Key("body"), obstacle.body, "must name a body of the scene");
    const ShapeFault fault = FindShapeFault(obstacle);
    if (fault.field.empty()) {
      if (!HasSoundNumbers(obstacle)) continue;
      usable_obstacles_.insert(&obstacle);
      if (obstacle.shape != ObstacleShape::kHalfPlane) surfaces_.emplace(&obstacle, MakeSurface(obstacle));
    } else if (sound || obstacle.shape == ObstacleShape::kHalfPlane) {
      checker_.Add(list[i].Key(fault.field), fault.value, fault.rule);
    }
  }
}

void ContactRules::CheckContacts(double length) {
  const KeyPath list = kScene.Key("contacts");
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
    if (!earlier.insert(contact.Name()).second)
      checker_.Add(path, contact.Name(), "must not be repeated");
    else if (node != nullptr && surface != nullptr)
      boundaries_.CheckContact(path, contact, *node, *surface, length);
    else if (const Obstacle* const circle = RollingCircle(contact, scene_);
             circle != nullptr && obstacle != nullptr && usable_obstacles_.count(obstacle) > 0)
      CheckRolling(path, contact, *circle, *obstacle, length);
    else if (node != nullptr && obstacle != nullptr && usable_obstacles_.count(obstacle) > 0)
      CheckGeometry(path, contact, *node, *obstacle, length);
  }
}

void ContactRules::CheckPartner(const KeyPath& path, const ContactCandidate& contact) {
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

void ContactRules::CheckGeometry(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                                 const Obstacle& obstacle, double length) {
  if (obstacle.shape != ObstacleShape::kHalfPlane) return CheckOnCurve(path, contact, node, obstacle, length);
  const Projection at = ProjectNode(node, obstacle);
  const double free_part = std::hypot(node.fixed_x ? 0.0 : at.normal.x(), node.fixed_y ? 0.0 : at.normal.y());
  if (free_part <= kCancelled)
    checker_.Add(path.Key("node"), contact.node, "must be free to move along the normal of the obstacle");
  if (Refuses(contact, at.gap, length))
    checker_.Add(path, contact.Name(),
                 "initial position penetrates the obstacle by " + NumberText(-at.gap) +
                     "; its normal points to the side where nodes may be");
}

void ContactRules::CheckRolling(const KeyPath& path, const ContactCandidate& contact, const Obstacle& circle,
                                const Obstacle& obstacle, double length) {
  if (const std::string misfit = FindMisfit(obstacle, circle.radius); !misfit.empty())
    return checker_.Add(path.Key("obstacles")[0], circle.name, misfit);
  const Eigen::Vector2d centre(circle.px, circle.py);
  const std::unique_ptr<const Surface> surface = MakeSurface(obstacle);
  const NearestFoot nearest = surface->Nearest(centre);
  const double distance = nearest.is_end ? nearest.distance : surface->Project(centre, nearest.patch).gap;
  if (const double gap = distance - circle.radius; Refuses(contact, gap, length))
    checker_.Add(path, contact.Name(), "the circle penetrates the obstacle at the start by " + NumberText(-gap));
}

void ContactRules::CheckOnCurve(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                                const Obstacle& obstacle, double length) {
  if (node.fixed_x && node.fixed_y)
    checker_.Add(path.Key("node"), contact.node, "must be free to move along the normal of the obstacle");
  const Eigen::Vector2d x(node.x, node.y);
  const Surface& surface = *surfaces_.at(&obstacle);
  const NearestFoot nearest = surface.Nearest(x);
  const double gap = surface.Project(x, nearest.patch).gap;
  if (!nearest.is_end && Refuses(contact, gap, length))
    checker_.Add(path, contact.Name(),
                 "initial position penetrates the obstacle by " + NumberText(-gap) +
                     (obstacle.shape == ObstacleShape::kCircle
                          ? std::string("; nodes may be ") + (obstacle.inside ? "inside" : "outside")
                          : "; nodes may be on the left of the curve"));
}

}  // namespace contact_path
