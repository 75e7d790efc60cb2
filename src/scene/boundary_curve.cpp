#include "contact_path/scene/boundary_curve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace contact_path {
namespace {

Eigen::Vector2d SlopeOf(const Parabola& curve, double tau) { return curve.b + 2.0 * tau * curve.c; }

Eigen::Vector2d NormalOf(const Parabola& curve, double tau) {
  const Eigen::Vector2d slope = SlopeOf(curve, tau);
  return Eigen::Vector2d(-slope.y(), slope.x()).stableNormalized();
}

}  // namespace

BoundaryCurve::BoundaryCurve(const std::vector<Eigen::Vector2d>& places, bool closed, double radius)
    : spline_(static_cast<int>(places.size()), closed), radius_(radius) {
  for (int i = 0; i < spline_.NumPatches(); ++i) {
    const SplinePatch patch = spline_.Patch(i);
    std::array<Eigen::Vector2d, 3> nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      nodes[k] = patch.nodes[k] < 0 ? Eigen::Vector2d::Zero() : places[static_cast<std::size_t>(patch.nodes[k])];
    patches_.push_back({Parabola(patch, nodes), patch.end});
  }
}

BoundaryCurve::Foot BoundaryCurve::Nearest(const Eigen::Vector2d& x, const AdmissiblePatches& patches) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  double foot = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (!patches.Has(static_cast<int>(i))) continue;
    const double tau = std::clamp(patches_[i].curve.FootOf(x, 0.0, patches_[i].end), 0.0, patches_[i].end);
    const double distance = (x - patches_[i].curve.At(tau)).norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    at = i;
    foot = tau;
  }
  const Patch& patch = patches_[at];
  const Eigen::Vector2d away = x - patch.curve.At(foot), normal = NormalOf(patch.curve, foot);
  const double along = away.dot(SlopeOf(patch.curve, foot));
  const int number = static_cast<int>(at);
  const bool before = !patches.Has(number - 1) && foot == 0.0 && along < 0.0;
  const bool after = !patches.Has(number + 1) && foot == patch.end && along > 0.0;
  if (before || after) return {nearest, normal, true};
  return {away.dot(normal) - radius_, normal, false};
}

std::vector<OutlinePoint> BoundaryCurve::Points(int parts) const {
  std::vector<OutlinePoint> points;
  for (std::size_t i = 0; i < patches_.size(); ++i)
    for (int part = 0; part < parts + (i + 1 == patches_.size() ? 1 : 0); ++part) {
      const double tau = patches_[i].end * part / parts;
      const Eigen::Vector2d normal = NormalOf(patches_[i].curve, tau);
      points.push_back({patches_[i].curve.At(tau) + radius_ * normal, normal, static_cast<double>(points.size())});
    }
  return points;
}

AdmissiblePatches PatchesFor(const std::string& node, const BoundarySurface& surface,
                             const std::vector<Eigen::Vector2d>& places) {
  const auto own = std::find(surface.nodes.begin(), surface.nodes.end(), node);
  if (own == surface.nodes.end())
    return AdmissiblePatches(NodalSpline(static_cast<int>(surface.nodes.size()), surface.closed));
  return {places, surface.closed, surface.radius, static_cast<int>(own - surface.nodes.begin())};
}

}  // namespace contact_path
