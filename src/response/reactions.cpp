#include "contact_path/response/reactions.h"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "contact_path/contact/scene_contacts.h"
#include "contact_path/law/ports.h"
#include "contact_path/scene/expand.h"
#include "contact_path/structure/scene_elements.h"

namespace contact_path {
namespace {

Scene WithoutSupports(Scene scene) {
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.fixed_rotation = false;
  scene.support_motions.clear();
  return scene;
}

double Moment(const Eigen::Vector2d& arm, const Eigen::Vector2d& force) {
  return arm.x() * force.y() - arm.y() * force.x();
}

}  // namespace

ReactionProblem::ReactionProblem(const Scene& scaled, const SceneIndex& index, const Configuration& configuration,
                                 const Scaling& scaling)
    : scaling_(scaling),
      released_(WithoutSupports(scaled), index, configuration,
                MakeElements(scaled, index, configuration.reference, OneSided::kElements)),
      contacts_(BuildContacts(scaled, index, released_)),
      pins_(BuildPins(scaled, index, released_, configuration.reference)),
      supports_(SupportedNodes(scaled)),
      boundaries_(TouchedBoundaries(scaled)),
      boundary_of_(BoundaryOfContacts(scaled, boundaries_)) {
  for (const ContactCandidate& contact : scaled.contacts) {
    nodes_.push_back(index.Node(contact.node));
    const Obstacle* const circle = RollingCircle(contact, scaled);
    radii_.push_back(circle == nullptr ? 0.0 : circle->radius);
  }
  for (const Obstacle& obstacle : scaled.obstacles) points_.emplace_back().at = {obstacle.px, obstacle.py};
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (const std::string& body = scaled.obstacles[i].body; !body.empty()) {
      const MovingFrame frame = released_.FrameOfBody(static_cast<int>(index.Node(body)));
      points_[i].carried.emplace(FixedPoint{frame, points_[i].at - frame.start});
    }
  for (const ObstacleMotion& motion : scaled.obstacle_motions) {
    MovingPoint& point = points_[index.Obstacle(motion.obstacle)];
    point.velocity = {motion.dx, motion.dy};
    point.turn = motion.turn;
    point.about = {motion.about_x, motion.about_y};
  }
  for (const BoundarySurface& surface : scaled.surfaces) first_nodes_.push_back(index.Node(surface.nodes.front()));
}

Eigen::Vector2d ReactionProblem::PlaceOf(std::size_t node, const Eigen::VectorXd& u) const {
  return MovingPlace(released_.PointOf(static_cast<int>(node))).At(u, 0.0);
}

Eigen::Vector2d ReactionProblem::Centre(const TouchedBoundary& boundary, const Eigen::VectorXd& u, double s) const {
  if (boundary.is_surface) return PlaceOf(first_nodes_[boundary.place], u);
  const MovingPoint& point = points_[boundary.place];
  if (point.carried) return point.carried->At(u, s);
  return point.about + Eigen::Rotation2Dd(point.turn * s) * (point.at - point.about) + s * point.velocity;
}

Reactions ReactionProblem::At(const Eigen::VectorXd& values, const PathPoint& point,
                              const std::vector<PortReals>& pins) const {
  const Eigen::VectorXd u = released_.UnknownsOf(values);
  Reactions reactions;
  reactions.boundaries.resize(boundaries_.size());
  Eigen::VectorXd missing(released_.NumDofs());  // phi - s f - f_constant - T r
  released_.InternalForce(u, missing);
  released_.Loads().TakeFrom(missing, point.s);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double rn = NormalReaction(point, i), rt = TangentialReaction(point, i);
    if (rn == 0.0 && rt == 0.0) continue;
    PortsAt at;
    contacts_[i]->Evaluate(u, point.s, point.modes[i].piece, {}, &at);
    const double along = rt * at[kTangent].factor;
    const std::array<Coordinate, 2> node = released_.PointOf(static_cast<int>(nodes_[i])).frame.origin;
    Eigen::Vector2d on_node = Eigen::Vector2d::Zero();
    for (std::size_t j = 0; j < at.dofs.size(); ++j) {
      const auto entry = static_cast<Eigen::Index>(j);
      const double force = rn * at[kNormal].factor * at[kNormal].gradient[entry] + along * at[kTangent].gradient[entry];
      missing[at.dofs[j]] -= force;
      for (const int axis : {0, 1})
        if (at.dofs[j] == node[static_cast<std::size_t>(axis)].dof) on_node[axis] = force;
    }
    if (boundary_of_[i] == boundaries_.size()) continue;
    Resultant& sum = reactions.boundaries[boundary_of_[i]];
    sum.rx += scaling_.force * on_node.x();
    sum.ry += scaling_.force * on_node.y();
    sum.rm +=
        scaling_.force * scaling_.length *
        (Moment(PlaceOf(nodes_[i], u) - Centre(boundaries_[boundary_of_[i]], u, point.s), on_node) + radii_[i] * along);
  }
  for (std::size_t k = 0; k < pins_.size(); ++k) {
    PortsAt at;
    pins_[k]->Evaluate(u, point.s, 0, {}, &at);
    for (const std::size_t p : {0U, 1U}) at.AddForce(at[p].gradient, -pins[k][p], &missing);
  }
  for (const SupportedNode& support : supports_) {
    const auto number = static_cast<int>(support.node);
    Resultant& of = reactions.supports.emplace_back();
    if (support.x) of.rx = scaling_.force * missing[released_.Dof(number, 0)];
    if (support.y) of.ry = scaling_.force * missing[released_.Dof(number, 1)];
    if (support.rotation)
      of.rm = scaling_.force * scaling_.length * missing[released_.Dofs().Dof(number, Field::kRotation, 0)];
  }
  return reactions;
}

}  // namespace contact_path
