#include "verify/verified_stage.h"

#include <cmath>
#include <set>
#include <utility>

#include "contact_path/scene/program.h"
#include "contact_path/scene/surface.h"

namespace contact_path {
namespace {

constexpr double kSoft = 1e-6;       // of F: where forces across a contact are smaller, F is no measure of them
constexpr double kRounding = 2e-13;  // of F: a contact that pulls with more is not at rounding
constexpr double kClosing = 10.0;    // the nodes of a surface have shares in a gap: each moves by more than that

// In the order of the scene. check, configuration: of the scene. rates: x, y by node, of the fixed components [length]
// per unit of the load factor. load: largest load factor of the path.
std::vector<VerifiedContact> VerifiedContacts(const Scene& scene, const SceneIndex& index, const ResidualCheck& check,
                                              const Configuration& configuration, const Scaling& scaling,
                                              const std::vector<double>& rates, double load) {
  const std::vector<ContactForceBound> forces = check.BoundContactForces(scaling.length, load);
  CheckedState start;
  start.positions = configuration.start;
  start.rotations = configuration.start_rotations;
  std::vector<VerifiedContact> contacts;
  contacts.reserve(scene.contacts.size());
  std::set<std::string> turning;
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    if (motion.turn != 0.0) turning.insert(motion.obstacle);
  // Of an obstacle where the node cannot slide: none.
  const auto friction_of = [&](const ContactCandidate& candidate, std::size_t at) {
    if (candidate.OnSurface() || candidate.at_eye) return candidate.friction;
    const Obstacle& obstacle = scene.obstacles[index.Obstacle(candidate.obstacle)];
    const Node& node = scene.nodes[at];
    const bool can_slide =
        CanSlide(!node.fixed_x || rates[2 * at] != 0.0, !node.fixed_y || rates[2 * at + 1] != 0.0, obstacle,
                 turning.count(candidate.obstacle) > 0 || !obstacle.body.empty() || candidate.Rolls());
    return can_slide ? candidate.FrictionWith(obstacle) : 0.0;
  };
  // Parts pass on forces: of the stiffest one the rounding, too.
  const double stiffest = check.LargestStiffness() * scaling.length;
  double closing = 0.0;  // largest force that closes a gap which counts as closed at the start
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const double gap = std::abs(check.Gap(i, start)) / scaling.length;
    if (gap <= kExact) closing = std::max(closing, kClosing * gap * forces[i].of_all_parts);
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    VerifiedContact contact;
    contact.node = index.Node(scene.contacts[i].node);
    contact.friction = friction_of(scene.contacts[i], contact.node);
    contact.name = scene.contacts[i].Name();
    const double unit = forces[i].on_node / scaling.force;
    if (unit > 0.0 && unit < kSoft) contact.unit = unit;
    if (kStiff * unit > 1.0) contact.unit = kStiff * unit;
    contact.of_parts = std::max(1.0, forces[i].of_all_parts / scaling.force);
    if (const double give = check.Give(i); give > 0.0)
      contact.of_parts = std::max(contact.of_parts, scaling.length / (give * scaling.force));
    const double rounding = kRoundingOfParts * std::max(stiffest, forces[i].of_all_parts);
    contact.rounding = std::max(kRounding, rounding / (scaling.force * contact.unit));
    contact.closing = std::max(contact.rounding, closing / (scaling.force * contact.unit));
    contacts.push_back(std::move(contact));
  }
  return contacts;
}

}  // namespace

DrivingLoad::DrivingLoad(const Scene& scene, const SceneIndex& index) : by_node(scene.nodes.size()) {
  for (const Load& of : scene.loads) {
    if (of.constant) continue;
    const std::size_t i = index.Node(of.node);
    const Node& node = scene.nodes[i];
    const std::array<double, 3> free = {node.fixed_x ? 0.0 : of.fx, node.fixed_y ? 0.0 : of.fy,
                                        node.fixed_rotation ? 0.0 : of.moment};
    for (std::size_t k = 0; k < free.size(); ++k) by_node[i][k] += free[k];
  }
  double forces = 0.0, moments = 0.0;
  for (const auto& [fx, fy, moment] : by_node) {
    forces += fx * fx + fy * fy;
    moments += moment * moment;
  }
  moments_alone = forces == 0.0;
  size = std::sqrt(moments_alone ? moments : forces);
}

VerifiedStage::VerifiedStage(const TraceRequest& request, const SceneIndex& index_given, const Scaling& of_program,
                             std::size_t stage, double largest_load)
    : index(index_given),
      scene(StageScene(request, index, stage)),
      configuration(StageConfiguration(request, index, stage)),
      scaling(StageScales(request, index, stage, of_program)),
      check(scene, configuration, scaling),
      driving(scene, index),
      located(request.options.LocatesEvents()),
      rates(2 * scene.nodes.size()),
      turn_rates(scene.nodes.size()),
      stiffest(check.LargestStiffness() * scaling.length / scaling.force) {
  double farthest = 0.0;
  for (const double coordinate : configuration.start) farthest = std::max(farthest, std::abs(coordinate));
  // What moves takes nodes along, and lengths of arc are of the load factor, too.
  for (const SupportMotion& motion : scene.support_motions) {
    const std::size_t node = index.Node(motion.node);
    farthest += largest_load * std::hypot(motion.dx, motion.dy);
    rates[2 * node] = motion.dx;
    rates[2 * node + 1] = motion.dy;
    turn_rates[node] = motion.rotation;
  }
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    farthest += largest_load * std::hypot(motion.dx, motion.dy);
  for (const Obstacle& obstacle : scene.obstacles) {
    farthest = std::max({farthest, std::abs(obstacle.px), std::abs(obstacle.py), obstacle.radius});
    for (const double number : obstacle.points) farthest = std::max(farthest, std::abs(number));
  }
  rounding = kRecorded + kRoundingOfParts * (farthest / scaling.length + largest_load / scaling.load_factor);
  contacts = VerifiedContacts(scene, index, check, configuration, scaling, rates, largest_load);
}

}  // namespace contact_path
