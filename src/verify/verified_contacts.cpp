#include "verify/verified_contacts.h"

#include <cmath>
#include <utility>

#include "contact_path/scene/can_slide.h"

namespace contact_path {
namespace {

constexpr double kSoft = 1e-6;  // of F: where forces across a contact are smaller, F is no measure of them

// Bounds of the forces on a node, of the loads and for a motion of L of the parts [force]: of parts that turn, in any
// direction.
struct ForceBounds {
  double any = 0.0, x = 0.0, y = 0.0;
};

// By node.
std::vector<ForceBounds> BoundForces(const Scene& scene, const SceneIndex& index, const Configuration& configuration,
                                     double length, double load_factor) {
  std::vector<ForceBounds> bounds(scene.nodes.size());
  const std::vector<double>& at = configuration.reference;
  for (const Bar& bar : scene.bars) {
    const std::size_t a = index.Node(bar.nodes[0]), b = index.Node(bar.nodes[1]);
    const double span = std::hypot(at[2 * b] - at[2 * a], at[2 * b + 1] - at[2 * a + 1]);
    const double force = bar.EA / (bar.rest_length > 0.0 ? bar.rest_length : span) * length;
    bounds[a].any += force;
    bounds[b].any += force;
  }
  for (const Superelement& part : scene.superelements) {
    const std::size_t size = 2 * part.nodes.size();
    for (std::size_t k = 0; k < size; k += 2) {
      ForceBounds& bound = bounds[index.Node(part.nodes[k / 2])];
      for (std::size_t j = 0; j < size; ++j) {
        bound.x += std::abs(part.stiffness[k * size + j]) * length;
        bound.y += std::abs(part.stiffness[(k + 1) * size + j]) * length;
      }
    }
  }
  for (const Load& load : scene.loads) {
    ForceBounds& bound = bounds[index.Node(load.node)];
    const double factor = load.constant ? 1.0 : load_factor;
    bound.x += std::abs(load.fx) * factor;
    bound.y += std::abs(load.fy) * factor;
  }
  return bounds;
}

}  // namespace

std::vector<VerifiedContact> VerifiedContacts(const Scene& scene, const SceneIndex& index,
                                              const Configuration& configuration, const Scaling& scaling,
                                              const std::vector<double>& rates, double load) {
  const std::vector<ForceBounds> bounds = BoundForces(scene, index, configuration, scaling.length, load);
  std::vector<VerifiedContact> contacts;
  contacts.reserve(scene.contacts.size());
  for (const ContactCandidate& candidate : scene.contacts) {
    const Obstacle& obstacle = scene.obstacles[index.Obstacle(candidate.obstacle)];
    VerifiedContact contact;
    contact.node = index.Node(candidate.node);
    const Node& node = scene.nodes[contact.node];
    const double length = std::hypot(obstacle.nx, obstacle.ny);
    contact.nx = obstacle.nx / length;
    contact.ny = obstacle.ny / length;
    const bool can_slide = CanSlide(!node.fixed_x || rates[2 * contact.node] != 0.0,
                                    !node.fixed_y || rates[2 * contact.node + 1] != 0.0, obstacle);
    contact.friction = can_slide ? obstacle.friction : 0.0;
    contact.name = candidate.Name();
    const ForceBounds& bound = bounds[contact.node];
    const double across = (bound.any + std::abs(contact.nx) * bound.x + std::abs(contact.ny) * bound.y) / scaling.force;
    if (across > 0.0 && across < kSoft) contact.unit = across;
    contacts.push_back(std::move(contact));
  }
  return contacts;
}

}  // namespace contact_path
