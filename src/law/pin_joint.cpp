#include "contact_path/law/pin_joint.h"

#include <cstddef>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/tolerances.h"

namespace contact_path {

PinJoint::PinJoint(MovingPlace apart, const Eigen::Vector2d& at_start, double compliance)
    : apart_(std::move(apart)), at_start_(at_start) {
  Traits traits;
  traits.num_ports = 2;
  traits.dofs = apart_.Dofs();
  for (std::size_t k = 0; k <= traits.dofs.size(); ++k)
    traits.moves[0][k] = traits.moves[1][k] = apart_.Moves(static_cast<Eigen::Index>(k));
  traits.couples = true;
  traits.compliant = compliance > 0.0;
  traits.curved = !apart_.Affine();
  StateRule together;
  together.ports[0] = together.ports[1] = {PortRule::Kind::kHeld, 0.0, compliance};
  SetLaw(traits, {together});
}

void PinJoint::Evaluate(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& reference,
                        PortsAt* ports) const {
  ports->dofs = OwnDofs();
  const PlaceAt apart(apart_, u, s);
  for (const Eigen::Index axis : {0, 1}) {
    const auto p = static_cast<std::size_t>(axis);
    PortAt& port = (*ports)[p];
    port.motion = apart.x[axis] - at_start_[axis] - reference[p];
    port.gradient = apart.first.row(axis).transpose();
    if (Curved()) port.hessian = apart.Second(Eigen::Vector2d::Unit(axis));
  }
}

void PinJoint::ForceHessian(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& forces,
                            const LawVector& weights, LawMatrix* hessian) const {
  // The force is a gradient: its second derivatives, weighted, are the change of its first ones along the weights.
  *hessian = PlaceAt(apart_, u, s).SecondChange({forces[0], forces[1]}, weights);
}

std::vector<Ray> PinJoint::Rays(const Eigen::VectorXd& /*u*/, double /*s*/, int /*piece*/,
                                const ActiveSetTolerance& /*tolerance*/) const {
  return {{{1.0, 0.0}, {1.0, 0.0}}, {{-1.0, 0.0}, {-1.0, 0.0}}, {{0.0, 1.0}, {0.0, 1.0}}, {{0.0, -1.0}, {0.0, -1.0}}};
}

std::vector<std::unique_ptr<const PinJoint>> BuildPins(const Scene& scene, const SceneIndex& index,
                                                       const Structure& structure,
                                                       const std::vector<double>& reference) {
  const auto written = [&](std::size_t node) { return Eigen::Vector2d(reference[2 * node], reference[2 * node + 1]); };
  const std::vector<bool> in_loops = PinsInLoops(scene);
  std::vector<std::unique_ptr<const PinJoint>> pins;
  for (const Pin& pin : scene.pins) {
    const std::size_t first = index.Node(pin.nodes[0]), second = index.Node(pin.nodes[1]);
    pins.push_back(std::make_unique<const PinJoint>(
        MovingPlace::Between(structure.PointOf(static_cast<int>(second)), structure.PointOf(static_cast<int>(first))),
        written(first) - written(second), in_loops[pins.size()] ? tolerances::kRootOfRounding : 0.0));
  }
  return pins;
}

}  // namespace contact_path
