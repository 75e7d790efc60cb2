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

// The state in which no port has a force; of a law that always acts, its state.
int IdleState(const Law& law) {
  int state = 0;
  while (law.CanBeIdle() && !law.In(state).idle) ++state;
  return state;
}

// Of a patch of a deformable surface and the patches beside it.
LawDofs DofsBeside(const ContactPair& pair, int patch) {
  std::set<int> all;
  for (const int beside : {patch - 1, patch, patch + 1})
    if (pair.HasPatch(beside))
      for (const int dof : pair.Dofs(beside)) all.insert(dof);
  LawDofs dofs;
  for (const int dof : all) dofs.push_back(dof);
  return dofs;
}

}  // namespace

IncrementProblem::IncrementProblem(const Structure& structure, const ContactPairs& contacts, const Laws& laws,
                                   const PathPoint& from, std::vector<int> working_set, IncrementGoal goal)
    : structure_(structure),
      contacts_(contacts),
      laws_(laws),
      from_(from),
      working_set_(std::move(working_set)),
      goal_(std::move(goal)),
      tangent_(structure.TangentPattern()) {
  const Eigen::Index nd = structure_.NumDofs();
  num_variables_ = nd + 1 + static_cast<Eigen::Index>(working_set_.size());
  num_constraints_ = nd;
  Eigen::VectorXd drive = Eigen::VectorXd::Zero(nd + 1);  // T_t r_t^k, by (u, s)
  for (std::size_t i = 0; i < working_set_.size(); ++i) {
    const auto number = static_cast<std::size_t>(working_set_[i]);
    const Slot& slot = AddSlot(number, nd + 1 + static_cast<Eigen::Index>(i));
    if (!slot.Frictional()) continue;
    const double rt = slot.at_start[kTangent].factor * TangentialReaction(from_, number);
    const LawVector& gradient = slot.at_start[kTangent].gradient;
    slot.at_start.AddForce(gradient, rt, &drive);
    drive[nd] += rt * gradient[gradient.size() - 1];  // the motion of the obstacle
  }
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs())
    supports_.push_back({&prescribed, num_variables_++, num_constraints_++});
  const double norm = drive.norm();
  linear_objective_ = -(norm > 0.0 ? 1.0 - goal_.dissipation : 1.0) * goal_.direction;
  if (norm > 0.0) linear_objective_ += goal_.dissipation / norm * drive;
}

IncrementProblem::Slot& IncrementProblem::AddSlot(std::size_t number, Eigen::Index rn) {
  const Law& law = laws_[number];
  const ContactPair* const pair = number < contacts_.size() ? contacts_[number].get() : nullptr;
  const Mode mode = law.Known(from_.u, from_.s, from_.modes[number]);
  Slot slot;
  slot.law = &law;
  slot.pair = pair;
  slot.port = laws_.FirstPort(number);
  slot.held = pair != nullptr ? NumberOf(ContactState::kClosed) : law.AllHeld();
  slot.always = !law.CanBeIdle();
  slot.compliance = {};
  for (std::size_t p = 0; p < law.NumPorts(); ++p) slot.compliance[p] = law.In(law.AllHeld()).ports[p].compliance;
  slot.start_patch = mode.piece;
  slot.dofs = pair != nullptr && pair->Deformable() ? DofsBeside(*pair, mode.piece) : law.Dofs(mode.piece);
  law.Evaluate(from_.u, from_.s, mode.piece, {}, &slot.at_start);
  slot.reference = law.ReferenceOf(from_.u, from_.s, mode, laws_.Of(from_.forces, number));
  slot.rn = rn;
  slot.rt = slot.lambda = slot.friction_row = -1;
  slot.gap_row = num_constraints_;
  if (slot.always) {
    if (law.NumPorts() > 1) slot.rt = num_variables_++;
    num_constraints_ += static_cast<Eigen::Index>(slot.NumForces());
  } else {
    num_constraints_ += 2;
  }
  if (pair != nullptr && pair->Frictional()) {
    slot.rt = num_variables_++;
    slot.lambda = num_variables_++;
    slot.friction_row = num_constraints_;
    num_constraints_ += 5;
  }
  slots_.push_back(slot);
  return slots_.back();
}

PortsAt IncrementProblem::ScaledKinematics(const Slot& slot, const Eigen::VectorXd& x) const {
  const Eigen::Index nd = structure_.NumDofs();
  PortReals given{};
  for (std::size_t p = 0; p < slot.NumForces(); ++p) given[p] = slot.compliance[p] * x[slot.ForceOf(p)];
  PortsAt at;
  if (!slot.law->Curved()) {
    at.dofs = slot.dofs;
    for (std::size_t p = 0; p < slot.law->NumPorts(); ++p) {
      at[p].gradient = slot.at_start[p].gradient;
      at[p].motion = (slot.at_start[p].motion - slot.reference[p]) / goal_.length +
                     at.Rate(at[p].gradient, x.head(nd), x[nd]) + given[p];
    }
    return at;
  }
  const Eigen::VectorXd u = from_.u + goal_.length * x.head(nd);
  const double s = from_.s + goal_.length * x[nd];
  slot.law->Evaluate(u, s, PatchOf(slot, u, s), slot.reference, &at);
  const bool spreads = slot.pair != nullptr && slot.pair->Deformable();
  for (std::size_t p = 0; p < slot.law->NumPorts(); ++p) {
    at[p].motion = at[p].motion / goal_.length + given[p];
    at[p].hessian *= goal_.length;
    at[p].factor_gradient *= goal_.length;
    if (!spreads) continue;
    at[p].gradient = Spread(at[p].gradient, at.dofs, slot.dofs);
    at[p].hessian = Spread(at[p].hessian, at.dofs, slot.dofs);
    if (at[p].factor_gradient.size() > 0) at[p].factor_gradient = Spread(at[p].factor_gradient, at.dofs, slot.dofs);
  }
  if (spreads) at.dofs = slot.dofs;
  return at;
}

int IncrementProblem::PatchOf(const Slot& slot, const Eigen::VectorXd& u, double s) const {
  if (slot.pair == nullptr) return slot.start_patch;
  const int patch = slot.pair->PatchAfter(u, s, slot.start_patch);
  return slot.pair->Deformable() ? std::clamp(patch, slot.start_patch - 1, slot.start_patch + 1) : patch;
}

Eigen::VectorXd IncrementProblem::StartingPoint(const Eigen::VectorXd& y, const PathPoint& reactions) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(num_variables_);
  x.head(y.size()) = y;
  for (const Slot& slot : slots_) {
    x[slot.rn] = reactions.forces[slot.port + kNormal] / goal_.length;
    if (slot.rt < 0) continue;
    x[slot.rt] = reactions.forces[slot.port + kTangent] / goal_.length;
    if (slot.Frictional()) x[slot.lambda] = std::abs(ScaledKinematics(slot, x)[kTangent].motion);
  }
  const Eigen::VectorXd values = Constraints(x);
  for (const Support& support : supports_) x[support.reaction] = values[support.prescribed->dof];
  return x;
}

std::vector<IncrementProblem::Zeros> IncrementProblem::ZerosAt(const PathPoint& point, const Eigen::VectorXd& x) const {
  std::vector<Zeros> zeros;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    if (slot.always) continue;
    const Mode& mode = point.modes[static_cast<std::size_t>(working_set_[i])];
    const PortsAt at = ScaledKinematics(slot, x);
    const bool open = slot.law->In(mode).idle;
    if (!open) zeros.push_back({{slot.gap_row, x[slot.rn]}});
    if (!slot.Frictional()) {
      if (open) zeros.push_back({{num_constraints_ + slot.rn, at[kNormal].motion}});
      continue;
    }
    const ContactState state = StateOf(mode);
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
    if (slots_[i].Frictional() && StateOf(point, static_cast<std::size_t>(working_set_[i])) == ContactState::kOpen)
      x[slots_[i].lambda] += 1.0;  // which is free, but for being far from its bounds

  // The equations that hold there, with one row more: the multipliers of (9), and how far to move off.
  const auto [of_variables, lower, upper] = Bounds();
  Eigen::VectorXi equation = Eigen::VectorXi::Constant(num_constraints_ + num_variables_, -1);
  int equations = 0;
  for (Eigen::Index row = 0; row < num_constraints_; ++row)
    if (lower[row] == upper[row]) equation[row] = equations++;
  for (const Zeros& of : ZerosAt(point, x))
    for (const Zero& zero : of) equation[zero.row] = equations++;
  MatrixEntries entries;
  for (const auto& entry : Jacobian(x))
    if (const int at = equation[entry.row()]; at >= 0) entries.emplace_back(entry.col(), at, entry.value());
  for (Eigen::Index variable = 0; variable < num_variables_; ++variable)
    if (const int at = equation[num_constraints_ + variable]; at >= 0) entries.emplace_back(variable, at, 1.0);
  Eigen::SparseMatrix<double> transposed(num_variables_, equations);
  transposed.setFromTriplets(entries.begin(), entries.end());
  BorderedSolver lu;
  MinimumNormSolver of_rows, of_columns;
  const bool regular = lu.FactorizeRegular(transposed, GenericVector(num_variables_));
  if (!regular && !(of_rows.Factorize(transposed) && of_columns.Factorize(transposed.transpose()))) return std::nullopt;
  const Eigen::VectorXd gradient = Gradient(x);
  const Eigen::VectorXd own = regular ? lu.SolveTransposed(-gradient) : of_columns.Solve(-gradient);

  // Each zero becomes barrier / (product's multiplier x factor - its own), and what that changes to the second order is
  // taken back.
  Eigen::VectorXd off(equations);
  for (int step = 0; step < kCentralSteps; ++step) {
    const Eigen::VectorXd values = Constraints(x);
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

  const Eigen::VectorXd values = Constraints(x);
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
    if (slot.always) continue;
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
  for (std::size_t i = 0; i < laws_.size(); ++i) point.modes.push_back(laws_[i].OfPoint({IdleState(laws_[i]), 0}));
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    point.forces[slot.port + kNormal] = goal_.length * x[slot.rn];
    if (slot.rt >= 0) point.forces[slot.port + kTangent] = goal_.length * x[slot.rt];
    if (slot.always) continue;
    Mode& mode = point.modes[static_cast<std::size_t>(working_set_[i])];
    mode.piece = PatchOf(slot, point.u, point.s);
    const PortsAt at = ScaledKinematics(slot, x);
    // What gives way by itself is held where it gives way by more than the gap.
    if (at[kNormal].motion > (slot.law->Elastic() ? slot.compliance[kNormal] : 1.0) * x[slot.rn]) continue;
    if (!slot.Frictional()) {
      mode.state = slot.held;
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

ProgramBounds IncrementProblem::Bounds() const {
  ProgramBounds bounds;
  bounds.variables.setConstant(num_variables_, -INFINITY);
  bounds.lower.setZero(num_constraints_);
  bounds.upper.setZero(num_constraints_);
  for (const Slot& slot : slots_) {
    if (slot.always) continue;
    bounds.variables[slot.rn] = 0.0;
    bounds.upper[slot.gap_row] = INFINITY;
    bounds.lower[slot.gap_row + 1] = -INFINITY;
    bounds.upper[slot.gap_row + 1] = eps_;
    if (!slot.Frictional()) continue;
    bounds.upper.segment<4>(slot.friction_row).setConstant(INFINITY);
    bounds.lower[slot.friction_row + 4] = -INFINITY;
    bounds.upper[slot.friction_row + 4] = eps_;
  }
  return bounds;
}

double IncrementProblem::Objective(const Eigen::VectorXd& x) const {
  const auto y = x.head(linear_objective_.size());
  return linear_objective_.dot(y) + 0.5 * goal_.gamma2_factor * y.squaredNorm();
}

Eigen::VectorXd IncrementProblem::Gradient(const Eigen::VectorXd& x) const {
  const Eigen::Index size = linear_objective_.size();
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(num_variables_);
  gradient.head(size) = linear_objective_ + goal_.gamma2_factor * x.head(size);
  return gradient;
}

}  // namespace contact_path
