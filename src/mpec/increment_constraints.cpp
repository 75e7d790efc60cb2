#include "contact_path/mpec/increment_constraints.h"

namespace contact_path {

Eigen::VectorXd IncrementConstraints::Values(const Eigen::VectorXd& x) const {
  const Eigen::Index nd = slots_.NumDofs();
  Eigen::VectorXd force(nd);
  structure_.InternalForce(slots_.U(x), force);
  structure_.Loads().TakeFrom(force, slots_.LoadFactor(x));
  force /= slots_.Length();
  Eigen::VectorXd values(slots_.NumConstraints());
  for (const Slot& slot : slots_.All()) {
    const PortsAt at = slots_.Kinematics(slot, x);
    for (std::size_t p = 0; p < slot.NumForces(); ++p)
      at.AddForce(at[p].gradient, -x[slot.ForceOf(p)] * at[p].factor, &force);
    if (slot.always) {
      for (std::size_t p = 0; p < slot.NumForces(); ++p)
        values[slot.gap_row + static_cast<Eigen::Index>(p)] = at[p].motion;
      continue;
    }
    const double gap = at[kNormal].motion, rn = x[slot.rn];
    values[slot.gap_row] = gap;
    values[slot.gap_row + 1] = gap * rn;
    if (!slot.Frictional()) continue;
    const double slip = at[kTangent].motion, rt = x[slot.rt], lambda = x[slot.lambda];
    const double mu = slot.pair->Friction();
    values.segment<5>(slot.friction_row) << lambda - slip, lambda + slip, mu * rn - rt, mu * rn + rt,
        lambda * mu * rn + slip * rt;
  }
  for (const Support& support : slots_.Supports()) {
    const PrescribedDof& prescribed = *support.prescribed;
    force[prescribed.dof] -= x[support.reaction];
    values[support.row] =
        (slots_.From().u[prescribed.dof] - prescribed.start - prescribed.rate * slots_.From().s) / slots_.Length() +
        x[prescribed.dof] - prescribed.rate * x[nd];
  }
  values.head(nd) = force;
  return values;
}

void IncrementConstraints::AddGap(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x,
                                  MatrixEntries* entries) const {
  const double rn = x[slot.rn];
  slots_.ForEachVariableOf(slot, kNormal, [&](Eigen::Index variable, Eigen::Index k) {
    const double gradient = at[kNormal].gradient[k];
    if (variable < slots_.NumDofs()) entries->emplace_back(variable, slot.rn, -at[kNormal].factor * gradient);
    entries->emplace_back(slot.gap_row, variable, gradient);
    entries->emplace_back(slot.gap_row + 1, variable, gradient * rn);
  });
  entries->emplace_back(slot.gap_row + 1, slot.rn, at[kNormal].motion + slot.compliance[kNormal] * rn);
  if (slot.compliance[kNormal] > 0.0) entries->emplace_back(slot.gap_row, slot.rn, slot.compliance[kNormal]);
}

void IncrementConstraints::AddHeld(const Slot& slot, const PortsAt& at, MatrixEntries* entries) const {
  for (std::size_t p = 0; p < slot.NumForces(); ++p) {
    const Eigen::Index force = slot.ForceOf(p), row = slot.gap_row + static_cast<Eigen::Index>(p);
    slots_.ForEachVariableOf(slot, p, [&](Eigen::Index variable, Eigen::Index k) {
      if (variable < slots_.NumDofs()) entries->emplace_back(variable, force, -at[p].factor * at[p].gradient[k]);
      entries->emplace_back(row, variable, at[p].gradient[k]);
    });
    if (slot.compliance[p] > 0.0) entries->emplace_back(row, force, slot.compliance[p]);
  }
}

void IncrementConstraints::AddFriction(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x,
                                       MatrixEntries* entries) const {
  const double slip = at[kTangent].motion, rn = x[slot.rn], rt = x[slot.rt], lambda = x[slot.lambda];
  const double mu = slot.pair->Friction(), gives = slot.compliance[kTangent];
  slots_.ForEachVariableOf(slot, kTangent, [&](Eigen::Index variable, Eigen::Index k) {
    const double gradient = at[kTangent].gradient[k];
    if (variable < slots_.NumDofs()) entries->emplace_back(variable, slot.rt, -at[kTangent].factor * gradient);
    entries->emplace_back(slot.friction_row, variable, -gradient);
    entries->emplace_back(slot.friction_row + 1, variable, gradient);
    entries->emplace_back(slot.friction_row + 4, variable, gradient * rt);
  });
  if (gives > 0.0) {
    entries->emplace_back(slot.friction_row, slot.rt, -gives);
    entries->emplace_back(slot.friction_row + 1, slot.rt, gives);
  }
  entries->emplace_back(slot.friction_row, slot.lambda, 1.0);
  entries->emplace_back(slot.friction_row + 1, slot.lambda, 1.0);
  entries->emplace_back(slot.friction_row + 2, slot.rn, mu);
  entries->emplace_back(slot.friction_row + 2, slot.rt, -1.0);
  entries->emplace_back(slot.friction_row + 3, slot.rn, mu);
  entries->emplace_back(slot.friction_row + 3, slot.rt, 1.0);
  entries->emplace_back(slot.friction_row + 4, slot.lambda, mu * rn);
  entries->emplace_back(slot.friction_row + 4, slot.rn, mu * lambda);
  entries->emplace_back(slot.friction_row + 4, slot.rt, slip + gives * rt);
}

void IncrementConstraints::AddTurns(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x,
                                    MatrixEntries* entries) const {
  // r_n and r_t over S, and Hessians times S.
  LawMatrix change = (x[slot.rn] * at[kNormal].factor) * at[kNormal].hessian;
  if (slot.rt >= 0) change += (x[slot.rt] * at[kTangent].factor) * at[kTangent].hessian;
  if (slot.rt >= 0 && at[kTangent].factor_gradient.size() > 0)
    change += x[slot.rt] * at[kTangent].gradient * at[kTangent].factor_gradient.transpose();
  slots_.ForEachVariable(slot, [&](Eigen::Index row, Eigen::Index a) {
    if (row == slots_.NumDofs()) return;
    slots_.ForEachVariable(
        slot, [&](Eigen::Index column, Eigen::Index b) { entries->emplace_back(row, column, -change(a, b)); });
  });
}

MatrixEntries IncrementConstraints::Jacobian(const Eigen::VectorXd& x) const {
  MatrixEntries entries;
  const Eigen::Index nd = slots_.NumDofs();
  structure_.Tangent(slots_.U(x), &tangent_);
  for (Eigen::Index column = 0; column < nd; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it)
      entries.emplace_back(it.row(), column, it.value());
  for (Eigen::Index row = 0; row < nd; ++row)
    if (structure_.Loads().Reference()[row] != 0.0) entries.emplace_back(row, nd, -structure_.Loads().Reference()[row]);
  for (const Slot& slot : slots_.All()) {
    const PortsAt at = slots_.Kinematics(slot, x);
    if (slot.always)
      AddHeld(slot, at, &entries);
    else
      AddGap(slot, at, x, &entries);
    if (slot.law->Curved()) AddTurns(slot, at, x, &entries);
    if (slot.Frictional()) AddFriction(slot, at, x, &entries);
  }
  for (const Support& support : slots_.Supports()) {
    entries.emplace_back(support.prescribed->dof, support.reaction, -1.0);
    entries.emplace_back(support.row, support.prescribed->dof, 1.0);
    entries.emplace_back(support.row, nd, -support.prescribed->rate);
  }
  return entries;
}

MatrixEntries IncrementConstraints::Hessian(const Eigen::VectorXd& x, double diagonal,
                                            const Eigen::VectorXd& multipliers) const {
  MatrixEntries entries;
  const Eigen::Index nd = slots_.NumDofs();
  // Second order of the equilibrium rows: S times the derivative of the tangent along their multipliers.
  structure_.TangentDerivative(slots_.U(x), multipliers.head(nd), &tangent_);
  for (Eigen::Index column = 0; column < nd; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it)
      if (it.row() >= column)
        entries.emplace_back(it.row(), column, slots_.Length() * it.value() + (it.row() == column ? diagonal : 0.0));
  entries.emplace_back(nd, nd, diagonal);
  for (const Slot& slot : slots_.All()) {
    const PortsAt at = slots_.Kinematics(slot, x);
    const PortReals& gives = slot.compliance;
    if (!slot.always) {
      const double gap_product = multipliers[slot.gap_row + 1];
      if (gives[kNormal] > 0.0) entries.emplace_back(slot.rn, slot.rn, 2.0 * gives[kNormal] * gap_product);
      slots_.ForEachVariableOf(slot, kNormal, [&](Eigen::Index variable, Eigen::Index k) {
        entries.emplace_back(slot.rn, variable, gap_product * at[kNormal].gradient[k]);
      });
    }
    if (slot.Frictional()) {
      const double slip_product = multipliers[slot.friction_row + 4];
      if (gives[kTangent] > 0.0) entries.emplace_back(slot.rt, slot.rt, 2.0 * gives[kTangent] * slip_product);
      entries.emplace_back(slot.lambda, slot.rn, slip_product * slot.pair->Friction());
      slots_.ForEachVariableOf(slot, kTangent, [&](Eigen::Index variable, Eigen::Index k) {
        entries.emplace_back(slot.rt, variable, slip_product * at[kTangent].gradient[k]);
      });
    }
    if (slot.law->Curved()) AddCurvature(slot, at, x, multipliers, &entries);
  }
  return entries;
}

void IncrementConstraints::AddCurvature(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x,
                                        const Eigen::VectorXd& multipliers, MatrixEntries* entries) const {
  const Eigen::Index nd = slots_.NumDofs();
  const Law& law = *slot.law;
  const double rn = x[slot.rn], rt = slot.rt < 0 ? 0.0 : x[slot.rt];
  // The multipliers of the equilibrium equations; the multiplier of the load factor is none.
  const LawVector weights = at.Local(multipliers.head(nd), 0.0);
  for (std::size_t p = 0; p < slot.NumForces(); ++p) {
    LawVector by_force = at[p].factor * (at[p].hessian * weights);
    if (at[p].factor_gradient.size() > 0) by_force += at[p].gradient.dot(weights) * at[p].factor_gradient;
    slots_.ForEachVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
      entries->emplace_back(slot.ForceOf(p), variable, -by_force[k]);
    });
  }
  PortReals along_port = {multipliers[slot.gap_row], slot.always && slot.rt >= 0 ? multipliers[slot.gap_row + 1] : 0.0};
  if (!slot.always) along_port[kNormal] += multipliers[slot.gap_row + 1] * rn;
  if (slot.Frictional())
    along_port[kTangent] =
        multipliers[slot.friction_row + 1] - multipliers[slot.friction_row] + multipliers[slot.friction_row + 4] * rt;
  LawMatrix second;
  const Eigen::VectorXd u = slots_.U(x);
  const double s = slots_.LoadFactor(x);
  const int patch = slots_.PatchOf(slot, u, s);
  const LawDofs dofs = law.Dofs(patch);
  law.ForceHessian(u, s, patch, {rn, rt}, LocalOf(dofs, multipliers.head(nd), 0.0), &second);
  if (slot.Deformable()) second = Spread(second, dofs, slot.dofs);
  LawMatrix along = along_port[kNormal] * at[kNormal].hessian;
  if (slot.rt >= 0) along += along_port[kTangent] * at[kTangent].hessian;
  second = along - slots_.Length() * slots_.Length() * second;
  slots_.ForEachVariable(slot, [&](Eigen::Index row, Eigen::Index a) {
    slots_.ForEachVariable(slot, [&](Eigen::Index column, Eigen::Index b) {
      if (row >= column) entries->emplace_back(row, column, second(a, b));
    });
  });
}

}  // namespace contact_path
