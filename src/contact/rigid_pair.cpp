#include "contact_path/contact/rigid_pair.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/geometry/surface.h"

namespace contact_path {

RigidPair::RigidPair(std::shared_ptr<const Surface> surface, const NodeMotion& motion, double friction,
                     const Eigen::VectorXd& force_bounds, const std::optional<Eigen::Vector2d>& slip_origin)
    : surface_(std::move(surface)), held_(Eigen::Vector2d::Zero()), turn_(motion.turn), about_(motion.about) {
  Traits traits;
  SurfaceTraits of_surface;
  traits.largest_ratio = friction;
  traits.curved = !surface_->Flat() || turn_ != 0.0;
  of_surface.has_patches = surface_->NumPatches() > 1 || std::isfinite(surface_->RangeOf(0).begin);
  of_surface.seamless = surface_->Seamless();
  const XiRange range = surface_->Range();
  if (surface_->Closed()) of_surface.round = range.end - range.begin;
  if (slip_origin)
    of_surface.slip_origin = std::clamp(surface_->ProjectOnNearest(*slip_origin).xi, range.begin, range.end);
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
      traits.moves[kNormal][i] = traits.moves[kTangent][i] = !motion_.col(static_cast<Eigen::Index>(i)).isZero(0.0);
    traits.largest_reach_rate = 1.0 + motion.velocity.norm();
    if (turn_ != 0.0) {  // the farther from the centre of the turn, the faster
      traits.moves[kNormal][traits.dofs.size()] = traits.moves[kTangent][traits.dofs.size()] = true;
      traits.largest_reach_rate = std::numeric_limits<double>::infinity();
    }
  } else {
    const Projection at_origin = surface_->Project(Eigen::Vector2d::Zero(), 0);
    const Eigen::Vector2d& n = at_origin.normal;
    const Eigen::Vector2d t = TangentOf(n);
    gap_offset_ = n.x() * held_.x() + n.y() * held_.y() + at_origin.gap;
    xi_offset_ = t.x() * held_.x() + t.y() * held_.y() + at_origin.xi;
    gap_gradient_ = motion_.transpose() * n;
    xi_gradient_ = motion_.transpose() * t;
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
  SetContact(traits, of_surface);
}

// x(q) = a + R z with z = p - a - velocity s, and its derivatives. The rotation R by the angle -turn s has the
// derivatives R' = -turn J R by s, with J the rotation by a quarter of a turn.
struct RigidPair::Frame {
  Frame(const RigidPair& pair, const Eigen::VectorXd& u, double s)
      : motion(pair.motion_), z(pair.Unturned(u, s) - pair.about_) {
    const double angle = -pair.turn_ * s;
    rotation[0] << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (std::size_t k = 1; k < rotation.size(); ++k)
      rotation[k] << pair.turn_ * rotation[k - 1].row(1), -pair.turn_ * rotation[k - 1].row(0);
    x = pair.about_ + rotation[0] * z;
    last = motion.cols() - 1;
    first = rotation[0] * motion;
    first.col(last) += rotation[1] * z;
  }

  // Second derivatives by q of weights . x.
  LawMatrix Second(const Eigen::Vector2d& weights) const {
    return Bordered(motion.transpose() * (rotation[1].transpose() * weights), weights.dot(rotation[2] * z));
  }
  // d/dh along q + h direction of the first derivatives, and of the second ones.
  Motion FirstChange(const LawVector& direction) const {
    const double ds = direction[last];
    Motion change = ds * rotation[1] * motion;
    change.col(last) += rotation[1] * (motion * direction) + ds * (rotation[2] * z);
    return change;
  }
  LawMatrix SecondChange(const Eigen::Vector2d& weights, const LawVector& direction) const {
    const double ds = direction[last];
    return Bordered(ds * (motion.transpose() * (rotation[2].transpose() * weights)),
                    weights.dot(ds * (rotation[3] * z) + rotation[2] * (motion * direction)));
  }

  // border in the last row and in the last column, both in the last place, and corner besides.
  LawMatrix Bordered(const LawVector& border, double corner) const {
    LawMatrix matrix = LawMatrix::Zero(last + 1, last + 1);
    matrix.row(last) += border.transpose();
    matrix.col(last) += border;
    matrix(last, last) += corner;
    return matrix;
  }

  const Motion& motion;
  Eigen::Vector2d z, x;
  std::array<Eigen::Matrix2d, 4> rotation;  // and its derivatives by s
  Motion first;                             // dx/dq
  Eigen::Index last = 0;                    // s in q
};

Eigen::Vector2d RigidPair::Position(const Eigen::VectorXd& u, double s) const {
  return turn_ != 0.0 ? Frame(*this, u, s).x : Unturned(u, s);
}

Eigen::Vector2d RigidPair::Unturned(const Eigen::VectorXd& u, double s) const {
  return held_ + motion_ * LocalOf(OwnDofs(), u, s);
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
    gap.motion = gap_offset_ + ports->Rate(gap_gradient_, u, s);
    xi.motion = xi_offset_ - reference[kTangent] + ports->Rate(xi_gradient_, u, s);
    gap.gradient = gap_gradient_;
    xi.gradient = xi_gradient_;
    return;
  }
  const int known = NearestKnown(KnownPatch(u, s, patch));
  const auto fill = [&](const Projection& at, const Motion& first) {
    gap.motion = at.gap;
    xi.motion = at.xi - reference[kTangent];
    gap.gradient = first.transpose() * at.normal;
    xi.gradient = first.transpose() * XiGradient(at);
    gap.hessian = first.transpose() * GapHessian(at) * first;
    xi.hessian = first.transpose() * XiHessian(at) * first;
  };
  if (turn_ == 0.0) {
    fill(surface_->Project(Position(u, s), known), motion_);
    return;
  }
  const Frame frame(*this, u, s);
  const Projection at = surface_->Project(frame.x, known);
  fill(at, frame.first);
  gap.hessian += frame.Second(at.normal);
  xi.hessian += frame.Second(XiGradient(at));
}

double RigidPair::Gap(const Eigen::VectorXd& u, double s, int patch) const {
  if (!Curved()) return FlatGap(u, s);
  const Eigen::Vector2d x = Position(u, s);
  if (patch != kNearestPatch || !HasPatches()) return GapBeside(*surface_, x, KnownPatch(u, s, patch));
  const NearestFoot nearest = NearestTo(x);
  return nearest.is_end ? nearest.distance : surface_->Project(x, nearest.patch).gap;
}

NearestFoot RigidPair::NearestTo(const Eigen::Vector2d& x) const {
  const NearestFoot nearest = surface_->NearestFrom(x, nearest_);
  nearest_ = nearest.patch;
  return nearest;
}

NearestFoot RigidPair::Nearest(const Eigen::VectorXd& u, double s) const {
  return HasPatches() ? NearestTo(Position(u, s)) : NearestFoot{0, Gap(u, s, 0), false};
}

int RigidPair::PatchAt(const Eigen::VectorXd& u, double s) const {
  return HasPatches() ? PatchBeside(*surface_, Position(u, s)) : 0;
}

int RigidPair::PatchAfter(const Eigen::VectorXd& u, double s, int from) const {
  return HasPatches() ? PatchBeside(*surface_, Position(u, s), from) : 0;
}

void RigidPair::ForceHessian(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                             const LawVector& direction, LawMatrix* derivative) const {
  const double rn = forces[kNormal], rt = forces[kTangent];
  // The force is a gradient: its second derivatives, weighted, are the change of its first ones along the weights.
  const auto change = [&](const Projection& at, const Motion& first) {
    const Eigen::Vector2d v = first * direction;
    return LawMatrix(first.transpose() * (rn * GapHessianChange(at, v) + rt * XiHessianChange(at, v)) * first);
  };
  const int known = NearestKnown(KnownPatch(u, s, patch));
  if (turn_ == 0.0) {
    *derivative = change(surface_->Project(Position(u, s), known), motion_);
    return;
  }
  const Frame frame(*this, u, s);
  const Projection at = surface_->Project(frame.x, known);
  const Eigen::Matrix2d hessian = rn * GapHessian(at) + rt * XiHessian(at);
  const Eigen::Vector2d weights = rn * at.normal + rt * XiGradient(at);
  const LawMatrix mixed = frame.FirstChange(direction).transpose() * hessian * frame.first;
  *derivative = change(at, frame.first) + mixed + mixed.transpose() +
                frame.Second(hessian * (frame.first * direction)) + frame.SecondChange(weights, direction);
}

}  // namespace contact_path
