#include "contact_path/geometry/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "contact_path/geometry/plane.h"
#include "contact_path/iterations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

constexpr int kDeepest = 12;       // halvings of a cubic
constexpr int kSamples = 8;        // of a cubic, where the search for a foot sets out
constexpr int kCurvatures = 64;    // of a cubic, where the search for the largest one sets out
constexpr double kFarthest = 2.0;  // tau of a foot, counted from the middle of the piece

// A number in two parts, high + low, of which the second is below the rounding of the first.
struct TwoParts {
  double high, low;
};

// The exact sum, and the exact product (Knuth; Dekker).
TwoParts Sum(double a, double b) {
  const double sum = a + b, share = sum - a;
  return {sum, (a - (sum - share)) + (b - share)};
}

TwoParts Product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// |x - centre|^2 - radius^2, exact to rounding of itself, of numbers that are exact.
double SquaredExcess(const Vector2d& x, const Vector2d& centre, double radius) {
  const TwoParts dx = Sum(x.x(), -centre.x()), dy = Sum(x.y(), -centre.y());
  const TwoParts xx = Product(dx.high, dx.high), yy = Product(dy.high, dy.high), rr = Product(radius, radius);
  const TwoParts squares = Sum(xx.high, yy.high), excess = Sum(squares.high, -rr.high);
  return excess.high +
         (excess.low + squares.low + xx.low + yy.low - rr.low + 2.0 * dx.high * dx.low + 2.0 * dy.high * dy.low);
}

// How far the point that is computed for an end of a piece may be from the end.
double RoundingAt(const CurvePiece& piece, double xi, const Vector2d& point) {
  const Projection at = piece.Project(point);
  return std::abs(at.gap) + std::abs(at.xi - xi) + tolerances::kLastDigits * (point.lpNorm<1>() + piece.Length());
}

// A curve between two points lies within the ellipse around them from whose points the ways to both are together as
// long as the curve: no point of it is farther from the line between them than its shorter half axis.
Capsule AroundPiece(const CurvePiece& piece) {
  const XiRange range = piece.Range();
  const Vector2d begin = piece.PointAt(range.begin), end = piece.PointAt(range.end);
  const double rounding = RoundingAt(piece, range.begin, begin) + RoundingAt(piece, range.end, end);
  const double length = piece.Length() + rounding, straight = std::max((end - begin).norm() - rounding, 0.0);
  return {begin, end, 0.5 * std::sqrt(std::max(length * length - straight * straight, 0.0)) + rounding};
}

}  // namespace

Projection LinePiece::Project(const Vector2d& x) const {
  Projection at;
  at.normal = LeftOf(direction_);
  at.gap = (x - begin_).dot(at.normal);
  at.xi = (x - begin_).dot(direction_);
  return at;
}

Projection ArcPiece::Project(const Vector2d& x) const {
  const Vector2d from_centre = x - centre_;
  const double distance = std::hypot(from_centre.x(), from_centre.y());
  Projection at;
  at.normal = -sign_ / distance * from_centre;
  at.gap = -sign_ * SquaredExcess(x, centre_, radius_) / (distance + radius_);
  at.xi = sign_ * radius_ * std::atan2(Cross(middle_, from_centre), middle_.dot(from_centre));
  at.curvature = sign_ / radius_;
  return at;
}

Vector2d ArcPiece::PointAt(double xi) const {
  const double angle = sign_ * xi / radius_;
  return centre_ + radius_ * (std::cos(angle) * middle_ + std::sin(angle) * LeftOf(middle_));
}

CubicPiece::CubicPiece(const Vector2d& begin, const Vector2d& first, const Vector2d& second, const Vector2d& third,
                       double distance)
    : begin_(begin), first_(first), second_(second), third_(third), distance_(distance), scale_(Integral(0.0, 1.0)) {
  Divide(0.0, 1.0, scale_, 0);
}

CubicPiece::Derivatives CubicPiece::At(double tau) const {
  return {first_ + tau * (2.0 * second_ + 3.0 * tau * third_), 2.0 * second_ + 6.0 * tau * third_};
}

double CubicPiece::CurvatureAt(double tau) const {
  const auto [first, second] = At(tau);
  const double speed = first.norm();
  return Cross(first, second) / (speed * speed * speed);
}

double CubicPiece::LargestCurvature() const {
  int nearest = 0;
  for (int i = 1; i <= kCurvatures; ++i)
    if (CurvatureAt(static_cast<double>(i) / kCurvatures) > CurvatureAt(static_cast<double>(nearest) / kCurvatures))
      nearest = i;
  double from = std::max(nearest - 1, 0) / static_cast<double>(kCurvatures),
         to = std::min(nearest + 1, kCurvatures) / static_cast<double>(kCurvatures);
  for (int i = 0; i < kMostIterations && to - from > tolerances::kSameDirection; ++i) {
    const double third = (to - from) / 3.0;
    if (CurvatureAt(from + third) < CurvatureAt(to - third))
      from += third;
    else
      to -= third;
  }
  return std::max({CurvatureAt(from), CurvatureAt(to), 0.0});
}

double CubicPiece::TurnOf(double from, double to) const {
  const Vector2d before = At(from).first, after = At(to).first;
  return std::atan2(Cross(before, after), before.dot(after));
}

double CubicPiece::Integral(double from, double to) const {
  // Gauss-Legendre, five points on [0, 1].
  constexpr std::array<double, 5> kPoints = {0.046910077030668, 0.23076534494715845, 0.5, 0.76923465505284155,
                                             0.953089922969332};
  constexpr std::array<double, 5> kWeights = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                              0.23931433524968324, 0.11846344252809454};
  double sum = 0.0;
  for (std::size_t i = 0; i < kPoints.size(); ++i)
    sum += kWeights[i] * At(from + kPoints[i] * (to - from)).first.norm();
  return (to - from) * sum;
}

void CubicPiece::Divide(double from, double to, double integral, int depth) {
  const double middle = 0.5 * (from + to), before = Integral(from, middle), after = Integral(middle, to);
  if (depth < kDeepest && std::abs(before + after - integral) > tolerances::kLastDigits * scale_) {
    Divide(from, middle, before, depth + 1);
    Divide(middle, to, after, depth + 1);
    return;
  }
  for (const auto& [end, length] : {std::pair(middle, before), std::pair(to, after)}) {
    const double turn = distance_ == 0.0 ? 0.0 : TurnOf(taus_.back(), end);
    taus_.push_back(end);
    lengths_.push_back(lengths_.back() + (length - distance_ * turn));
  }
}

double CubicPiece::ArcLength(double tau) const {
  // From the part that tau is in; before the first one and after the last one from there.
  const auto next = std::upper_bound(taus_.begin() + 1, taus_.end() - 1, tau);
  const auto part = static_cast<std::size_t>(next - taus_.begin()) - 1;
  const double length = Integral(taus_[part], tau);
  return lengths_[part] + (distance_ == 0.0 ? length : length - distance_ * TurnOf(taus_[part], tau));
}

double CubicPiece::FootOf(const Vector2d& from_begin) const {
  double tau = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSamples; ++i) {
    const double sample = static_cast<double>(i) / kSamples, distance = (Offset(sample) - from_begin).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    tau = sample;
  }
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostIterations; ++i) {
    const Vector2d away = Offset(tau) - from_begin;
    const auto [first, second] = At(tau);
    const double square = first.squaredNorm(), slope = square + away.dot(second);
    // Behind the centre of curvature Newton's method leads away from the nearest foot.
    double move = -away.dot(first) / (slope > 0.0 ? slope : square);
    if (std::abs(move) > 0.5) move = std::copysign(0.5, move);
    tau += move;
    if (std::abs(move) <= tolerances::kLastDigits ||
        (std::abs(move) < tolerances::kEqual && std::abs(move) >= previous))
      return tau;
    if (!(std::abs(tau - 0.5) <= kFarthest)) break;
    previous = std::abs(move);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Projection CubicPiece::Project(const Vector2d& x) const {
  const Vector2d from_begin = x - begin_;
  const double tau = FootOf(from_begin);
  const auto [first, second] = At(tau);
  const Vector2d third = 6.0 * third_;
  // With w = |p'|^2: curvature k = (p' x p'') w^-3/2, and dtau = dxi / sqrt(w).
  const double w = first.squaredNorm(), w_first = 2.0 * first.dot(second);
  const double w_second = 2.0 * (second.squaredNorm() + first.dot(third));
  const double c = Cross(first, second), c_first = Cross(first, third), c_second = Cross(second, third);
  const double speed = std::sqrt(w), cube = w * speed;
  const double a = c / cube, b = w_first / w;
  const double k_first = c_first / cube - 1.5 * a * b;
  const double k_second = c_second / cube - 3.0 * c_first / cube * b - 1.5 * a * w_second / w + 3.75 * a * b * b;
  Projection at;
  at.normal = LeftOf(first / speed);
  at.gap = (from_begin - Offset(tau)).dot(at.normal) - distance_;
  at.xi = ArcLength(tau);
  at.curvature = a;
  at.curvature_first = k_first / speed;
  at.curvature_second = (k_second - 0.5 * k_first * b) / w;
  if (distance_ == 0.0) return at;
  // With m = 1 - k d, dxi is m times that of the cubic, and the curvature k / m.
  const double m = 1.0 - at.curvature * distance_, m3 = m * m * m;
  at.curvature /= m;
  at.curvature_second =
      (at.curvature_second / m + 3.0 * distance_ * at.curvature_first * at.curvature_first / (m * m)) / m3;
  at.curvature_first /= m3;
  return at;
}

Vector2d CubicPiece::PointAt(double xi) const {
  double tau = xi / Length();
  for (int i = 0; i < kMostIterations; ++i) {
    const double move = (xi - ArcLength(tau)) / (At(tau).first.norm() * (1.0 - distance_ * CurvatureAt(tau)));
    tau += move;
    if (!(std::abs(move) > tolerances::kLastDigits)) break;
  }
  if (distance_ == 0.0) return begin_ + Offset(tau);
  return begin_ + Offset(tau) + distance_ * LeftOf(At(tau).first.normalized());
}

Curve::Curve(std::vector<std::unique_ptr<const CurvePiece>> pieces, bool closed, double xi, bool seamless)
    : pieces_(std::move(pieces)), begins_{xi}, closed_(closed), seamless_(seamless) {
  std::vector<Capsule> capsules;
  for (const auto& piece : pieces_) {
    capsules.push_back(AroundPiece(*piece));
    begins_.push_back(begins_.back() + piece->Length());
  }
  tree_ = CapsuleTree(capsules);
}

Curve::Place Curve::PlaceOf(int patch) const {
  const int n = NumPatches();
  const int round = closed_ ? (patch >= 0 ? patch / n : -((n - 1 - patch) / n)) : 0;
  const auto piece = static_cast<std::size_t>(patch - round * n);
  return {piece, begins_[piece] - pieces_[piece]->Range().begin + round * Length()};
}

XiRange Curve::RangeOf(int patch) const {
  const auto [piece, offset] = PlaceOf(patch);
  const XiRange range = pieces_[piece]->Range();
  return {offset + range.begin, offset + range.end};
}

Projection Curve::Project(const Vector2d& x, int patch) const {
  const auto [piece, offset] = PlaceOf(patch);
  Projection at = pieces_[piece]->Project(x);
  at.xi += offset;
  return at;
}

NearestFoot Curve::Nearest(const Vector2d& x) const { return NearestFrom(x, -1); }

NearestFoot Curve::NearestFrom(const Vector2d& x, int near) const {
  NearestOfPatches nearest;
  const auto visit = [&](std::size_t i) {
    const auto patch = static_cast<int>(i);
    const CurvePiece& piece = *pieces_[i];
    const Projection at = piece.Project(x);
    const XiRange range = piece.Range();
    if (at.xi >= range.begin && at.xi <= range.end) return nearest.OfferFoot(patch, std::abs(at.gap));
    // Also of a point that has no foot.
    nearest.OfferEnd(patch, (x - piece.PointAt(range.begin)).norm(), closed_ || i > 0);
    nearest.OfferEnd(patch, (x - piece.PointAt(range.end)).norm(), closed_ || i + 1 < pieces_.size());
  };
  if (near < 0)
    tree_.Search(x, &nearest.most, visit);
  else
    tree_.SearchFrom(static_cast<std::size_t>(near), x, &nearest.most, visit);
  return nearest.foot;
}

Vector2d Curve::PointAt(double xi) const {
  const auto next = std::upper_bound(begins_.begin() + 1, begins_.end() - 1, xi);
  const auto piece = static_cast<std::size_t>(next - begins_.begin()) - 1;
  return pieces_[piece]->PointAt(xi - begins_[piece] + pieces_[piece]->Range().begin);
}

std::unique_ptr<const Curve> MakeCircle(const Vector2d& centre, double radius, bool inside) {
  const auto side = inside ? ArcPiece::Side::kInside : ArcPiece::Side::kOutside;
  const Vector2d first(0.0, inside ? -1.0 : 1.0);
  std::vector<std::unique_ptr<const CurvePiece>> pieces;
  for (const double sign : {1.0, -1.0})
    pieces.push_back(std::make_unique<ArcPiece>(centre, radius, sign * first, M_PI, side));
  return std::make_unique<Curve>(std::move(pieces), true, -0.5 * M_PI * radius, true);
}

}  // namespace contact_path
