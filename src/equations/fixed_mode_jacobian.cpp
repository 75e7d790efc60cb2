#include "contact_path/equations/fixed_mode_jacobian.h"

#include <algorithm>
#include <vector>

namespace contact_path {

template <typename Emit>
void FixedModeJacobian::ForEachMotionEntry(const MotionEquation& of, const PortsAt& at, Emit emit) const {
  const Law& law = laws_[of.motion.law];
  const LawVector& gradient = at[of.motion.port].gradient;
  const std::size_t m = at.dofs.size();
  for (std::size_t k = 0; k <= m; ++k)
    if (law.Moves(of.motion.port, k))
      emit(k < m ? at.dofs[k] : laws_.NumDofs(), of.equation, of.motion.sign * gradient[static_cast<Eigen::Index>(k)]);
}

template <typename Emit>
void FixedModeJacobian::ForEachForceEntry(std::size_t law, const PortsAt& at, Emit emit) const {
  const Law& of = laws_[law];
  const StateRule& state = laws_.StateOf(law);
  for (std::size_t k = 0; k < at.dofs.size(); ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    for (std::size_t p = 0; p < of.NumPorts(); ++p) {
      const PortRule& port = state.ports[p];
      if (port.kind == PortRule::Kind::kFree || !of.Moves(p, k)) continue;
      if (port.Holds())
        emit(laws_.UnknownOf(law, p), at.dofs[k], -at[p].factor * at[p].gradient[e]);
      else
        emit(laws_.UnknownOf(law, 0), at.dofs[k], -(port.ratio * at[p].factor) * at[p].gradient[e]);
    }
  }
}

template <typename Emit>
void FixedModeJacobian::ForEachCurvatureEntry(const PortsAt& at, const PortReals& forces, Emit emit) const {
  const LawMatrix change = at.ForceChange(forces);
  const std::size_t m = at.dofs.size();
  for (std::size_t column = 0; column < m; ++column)
    for (std::size_t row = 0; row <= m; ++row)
      emit(row < m ? at.dofs[row] : laws_.NumDofs(), at.dofs[column],
           -change(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
}

template <typename Emit>
void FixedModeJacobian::ForEachConstantEntry(Emit emit) const {
  for (Eigen::Index column = 0; column < laws_.NumDofs(); ++column)
    emit(laws_.NumDofs(), column, -structure_.Loads().Reference()[column]);
  Eigen::Index k = 0;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    emit(layout_.first_support + k, prescribed.dof, -1.0);
    emit(prescribed.dof, layout_.first_support_equation + k, 1.0);
    emit(laws_.NumDofs(), layout_.first_support_equation + k, -prescribed.rate);
    ++k;
  }
  for (const MotionEquation& of : layout_.motions)
    if (of.compliance != 0.0) emit(of.force, of.equation, of.compliance);
  for (std::size_t c = 0; c < layout_.active.size(); ++c) {
    const LimitRule& rule = limits_.RuleOf(layout_.active[c]);
    if (!rule.OfForces()) continue;
    for (std::size_t p = 0; p < rule.weights.size(); ++p)
      if (rule.weights[p] != 0.0)
        emit(laws_.UnknownOf(static_cast<std::size_t>(layout_.active[c].law), p),
             layout_.first_active_equation + static_cast<Eigen::Index>(c), rule.weights[p]);
  }
  if (layout_.load_factor_fixed) emit(laws_.NumDofs(), layout_.num_equations - 1, 1.0);
}

void FixedModeJacobian::Rebuild(const Eigen::SparseMatrix<double>& tangent) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(static_cast<std::size_t>(tangent.nonZeros() + laws_.NumDofs()) + 6 * laws_.Acting().size() +
                   4 * static_cast<std::size_t>(layout_.num_equations - laws_.NumDofs()));
  const auto add = [&triplets](Eigen::Index unknown, Eigen::Index equation, double value) {
    triplets.emplace_back(unknown, equation, value);
  };
  const auto add_place = [&triplets](Eigen::Index unknown, Eigen::Index equation, double) {
    triplets.emplace_back(unknown, equation, 0.0);
  };
  for (Eigen::Index column = 0; column < laws_.NumDofs(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent, column); it; ++it) add(it.row(), column, 0.0);
  ForEachConstantEntry(add);
  // Derivatives of laws without curvature are the same everywhere. Those of others come with each point.
  Eigen::VectorXd anywhere = Eigen::VectorXd::Zero(laws_.NumDofs() + 1);
  anywhere.head(laws_.NumDofs()) = structure_.Start();
  for (const std::size_t i : laws_.Acting()) {
    const PortsAt at = laws_.Evaluate(i, anywhere);
    if (laws_[i].Curved()) {
      ForEachForceEntry(i, at, add_place);
      ForEachCurvatureEntry(at, {}, add_place);
    } else {
      ForEachForceEntry(i, at, add);
    }
  }
  for (const MotionEquation& of : layout_.motions) {
    const PortsAt at = laws_.Evaluate(of.motion.law, anywhere);
    if (laws_[of.motion.law].Curved())
      ForEachMotionEntry(of, at, add_place);
    else
      ForEachMotionEntry(of, at, add);
  }
  transposed_.resize(layout_.num_unknowns, layout_.num_equations);
  transposed_.setFromTriplets(triplets.begin(), triplets.end());
  transposed_.makeCompressed();
  if (layout_.curved) constant_ = Eigen::Map<const Eigen::VectorXd>(transposed_.valuePtr(), transposed_.nonZeros());
}

const Eigen::SparseMatrix<double>& FixedModeJacobian::At(const Eigen::VectorXd& x,
                                                         const Eigen::SparseMatrix<double>& tangent) {
  if (transposed_.rows() == 0) Rebuild(tangent);
  if (layout_.curved) std::copy_n(constant_.data(), constant_.size(), transposed_.valuePtr());
  // The places of the tangent are among the places of transposed_, in the same order.
  for (Eigen::Index column = 0; column < laws_.NumDofs(); ++column) {
    Eigen::Index place = transposed_.outerIndexPtr()[column];
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent, column); it; ++it, ++place) {
      while (transposed_.innerIndexPtr()[place] != it.row()) ++place;
      transposed_.valuePtr()[place] = it.value();
    }
  }
  if (!layout_.curved) return transposed_;
  const auto add = [this](Eigen::Index unknown, Eigen::Index equation, double value) {
    transposed_.coeffRef(unknown, equation) += value;
  };
  for (const std::size_t i : laws_.Acting()) {
    if (!laws_[i].Curved()) continue;
    const PortsAt at = laws_.Evaluate(i, x);
    ForEachForceEntry(i, at, add);
    ForEachCurvatureEntry(at, laws_.ForcesOf(i, x), add);
  }
  for (const MotionEquation& of : layout_.motions)
    if (laws_[of.motion.law].Curved()) ForEachMotionEntry(of, laws_.Evaluate(of.motion.law, x), add);
  return transposed_;
}

}  // namespace contact_path
