#include "contact_path/path/work.h"

#include <cmath>

namespace contact_path {

Work WorkOfIncrement(const Model& model, const PathPoint& from, const PathPoint& to) {
  const Eigen::VectorXd du = to.u - from.u;
  Work work;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    if (to.states[i] != ContactState::kSlipPlus && to.states[i] != ContactState::kSlipMinus) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const double mean = 0.5 * (from.rn[k] + to.rn[k]);
    work.friction += model.contacts[i].friction * mean * std::abs(model.contacts[i].tangential.Rate(du));
  }
  const Structure& structure = model.structure;
  work.loads = 0.5 * (from.s + to.s) * structure.ReferenceLoad().dot(du) + structure.ConstantLoad().dot(du);
  const double unit = model.scaling.force * model.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

}  // namespace contact_path
