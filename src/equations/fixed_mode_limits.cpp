// The limits that keep the modes of a fixed-mode system admissible.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/tolerances.h"

namespace contact_path {

void FixedModeSystem::SetModesFrom(const PathPoint& from) {
  SetModes(from.modes, laws_.ReferencesAt(from));
  moved_forces_.clear();
  Eigen::VectorXd stiffness;
  for (const std::size_t i : acting_) {
    const Law& law = laws_[i];
    const PortRule& port = law.In(modes_[i]).ports[0];
    if (!port.Holds() || port.compliance != 0.0) continue;
    const double moved = law.Motion(0, from.u, from.s, modes_[i].piece, laws_.Of(reference_, i));
    if (!(moved > tolerances::kResidual)) continue;
    if (stiffness.size() == 0) {
      structure_.Tangent(from.u, &tangent_);
      stiffness = tangent_.diagonal().cwiseAbs();
    }
    double largest = 0.0;
    for (const int dof : law.Dofs(modes_[i].piece)) largest = std::max(largest, stiffness[dof]);
    moved_forces_[static_cast<int>(i)] = (1.0 + law.LargestRatio()) * largest * moved;
  }
}

double FixedModeSystem::RoundingOf(const Limit& limit, double of_forces) const {
  double rounding = tolerances::kResidual * UnitOf(limit);
  if (RuleOf(limit).OfForces()) rounding = std::max(rounding, of_forces);
  const auto moved = moved_forces_.find(limit.law);
  return moved == moved_forces_.end() ? rounding : std::max(rounding, moved->second);
}

std::vector<Limit> FixedModeSystem::LimitsInReach(const Eigen::VectorXd& x, double reach, std::vector<Limit>* near) {
  const double s = x[NumDofs()];
  if (!tracker_) tracker_.emplace(laws_);
  in_reach_ = tracker_->InReach(x.head(NumDofs()), s, reach);
  near->clear();
  for (const std::size_t i : acting_) modes_[i] = laws_[i].AtStart(x, s, modes_[i]);
  for (const std::size_t i : in_reach_) {
    if (!laws_[i].In(modes_[i]).idle) continue;
    modes_[i] = laws_[i].AtStart(x, s, modes_[i]);
    laws_[i].AddNear(modes_[i], static_cast<int>(i), near);
  }
  std::vector<std::size_t> all;
  std::set_union(acting_.begin(), acting_.end(), in_reach_.begin(), in_reach_.end(), std::back_inserter(all));
  std::vector<Limit> limits;
  for (const std::size_t i : all) laws_[i].AddLimits(modes_[i], static_cast<int>(i), &limits);
  return limits;
}

bool FixedModeSystem::BeyondReach(const Eigen::VectorXd& x) const {
  return std::any_of(in_reach_.begin(), in_reach_.end(), [&](std::size_t i) {
    return laws_[i].In(modes_[i]).idle && laws_[i].Passed(x, x[NumDofs()], modes_[i]);
  });
}

std::vector<Limit> FixedModeSystem::Limits() const {
  std::vector<Limit> limits;
  for (std::size_t i = 0; i < laws_.size(); ++i) laws_[i].AddLimits(modes_[i], static_cast<int>(i), &limits);
  return limits;
}

bool FixedModeSystem::IsWeaklyActive(const Limit& limit, const Eigen::VectorXd& x,
                                     const ActiveSetTolerance& tolerance) const {
  const LimitRule& rule = RuleOf(limit);
  return rule.OfRate() || Value(limit, x) <= (rule.OfForces() ? tolerance.force : tolerance.motion) * rule.unit;
}

double FixedModeSystem::MotionValue(const Motion& motion, const Eigen::VectorXd& x) const {
  return motion.offset + motion.sign * laws_[motion.law].Motion(motion.port, x, x[NumDofs()], modes_[motion.law].piece,
                                                                laws_.Of(reference_, motion.law));
}

double FixedModeSystem::Value(const Limit& limit, const Eigen::VectorXd& x) const {
  const LimitRule& rule = RuleOf(limit);
  if (!rule.OfForces() && rule.compliance == 0.0) return MotionValue(MotionOf(limit), x);
  const PortReals forces = ForcesOf(static_cast<std::size_t>(limit.law), x);
  if (!rule.OfForces()) return MotionValue(MotionOf(limit), x) + rule.sign * rule.compliance * forces[rule.port];
  double value = 0.0;
  for (std::size_t p = 0; p < forces.size(); ++p)
    if (rule.weights[p] != 0.0) value += rule.weights[p] * forces[p];
  return value;
}

double FixedModeSystem::Rate(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const {
  if (RuleOf(limit).OfForces()) return Value(limit, dx);
  const Motion motion = MotionOf(limit);
  const PortsAt at = Evaluate(motion.law, x);
  const double rate = at.Rate(at[motion.port].gradient, dx, dx[NumDofs()]), compliance = RuleOf(limit).compliance;
  return motion.sign * (compliance == 0.0 ? rate : rate + compliance * ForcesOf(motion.law, dx)[motion.port]);
}

Eigen::VectorXd FixedModeSystem::Gradient(const Limit& limit, const Eigen::VectorXd& x) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(num_unknowns_);
  const auto i = static_cast<std::size_t>(limit.law);
  const LimitRule& rule = RuleOf(limit);
  if (!rule.OfForces()) {
    const Motion motion = MotionOf(limit);
    const PortsAt at = Evaluate(i, x);
    const LawVector& by_local = at[motion.port].gradient;
    const std::size_t m = at.dofs.size();
    for (std::size_t k = 0; k <= m; ++k)
      if (laws_[i].Moves(motion.port, k))
        gradient[k < m ? at.dofs[k] : NumDofs()] += motion.sign * by_local[static_cast<Eigen::Index>(k)];
    if (rule.compliance != 0.0)
      gradient[UnknownOf(i, 0)] += motion.sign * rule.compliance * laws_[i].In(modes_[i]).ports[motion.port].ratio;
  } else {
    for (std::size_t p = 0; p < rule.weights.size(); ++p)
      if (rule.weights[p] != 0.0) gradient[UnknownOf(i, p)] = rule.weights[p];
  }
  return gradient;
}

const RigidModes& FixedModeSystem::FreeModes() const {
  if (!free_modes_) free_modes_.emplace(structure_);
  return *free_modes_;
}

bool FixedModeSystem::MayMoveFreely() const { return FreeModes().Possible(); }

Eigen::MatrixXd FixedModeSystem::FreeMotions(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed) {
  return FreeModes().At(x.head(NumDofs()), transposed);
}

}  // namespace contact_path
