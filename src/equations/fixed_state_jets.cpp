// What changes along a curve of the unknowns, with its derivatives by the parameter of the curve.
#include <cmath>

#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

Jet FixedStateSystem::ValueAlong(const Constraint& constraint, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                 const Eigen::VectorXd& second) const {
  if (!IsMotion(constraint.inequality))
    return {Value(constraint, x), Value(constraint, first), Value(constraint, second)};
  const Motion motion = MotionOf(constraint);
  const ContactPair& pair = *contacts_[motion.contact];
  const Kinematics at = Evaluate(motion.contact, x);
  const PairVector& gradient = motion.is_gap ? at.gap_gradient : at.xi_gradient;
  const Eigen::Index s = NumDofs();
  Jet jet = {motion.is_gap ? at.gap : at.xi, at.Rate(gradient, first, first[s]), at.Rate(gradient, second, second[s])};
  if (pair.Curved()) jet.second += Bend(motion, at, first);
  return {motion.offset + motion.sign * jet.value, motion.sign * jet.first, motion.sign * jet.second};
}

double FixedStateSystem::Bend(const Motion& motion, const Kinematics& at, const Eigen::VectorXd& dx) const {
  const PairVector along = at.Local(dx, dx[NumDofs()]);
  return along.dot((motion.is_gap ? at.gap_hessian : at.xi_hessian) * along);
}

Jet FixedStateSystem::SlidingForceAlong(std::size_t contact, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                        const Eigen::VectorXd& second) const {
  const Eigen::Index k = rn_unknown_[contact], s = NumDofs();
  const ContactPair& pair = *contacts_[contact];
  const Jet rn = {x[k], first[k], second[k]};
  if (!pair.Deformable()) return rn;
  const Kinematics at = Evaluate(contact, x);
  const Eigen::Vector3d c =
      pair.SlipFactorAlong(x, x[s], patches_[contact], at.Local(first, first[s]), at.Local(second, second[s]));
  return {rn.value * c[0], rn.first * c[0] + rn.value * c[1],
          rn.second * c[0] + 2.0 * rn.first * c[1] + rn.value * c[2]};
}

Jet FixedStateSystem::DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                        const Eigen::VectorXd& second) const {
  Jet force;
  Eigen::Index k = first_support_;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    force.value += prescribed.rate * x[k];
    force.first += prescribed.rate * first[k];
    force.second += prescribed.rate * second[k];
    ++k;
  }
  for (const std::size_t i : touching_) {
    const Reaction reaction = ReactionOf(i, x), rate = ReactionOf(i, first), change = ReactionOf(i, second);
    // A contact without a reaction may be too far from its curve for a foot there.
    if (std::hypot(reaction.rn, rate.rn, change.rn) + std::hypot(reaction.rt, rate.rt, change.rt) == 0.0) continue;
    const ContactPair& pair = *contacts_[i];
    const Kinematics at = Evaluate(i, x);
    const auto last = static_cast<Eigen::Index>(at.dofs.size());
    const double gap = at.gap_gradient[last], xi = at.xi_gradient[last];
    force.value -= reaction.rn * gap + reaction.rt * xi;
    force.first -= rate.rn * gap + rate.rt * xi;
    force.second -= change.rn * gap + change.rt * xi;
    if (!pair.Curved()) continue;
    const PairVector along = at.Local(first, first[NumDofs()]), bend = at.Local(second, second[NumDofs()]);
    const PairMatrix hessian = reaction.rn * at.gap_hessian + reaction.rt * at.xi_hessian;
    const PairMatrix hessian_rate = rate.rn * at.gap_hessian + rate.rt * at.xi_hessian;
    force.first -= hessian.row(last).dot(along);
    force.second -= 2.0 * hessian_rate.row(last).dot(along) + hessian.row(last).dot(bend) +
                    pair.SecondDirectional(x, x[NumDofs()], patches_[i], reaction.rn, reaction.rt, along)[last];
  }
  return force;
}

}  // namespace contact_path
