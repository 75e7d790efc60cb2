#include "contact_path/mpec/increment_problem.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/linear/minimum_norm.h"
namespace contact_path {
namespace {

// Newton steps with one matrix to a point of (10).
constexpr int kCentralSteps = 3;
// Of a bound, over the barrier parameter: how far outside rounding may leave that point, and from where on it is
// inside.
constexpr double kOutside = 1e-2, kLeastDistance = 1e-3;

int Int(Eigen::Index index) { return static_cast<int>(index); }

// Of a patch of a deformable surface and the patches beside it.
LawDofs DofsBeside(const ContactPair& pair, int patch) {
  if (!pair.Deformable()) return pair.Dofs(patch);
  std::set<int> all;
  for (const int beside : {patch - 1, patch, patch + 1})
    if (pair.HasPatch(beside))
      for (const int dof : pair.Dofs(beside)) all.insert(dof);
  LawDofs dofs;
  for (const int dof : all) dofs.push_back(dof);
  return dofs;
}

}  // namespace

IncrementProblem::IncrementProblem(const Structure& structure, const ContactPairs& contacts, const PathPoint& from,
                                   std::vector<int> working_set, IncrementGoal goal)
    : structure_(structure),
      contacts_(contacts),
      from_(from),
      working_set_(std::move(working_set)),
      goal_(std::move(goal)),
      tangent_(structure.TangentPattern()) {
  const Eigen::Index nd = structure_.NumDofs();
  num_variables_ = nd + 1 + static_cast<Eigen::Index>(working_set_.size());
  num_constraints_ = nd;
  Eigen::VectorXd drive = Eigen::VectorXd::Zero(nd + 1);  // T_t r_t^k, by (u, s)
  for (std::size_t i = 0; i < working_set_.size(); ++i) {
    const ContactPair& pair = *contacts_[static_cast<std::size_t>(working_set_[i])];
    const int patch = pair.KnownPatch(from_.u, from_.s, from_.modes[static_cast<std::size_t>(working_set_[i])].piece);
    PortsAt at_start;
    pair.Evaluate(from_.u, from_.s, patch, {}, &at_start);
    const double reference = pair.SlipReference(from_.u, from_.s, patch);
    const Eigen::Index rn = nd + 1 + static_cast<Eigen::Index>(i);
    Slot slot{&pair, patch, DofsBeside(pair, patch), at_start, reference, rn, -1, -1, num_constraints_, -1};
    num_constraints_ += 2;
    if (pair.Frictional()) {
      slot.rt = num_variables_++;
      slot.lambda = num_variables_++;
      slot.friction_row = num_constraints_;
      num_constraints_ += 5;
      const double rt =
          at_start[kTangent].factor * TangentialReaction(from_, static_cast<std::size_t>(working_set_[i]));
      const LawVector& gradient = at_start[kTangent].gradient;
      at_start.AddForce(gradient, rt, &drive);
      drive[nd] += rt * gradient[gradient.size() - 1];  // the motion of the obstacle
    }
    slots_.push_back(slot);
  }
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs())
    supports_.push_back({&prescribed, num_variables_++, num_constraints_++});
  const double norm = drive.norm();
  linear_objective_ = -(norm > 0.0 ? 1.0 - goal_.dissipation : 1.0) * goal_.direction;
  if (norm > 0.0) linear_objective_ += goal_.dissipation / norm * drive;

  const Eigen::VectorXd x = Eigen::VectorXd::Zero(num_variables_);
  const auto record = [](std::vector<MatrixEntry>* structure_out) {
    return [structure_out](Eigen::Index row, Eigen::Index column, double) {
      structure_out->push_back({Int(row), Int(column)});
    };
  };
  ForEachJacobianEntry(x, record(&jacobian_structure_));
  ForEachHessianEntry(x, 1.0, Eigen::VectorXd::Zero(num_constraints_), record(&hessian_structure_));
}

PortsAt IncrementProblem::ScaledKinematics(const Slot& slot, const Eigen::VectorXd& x) const {
  const Eigen::Index nd = structure_.NumDofs();
  PortsAt at;
  if (!slot.pair->Curved()) {
    at.dofs = slot.dofs;
    at[kNormal].gradient = slot.at_start[kNormal].gradient;
    at[kTangent].gradient = slot.at_start[kTangent].gradient;
    at[kNormal].motion =
        slot.at_start[kNormal].motion / goal_.length + at.Rate(at[kNormal].gradient, x.head(nd), x[nd]);
    at[kTangent].motion = (slot.at_start[kTangent].motion - slot.reference) / goal_.length +
                          at.Rate(at[kTangent].gradient, x.head(nd), x[nd]);
    return at;
  }
  const Eigen::VectorXd u = from_.u + goal_.length * x.head(nd);
  const double s = from_.s + goal_.length * x[nd];
  slot.pair->Evaluate(u, s, PatchOf(slot, u, s), {0.0, slot.reference}, &at);
  at[kNormal].motion /= goal_.length;
  at[kTangent].motion /= goal_.length;
  at[kNormal].hessian *= goal_.length;
  at[kTangent].hessian *= goal_.length;
  if (!slot.pair->Deformable()) return at;
  at[kNormal].gradient = Spread(at[kNormal].gradient, at.dofs, slot.dofs);
  at[kTangent].gradient = Spread(at[kTangent].gradient, at.dofs, slot.dofs);
  at[kNormal].hessian = Spread(at[kNormal].hessian, at.dofs, slot.dofs);
  at[kTangent].hessian = Spread(at[kTangent].hessian, at.dofs, slot.dofs);
  at[kTangent].factor_gradient = goal_.length * Spread(at[kTangent].factor_gradient, at.dofs, slot.dofs);
  at.dofs = slot.dofs;
  return at;
}

int IncrementProblem::PatchOf(const Slot& slot, const Eigen::VectorXd& u, double s) const {
  const int patch = slot.pair->PatchAfter(u, s, slot.start_patch);
  return slot.pair->Deformable() ? std::clamp(patch, slot.start_patch - 1, slot.start_patch + 1) : patch;
}

Eigen::VectorXd IncrementProblem::StartingPoint(const Eigen::VectorXd& y, const PathPoint& reactions) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(num_variables_), values;
  x.head(y.size()) = y;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    const auto contact = static_cast<std::size_t>(working_set_[i]);
    x[slot.rn] = NormalReaction(reactions, contact) / goal_.length;
    if (slot.rt < 0) continue;
    x[slot.rt] = TangentialReaction(reactions, contact) / goal_.length;
    x[slot.lambda] = std::abs(ScaledKinematics(slot, x)[kTangent].motion);
  }
  Constraints(x, &values);
  for (const Support& support : supports_) x[support.reaction] = values[support.prescribed->dof];
  return x;
}

std::vector<IncrementProblem::Zeros> IncrementProblem::ZerosAt(const PathPoint& point, const Eigen::VectorXd& x) const {
  std::vector<Zeros> zeros;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    const ContactState state = StateOf(point, static_cast<std::size_t>(working_set_[i]));
    const PortsAt at = ScaledKinematics(slot, x);
    const bool open = state == ContactState::kOpen;
    if (!open) zeros.push_back({{slot.gap_row, x[slot.rn]}});
    if (slot.rt < 0) {
      if (open) zeros.push_back({{num_constraints_ + slot.rn, at[kNormal].motion}});
      continue;
    }
    const double mu = slot.pair->Friction(), limit = mu * x[slot.rn], rt = x[slot.rt], lambda = x[slot.lambda];
    const Eigen::Index row = slot.friction_row;
    if (state == ContactState::kStick)
      zeros.push_back({{row, 0.5 * (limit - rt)}, {row + 1, 0.5 * (limit + rt)}});
    else if (state == ContactState::kSlipPlus)
      zeros.push_back({{row, 0.5 * (limit - rt)}, {row + 3, 0.5 * (lambda + at[kTangent].motion)}});
    else if (state == ContactState::kSlipMinus)
      zeros.push_back({{row + 1, 0.5 * (limit + rt)}, {row + 2, 0.5 * (lambda - at[kTangent].motion)}});
    else if (at[kNormal].motion >
             mu * (lambda + std::abs(at[kTangent].motion)))  // both products are of these two: the larger one counts
      zeros.push_back({{row + 2, 0.5 * at[kNormal].motion / mu}, {row + 3, 0.5 * at[kNormal].motion / mu}});
    else
      zeros.push_back(
          {{row + 2, 0.5 * (lambda - at[kTangent].motion)}, {row + 3, 0.5 * (lambda + at[kTangent].motion)}});
  }
  return zeros;
}

std::optional<PrimalDual> IncrementProblem::CentralPoint(const PathPoint& point, double barrier) const {
  PrimalDual result;
  Eigen::VectorXd& x = result.x;
  x = StartingPoint(Chord(from_, point) / goal_.length, point);
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].rt >= 0 && StateOf(point, static_cast<std::size_t>(working_set_[i])) == ContactState::kOpen)
      x[slots_[i].lambda] += 1.0;  // which is free, but for being far from its bounds

  // The equations that hold there, with one row more: the multipliers of (9), and how far to move off.
  const Eigen::VectorXd lower = ConstraintLowerBounds(), upper = ConstraintUpperBounds();
  Eigen::VectorXi equation = Eigen::VectorXi::Constant(num_constraints_ + num_variables_, -1);
  int equations = 0;
  for (Eigen::Index row = 0; row < num_constraints_; ++row)
    if (lower[row] == upper[row]) equation[row] = equations++;
  for (const Zeros& of : ZerosAt(point, x))
    for (const Zero& zero : of) equation[zero.row] = equations++;
  Eigen::VectorXd values, gradient;
  JacobianValues(x, &values);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < jacobian_structure_.size(); ++k)
    if (const int at = equation[jacobian_structure_[k].row]; at >= 0)
      entries.emplace_back(jacobian_structure_[k].column, at, values[static_cast<Eigen::Index>(k)]);
  for (Eigen::Index variable = 0; variable < num_variables_; ++variable)
    if (const int at = equation[num_constraints_ + variable]; at >= 0) entries.emplace_back(variable, at, 1.0);
  Eigen::SparseMatrix<double> transposed(num_variables_, equations);
  transposed.setFromTriplets(entries.begin(), entries.end());
  BorderedSolver lu;
  MinimumNormSolver of_rows, of_columns;
  const bool regular = lu.FactorizeRegular(transposed, GenericVector(num_variables_));
  if (!regular && !(of_rows.Factorize(transposed) && of_columns.Factorize(transposed.transpose()))) return std::nullopt;
  Gradient(x, &gradient);
  const Eigen::VectorXd own = regular ? lu.SolveTransposed(-gradient) : of_columns.Solve(-gradient);

  // Each zero becomes barrier / (product's multiplier x factor - its own), and what that changes to the second order is
  // taken back.
  Eigen::VectorXd off(equations);
  for (int step = 0; step < kCentralSteps; ++step) {
    Constraints(x, &values);
    for (Eigen::Index row = 0; row < equation.size(); ++row)
      if (equation[row] >= 0) off[equation[row]] = -(row < num_constraints_ ? values[row] : x[row - num_constraints_]);
    for (const Zeros& of : ZerosAt(point, x)) {
      double low = 0.0;
      for (const Zero& zero : of) low = std::max(low, own[equation[zero.row]] / zero.factor);
      double high = low + static_cast<double>(of.size() + 1) * barrier / eps_;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        double left = eps_ - barrier / middle;
        for (const Zero& zero : of) left -= zero.factor * barrier / (middle * zero.factor - own[equation[zero.row]]);
        (left > 0.0 ? high : low) = middle;
      }
      for (const Zero& zero : of) off[equation[zero.row]] += barrier / (high * zero.factor - own[equation[zero.row]]);
    }
    x += regular ? lu.Solve(off, 0.0) : of_rows.Solve(off);
  }

  Constraints(x, &values);
  const Eigen::VectorXd distance = (values - lower).cwiseMin(upper - values);  // where it is not an equation
  result.multipliers.resize(num_constraints_);
  for (Eigen::Index row = 0; row < num_constraints_; ++row) {
    const bool equality = lower[row] == upper[row];
    if (!equality && !(distance[row] > -kOutside * barrier)) return std::nullopt;
    const double sign = upper[row] == eps_ ? 1.0 : -1.0;
    result.multipliers[row] =
        equality ? own[equation[row]] : sign * barrier / std::max(distance[row], kLeastDistance * barrier);
  }
  result.lower_multipliers = Eigen::VectorXd::Zero(num_variables_);
  for (const Slot& slot : slots_) {
    if (!(x[slot.rn] > 0.0)) return std::nullopt;
    result.lower_multipliers[slot.rn] = barrier / x[slot.rn];
  }
  return result;
}

PathPoint IncrementProblem::Point(const Eigen::VectorXd& x) const {
  const Eigen::Index nd = structure_.NumDofs();
  PathPoint point;
  point.u = from_.u + goal_.length * x.head(nd);
  point.s = from_.s + goal_.length * x[nd];
  point.forces = Eigen::VectorXd::Zero(from_.forces.size());
  for (const auto& contact : contacts_) point.modes.push_back(contact->OfPoint({NumberOf(ContactState::kOpen), 0}));
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    const auto contact = static_cast<std::size_t>(working_set_[i]);
    SetReaction(contact, goal_.length * x[slot.rn], slot.rt >= 0 ? goal_.length * x[slot.rt] : 0.0, &point);
    Mode& mode = point.modes[contact];
    mode.piece = PatchOf(slot, point.u, point.s);
    const PortsAt at = ScaledKinematics(slot, x);
    if (at[kNormal].motion > x[slot.rn]) continue;
    if (slot.rt < 0) {
      mode.state = NumberOf(ContactState::kClosed);
      continue;
    }
    const double slip = at[kTangent].motion;
    const double margin = slot.pair->Friction() * x[slot.rn] - std::abs(x[slot.rt]);
    if (std::abs(slip) <= margin)
      mode.state = NumberOf(ContactState::kStick);
    else
      // Motion and reaction are opposed; at a corner the motion is zero, with a reaction next to zero it is the motion
      // that tells.
      mode.state = NumberOf(slip > x[slot.rt] ? ContactState::kSlipPlus : ContactState::kSlipMinus);
  }
  return point;
}

Eigen::VectorXd IncrementProblem::UnconstrainedMinimiser() const {
  Eigen::VectorXd minimiser = -goal_.length / goal_.gamma2_factor * linear_objective_;
  minimiser.head(structure_.NumDofs()) += from_.u;
  minimiser[structure_.NumDofs()] += from_.s;
  return minimiser;
}

Eigen::VectorXd IncrementProblem::VariableLowerBounds() const {
  Eigen::VectorXd bounds = Eigen::VectorXd::Constant(num_variables_, -INFINITY);
  for (const Slot& slot : slots_) bounds[slot.rn] = 0.0;
  return bounds;
}

Eigen::VectorXd IncrementProblem::ConstraintLowerBounds() const {
  Eigen::VectorXd bounds = Eigen::VectorXd::Zero(num_constraints_);
  for (const Slot& slot : slots_) {
    bounds[slot.gap_row + 1] = -INFINITY;
    if (slot.friction_row >= 0) bounds[slot.friction_row + 4] = -INFINITY;
  }
  return bounds;
}

Eigen::VectorXd IncrementProblem::ConstraintUpperBounds() const {
  Eigen::VectorXd bounds = Eigen::VectorXd::Zero(num_constraints_);
  for (const Slot& slot : slots_) {
    bounds[slot.gap_row] = INFINITY;
    bounds[slot.gap_row + 1] = eps_;
    if (slot.friction_row < 0) continue;
    bounds.segment<4>(slot.friction_row).setConstant(INFINITY);
    bounds[slot.friction_row + 4] = eps_;
  }
  return bounds;
}

double IncrementProblem::Objective(const Eigen::VectorXd& x) const {
  const auto y = x.head(linear_objective_.size());
  return linear_objective_.dot(y) + 0.5 * goal_.gamma2_factor * y.squaredNorm();
}

void IncrementProblem::Gradient(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) const {
  gradient->setZero(num_variables_);
  gradient->head(linear_objective_.size()) = linear_objective_ + goal_.gamma2_factor * x.head(linear_objective_.size());
}

void IncrementProblem::Constraints(const Eigen::VectorXd& x, Eigen::VectorXd* values) const {
  const Eigen::Index nd = structure_.NumDofs();
  Eigen::VectorXd force(nd);
  structure_.InternalForce(from_.u + goal_.length * x.head(nd), force);
  force -= (from_.s + goal_.length * x[nd]) * structure_.ReferenceLoad() + structure_.ConstantLoad();
  force /= goal_.length;
  values->resize(num_constraints_);
  for (const Slot& slot : slots_) {
    const PortsAt at = ScaledKinematics(slot, x);
    const double gap = at[kNormal].motion, rn = x[slot.rn];
    at.AddForce(at[kNormal].gradient, -rn, &force);
    (*values)[slot.gap_row] = gap;
    (*values)[slot.gap_row + 1] = gap * rn;
    if (slot.rt < 0) continue;
    const double slip = at[kTangent].motion, rt = x[slot.rt], lambda = x[slot.lambda];
    const double mu = slot.pair->Friction();
    at.AddForce(at[kTangent].gradient, -rt * at[kTangent].factor, &force);
    values->segment<5>(slot.friction_row) << lambda - slip, lambda + slip, mu * rn - rt, mu * rn + rt,
        lambda * mu * rn + slip * rt;
  }
  for (const Support& support : supports_) {
    const PrescribedDof& prescribed = *support.prescribed;
    force[prescribed.dof] -= x[support.reaction];
    (*values)[support.row] = (from_.u[prescribed.dof] - prescribed.start - prescribed.rate * from_.s) / goal_.length +
                             x[prescribed.dof] - prescribed.rate * x[nd];
  }
  values->head(nd) = force;
}

template <typename Visit>
void IncrementProblem::ForEachVariable(const Slot& slot, Visit visit) const {
  Eigen::Index k = 0;
  for (const int dof : slot.dofs) visit(static_cast<Eigen::Index>(dof), k++);
  visit(structure_.NumDofs(), k);
}

template <typename Visit>
void IncrementProblem::ForEachGapVariable(const Slot& slot, Visit visit) const {
  ForEachVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
    if (slot.pair->Moves(kNormal, static_cast<std::size_t>(k))) visit(variable, k);
  });
}

template <typename Visit>
void IncrementProblem::ForEachXiVariable(const Slot& slot, Visit visit) const {
  ForEachVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
    if (slot.pair->Moves(kTangent, static_cast<std::size_t>(k))) visit(variable, k);
  });
}

template <typename Emit>
void IncrementProblem::ForEachJacobianEntry(const Eigen::VectorXd& x, Emit emit) const {
  const Eigen::Index nd = structure_.NumDofs();
  structure_.Tangent(from_.u + goal_.length * x.head(nd), &tangent_);
  for (Eigen::Index column = 0; column < nd; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it) emit(it.row(), column, it.value());
  for (Eigen::Index row = 0; row < nd; ++row)
    if (structure_.ReferenceLoad()[row] != 0.0) emit(row, nd, -structure_.ReferenceLoad()[row]);
  for (const Slot& slot : slots_) {
    const PortsAt at = ScaledKinematics(slot, x);
    const double rn = x[slot.rn];
    ForEachGapVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
      const double gradient = at[kNormal].gradient[k];
      if (variable < nd) emit(variable, slot.rn, -gradient);
      emit(slot.gap_row, variable, gradient);
      emit(slot.gap_row + 1, variable, gradient * rn);
    });
    emit(slot.gap_row + 1, slot.rn, at[kNormal].motion);
    if (slot.pair->Curved()) {
      // r_n and r_t over S, and Hessians times S.
      LawMatrix change = rn * at[kNormal].hessian;
      if (slot.rt >= 0) change += (x[slot.rt] * at[kTangent].factor) * at[kTangent].hessian;
      if (slot.rt >= 0 && slot.pair->Deformable())
        change += x[slot.rt] * at[kTangent].gradient * at[kTangent].factor_gradient.transpose();
      ForEachVariable(slot, [&](Eigen::Index row, Eigen::Index a) {
        if (row == nd) return;
        ForEachVariable(slot, [&](Eigen::Index column, Eigen::Index b) { emit(row, column, -change(a, b)); });
      });
    }
    if (slot.rt < 0) continue;
    const double slip = at[kTangent].motion, rt = x[slot.rt], lambda = x[slot.lambda];
    const double mu = slot.pair->Friction();
    ForEachXiVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
      const double gradient = at[kTangent].gradient[k];
      if (variable < nd) emit(variable, slot.rt, -at[kTangent].factor * gradient);
      emit(slot.friction_row, variable, -gradient);
      emit(slot.friction_row + 1, variable, gradient);
      emit(slot.friction_row + 4, variable, gradient * rt);
    });
    emit(slot.friction_row, slot.lambda, 1.0);
    emit(slot.friction_row + 1, slot.lambda, 1.0);
    emit(slot.friction_row + 2, slot.rn, mu);
    emit(slot.friction_row + 2, slot.rt, -1.0);
    emit(slot.friction_row + 3, slot.rn, mu);
    emit(slot.friction_row + 3, slot.rt, 1.0);
    emit(slot.friction_row + 4, slot.lambda, mu * rn);
    emit(slot.friction_row + 4, slot.rn, mu * lambda);
    emit(slot.friction_row + 4, slot.rt, slip);
  }
  for (const Support& support : supports_) {
    emit(support.prescribed->dof, support.reaction, -1.0);
    emit(support.row, support.prescribed->dof, 1.0);
    emit(support.row, nd, -support.prescribed->rate);
  }
}

template <typename Emit>
void IncrementProblem::ForEachHessianEntry(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                                           Emit emit) const {
  const Eigen::Index nd = structure_.NumDofs();
  // Second order of the equilibrium rows: S times the derivative of the tangent along their multipliers.
  structure_.TangentDerivative(from_.u + goal_.length * x.head(nd), multipliers.head(nd), &tangent_);
  for (Eigen::Index column = 0; column < nd; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it)
      if (it.row() >= column)
        emit(it.row(), column, goal_.length * it.value() + (it.row() == column ? factor * goal_.gamma2_factor : 0.0));
  emit(nd, nd, factor * goal_.gamma2_factor);
  for (const Slot& slot : slots_) {
    const ContactPair& pair = *slot.pair;
    const PortsAt at = ScaledKinematics(slot, x);
    const double gap_product = multipliers[slot.gap_row + 1];
    ForEachGapVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
      emit(slot.rn, variable, gap_product * at[kNormal].gradient[k]);
    });
    const double slip_product = slot.rt < 0 ? 0.0 : multipliers[slot.friction_row + 4];
    if (slot.rt >= 0) {
      emit(slot.lambda, slot.rn, slip_product * pair.Friction());
      ForEachXiVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
        emit(slot.rt, variable, slip_product * at[kTangent].gradient[k]);
      });
    }
    if (pair.Curved()) ForEachCurvatureEntry(slot, at, x, multipliers, emit);
  }
}

template <typename Emit>
void IncrementProblem::ForEachCurvatureEntry(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x,
                                             const Eigen::VectorXd& multipliers, Emit emit) const {
  const Eigen::Index nd = structure_.NumDofs();
  const ContactPair& pair = *slot.pair;
  const bool frictional = slot.rt >= 0;
  const double rn = x[slot.rn], rt = frictional ? x[slot.rt] : 0.0;
  // The multipliers of the equilibrium equations; the multiplier of the load factor is none.
  const LawVector weights = at.Local(multipliers.head(nd), 0.0);
  const LawVector by_rn = at[kNormal].hessian * weights;
  ForEachVariable(slot, [&](Eigen::Index variable, Eigen::Index k) { emit(slot.rn, variable, -by_rn[k]); });
  double along_gap = multipliers[slot.gap_row] + multipliers[slot.gap_row + 1] * rn, along_xi = 0.0;
  if (frictional) {
    LawVector by_rt = at[kTangent].factor * (at[kTangent].hessian * weights);
    if (pair.Deformable()) by_rt += at[kTangent].gradient.dot(weights) * at[kTangent].factor_gradient;
    ForEachVariable(slot, [&](Eigen::Index variable, Eigen::Index k) { emit(slot.rt, variable, -by_rt[k]); });
    along_xi =
        multipliers[slot.friction_row + 1] - multipliers[slot.friction_row] + multipliers[slot.friction_row + 4] * rt;
  }
  LawMatrix second;
  const Eigen::VectorXd u = from_.u + goal_.length * x.head(nd);
  const double s = from_.s + goal_.length * x[nd];
  const int patch = PatchOf(slot, u, s);
  const LawDofs dofs = pair.Dofs(patch);
  pair.ForceHessian(u, s, patch, {rn, rt}, LocalOf(dofs, multipliers.head(nd), 0.0), &second);
  if (pair.Deformable()) second = Spread(second, dofs, slot.dofs);
  second = along_gap * at[kNormal].hessian + along_xi * at[kTangent].hessian - goal_.length * goal_.length * second;
  ForEachVariable(slot, [&](Eigen::Index row, Eigen::Index a) {
    ForEachVariable(slot, [&](Eigen::Index column, Eigen::Index b) {
      if (row >= column) emit(row, column, second(a, b));
    });
  });
}

void IncrementProblem::JacobianValues(const Eigen::VectorXd& x, Eigen::VectorXd* values) const {
  values->resize(static_cast<Eigen::Index>(jacobian_structure_.size()));
  Eigen::Index k = 0;
  ForEachJacobianEntry(x, [&](Eigen::Index, Eigen::Index, double value) { (*values)[k++] = value; });
}

void IncrementProblem::HessianValues(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                                     Eigen::VectorXd* values) const {
  values->resize(static_cast<Eigen::Index>(hessian_structure_.size()));
  Eigen::Index k = 0;
  ForEachHessianEntry(x, factor, multipliers,
                      [&](Eigen::Index, Eigen::Index, double value) { (*values)[k++] = value; });
}

}  // namespace contact_path
