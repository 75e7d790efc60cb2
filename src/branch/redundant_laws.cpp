#include "contact_path/branch/redundant_laws.h"

#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Of vectors of length 1, or zero, as columns.
bool Dependent(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return false;
  if (columns.cols() > columns.rows()) return true;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(columns);
  lu.setThreshold(tolerances::kDependent);
  return lu.rank() < columns.cols();
}

}  // namespace

RedundantLaws::RedundantLaws(const Laws& laws, const PathPoint& point, double gap) : laws_(laws) {
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const Law& law = laws[i];
    // What gives way is for the equations to tell.
    if (law.Compliant() || law.Dofs(0).empty() || law.Motion(0, point.u, point.s, point.modes[i].piece, {}) > gap)
      continue;
    PortsAt at;
    law.Evaluate(point.u, point.s, point.modes[i].piece, {}, &at);
    Holding holding = {i, {}, {}};
    for (std::size_t p = 0; p < law.NumPorts(); ++p) holding.gradients.push_back(at[p].gradient);
    for (std::size_t p = 0; p < law.NumPorts(); ++p) holding.factors.push_back(at[p].factor);
    by_dofs_[std::vector<int>(at.dofs.begin(), at.dofs.end())].push_back(std::move(holding));
  }
  // One law holds what moves in as many directions as it has ports in one way.
  for (auto of = by_dofs_.begin(); of != by_dofs_.end();) {
    const bool alone = of->second.size() == 1 && of->first.size() >= of->second.front().gradients.size();
    of = alone ? by_dofs_.erase(of) : std::next(of);
  }
}

bool RedundantLaws::Among(const States& states) const {
  return std::any_of(by_dofs_.begin(), by_dofs_.end(), [&](const auto& of) { return AmongThese(of.second, states); });
}

bool RedundantLaws::AmongThese(const std::vector<Holding>& laws, const States& states) const {
  const Eigen::Index q = laws.front().gradients.front().size();
  Eigen::MatrixXd motions(q, 0), forces(q - 1, 0);
  const auto append = [](Eigen::MatrixXd* columns, const auto& column) {
    columns->conservativeResize(Eigen::NoChange, columns->cols() + 1);
    columns->rightCols<1>() = column.normalized();
  };
  for (const Holding& holding : laws) {
    const StateRule& state = laws_[holding.law].In(states[holding.law]);
    if (state.idle) continue;
    for (std::size_t p = 0; p < holding.gradients.size(); ++p) {
      if (!state.ports[p].Holds()) continue;
      LawVector force = holding.gradients[p];
      for (std::size_t other = 1; p == 0 && other < holding.gradients.size(); ++other)
        if (state.ports[other].Follows())
          force += (state.ports[other].ratio * holding.factors[other]) * holding.gradients[other];
      append(&motions, holding.gradients[p]);
      append(&forces, force.head(q - 1));
    }
  }
  return Dependent(motions) || Dependent(forces);
}

}  // namespace contact_path
