#include "contact_path/path/work.h"

#include <cmath>
#include <vector>

#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {
namespace {

double DrivingForce(const Model& model, const PathPoint& point) {
  // With both reactions of each contact among the unknowns, whatever its state: those of a regularised point are not
  // zero where it is open.
  FixedStateSystem system(model.structure, model.contacts);
  system.SetStates(std::vector<ContactState>(model.contacts.size(), ContactState::kStick),
                   Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.contacts.size())));
  const Eigen::VectorXd x = system.Pack(point), still = Eigen::VectorXd::Zero(x.size());
  return system.DrivingForceAlong(x, still, still).value;
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
