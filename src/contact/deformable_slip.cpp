// How far the foot of a node walks along a surface that deforms.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact_path/contact/deformable_pair.h"
#include "contact_path/geometry/curve.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

struct Foot {
  int patch;
  double tau;
};

// On the surface at the distance `radius` to the left of a parabola, which is shorter by that times the angle of its
// turn to the left.
double WalkedOn(const Parabola& curve, double from, double to, double radius) {
  if (to < from) return -WalkedOn(curve, to, from, radius);
  if (to == from) return 0.0;
  const double part = to - from;
  const Vector2d first = curve.b + 2.0 * from * curve.c, last = curve.b + 2.0 * to * curve.c;
  const CubicPiece walked(curve.At(from), part * first, part * part * curve.c, Vector2d::Zero());
  const double turn = std::atan2(first.x() * last.y() - first.y() * last.x(), first.dot(last));
  return walked.Length() - radius * turn;
}

// On the surface as it is at u.
double Walked(const DeformableBoundary& boundary, const Eigen::VectorXd& u, const Foot& from, const Foot& to) {
  if (to.patch < from.patch) return -Walked(boundary, u, to, from);
  double length = 0.0;
  for (int i = from.patch; i <= to.patch; ++i) {
    const SplinePatch patch = boundary.Spline().Patch(i);
    const double begin = i == from.patch ? from.tau : 0.0, end = i == to.patch ? to.tau : patch.end;
    length += WalkedOn(Parabola(patch, boundary.Places(patch, u)), begin, end, boundary.Radius());
  }
  return length;
}

}  // namespace

double DeformablePair::Travel(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                              const Eigen::VectorXd& du, double ds, int patch_after) const {
  if (port == kNormal) return Law::Travel(port, u, s, patch, du, ds, patch_after);
  const auto foot_at = [this](const Eigen::VectorXd& at, int known) {
    // Away from the surface as past its end.
    const int most = boundary_->Spline().NumPatches();
    const int number = patches_.Beside(boundary_->Spline().Closed() ? known : std::min(known, most));
    const SplinePatch of = boundary_->Spline().Patch(number);
    const double tau = Parabola(of, boundary_->Places(of, at)).FootOf(node_.At(at), of.begin, of.end);
    return Foot{number, number == known ? tau : std::clamp(tau, of.begin, of.end)};
  };
  const Eigen::VectorXd after = u + du;
  const Foot from = foot_at(u, KnownPatch(u, s, patch)), to = foot_at(after, KnownPatch(after, s + ds, patch_after));
  return 0.5 * (Walked(*boundary_, u, from, to) + Walked(*boundary_, after, from, to));
}

}  // namespace contact_path
