// What changes along a curve of the unknowns, with its derivatives by the parameter of the curve.
#include <algorithm>
#include <cmath>

#include "contact_path/equations/fixed_mode_system.h"

namespace contact_path {

Jet FixedModeSystem::ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                const Eigen::VectorXd& second) const {
  if (RuleOf(limit).OfForces()) return {Value(limit, x), Value(limit, first), Value(limit, second)};
  const Motion motion = MotionOf(limit);
  Jet jet = MotionAlong(motion.law, motion.port, x, first, second);
  if (const double compliance = RuleOf(limit).compliance; compliance != 0.0) {
    jet.value += compliance * ForcesOf(motion.law, x)[motion.port];
    jet.first += compliance * ForcesOf(motion.law, first)[motion.port];
    jet.second += compliance * ForcesOf(motion.law, second)[motion.port];
  }
  return {motion.offset + motion.sign * jet.value, motion.sign * jet.first, motion.sign * jet.second};
}

Jet FixedModeSystem::MotionAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x,
                                 const Eigen::VectorXd& first, const Eigen::VectorXd& second) const {
  const PortsAt at = Evaluate(law, x);
  const LawVector& gradient = at[port].gradient;
  const Eigen::Index s = NumDofs();
  Jet jet = {at[port].motion, at.Rate(gradient, first, first[s]), at.Rate(gradient, second, second[s])};
  if (laws_[law].Curved()) jet.second += Bend({law, port}, at, first);
  return jet;
}

double FixedModeSystem::Bend(const Motion& motion, const PortsAt& at, const Eigen::VectorXd& dx) const {
  const LawVector along = at.Local(dx, dx[NumDofs()]);
  return along.dot(at[motion.port].hessian * along);
}

Jet FixedModeSystem::LeadingForceAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x,
                                       const Eigen::VectorXd& first, const Eigen::VectorXd& second) const {
  const Eigen::Index k = UnknownOf(law, 0), s = NumDofs();
  const Law& of = laws_[law];
  const Jet force = {x[k], first[k], second[k]};
  if (!of.Curved()) return force;
  const PortsAt at = Evaluate(law, x);
  const Eigen::Vector3d c =
      of.FactorAlong(port, x, x[s], modes_[law].piece, at.Local(first, first[s]), at.Local(second, second[s]));
  return {force.value * c[0], force.first * c[0] + force.value * c[1],
          force.second * c[0] + 2.0 * force.first * c[1] + force.value * c[2]};
}

Jet FixedModeSystem::DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                       const Eigen::VectorXd& second) const {
  Jet force;
  Eigen::Index k = first_support_;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    force.value += prescribed.rate * x[k];
    force.first += prescribed.rate * first[k];
    force.second += prescribed.rate * second[k];
    ++k;
  }
  const auto weighted = [](const PortReals& forces, const auto& of_port) {
    double sum = 0.0;
    for (std::size_t p = 0; p < forces.size(); ++p)
      if (forces[p] != 0.0) sum += forces[p] * of_port(p);
    return sum;
  };
  for (const std::size_t i : acting_) {
    const PortReals forces = ForcesOf(i, x), rates = ForcesOf(i, first), changes = ForcesOf(i, second);
    // A law without a force may be where it cannot be evaluated.
    if (forces == PortReals{} && rates == PortReals{} && changes == PortReals{}) continue;
    const Law& law = laws_[i];
    const PortsAt at = Evaluate(i, x);
    const auto last = static_cast<Eigen::Index>(at.dofs.size());
    const auto by_load = [&](std::size_t p) { return at[p].factor * at[p].gradient[last]; };
    force.value -= weighted(forces, by_load);
    force.first -= weighted(rates, by_load);
    force.second -= weighted(changes, by_load);
    if (!law.Curved()) continue;
    const LawVector along = at.Local(first, first[NumDofs()]), bend = at.Local(second, second[NumDofs()]);
    const auto row = [&](const PortReals& of_forces) {
      LawVector sum = LawVector::Zero(last + 1);
      for (std::size_t p = 0; p < law.NumPorts(); ++p) {
        sum += (of_forces[p] * at[p].factor) * at[p].hessian.row(last).transpose();
        if (at[p].factor_gradient.size() > 0) sum += (of_forces[p] * at[p].gradient[last]) * at[p].factor_gradient;
      }
      return sum;
    };
    // Compliances are of factors that are linear in the load factor.
    for (std::size_t p = 0; p < law.NumPorts(); ++p) {
      const double compliance = law.In(modes_[i]).ports[p].compliance;
      if (compliance == 0.0 || at[p].factor_gradient.size() == 0) continue;
      const double stores = compliance * at[p].factor_gradient[last];
      force.value += 0.5 * stores * forces[p] * forces[p];
      force.first += stores * forces[p] * rates[p];
      force.second += stores * (rates[p] * rates[p] + forces[p] * changes[p]);
    }
    const LawVector of_forces = row(forces);
    force.first -= of_forces.dot(along);
    force.second -= 2.0 * row(rates).dot(along) + of_forces.dot(bend) +
                    law.SecondDirectional(x, x[NumDofs()], modes_[i].piece, forces, along)[last];
  }
  return force;
}

}  // namespace contact_path
