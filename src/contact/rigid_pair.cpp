#include "contact_path/contact/rigid_pair.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Scaling by a power of 2 is exact. The powers are far apart, so that nearly all scenes have the unit 1.
constexpr int kPowersApart = 20;  // 2^20 is about 1e6

// The smallest unit that is no less than `bound`, and at most 1; more only where rounding makes reactions uncertain, as
// Structure::ResidualUnits() tells of forces.
double ForceUnitAbove(double bound) {
  const double rounding = tolerances::kStiffForce * bound;
  if (rounding > 1.0 && std::isfinite(rounding))
    return std::ldexp(1.0, static_cast<int>(std::ceil(std::log2(rounding))));
  if (!(bound > 0.0) || !(bound < 1.0)) return 1.0;
  return std::ldexp(1.0, kPowersApart * static_cast<int>(std::ceil(std::log2(bound) / kPowersApart)));
}

}  // namespace

RigidPair::RigidPair(std::shared_ptr<const Surface> surface, const NodeMotion& motion, double friction,
                     const Eigen::VectorXd& force_bounds)
    : surface_(std::move(surface)), held_(Eigen::Vector2d::Zero()) {
  Traits traits;
  traits.friction = friction;
  traits.curved = !surface_->Flat();
  for (const int dof : motion.dofs)
    if (dof >= 0) traits.dofs.push_back(dof);
  const auto last = static_cast<Eigen::Index>(traits.dofs.size());
  motion_ = Motion::Zero(2, last + 1);
  motion_.col(last) = -motion.velocity;
  Eigen::Index k = 0;
  for (const Eigen::Index axis : {0, 1}) {
    if (motion.dofs[static_cast<std::size_t>(axis)] >= 0)
      motion_(axis, k++) = 1.0;
    else
      held_[axis] = motion.held[axis];
  }
  if (traits.curved) {
    // The foot moves along the surface, where both components of the node have a share in gap and xi.
    for (std::size_t i = 0; i < traits.dofs.size() + 1; ++i)
      traits.moves_gap[i] = traits.moves_xi[i] = !motion_.col(static_cast<Eigen::Index>(i)).isZero(0.0);
    traits.largest_gap_rate = 1.0 + motion.velocity.norm();
  } else {
    const Projection at_origin = surface_->Project(Eigen::Vector2d::Zero(), 0);
    const Eigen::Vector2d& n = at_origin.normal;
    const Eigen::Vector2d t = TangentOf(n);
    gap_offset_ = n.x() * held_.x() + n.y() * held_.y() + at_origin.gap;
    xi_offset_ = t.x() * held_.x() + t.y() * held_.y() + at_origin.xi;
    gap_gradient_ = motion_.transpose() * n;
    xi_gradient_ = motion_.transpose() * t;
    for (Eigen::Index i = 0; i <= last; ++i) {
      traits.moves_gap[static_cast<std::size_t>(i)] = gap_gradient_[i] != 0.0;
      traits.moves_xi[static_cast<std::size_t>(i)] = xi_gradient_[i] != 0.0;
    }
    traits.largest_gap_rate = 1.0 + std::abs(gap_gradient_[last]);
  }
  if (force_bounds.size() > 0) {
    double bound = 0.0;
    for (std::size_t i = 0; i < traits.dofs.size(); ++i)
      bound +=
          (traits.curved ? 1.0 : std::abs(gap_gradient_[static_cast<Eigen::Index>(i)])) * force_bounds[traits.dofs[i]];
    traits.force_unit = ForceUnitAbove(bound);
  }
  SetTraits(std::move(traits));
}

Eigen::Vector2d RigidPair::Position(const Eigen::VectorXd& u, double s) const { return held_ + motion_ * Local(u, s); }

void RigidPair::Evaluate(const Eigen::VectorXd& u, double s, double reference, Kinematics* kinematics) const {
  if (!Curved()) {
    kinematics->gap = gap_offset_ + Rate(gap_gradient_, u, s);
    kinematics->xi = xi_offset_ - reference + Rate(xi_gradient_, u, s);
    kinematics->gap_gradient = gap_gradient_;
    kinematics->xi_gradient = xi_gradient_;
    return;
  }
  const Projection at = surface_->Project(Position(u, s), 0);
  kinematics->gap = at.gap;
  kinematics->xi = at.xi - reference;
  kinematics->gap_gradient = motion_.transpose() * at.normal;
  kinematics->xi_gradient = motion_.transpose() * XiGradient(at);
  kinematics->gap_hessian = motion_.transpose() * GapHessian(at) * motion_;
  kinematics->xi_hessian = motion_.transpose() * XiHessian(at) * motion_;
}

double RigidPair::Gap(const Eigen::VectorXd& u, double s) const {
  return Curved() ? surface_->Project(Position(u, s), 0).gap : gap_offset_ + Rate(gap_gradient_, u, s);
}

void RigidPair::HessianDerivative(const Eigen::VectorXd& u, double s, double rn, double rt, const PairVector& direction,
                                  PairMatrix* derivative) const {
  const Projection at = surface_->Project(Position(u, s), 0);
  const Eigen::Vector2d v = motion_ * direction;
  *derivative = motion_.transpose() * (rn * GapHessianChange(at, v) + rt * XiHessianChange(at, v)) * motion_;
}

}  // namespace contact_path
