#include "contact_path/equations/mode_limits.h"

#include <algorithm>
#include <iterator>

namespace contact_path {

std::vector<Limit> ModeLimits::All() const {
  std::vector<Limit> limits;
  for (std::size_t i = 0; i < laws_.laws().size(); ++i)
    laws_[i].AddLimits(laws_.modes()[i], static_cast<int>(i), &limits);
  return limits;
}

std::vector<Limit> ModeLimits::InReach(const Eigen::VectorXd& x, double reach, std::vector<Limit>* near) {
  if (!tracker_) tracker_.emplace(laws_.laws());
  in_reach_ = tracker_->InReach(x.head(laws_.NumDofs()), x[laws_.NumDofs()], reach);
  near->clear();
  for (const std::size_t i : laws_.Acting()) laws_.Start(i, x);
  for (const std::size_t i : in_reach_) {
    if (!laws_.StateOf(i).idle) continue;
    laws_.Start(i, x);
    laws_[i].AddNear(laws_.modes()[i], static_cast<int>(i), near);
  }
  std::vector<std::size_t> all;
  std::set_union(laws_.Acting().begin(), laws_.Acting().end(), in_reach_.begin(), in_reach_.end(),
                 std::back_inserter(all));
  std::vector<Limit> limits;
  for (const std::size_t i : all) laws_[i].AddLimits(laws_.modes()[i], static_cast<int>(i), &limits);
  return limits;
}

bool ModeLimits::BeyondReach(const Eigen::VectorXd& x) const {
  return std::any_of(in_reach_.begin(), in_reach_.end(), [&](std::size_t i) {
    return laws_.StateOf(i).idle && laws_[i].Passed(x, x[laws_.NumDofs()], laws_.modes()[i]);
  });
}

bool ModeLimits::IsWeaklyActive(const Limit& limit, const Eigen::VectorXd& x,
                                const ActiveSetTolerance& tolerance) const {
  const LimitRule& rule = RuleOf(limit);
  return rule.OfRate() ||
         Value(limit, x) <= (rule.OfForces() ? tolerance.ForceOf(rule.unit) : tolerance.motion * rule.unit);
}

PortMotion ModeLimits::MotionOf(const Limit& limit) const {
  const auto i = static_cast<std::size_t>(limit.law);
  const LimitRule& rule = RuleOf(limit);
  if (!rule.OfPiece()) return {i, rule.port, rule.sign};
  const double reference = laws_.ReferencesOf(i)[rule.port];
  return {i, rule.port, rule.sign, rule.sign * (reference - laws_[i].BoundOf(laws_.modes()[i], limit.id))};
}

double ModeLimits::Value(const Limit& limit, const Eigen::VectorXd& x) const {
  const LimitRule& rule = RuleOf(limit);
  if (!rule.OfForces() && rule.compliance == 0.0) return laws_.ValueOf(MotionOf(limit), x);
  const PortReals forces = laws_.ForcesOf(static_cast<std::size_t>(limit.law), x);
  if (!rule.OfForces()) return laws_.ValueOf(MotionOf(limit), x) + rule.sign * rule.compliance * forces[rule.port];
  double value = 0.0;
  for (std::size_t p = 0; p < forces.size(); ++p)
    if (rule.weights[p] != 0.0) value += rule.weights[p] * forces[p];
  return value;
}

double ModeLimits::Rate(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const {
  if (RuleOf(limit).OfForces()) return Value(limit, dx);
  const PortMotion motion = MotionOf(limit);
  const PortsAt at = laws_.Evaluate(motion.law, x);
  const double rate = at.Rate(at[motion.port].gradient, dx, dx[laws_.NumDofs()]), compliance = RuleOf(limit).compliance;
  return motion.sign * (compliance == 0.0 ? rate : rate + compliance * laws_.ForcesOf(motion.law, dx)[motion.port]);
}

Eigen::VectorXd ModeLimits::Gradient(const Limit& limit, const Eigen::VectorXd& x, Eigen::Index size) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
  const auto i = static_cast<std::size_t>(limit.law);
  const LimitRule& rule = RuleOf(limit);
  if (!rule.OfForces()) {
    const PortMotion motion = MotionOf(limit);
    const PortsAt at = laws_.Evaluate(i, x);
    const LawVector& by_local = at[motion.port].gradient;
    const std::size_t m = at.dofs.size();
    for (std::size_t k = 0; k <= m; ++k)
      if (laws_[i].Moves(motion.port, k))
        gradient[k < m ? at.dofs[k] : laws_.NumDofs()] += motion.sign * by_local[static_cast<Eigen::Index>(k)];
    if (rule.compliance != 0.0)
      gradient[laws_.UnknownOf(i, 0)] += motion.sign * rule.compliance * laws_.StateOf(i).ports[motion.port].ratio;
  } else {
    for (std::size_t p = 0; p < rule.weights.size(); ++p)
      if (rule.weights[p] != 0.0) gradient[laws_.UnknownOf(i, p)] = rule.weights[p];
  }
  return gradient;
}

Jet ModeLimits::ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                           const Eigen::VectorXd& second) const {
  if (RuleOf(limit).OfForces()) return {Value(limit, x), Value(limit, first), Value(limit, second)};
  const PortMotion motion = MotionOf(limit);
  Jet jet = laws_.MotionAlong(motion.law, motion.port, x, first, second);
  if (const double compliance = RuleOf(limit).compliance; compliance != 0.0) {
    jet.value += compliance * laws_.ForcesOf(motion.law, x)[motion.port];
    jet.first += compliance * laws_.ForcesOf(motion.law, first)[motion.port];
    jet.second += compliance * laws_.ForcesOf(motion.law, second)[motion.port];
  }
  return {motion.offset + motion.sign * jet.value, motion.sign * jet.first, motion.sign * jet.second};
}

}  // namespace contact_path
