#include "check/boundary.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

namespace contact_path::check {
namespace {

constexpr int kParts = 16;         // of a patch, for its length
constexpr Real kRounding = 1e-9L;  // of the length within which patches are left out
constexpr Real kAtEnd = 1e-9L;     // [rad] off the normal at an end: a path that ends there does so to rounding

constexpr BoundaryPatch::Weights kInner = {{{0.5L, -1.0L, 0.5L}, {0.5L, 1.0L, -1.0L}, {0.0L, 0.0L, 0.5L}}};
constexpr BoundaryPatch::Weights kFirst = {{{1.0L, -0.5L, 0.0L}, {0.0L, 0.5L, 0.0L}, {}}};
constexpr BoundaryPatch::Weights kLast = {{{0.5L, -0.5L, 0.0L}, {0.5L, 0.5L, 0.0L}, {}}};
// The second and the first half of kInner.
constexpr BoundaryPatch::Weights kFromAxis = {
    {{0.125L, -0.25L, 0.125L}, {0.75L, 0.0L, -0.25L}, {0.125L, 0.25L, 0.125L}}};
constexpr BoundaryPatch::Weights kToAxis = {{{0.5L, -0.5L, 0.125L}, {0.5L, 0.5L, -0.25L}, {0.0L, 0.0L, 0.125L}}};

// A number with its derivatives by the positions of a node and of the three nodes of a patch.
using PlaceGradient = Eigen::Matrix<Real, 8, 1>;
using PlaceDual = Eigen::AutoDiffScalar<PlaceGradient>;
using DualVector = VectorOf<PlaceDual>;

DualVector VariableAt(const Vector& place, int number) {
  constexpr int kCount = PlaceGradient::SizeAtCompileTime;
  return {PlaceDual(place.x, kCount, number), PlaceDual(place.y, kCount, number + 1)};
}

// y and dy/dtau of a patch.
struct CurvePoint {
  DualVector place, direction;
};

CurvePoint PointAt(const BoundaryPatch::Weights& weights, const BoundaryPatch::PerNode<DualVector>& nodes,
                   const PlaceDual& tau) {
  const PlaceDual zero(0.0L);
  CurvePoint point = {{zero, zero}, {zero, zero}};
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const auto& [constant, linear, square] = weights[j];
    const PlaceDual shape = (tau * square + linear) * tau + constant, slope = tau * (2.0L * square) + linear;
    point.place += shape * nodes[j];
    point.direction += slope * nodes[j];
  }
  return point;
}

}  // namespace

std::vector<bool> PatchesLeftOut(const BoundarySurface& surface, const std::vector<Vector>& places, std::size_t node) {
  const std::size_t n = places.size();
  std::vector<Real> walked = {0.0L};  // up to each node, and of a closed surface back to the first
  for (std::size_t i = 1; i < n + (surface.closed ? 1 : 0); ++i)
    walked.push_back(walked.back() + Length(places[i % n] - places[i - 1]));
  const Real round = walked.back(), most = (1.0L + kRounding) * kPi * surface.radius;
  const auto onwards = [&](Real length) {
    if (length >= 0.0L) return length;
    return surface.closed ? length + round : std::numeric_limits<Real>::infinity();
  };
  std::vector<bool> left_out;
  for (std::size_t i = 0; i < n; ++i) {
    const Real before = i > 0 ? walked[i - 1] : walked[n - 1] - round;
    const Real after = i + 1 < walked.size() ? walked[i + 1] : walked[i];
    const Real begin = 0.5L * (before + walked[i]), end = 0.5L * (walked[i] + after);  // of the patch: middles of edges
    const Real least = std::min(onwards(begin - walked[node]), onwards(walked[node] - end));
    const std::size_t apart = std::max(i, node) - std::min(i, node);
    left_out.push_back(apart <= 2 || (surface.closed && n - apart <= 2) || least <= most);
  }
  return left_out;
}

Axis SymmetryOf(const Node& end, const Node& next, const Scene& scene) {
  bool turns = !end.fixed_rotation;
  for (const Solid& solid : scene.solids)
    for (const std::string& node : solid.nodes) turns = turns && node != end.name;
  if (turns) return Axis::kNone;
  const Real x = std::abs(static_cast<Real>(next.x) - end.x), y = std::abs(static_cast<Real>(next.y) - end.y);
  if (end.fixed_x && !end.fixed_y && x > y) return Axis::kAcrossX;
  if (end.fixed_y && !end.fixed_x && y > x) return Axis::kAcrossY;
  return Axis::kNone;
}

Boundary::Boundary(const BoundarySurface& surface, const std::vector<std::size_t>& nodes,
                   const std::array<Axis, 2>& axes, std::vector<std::vector<std::size_t>> elements)
    : elements_(std::move(elements)), closed_(surface.closed), radius_(surface.radius) {
  const std::size_t n = nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (closed_ || (i > 0 && i + 1 < n)) {
      patches_.push_back({{nodes[(i + n - 1) % n], nodes[i], nodes[(i + 1) % n]}, kInner});
    } else if (const Axis axis = axes[i == 0 ? 0 : 1]; axis != Axis::kNone) {
      const std::size_t next = i == 0 ? nodes[1] : nodes[n - 2];
      patches_.push_back({{next, nodes[i], next}, i == 0 ? kFromAxis : kToAxis});
      patches_.back().image = i == 0 ? 0 : 2;
      patches_.back().across_x = axis == Axis::kAcrossX;
    } else if (i == 0) {
      patches_.push_back({{nodes[0], nodes[1], nodes[1]}, kFirst});
    } else {
      patches_.push_back({{nodes[n - 2], nodes[n - 1], nodes[n - 1]}, kLast});
    }
  }
}

BoundaryShape::BoundaryShape(const Boundary& boundary, const std::vector<double>& positions)
    : boundary_(boundary), positions_(positions) {
  std::vector<Around> around;
  for (const BoundaryPatch& patch : boundary.Patches()) {
    Parabola curve;
    for (std::size_t j = 0; j < patch.nodes.size(); ++j) {
      const Vector place = PlaceOf(patch, j);
      curve.at += patch.weights[j][0] * place;
      curve.first += patch.weights[j][1] * place;
      curve.second += 2.0L * patch.weights[j][2] * place;
    }
    // Within the triangle of its Bezier points.
    const Vector corner = curve.at + 0.5L * curve.first, end = Place(curve, 1.0L);
    around.push_back({corner, std::max(Length(curve.at - corner), Length(end - corner))});
    curves_.push_back(curve);
  }
  search_ = NearestPiece(std::move(around));
}

Vector BoundaryShape::PlaceOf(const BoundaryPatch& patch, std::size_t node) const {
  Vector place = NodePosition(positions_, patch.nodes[node]);
  if (node != patch.image) return place;
  const Vector axis = NodePosition(positions_, patch.nodes[1]);
  Real& across = patch.across_x ? place.x : place.y;
  across = 2.0L * (patch.across_x ? axis.x : axis.y) - across;
  return place;
}

Vector BoundaryShape::Reflected(const BoundaryPatch& patch, std::size_t node, const Vector& force) {
  if (node != patch.image) return force;
  return patch.across_x ? Vector{-force.x, force.y} : Vector{force.x, -force.y};
}

Vector BoundaryShape::Place(const Parabola& curve, Real tau) {
  return curve.at + tau * curve.first + 0.5L * tau * tau * curve.second;
}

Vector BoundaryShape::Direction(const Parabola& curve, Real tau) { return curve.first + tau * curve.second; }

// The distance has its minima at roots of h = (y - x) . y', a cubic; between the roots of h' there is one of h at most.
BoundaryFoot BoundaryShape::FootOn(const Parabola& curve, const Vector& x) {
  const auto h = [&](Real tau) { return Dot(Place(curve, tau) - x, Direction(curve, tau)); };
  // h' = a tau^2 + 2 b tau + c.
  const Real a = 1.5L * Dot(curve.second, curve.second), b = 1.5L * Dot(curve.first, curve.second);
  const Real c = Dot(curve.first, curve.first) + Dot(curve.at - x, curve.second);
  std::array<Real, 4> bounds = {0.0L, 0.0L, 0.0L, 1.0L};
  if (const Real square = b * b - a * c; square > 0.0L) {
    const Real sum = -(b + std::copysign(std::sqrt(square), b));  // of equal signs
    const Real first = sum / a, second = sum == 0.0L ? 0.0L : c / sum;
    for (std::size_t i = 0; i < 2; ++i) {
      const Real root = i == 0 ? std::min(first, second) : std::max(first, second);
      bounds[i + 1] = std::isfinite(root) ? std::clamp(root, 0.0L, 1.0L) : bounds[i];
    }
  }
  BoundaryFoot nearest;
  const auto offer = [&](Real tau) {
    const Real distance = Length(Place(curve, tau) - x);
    if (!(distance < nearest.distance)) return;
    nearest.tau = tau;
    nearest.distance = distance;
  };
  for (const Real bound : bounds) offer(bound);
  for (std::size_t i = 0; i < 3; ++i) {
    Real low = bounds[i], high = bounds[i + 1];
    if (!(h(low) < 0.0L && h(high) > 0.0L)) continue;  // no minimum inside
    for (Real middle = 0.5L * (low + high); middle > low && middle < high; middle = 0.5L * (low + high))
      (h(middle) < 0.0L ? low : high) = middle;
    offer(0.5L * (low + high));
  }
  return nearest;
}

BoundaryFoot BoundaryShape::Nearest(const Vector& x, const std::vector<bool>& left_out) const {
  BoundaryFoot nearest;
  const std::size_t n = curves_.size();
  const auto is_left_out = [&](std::size_t i) { return !left_out.empty() && left_out[i]; };
  search_.Search(x, [&](std::size_t i) {
    if (is_left_out(i)) return std::numeric_limits<Real>::infinity();
    BoundaryFoot foot = FootOn(curves_[i], x);
    foot.patch = i;
    if (foot.distance < nearest.distance || (foot.distance == nearest.distance && i < nearest.patch)) nearest = foot;
    return foot.distance;
  });
  const bool begins = is_left_out((nearest.patch + n - 1) % n) || (!boundary_.Closed() && nearest.patch == 0);
  const bool ends = is_left_out((nearest.patch + 1) % n) || (!boundary_.Closed() && nearest.patch + 1 == n);
  const bool at_begin = begins && nearest.tau == 0.0L, at_end = ends && nearest.tau == 1.0L;
  const Vector back = x - Place(curves_[nearest.patch], nearest.tau);
  const Vector direction = Direction(curves_[nearest.patch], nearest.tau);
  const Real along = Dot(back, direction), rounding = kAtEnd * Length(back) * Length(direction);
  nearest.is_end = (at_begin && along < -rounding) || (at_end && along > rounding);
  nearest.over_end = (at_begin || at_end) && std::abs(along) <= rounding;
  nearest.is_end = nearest.is_end || (!boundary_.Closed() && IsAway(x, nearest));
  return nearest;
}

bool BoundaryShape::IsAway(const Vector& x, const BoundaryFoot& foot) const {
  const std::size_t last = curves_.size() - 1;
  const Vector per_tau = Direction(curves_[foot.patch], foot.tau);
  // The patches at both ends are halves of an edge.
  const Real edge = (foot.patch == 0 || foot.patch == last ? 2.0L : 1.0L) * Length(per_tau);
  if (!(-Gap(x, foot) > std::max(2.0L * boundary_.Radius(), edge))) return false;
  // Of a ray to the right: how many sides of the element it crosses.
  const auto has_inside = [&](const std::vector<std::size_t>& element) {
    int crossed = 0;
    for (std::size_t i = 0; i < element.size(); ++i) {
      const Vector a = NodePosition(positions_, element[i]) - x;
      const Vector b = NodePosition(positions_, element[(i + 1) % element.size()]) - x;
      if (a.x == 0.0L && a.y == 0.0L) return false;
      const bool up = a.y <= 0.0L && b.y > 0.0L, down = b.y <= 0.0L && a.y > 0.0L;
      if ((up && Cross(a, b) > 0.0L) || (down && Cross(a, b) < 0.0L)) ++crossed;
    }
    return crossed % 2 == 1;
  };
  return std::none_of(boundary_.Elements().begin(), boundary_.Elements().end(), has_inside);
}

Vector BoundaryShape::Normal(const BoundaryFoot& foot) const {
  const Vector direction = Direction(curves_[foot.patch], foot.tau);
  return 1.0L / Length(direction) * Left(direction);
}

Real BoundaryShape::Gap(const Vector& x, const BoundaryFoot& foot) const {
  if (foot.is_end) return foot.distance;
  return Dot(Normal(foot), x - Place(curves_[foot.patch], foot.tau)) - boundary_.Radius();
}

// Gauss's rule of three points for the length of the curve itself; the curve at a distance to the left is shorter by
// the distance times the angle by which the tangent turns to the left.
Real BoundaryShape::Walked(std::size_t patch, Real from, Real to) const {
  const Parabola& curve = curves_[patch];
  const Real half = 0.5L * (to - from) / kParts;
  Real length = 0.0L;
  for (int part = 0; part < kParts; ++part)
    length += GaussLength(from + static_cast<Real>(2 * part + 1) * half, half,
                          [&](Real tau) { return Direction(curve, tau); });
  return length - boundary_.Radius() * AngleBetween(Direction(curve, from), Direction(curve, to));
}

Real BoundaryShape::Walked(const BoundaryFoot& from, const BoundaryFoot& to) const {
  if (from.patch == to.patch) return Walked(from.patch, from.tau, to.tau);
  if (from.patch > to.patch) return -Walked(to, from);
  Real length = Walked(from.patch, from.tau, 1.0L) + Walked(to.patch, 0.0L, to.tau);
  for (std::size_t patch = from.patch + 1; patch < to.patch; ++patch) length += Walked(patch, 0.0L, 1.0L);
  if (!boundary_.Closed()) return length;
  Real round = 0.0L;
  for (std::size_t patch = 0; patch < curves_.size(); ++patch) round += Walked(patch, 0.0L, 1.0L);
  return std::remainder(length, round);
}

// tau solves F = (x - y) . y' = 0. One step of Newton's method from the foot, with the derivative of F by tau as a
// number, gives tau with its derivatives.
BoundaryShape::Forces BoundaryShape::ForcesOf(const Vector& x, const BoundaryFoot& foot, Real rn, Real rt) const {
  const BoundaryPatch& patch = boundary_.Patches()[foot.patch];
  const Parabola& curve = curves_[foot.patch];
  const DualVector node = VariableAt(x, 0);
  BoundaryPatch::PerNode<DualVector> nodes;
  for (std::size_t j = 0; j < nodes.size(); ++j) nodes[j] = VariableAt(PlaceOf(patch, j), 2 + 2 * static_cast<int>(j));

  const CurvePoint at_foot = PointAt(patch.weights, nodes, PlaceDual(foot.tau));
  const Vector first = Direction(curve, foot.tau);
  const Real slope = Dot(x - Place(curve, foot.tau), curve.second) - Dot(first, first);
  const PlaceDual tau = PlaceDual(foot.tau) - Dot(node - at_foot.place, at_foot.direction) / slope;

  const CurvePoint at = PointAt(patch.weights, nodes, tau);
  const PlaceDual gap =
      Cross(at.direction, node - at.place) / sqrt(Dot(at.direction, at.direction)) - boundary_.Radius();

  const Real speed = Length(first), curvature = Cross(first, curve.second) / (speed * speed * speed);
  const Real per_tau = speed * (1.0L - curvature * boundary_.Radius());
  const auto force = [&](Eigen::Index k) -> Vector {
    return {rn * gap.derivatives()[k] + rt * per_tau * tau.derivatives()[k],
            rn * gap.derivatives()[k + 1] + rt * per_tau * tau.derivatives()[k + 1]};
  };
  return {force(0), {force(2), force(4), force(6)}};
}

}  // namespace contact_path::check
