#include "contact_path/path/work.h"

#include <cmath>

namespace contact_path {
namespace {

// The force that moving supports and obstacles exert along their motion.
double DrivingForce(const Model& model, const PathPoint& point) {
  const Eigen::VectorXd reactions = model.structure.SupportReactions(point.u, point.s);
  double force = 0.0;
  for (std::size_t k = 0; k < model.structure.PrescribedDofs().size(); ++k)
    force += model.structure.PrescribedDofs()[k].rate * reactions[static_cast<Eigen::Index>(k)];
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    Kinematics at;
    model.contacts[i]->Evaluate(point.u, point.s, 0.0, &at);
    const auto s = static_cast<Eigen::Index>(model.contacts[i]->Dofs().size());
    force -= point.rn[k] * at.gap_gradient[s] + point.rt[k] * at.xi_gradient[s];
  }
  return force;
}

}  // namespace

Work WorkOfIncrement(const Model& model, const PathPoint& from, const PathPoint& to) {
  const Eigen::VectorXd du = to.u - from.u;
  Work work;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    if (to.states[i] != ContactState::kSlipPlus && to.states[i] != ContactState::kSlipMinus) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const double mean = 0.5 * (from.rn[k] + to.rn[k]);
    work.friction +=
        model.contacts[i]->Friction() * mean * std::abs(model.contacts[i]->Slip(from.u, from.s, du, to.s - from.s));
  }
  const Structure& structure = model.structure;
  work.loads = 0.5 * (from.s + to.s) * structure.ReferenceLoad().dot(du) + structure.ConstantLoad().dot(du) +
               0.5 * (DrivingForce(model, from) + DrivingForce(model, to)) * (to.s - from.s);
  const double unit = model.scaling.force * model.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

}  // namespace contact_path
