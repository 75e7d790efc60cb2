#include "check/surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "check/nearest_piece.h"
#include "contact_path/iterations.h"

namespace contact_path::check {
namespace {

// n . (x - p) >= 0.
class HalfPlane : public Surface {
 public:
  explicit HalfPlane(const Obstacle& obstacle) : point_{obstacle.px, obstacle.py} {
    const Vector along{obstacle.nx, obstacle.ny};
    const Real length = Length(along);
    normal_ = {along.x / length, along.y / length};
    tangent_ = {normal_.y, -normal_.x};
  }

  Real Gap(const Vector& x) const override { return Dot(normal_, x - point_); }
  Vector Normal(const Vector&) const override { return normal_; }
  Real Slip(const Vector& from, const Vector& to) const override { return Dot(tangent_, to - from); }

 private:
  Vector point_, normal_, tangent_;
};

// |x - p| >= radius, or <= radius.
class Circle : public Surface {
 public:
  explicit Circle(const Obstacle& obstacle)
      : centre_{obstacle.px, obstacle.py}, radius_(obstacle.radius), side_(obstacle.inside ? -1.0L : 1.0L) {}

  Real Gap(const Vector& x) const override { return side_ * (Length(x - centre_) - radius_); }
  Vector Normal(const Vector& x) const override { return side_ / Length(x - centre_) * (x - centre_); }
  // The shorter way round; t is clockwise on the outside.
  Real Slip(const Vector& from, const Vector& to) const override {
    return -side_ * radius_ * AngleBetween(from - centre_, to - centre_);
  }

 private:
  Vector centre_;
  Real radius_, side_;
};

// Of a piece: what is no farther beyond its end is at the end.
constexpr Real kBeyond = 1e-12L;

// A curve of pieces, each of which is walked from its begin to its end. A piece has a parameter from 0 to End(), and
// Foot() one that may be beyond; Direction() is of length 1, and Walked() is the length of the curve up to a place.
template <typename Piece>
struct Curve {
  bool closed;
  std::vector<Piece> pieces;
  // In the convex hulls of the places is the whole curve, and of the directions its tangent. Empty: they are not known.
  std::vector<Vector> places, directions;
};

template <typename Piece>
class Walk : public Surface {
 public:
  Walk(Curve<Piece> curve, bool for_circles)
      : pieces_(std::move(curve.pieces)), closed_(curve.closed), for_circles_(for_circles) {
    std::vector<Around> around;
    around.reserve(pieces_.size());
    for (const Piece& piece : pieces_) around.push_back({piece.from, piece.Length()});
    search_ = NearestPiece(std::move(around));
    FindBeyond(curve);
  }

  Real Gap(const Vector& x) const override {
    const Foot foot = Nearest(x);
    return foot.is_end ? foot.distance : Dot(foot.normal, x - foot.place);
  }
  Vector Normal(const Vector& x) const override {
    const Foot foot = Nearest(x);
    return foot.is_end && for_circles_ ? 1.0L / foot.distance * (x - foot.place) : foot.normal;
  }
  Real Slip(const Vector& from, const Vector& to) const override {
    const Real slip = Nearest(to).walked - Nearest(from).walked;
    return closed_ ? std::remainder(slip, pieces_.back().Walked(pieces_.back().End())) : slip;
  }
  bool SurelyOpen(const Vector& x) const override {
    return std::any_of(beyond_.begin(), beyond_.end(),
                       [&](const HalfPlaneBeyond& part) { return Dot(part.direction, x) > part.height; });
  }

 private:
  struct Foot {
    Vector place, normal;
    Real walked = 0.0L;  // length of the curve up to it
    Real distance = std::numeric_limits<Real>::infinity();
    bool is_end = false;  // of an open curve
  };
  // All of the curve is below it.
  struct HalfPlaneBeyond {
    Vector direction;
    Real height;
  };

  // The nearest of the feet on all pieces; of equal ones the first.
  Foot Nearest(const Vector& x) const {
    Foot nearest;
    std::size_t nearest_piece = 0;
    search_.Search(x, [&](std::size_t i) {
      const Piece& piece = pieces_[i];
      const Real on = piece.Foot(x), at = std::clamp(on, 0.0L, piece.End());
      const Vector place = piece.Place(at);
      const Real distance = Length(x - place);
      if (distance < nearest.distance || (distance == nearest.distance && i < nearest_piece)) {
        const Real rounding = kBeyond * piece.End();
        const bool before = i == 0 && -on > rounding, behind = i + 1 == pieces_.size() && on - piece.End() > rounding;
        const bool is_end = !closed_ && (before || behind);
        nearest = {place, Left(piece.Direction(at)), piece.Walked(at), distance, is_end};
        nearest_piece = i;
      }
      return distance;
    });
    return nearest;
  }

  void FindBeyond(const Curve<Piece>& curve) {
    const std::vector<Vector>& places = curve.places;
    if (places.empty()) return;
    const auto add = [&](const Vector& direction) {
      Real height = -std::numeric_limits<Real>::infinity();
      for (const Vector& place : places) height = std::max(height, Dot(direction, place));
      beyond_.push_back({direction, height});
    };
    if (closed_) {
      // Its outside is admissible where it is walked clockwise.
      Real area = 0.0L;
      for (std::size_t i = 2; i < places.size(); ++i) area += Cross(places[i - 1] - places[0], places[i] - places[0]);
      if (area < 0.0L)
        for (const Vector& axis : {Vector{1.0L, 0.0L}, Vector{0.0L, 1.0L}}) {
          add(axis);
          add(-1.0L * axis);
        }
      return;
    }
    // The foot of a point beyond is an end, or the gap has the sign of (x - foot) . direction, since n . direction > 0.
    const Vector along = places.back() - places.front();
    if (std::all_of(curve.directions.begin(), curve.directions.end(),
                    [&](const Vector& direction) { return Dot(direction, along) > 0.0L; }))
      add(Left(along));
  }

  std::vector<Piece> pieces_;
  bool closed_, for_circles_;
  NearestPiece search_;
  std::vector<HalfPlaneBeyond> beyond_;
};

std::vector<Vector> PointsOf(const Obstacle& obstacle) {
  std::vector<Vector> points;
  for (std::size_t i = 0; i + 1 < obstacle.points.size(); i += 2)
    points.push_back(
        {static_cast<Real>(obstacle.px) + obstacle.points[i], static_cast<Real>(obstacle.py) + obstacle.points[i + 1]});
  return points;
}

// A straight line or a part of a circle. The parameter is the length from its begin.
struct Arc {
  Vector from, direction;  // at the begin
  Real curvature, length, begin = 0.0L;

  Real End() const { return length; }
  Real Length() const { return length; }
  Real Walked(Real at) const { return begin + at; }
  Vector Direction(Real at) const {
    const Real angle = curvature * at;
    return std::cos(angle) * direction + std::sin(angle) * Left(direction);
  }
  Vector Place(Real at) const {
    if (curvature == 0.0L) return from + at * direction;
    // Along the chord, which halves the angle.
    const Real half = 0.5L * curvature * at;
    return from + 2.0L * std::sin(half) / curvature * (std::cos(half) * direction + std::sin(half) * Left(direction));
  }
  Real Foot(const Vector& x) const {
    if (curvature == 0.0L) return Dot(direction, x - from);
    // The angle from the begin, seen from the centre, in the sense of the walk.
    const Real sense = curvature > 0.0L ? 1.0L : -1.0L, radius = sense / curvature;
    const Vector centre = from + 1.0L / curvature * Left(direction);
    Real angle = sense * AngleBetween(from - centre, x - centre);
    if (angle < 0.5L * length / radius - kPi) angle += 2.0L * kPi;
    return radius * angle;
  }
};

// The corners of a polyline are cut by circles that touch both edges.
Curve<Arc> PolylineOf(const Obstacle& obstacle) {
  constexpr Real kInLine = 1e-14L;
  constexpr Real kDefaultShare = 0.1L;
  const std::vector<Vector> corners = PointsOf(obstacle);
  const std::size_t n = corners.size(), edges = obstacle.closed ? n : n - 1;
  std::vector<Vector> directions;
  std::vector<Real> lengths;
  for (std::size_t i = 0; i < edges; ++i) {
    const Vector edge = corners[(i + 1) % n] - corners[i];
    lengths.push_back(Length(edge));
    directions.push_back(1.0L / lengths.back() * edge);
  }
  // Of a corner: the angle, and what a circle of radius 1 cuts off of both edges.
  std::vector<Real> turns(n, 0.0L), cuts(n, 0.0L);
  for (std::size_t i = obstacle.closed ? 0 : 1; i < edges; ++i) {
    turns[i] = AngleBetween(directions[(i + edges - 1) % edges], directions[i]);
    cuts[i] = std::abs(turns[i]) > kInLine ? std::tan(0.5L * std::abs(turns[i])) : 0.0L;
  }
  std::vector<Real> radii(n, obstacle.fillet);
  if (!obstacle.fillets.empty()) radii.assign(obstacle.fillets.begin(), obstacle.fillets.end());
  Real largest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < edges; ++i)
    if (const Real both = cuts[i] + cuts[(i + 1) % n]; both > 0.0L) largest = std::min(largest, lengths[i] / both);
  for (Real& radius : radii)
    if (!(radius > 0.0L)) radius = std::isfinite(largest) ? kDefaultShare * largest : 1.0L;
  std::vector<Arc> pieces;
  for (std::size_t i = 0; i < edges; ++i) {
    const std::size_t corner = (i + 1) % n;
    const Real radius = radii[corner], from = radii[i] * cuts[i], to = lengths[i] - radius * cuts[corner];
    pieces.push_back({corners[i] + from * directions[i], directions[i], 0.0L, std::max(to - from, 0.0L)});
    if (cuts[corner] == 0.0L) continue;
    pieces.push_back({corners[i] + to * directions[i], directions[i], std::copysign(1.0L / radius, turns[corner]),
                      radius * std::abs(turns[corner])});
  }
  for (std::size_t i = 1; i < pieces.size(); ++i) pieces[i].begin = pieces[i - 1].Walked(pieces[i - 1].End());
  return {obstacle.closed, pieces, corners, directions};
}

// A part of a spline. The parameter w goes from 0 to 1.
struct Cubic {
  static constexpr int kParts = 32;
  static constexpr int kSamples = 12;
  static constexpr Real kRounding = 1e-18L;  // of w

  Vector from, to, bend_from, bend_to;
  Real step;
  std::vector<Real> walked = {};  // up to the parts of equal parameter

  Real End() const { return 1.0L; }
  Real Length() const { return walked.back() - walked.front(); }
  Real Walked(Real w) const {
    const auto part = static_cast<std::size_t>(std::min<Real>(w * kParts, kParts - 1));
    return walked[part] + LengthOf(static_cast<Real>(part) / kParts, w);
  }
  Vector Direction(Real w) const {
    const Vector first = First(w);
    return 1.0L / check::Length(first) * first;
  }
  Vector Place(Real w) const {
    const Real v = 1.0L - w, h = step * step / 6.0L;
    return v * from + w * to + h * (v * v * v - v) * bend_from + h * (w * w * w - w) * bend_to;
  }
  // Derivatives by w.
  Vector First(Real w) const {
    const Real v = 1.0L - w, h = step * step / 6.0L;
    return to - from - h * (3.0L * v * v - 1.0L) * bend_from + h * (3.0L * w * w - 1.0L) * bend_to;
  }
  Vector Second(Real w) const {
    const Real h = step * step;
    return h * (1.0L - w) * bend_from + h * w * bend_to;
  }
  Real LengthOf(Real begin, Real end) const {
    return GaussLength(0.5L * (begin + end), 0.5L * (end - begin), [&](Real w) { return First(w); });
  }
  Real Foot(const Vector& x) const {
    Real w = 0.0L, nearest = std::numeric_limits<Real>::infinity();
    for (int i = 0; i <= kSamples; ++i) {
      const Real sample = static_cast<Real>(i) / kSamples, distance = check::Length(Place(sample) - x);
      if (distance < nearest) {
        nearest = distance;
        w = sample;
      }
    }
    for (int i = 0; i < kMostIterations; ++i) {
      const Vector first = First(w), away = Place(w) - x;
      const Real square = Dot(first, first), slope = square + Dot(away, Second(w));
      const Real move = -Dot(away, first) / (slope > 0.0L ? slope : square);
      w = std::clamp(w + move, -0.25L, 1.25L);
      if (std::abs(move) <= kRounding) break;
    }
    return w;
  }
};

// Cubics between the points, in a parameter that grows by the distance of the points, with continuous second
// derivatives; these are zero at open ends.
Curve<Cubic> SplineOf(const Obstacle& obstacle) {
  const std::vector<Vector> points = PointsOf(obstacle);
  const std::size_t n = points.size(), count = obstacle.closed ? n : n - 1;
  std::vector<Real> steps;
  for (std::size_t i = 0; i < count; ++i) steps.push_back(Length(points[(i + 1) % n] - points[i]));
  std::vector<Vector> bends(n);
  // Gauss-Seidel: each sweep halves the error at least.
  for (int sweep = 0; sweep < kMostIterations; ++sweep)
    for (std::size_t i = obstacle.closed ? 0 : 1; i < count; ++i) {
      const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
      const Real h = steps[before % count], k = steps[i];
      const Vector right = 6.0L * (1.0L / k * (points[after] - points[i]) - 1.0L / h * (points[i] - points[before]));
      bends[i] = 0.5L / (h + k) * (right - h * bends[before] - k * bends[after]);
    }
  Curve<Cubic> curve = {obstacle.closed, {}, {}, {}};
  Real length = 0.0L;
  for (std::size_t i = 0; i < count; ++i) {
    Cubic piece{points[i], points[(i + 1) % n], bends[i], bends[(i + 1) % n], steps[i]};
    piece.walked.push_back(length);
    for (int part = 0; part < Cubic::kParts; ++part)
      piece.walked.push_back(piece.walked.back() + piece.LengthOf(static_cast<Real>(part) / Cubic::kParts,
                                                                  static_cast<Real>(part + 1) / Cubic::kParts));
    length = piece.walked.back();
    curve.pieces.push_back(std::move(piece));
  }
  if (obstacle.closed) return curve;
  // Bezier points of the derivative, a parabola, and of the cubic.
  for (const Cubic& piece : curve.pieces) {
    const Vector begin = piece.First(0.0L), end = piece.First(1.0L);
    const Vector middle = 2.0L * piece.First(0.5L) - 0.5L * (begin + end);
    curve.directions.insert(curve.directions.end(), {begin, middle, end});
    curve.places.insert(curve.places.end(),
                        {piece.from, piece.from + 1.0L / 3.0L * begin, piece.to - 1.0L / 3.0L * end, piece.to});
  }
  return curve;
}

}  // namespace

std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle, bool for_circles) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane: break;
    case ObstacleShape::kCircle: return std::make_unique<Circle>(obstacle);
    case ObstacleShape::kPolyline: return std::make_unique<Walk<Arc>>(PolylineOf(obstacle), for_circles);
    case ObstacleShape::kSpline: return std::make_unique<Walk<Cubic>>(SplineOf(obstacle), for_circles);
  }
  return std::make_unique<HalfPlane>(obstacle);
}

}  // namespace contact_path::check
