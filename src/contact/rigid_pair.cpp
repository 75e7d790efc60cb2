#include "contact_path/contact/rigid_pair.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace contact_path {

RigidPair::RigidPair(std::shared_ptr<const Surface> surface, MovingPlace place, double friction,
                     const Eigen::VectorXd& force_bounds, const std::optional<Eigen::Vector2d>& slip_origin,
                     double compliance, const Rolling& rolls, double friction_rate, const BroughtOn& overlap)
    : surface_(std::move(surface)),
      place_(std::move(place)),
      share_rate_(friction > 0.0 ? friction_rate / friction : 0.0),
      radius_(rolls.radius) {
  Traits traits;
  SurfaceTraits of_surface;
  traits.largest_ratio = friction;
  traits.curved = !surface_->Flat() || !place_.Affine() || share_rate_ != 0.0;
  traits.compliant = compliance > 0.0;
  of_surface.compliance = compliance;
  of_surface.overlap = overlap;
  of_surface.has_patches = surface_->NumPatches() > 1 || std::isfinite(surface_->RangeOf(0).begin);
  of_surface.seamless = surface_->Seamless();
  of_surface.rolls = rolls.radius > 0.0 && of_surface.has_patches && !of_surface.seamless;
  const XiRange range = surface_->Range();
  if (surface_->Closed()) of_surface.round = range.end - range.begin;
  if (slip_origin)
    of_surface.slip_origin = std::clamp(surface_->ProjectOnNearest(*slip_origin).xi, range.begin, range.end);
  traits.dofs = place_.Dofs();
  traits.couples = rolls.radius > 0.0 || (!place_.Affine() && traits.dofs.size() > 2);  // unknowns of a body
  const auto last = static_cast<Eigen::Index>(traits.dofs.size());
  roll_ = LawVector::Zero(last + 1);
  for (const auto& [angle, radius] : {std::pair(rolls.angle, rolls.radius), std::pair(rolls.obstacle, -rolls.radius)})
    roll_[std::find(traits.dofs.begin(), traits.dofs.end(), angle.dof) - traits.dofs.begin()] +=
        angle.dof >= 0 ? radius : radius * angle.rate;
  if (traits.curved) {
    // The foot moves along the surface, where both components of the node have a share in gap and xi.
    for (Eigen::Index i = 0; i <= last; ++i) {
      traits.moves[kNormal][static_cast<std::size_t>(i)] = place_.Moves(i) || (i == last && overlap.rate != 0.0);
      traits.moves[kTangent][static_cast<std::size_t>(i)] = place_.Moves(i) || roll_[i] != 0.0;
      traits.moves[kFoot][static_cast<std::size_t>(i)] = of_surface.rolls && place_.Moves(i);
    }
    // In a frame that turns: the farther from its origin, the faster.
    traits.largest_reach_rate = place_.Affine()
                                    ? 1.0 + place_.ConstantGradient().col(last).norm() + std::abs(overlap.rate)
                                    : std::numeric_limits<double>::infinity();
  } else {
    const Eigen::Vector2d held = place_.Constant();
    const Projection at_origin = surface_->Project(Eigen::Vector2d::Zero(), 0);
    const Eigen::Vector2d& n = at_origin.normal;
    const Eigen::Vector2d t = TangentOf(n);
    gap_offset_ = n.x() * held.x() + n.y() * held.y() + at_origin.gap + overlap.at_0;
    xi_offset_ = t.x() * held.x() + t.y() * held.y() + at_origin.xi;
    gap_gradient_ = place_.ConstantGradient().transpose() * n;
    gap_gradient_[last] += overlap.rate;
    xi_gradient_ = place_.ConstantGradient().transpose() * t + roll_;
    for (Eigen::Index i = 0; i <= last; ++i) {
      traits.moves[kNormal][static_cast<std::size_t>(i)] = gap_gradient_[i] != 0.0;
      traits.moves[kTangent][static_cast<std::size_t>(i)] = xi_gradient_[i] != 0.0;
    }
    traits.largest_reach_rate = 1.0 + std::abs(gap_gradient_[last]);
  }
  if (force_bounds.size() > 0) {
    double bound = 0.0;
    for (std::size_t i = 0; i < traits.dofs.size(); ++i)
      bound +=
          (traits.curved ? 1.0 : std::abs(gap_gradient_[static_cast<Eigen::Index>(i)])) * force_bounds[traits.dofs[i]];
    traits.force_unit = ForceUnitAbove(bound);
  }
  if (compliance > 0.0) traits.force_unit = std::max(traits.force_unit, ForceUnitOf(compliance));
  SetContact(traits, of_surface);
}

double RigidPair::FlatGap(const Eigen::VectorXd& u, double s) const {
  double sum = 0.0;
  Eigen::Index k = 0;
  for (const int dof : OwnDofs()) sum += gap_gradient_[k++] * u[dof];
  return gap_offset_ + (sum + gap_gradient_[k] * s);
}

int RigidPair::NearestKnown(int patch) const {
  return surface_->Closed() ? patch : std::clamp(patch, 0, surface_->NumPatches() - 1);
}

void RigidPair::Evaluate(const Eigen::VectorXd& u, double s, int patch, const PortReals& reference,
                         PortsAt* ports) const {
  ports->dofs = OwnDofs();
  PortAt &gap = (*ports)[kNormal], &xi = (*ports)[kTangent];
  if (!Curved()) {
    gap.motion = gap_offset_ - reference[kNormal] + ports->Rate(gap_gradient_, u, s);
    xi.motion = xi_offset_ - reference[kTangent] + ports->Rate(xi_gradient_, u, s);
    gap.gradient = gap_gradient_;
    xi.gradient = xi_gradient_;
    return;
  }
  const PlaceAt place(place_, u, s);
  const Projection at = FootOf(place, u, s, patch);
  gap.motion = at.gap - reference[kNormal];
  xi.motion = at.xi - reference[kTangent] + ports->Rate(roll_, u, s);
  gap.gradient = place.first.transpose() * at.normal;
  xi.gradient = place.first.transpose() * XiGradient(at) + roll_;
  ToGap(s, &gap);
  gap.hessian = place.Hessian(at.normal, GapHessian(at));
  xi.hessian = place.Hessian(XiGradient(at), XiHessian(at));
  if (FootPort() == kFoot)
    (*ports)[kFoot] = {at.xi, place.first.transpose() * XiGradient(at), xi.hessian, 1.0, LawVector()};
  if (share_rate_ == 0.0) return;
  xi.factor = Share(s);
  xi.factor_gradient = LawVector::Unit(xi.gradient.size(), xi.gradient.size() - 1) * share_rate_;
}

Projection RigidPair::FootOf(const PlaceAt& place, const Eigen::VectorXd& u, double s, int patch) const {
  return surface_->Project(place.x, NearestKnown(KnownPatch(u, s, patch)));
}

double RigidPair::Gap(const Eigen::VectorXd& u, double s, int patch) const {
  if (!Curved()) return FlatGap(u, s);
  const Eigen::Vector2d x = place_.At(u, s);
  if (patch != kNearestPatch || !HasPatches()) return GapAt(s, GapBeside(*surface_, x, KnownPatch(u, s, patch)));
  const NearestFoot nearest = NearestTo(x);
  return GapAt(s, nearest.is_end ? nearest.distance : surface_->Project(x, nearest.patch).gap);
}

NearestFoot RigidPair::NearestTo(const Eigen::Vector2d& x) const {
  const NearestFoot nearest = surface_->NearestFrom(x, nearest_);
  nearest_ = nearest.patch;
  return nearest;
}

NearestFoot RigidPair::Nearest(const Eigen::VectorXd& u, double s) const {
  if (!HasPatches()) return {0, Gap(u, s, 0), false};
  NearestFoot nearest = NearestTo(place_.At(u, s));
  nearest.distance = GapAt(s, nearest.distance);
  return nearest;
}

int RigidPair::PatchAfter(const Eigen::VectorXd& u, double s, int from) const {
  return HasPatches() ? PatchBeside(*surface_, place_.At(u, s), from) : 0;
}

bool RigidPair::TouchesTwice(const Eigen::VectorXd& u, double s, int patch) const {
  if (FootPort() != kFoot) return false;
  const Eigen::Vector2d x = place_.At(u, s);
  const double own = surface_->Project(x, NearestKnown(patch)).gap;
  for (int other = 0; other < surface_->NumPatches(); ++other) {
    const Projection at = surface_->Project(x, other);
    const XiRange range = surface_->RangeOf(other);
    const bool has_foot = at.xi >= range.begin && at.xi <= range.end;
    if (has_foot && at.gap < own - tolerances::kTouching && at.gap > -radius_) return true;
  }
  return false;
}

LawMatrix RigidPair::ChangeAlong(const PlaceAt& place, const Projection& at, double rn, double rt,
                                 const LawVector& weights) const {
  // The force is a gradient: its second derivatives, weighted, are the change of its first ones along the weights.
  const Eigen::Vector2d v = place.first * weights;
  return place.HessianChange(rn * at.normal + rt * XiGradient(at), rn * GapHessian(at) + rt * XiHessian(at),
                             rn * GapHessianChange(at, v) + rt * XiHessianChange(at, v), weights);
}

void RigidPair::ForceHessian(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                             const LawVector& weights, LawMatrix* hessian) const {
  const PlaceAt place(place_, u, s);
  const Projection at = FootOf(place, u, s, patch);
  *hessian = ChangeAlong(place, at, forces[kNormal], OnRecord(u, s, forces[kTangent]), weights);
  if (share_rate_ == 0.0) return;
  const LawVector change = (forces[kTangent] * share_rate_) * (place.Hessian(XiGradient(at), XiHessian(at)) * weights);
  hessian->rightCols<1>() += change;
  hessian->bottomRows<1>() += change.transpose();
}

LawVector RigidPair::SecondDirectional(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                                       const LawVector& direction) const {
  const PlaceAt place(place_, u, s);
  const Projection at = FootOf(place, u, s, patch);
  LawVector second = ChangeAlong(place, at, forces[kNormal], OnRecord(u, s, forces[kTangent]), direction) * direction;
  if (const double change = forces[kTangent] * share_rate_ * direction[direction.size() - 1]; change != 0.0)
    second += (2.0 * change) * (place.Hessian(XiGradient(at), XiHessian(at)) * direction);
  return second;
}

Eigen::Vector3d RigidPair::FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                                       const LawVector& first, const LawVector& second) const {
  if (port == kNormal || share_rate_ == 0.0) return Law::FactorAlong(port, u, s, patch, first, second);
  const Eigen::Index last = first.size() - 1;
  return {Share(s), share_rate_ * first[last], share_rate_ * second[last]};
}

double RigidPair::Travel(std::size_t port, const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du,
                         double ds, int patch_after) const {
  const double motion = Law::Travel(port, u, s, patch, du, ds, patch_after);
  return port == kTangent && share_rate_ != 0.0 ? Share(s + 0.5 * ds) * motion : motion;
}

}  // namespace contact_path
