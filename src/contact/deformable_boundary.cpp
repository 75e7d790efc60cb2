#include "contact_path/contact/deformable_boundary.h"

#include <algorithm>
#include <cmath>

#include "contact_path/geometry/plane.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

// From the line between two points.
double Distance(const Vector2d& x, const Vector2d& begin, const Vector2d& end) {
  const Vector2d along = end - begin, away = x - begin;
  const double share = std::clamp(along.dot(away) / along.squaredNorm(), 0.0, 1.0);
  return (away - share * along).norm();
}

}  // namespace

DeformableBoundary::DeformableBoundary(std::vector<NodePlace> nodes, const std::vector<Vector2d>& start, bool closed,
                                       double radius)
    : nodes_(std::move(nodes)), spline_(static_cast<int>(nodes_.size()), closed), radius_(radius) {
  double length = closed ? (start.front() - start.back()).norm() : 0.0;
  for (std::size_t i = 1; i < start.size(); ++i) length += (start[i] - start[i - 1]).norm();
  length_per_knot_ = length / static_cast<double>(closed ? start.size() : start.size() - 1);
}

void DeformableBoundary::SetMirroredEnds(const std::array<int, 2>& across) {
  const int count = spline_.NumPatches();
  const auto image = [&](int axis, int end, int next) {
    const NodePlace& of = nodes_[static_cast<std::size_t>(next)];
    return axis < 0 ? of : of.Mirrored(axis, nodes_[static_cast<std::size_t>(end)].held[axis]);
  };
  const NodePlace first = image(across[0], 0, 1), last = image(across[1], count - 1, count - 2);
  nodes_.resize(static_cast<std::size_t>(count));
  nodes_.insert(nodes_.end(), {first, last});
  spline_ = NodalSpline(count, spline_.Closed(), {across[0] >= 0, across[1] >= 0});
}

std::array<Vector2d, 3> DeformableBoundary::Places(const SplinePatch& patch, const Eigen::VectorXd& u) const {
  std::array<Vector2d, 3> places;
  for (std::size_t k = 0; k < places.size(); ++k)
    places[k] = patch.nodes[k] >= 0 ? nodes_[static_cast<std::size_t>(patch.nodes[k])].At(u) : Vector2d::Zero();
  return places;
}

bool DeformableBoundary::InSolid(const Vector2d& x, const Eigen::VectorXd& u) const {
  std::vector<Vector2d> corners;
  return std::any_of(elements_.begin(), elements_.end(), [&](const std::vector<MovingPlace>& element) {
    corners.clear();
    for (const MovingPlace& node : element) corners.push_back(node.At(u, 0.0));
    return IsInside(corners, x);
  });
}

XiRange BoundaryAt::RangeOf(int patch) const {
  const SplinePatch of = boundary_.Spline().Patch(patch);
  const double length = boundary_.LengthPerKnot();
  return {length * of.knot, length * (of.knot + of.end)};
}

NearestFoot BoundaryAt::Nearest(const Vector2d& x) const {
  NearestOfPatches nearest;
  for (int i = 0; i < NumPatches(); ++i) {
    if (!HasPatch(i)) continue;
    const SplinePatch patch = boundary_.Spline().Patch(i);
    const Parabola curve = ParabolaOf(patch);
    const Vector2d begin = curve.a, end = curve.At(patch.end);
    // The parabola is no farther from its chord than a quarter of c.
    if (Distance(x, begin, end) > nearest.most + 0.25 * curve.c.lpNorm<1>()) continue;
    const double tau = curve.FootOf(x, patch.begin, patch.end);
    // Over an axis of symmetry, rounding does not take a node that is held on the axis past the end.
    const bool mirrored = std::max(patch.nodes[0], patch.nodes[2]) >= NumPatches();
    const double rounding = mirrored ? tolerances::kEqual : 0.0;
    if (tau >= -rounding && tau <= patch.end + rounding) {
      nearest.OfferFoot(i, (x - curve.At(tau)).norm());
      continue;
    }
    nearest.OfferEnd(i, (x - begin).norm(), HasPatch(i - 1));
    nearest.OfferEnd(i, (x - end).norm(), HasPatch(i + 1));
  }
  NearestFoot& foot = nearest.foot;
  foot.is_away = !Closed() && !foot.is_end && IsAway(x, foot.patch);
  return foot;
}

// Where x has its foot on a patch, which is prolonged.
struct BoundaryAt::Foot {
  Foot(const BoundaryAt& at, const Vector2d& x, int patch) : of(at.patches_.Patch(patch)) {
    const Parabola curve = at.ParabolaOf(of);
    tau = curve.FootOf(x, of.begin, of.end);
    first = curve.b + 2.0 * tau * curve.c;
    second = 2.0 * curve.c;
    away = x - curve.At(tau);
  }

  SplinePatch of;
  double tau;
  Vector2d first, second, away;  // y', y'', x - y
};

bool BoundaryAt::IsAway(const Vector2d& x, int patch) const {
  const Foot foot(*this, x, patch);
  const double edge = foot.first.norm(), radius = boundary_.Radius();
  const double behind = radius + Cross(foot.away, foot.first) / edge;
  return behind > DepthBehind(radius, edge) && !boundary_.InSolid(x, u_);
}

Projection BoundaryAt::Project(const Vector2d& x, int patch) const {
  const Foot foot(*this, x, patch);
  const double speed = foot.first.norm();
  Projection at;
  at.normal = LeftOf(foot.first) / speed;
  at.gap = foot.away.dot(at.normal) - boundary_.Radius();
  at.xi = boundary_.LengthPerKnot() * (foot.of.knot + foot.tau);
  at.curvature = Cross(foot.first, foot.second) / (speed * speed * speed);
  return at;
}

Vector2d BoundaryAt::PointAt(double xi) const {
  const double knot = xi / boundary_.LengthPerKnot();
  const SplinePatch of = boundary_.Spline().Patch(static_cast<int>(std::floor(knot + 0.5)));
  return ParabolaOf(of).At(knot - of.knot);
}

}  // namespace contact_path
