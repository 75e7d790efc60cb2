#include "contact_path/mpec/increment_problem.h"

#include <algorithm>
#include <cmath>
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

}  // namespace

IncrementProblem::IncrementProblem(const Structure& structure, const ContactPairs& contacts, const Laws& laws,
                                   const PathPoint& from, const std::vector<int>& working_set, IncrementGoal goal)
    : laws_(laws),
      from_(from),
      goal_(std::move(goal)),
      slots_(structure, contacts, laws, from, working_set, goal_.length),
      constraints_(structure, slots_) {
  const Eigen::Index nd = slots_.NumDofs();
  Eigen::VectorXd drive = Eigen::VectorXd::Zero(nd + 1);  // T_t r_t^k, by (u, s)
  for (const Slot& slot : slots_.All()) {
    if (!slot.Frictional()) continue;
    const double rt = slot.at_start[kTangent].factor * TangentialReaction(from_, slot.number);
    const LawVector& gradient = slot.at_start[kTangent].gradient;
    slot.at_start.AddForce(gradient, rt, &drive);
    drive[nd] += rt * gradient[gradient.size() - 1];  // the motion of the obstacle
  }
  const double norm = drive.norm();
  linear_objective_ = -(norm > 0.0 ? 1.0 - goal_.dissipation : 1.0) * goal_.direction;
  if (norm > 0.0) linear_objective_ += goal_.dissipation / norm * drive;
}

Eigen::VectorXd IncrementProblem::StartingPoint(const Eigen::VectorXd& y, const PathPoint& reactions) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(NumVariables());
  x.head(y.size()) = y;
  for (const Slot& slot : slots_.All()) {
    x[slot.rn] = reactions.forces[slot.port + kNormal] / goal_.length;
    if (slot.rt < 0) continue;
    x[slot.rt] = reactions.forces[slot.port + kTangent] / goal_.length;
    if (slot.Frictional()) x[slot.lambda] = std::abs(slots_.Kinematics(slot, x)[kTangent].motion);
  }
  const Eigen::VectorXd values = Constraints(x);
  for (const Support& support : slots_.Supports()) x[support.reaction] = values[support.prescribed->dof];
  return x;
}

std::vector<IncrementProblem::Zeros> IncrementProblem::ZerosAt(const PathPoint& point, const Eigen::VectorXd& x) const {
  std::vector<Zeros> zeros;
  for (const Slot& slot : slots_.All()) {
    if (slot.always) continue;
    const Mode& mode = point.modes[slot.number];
    const PortsAt at = slots_.Kinematics(slot, x);
    const bool open = slot.law->In(mode).idle;
    if (!open) zeros.push_back({{slot.gap_row, x[slot.rn]}});
    if (!slot.Frictional()) {
      if (open) zeros.push_back({{NumConstraints() + slot.rn, at[kNormal].motion}});
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
  for (const Slot& slot : slots_.All())
    if (slot.Frictional() && StateOf(point, slot.number) == ContactState::kOpen)
      x[slot.lambda] += 1.0;  // which is free, but for being far from its bounds

  // The equations that hold there, with one row more: the multipliers of (9), and how far to move off.
  const auto [of_variables, lower, upper] = Bounds();
  Eigen::VectorXi equation = Eigen::VectorXi::Constant(NumConstraints() + NumVariables(), -1);
  int equations = 0;
  for (Eigen::Index row = 0; row < NumConstraints(); ++row)
    if (lower[row] == upper[row]) equation[row] = equations++;
  for (const Zeros& of : ZerosAt(point, x))
    for (const Zero& zero : of) equation[zero.row] = equations++;
  MatrixEntries entries;
  for (const auto& entry : Jacobian(x))
    if (const int at = equation[entry.row()]; at >= 0) entries.emplace_back(entry.col(), at, entry.value());
  for (Eigen::Index variable = 0; variable < NumVariables(); ++variable)
    if (const int at = equation[NumConstraints() + variable]; at >= 0) entries.emplace_back(variable, at, 1.0);
  Eigen::SparseMatrix<double> transposed(NumVariables(), equations);
  transposed.setFromTriplets(entries.begin(), entries.end());
  BorderedSolver lu;
  MinimumNormSolver of_rows, of_columns;
  const bool regular = lu.FactorizeRegular(transposed, GenericVector(NumVariables()));
  if (!regular && !(of_rows.Factorize(transposed) && of_columns.Factorize(transposed.transpose()))) return std::nullopt;
  const Eigen::VectorXd gradient = Gradient(x);
  const Eigen::VectorXd own = regular ? lu.SolveTransposed(-gradient) : of_columns.Solve(-gradient);

  // Each zero becomes barrier / (product's multiplier x factor - its own), and what that changes to the second order is
  // taken back.
  Eigen::VectorXd off(equations);
  for (int step = 0; step < kCentralSteps; ++step) {
    const Eigen::VectorXd values = Constraints(x);
    for (Eigen::Index row = 0; row < equation.size(); ++row)
      if (equation[row] >= 0) off[equation[row]] = -(row < NumConstraints() ? values[row] : x[row - NumConstraints()]);
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
  result.multipliers.resize(NumConstraints());
  for (Eigen::Index row = 0; row < NumConstraints(); ++row) {
    const bool equality = lower[row] == upper[row];
    if (!equality && !(distance[row] > -kOutside * barrier)) return std::nullopt;
    const double sign = upper[row] == eps_ ? 1.0 : -1.0;
    result.multipliers[row] =
        equality ? own[equation[row]] : sign * barrier / std::max(distance[row], kLeastDistance * barrier);
  }
  result.lower_multipliers = Eigen::VectorXd::Zero(NumVariables());
  for (const Slot& slot : slots_.All()) {
    if (slot.always) continue;
    if (!(x[slot.rn] > 0.0)) return std::nullopt;
    result.lower_multipliers[slot.rn] = barrier / x[slot.rn];
  }
  return result;
}

PathPoint IncrementProblem::Point(const Eigen::VectorXd& x) const {
  PathPoint point;
  point.u = slots_.U(x);
  point.s = slots_.LoadFactor(x);
  point.forces = Eigen::VectorXd::Zero(from_.forces.size());
  for (std::size_t i = 0; i < laws_.size(); ++i) point.modes.push_back(laws_[i].OfPoint({IdleState(laws_[i]), 0}));
  for (const Slot& slot : slots_.All()) {
    point.forces[slot.port + kNormal] = goal_.length * x[slot.rn];
    if (slot.rt >= 0) point.forces[slot.port + kTangent] = goal_.length * x[slot.rt];
    if (slot.always) continue;
    Mode& mode = point.modes[slot.number];
    mode.piece = slots_.PatchOf(slot, point.u, point.s);
    const PortsAt at = slots_.Kinematics(slot, x);
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
  minimiser.head(slots_.NumDofs()) += from_.u;
  minimiser[slots_.NumDofs()] += from_.s;
  return minimiser;
}

ProgramBounds IncrementProblem::Bounds() const {
  ProgramBounds bounds;
  bounds.variables.setConstant(NumVariables(), -INFINITY);
  bounds.lower.setZero(NumConstraints());
  bounds.upper.setZero(NumConstraints());
  for (const Slot& slot : slots_.All()) {
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
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(NumVariables());
  gradient.head(size) = linear_objective_ + goal_.gamma2_factor * x.head(size);
  return gradient;
}

}  // namespace contact_path
