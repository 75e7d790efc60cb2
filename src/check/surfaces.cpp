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
    const Vector a = from - centre_, b = to - centre_;
    return -side_ * radius_ * std::atan2(Cross(a, b), Dot(a, b));
  }

 private:
  Vector centre_;
  Real radius_, side_;
};

// A curve of pieces, each of which is walked from its begin to its end.
class Walk : public Surface {
 public:
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
    return closed_ ? std::remainder(slip, length_) : slip;
  }
  bool SurelyOpen(const Vector& x) const override {
    return std::any_of(beyond_.begin(), beyond_.end(),
                       [&](const HalfPlaneBeyond& part) { return Dot(part.direction, x) > part.height; });
  }

 protected:
  struct Foot {
    Vector place, normal;
    Real walked = 0.0L;  // length of the curve up to it
    Real distance = std::numeric_limits<Real>::infinity();
    bool is_end = false;  // of an open curve
  };

  Walk(bool closed, bool for_circles) : closed_(closed), for_circles_(for_circles) {}

  virtual Foot Nearest(const Vector& x) const = 0;

  static std::vector<Vector> PlacesOf(const Obstacle& obstacle) {
    std::vector<Vector> places;
    for (std::size_t i = 0; i + 1 < obstacle.points.size(); i += 2)
      places.push_back({static_cast<Real>(obstacle.px) + obstacle.points[i],
                        static_cast<Real>(obstacle.py) + obstacle.points[i + 1]});
    return places;
  }

  template <typename Piece, typename LengthOf>
  void MakeSearch(const std::vector<Piece>& pieces, LengthOf length_of) {
    std::vector<Around> around;
    around.reserve(pieces.size());
    for (const Piece& piece : pieces) around.push_back({piece.from, length_of(piece)});
    search_ = NearestPiece(std::move(around));
  }

  // The nearest of the feet on all pieces; of equal ones the first. foot_on(i): on the piece i.
  template <typename FootOn>
  Foot NearestOf(const Vector& x, FootOn foot_on) const {
    Foot nearest;
    std::size_t piece = 0;
    search_.Search(x, [&](std::size_t i) {
      Foot foot = foot_on(i);
      const Real distance = foot.distance;
      if (distance < nearest.distance || (distance == nearest.distance && i < piece)) {
        nearest = foot;
        piece = i;
      }
      return distance;
    });
    return nearest;
  }

  // Where the whole curve, which lies within these points' convex hull, is behind a line with this normal.
  void AddBeyond(const Vector& direction, const std::vector<Vector>& hull) {
    Real height = -std::numeric_limits<Real>::infinity();
    for (const Vector& point : hull) height = std::max(height, Dot(direction, point));
    beyond_.push_back({direction, height});
  }

  bool closed_, for_circles_;
  Real length_ = 0.0L;
  NearestPiece search_;

 private:
  struct HalfPlaneBeyond {
    Vector direction;
    Real height;
  };
  std::vector<HalfPlaneBeyond> beyond_;
};

// The corners of a polyline are cut by circles that touch both edges.
class Polyline : public Walk {
 public:
  Polyline(const Obstacle& obstacle, bool for_circles) : Walk(obstacle.closed, for_circles) {
    const std::vector<Vector> corners = PlacesOf(obstacle);
    const std::size_t n = corners.size(), edges = closed_ ? n : n - 1;
    std::vector<Vector> directions;
    std::vector<Real> lengths;
    for (std::size_t i = 0; i < edges; ++i) {
      const Vector edge = corners[(i + 1) % n] - corners[i];
      lengths.push_back(Length(edge));
      directions.push_back(1.0L / lengths.back() * edge);
    }
    // Of a corner: the angle, and what a circle of radius 1 cuts off of both edges.
    std::vector<Real> turns(n, 0.0L), cuts(n, 0.0L);
    for (std::size_t i = closed_ ? 0 : 1; i < (closed_ ? n : n - 1); ++i) {
      const Vector &before = directions[(i + edges - 1) % edges], &after = directions[i];
      turns[i] = std::atan2(Cross(before, after), Dot(before, after));
      cuts[i] = std::abs(turns[i]) > kInLine ? std::tan(0.5L * std::abs(turns[i])) : 0.0L;
    }
    std::vector<Real> radii(n, obstacle.fillet);
    if (!obstacle.fillets.empty()) radii.assign(obstacle.fillets.begin(), obstacle.fillets.end());
    if (std::any_of(radii.begin(), radii.end(), [](Real radius) { return !(radius > 0.0L); })) {
      Real radius = std::numeric_limits<Real>::infinity();
      for (std::size_t i = 0; i < edges; ++i)
        if (const Real both = cuts[i] + cuts[(i + 1) % n]; both > 0.0L) radius = std::min(radius, lengths[i] / both);
      radius = std::isfinite(radius) ? kDefaultShare * radius : 1.0L;
      for (Real& of : radii)
        if (!(of > 0.0L)) of = radius;
    }
    for (std::size_t i = 0; i < edges; ++i) {
      const std::size_t corner = (i + 1) % n;
      const Real radius = radii[corner], from = radii[i] * cuts[i], to = lengths[i] - radius * cuts[corner];
      pieces_.push_back({corners[i] + from * directions[i], directions[i], 0.0L, std::max(to - from, 0.0L)});
      if (cuts[corner] == 0.0L) continue;
      pieces_.push_back({corners[i] + to * directions[i], directions[i], std::copysign(1.0L / radius, turns[corner]),
                         radius * std::abs(turns[corner])});
    }
    for (Piece& piece : pieces_) {
      piece.begin = length_;
      length_ += piece.length;
    }
    MakeSearch(pieces_, [](const Piece& piece) { return piece.length; });
    FindBeyond(corners, directions);
  }

 private:
  static constexpr Real kInLine = 1e-14L;
  static constexpr Real kDefaultShare = 0.1L;

  struct Piece {
    Vector from, direction;  // at the begin
    Real curvature, length, begin = 0.0L;
  };

  void FindBeyond(const std::vector<Vector>& corners, const std::vector<Vector>& directions) {
    if (closed_) {
      // Its outside is admissible where it is walked clockwise.
      Real area = 0.0L;
      for (std::size_t i = 2; i < corners.size(); ++i)
        area += Cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
      if (area < 0.0L)
        for (const Vector& direction :
             {Vector{1.0L, 0.0L}, Vector{-1.0L, 0.0L}, Vector{0.0L, 1.0L}, Vector{0.0L, -1.0L}})
          AddBeyond(direction, corners);
      return;
    }
    // The foot of a point beyond is an end, or the gap has the sign of (x - foot) . direction, since n . direction > 0.
    const Vector along = corners.back() - corners.front();
    if (std::all_of(directions.begin(), directions.end(), [&](const Vector& edge) { return Dot(edge, along) > 0.0L; }))
      AddBeyond(Left(along), corners);
  }

  // At a length from the begin of a piece.
  static Vector DirectionAt(const Piece& piece, Real walked) {
    const Real angle = piece.curvature * walked;
    return std::cos(angle) * piece.direction + std::sin(angle) * Left(piece.direction);
  }
  static Vector PlaceAt(const Piece& piece, Real walked) {
    if (piece.curvature == 0.0L) return piece.from + walked * piece.direction;
    // Along the chord, which halves the angle.
    const Real half = 0.5L * piece.curvature * walked;
    return piece.from + 2.0L * std::sin(half) / piece.curvature *
                            (std::cos(half) * piece.direction + std::sin(half) * Left(piece.direction));
  }
  static Real FootOn(const Piece& piece, const Vector& x) {
    if (piece.curvature == 0.0L) return Dot(piece.direction, x - piece.from);
    // The angle from the begin, seen from the centre, in the sense of the walk.
    const Real sense = piece.curvature > 0.0L ? 1.0L : -1.0L, radius = sense / piece.curvature;
    const Vector centre = piece.from + 1.0L / piece.curvature * Left(piece.direction);
    const Vector begin = piece.from - centre, here = x - centre;
    Real angle = sense * std::atan2(Cross(begin, here), Dot(begin, here));
    if (angle < 0.5L * piece.length / radius - kPi) angle += 2.0L * kPi;
    return radius * angle;
  }

  Foot Nearest(const Vector& x) const override {
    return NearestOf(x, [&](std::size_t i) {
      const Piece& piece = pieces_[i];
      const Real on = FootOn(piece, x), walked = std::clamp(on, 0.0L, piece.length);
      const Vector place = PlaceAt(piece, walked);
      const bool is_end = !closed_ && ((i == 0 && on < 0.0L) || (i + 1 == pieces_.size() && on > piece.length));
      return Foot{place, Left(DirectionAt(piece, walked)), piece.begin + walked, Length(x - place), is_end};
    });
  }

  std::vector<Piece> pieces_;
};

// Cubics between the points, in a parameter that grows by the distance of the points, with continuous second
// derivatives; these are zero at open ends.
class Spline : public Walk {
 public:
  Spline(const Obstacle& obstacle, bool for_circles) : Walk(obstacle.closed, for_circles) {
    const std::vector<Vector> points = PlacesOf(obstacle);
    const std::size_t n = points.size(), count = closed_ ? n : n - 1;
    std::vector<Real> steps;
    for (std::size_t i = 0; i < count; ++i) steps.push_back(Length(points[(i + 1) % n] - points[i]));
    std::vector<Vector> bends(n);
    // Gauss-Seidel: each sweep halves the error at least.
    for (int sweep = 0; sweep < kMostIterations; ++sweep)
      for (std::size_t i = closed_ ? 0 : 1; i < (closed_ ? n : n - 1); ++i) {
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const Real h = steps[before % count], k = steps[i];
        const Vector right = 6.0L * (1.0L / k * (points[after] - points[i]) - 1.0L / h * (points[i] - points[before]));
        bends[i] = 0.5L / (h + k) * (right - h * bends[before] - k * bends[after]);
      }
    for (std::size_t i = 0; i < count; ++i) {
      Piece piece{points[i], points[(i + 1) % n], bends[i], bends[(i + 1) % n], steps[i], {}};
      piece.walked.push_back(length_);
      for (int part = 0; part < kParts; ++part)
        piece.walked.push_back(piece.walked.back() +
                               Walked(piece, static_cast<Real>(part) / kParts, static_cast<Real>(part + 1) / kParts));
      length_ = piece.walked.back();
      pieces_.push_back(std::move(piece));
    }
    MakeSearch(pieces_, [](const Piece& piece) { return piece.walked.back() - piece.walked.front(); });
    if (!closed_) FindBeyond();
  }

 private:
  static constexpr int kParts = 32;
  static constexpr int kSamples = 12;
  static constexpr Real kRounding = 1e-18L;  // of w

  struct Piece {
    Vector from, to, bend_from, bend_to;
    Real step;
    std::vector<Real> walked;  // up to the parts of equal parameter
  };

  // At the share w of the parameter of the piece, its derivatives by w.
  static Vector At(const Piece& piece, Real w) {
    const Real v = 1.0L - w, h = piece.step * piece.step / 6.0L;
    return v * piece.from + w * piece.to + h * (v * v * v - v) * piece.bend_from + h * (w * w * w - w) * piece.bend_to;
  }
  static Vector First(const Piece& piece, Real w) {
    const Real v = 1.0L - w, h = piece.step * piece.step / 6.0L;
    return piece.to - piece.from - h * (3.0L * v * v - 1.0L) * piece.bend_from +
           h * (3.0L * w * w - 1.0L) * piece.bend_to;
  }
  static Vector Second(const Piece& piece, Real w) {
    const Real h = piece.step * piece.step;
    return h * (1.0L - w) * piece.bend_from + h * w * piece.bend_to;
  }
  // Gauss's rule of three points.
  static Real Walked(const Piece& piece, Real from, Real to) {
    const Real middle = 0.5L * (from + to), half = 0.5L * (to - from), offset = half * std::sqrt(0.6L);
    return half *
           (5.0L * Length(First(piece, middle - offset)) + 8.0L * Length(First(piece, middle)) +
            5.0L * Length(First(piece, middle + offset))) /
           9.0L;
  }

  static Real FootOn(const Piece& piece, const Vector& x) {
    Real w = 0.0L, nearest = std::numeric_limits<Real>::infinity();
    for (int i = 0; i <= kSamples; ++i) {
      const Real sample = static_cast<Real>(i) / kSamples, distance = Length(At(piece, sample) - x);
      if (distance < nearest) {
        nearest = distance;
        w = sample;
      }
    }
    for (int i = 0; i < kMostIterations; ++i) {
      const Vector first = First(piece, w), away = At(piece, w) - x;
      const Real square = Dot(first, first), slope = square + Dot(away, Second(piece, w));
      const Real move = -Dot(away, first) / (slope > 0.0L ? slope : square);
      w = std::clamp(w + move, -0.25L, 1.25L);
      if (std::abs(move) <= kRounding) break;
    }
    return w;
  }

  // As of an open polyline. The derivative, a parabola, and the cubic lie within the hulls of their Bezier points.
  void FindBeyond() {
    const Vector along = pieces_.back().to - pieces_.front().from;
    std::vector<Vector> hull;
    for (const Piece& piece : pieces_) {
      const Vector begin = First(piece, 0.0L), end = First(piece, 1.0L);
      const Vector middle = 2.0L * First(piece, 0.5L) - 0.5L * (begin + end);
      for (const Vector& first : {begin, middle, end})
        if (!(Dot(first, along) > 0.0L)) return;
      for (const Vector& point : {piece.from, piece.from + 1.0L / 3.0L * begin, piece.to - 1.0L / 3.0L * end, piece.to})
        hull.push_back(point);
    }
    AddBeyond(Left(along), hull);
  }

  Foot Nearest(const Vector& x) const override {
    return NearestOf(x, [&](std::size_t i) {
      const Piece& piece = pieces_[i];
      const Real on = FootOn(piece, x), w = std::clamp(on, 0.0L, 1.0L);
      const Vector place = At(piece, w), first = First(piece, w);
      const auto part = static_cast<std::size_t>(std::min<Real>(w * kParts, kParts - 1));
      const bool is_end = !closed_ && ((i == 0 && on < 0.0L) || (i + 1 == pieces_.size() && on > 1.0L));
      return Foot{place, 1.0L / Length(first) * Left(first),
                  piece.walked[part] + Walked(piece, static_cast<Real>(part) / kParts, w), Length(x - place), is_end};
    });
  }

  std::vector<Piece> pieces_;
};

}  // namespace

std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle, bool for_circles) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane: break;
    case ObstacleShape::kCircle: return std::make_unique<Circle>(obstacle);
    case ObstacleShape::kPolyline: return std::make_unique<Polyline>(obstacle, for_circles);
    case ObstacleShape::kSpline: return std::make_unique<Spline>(obstacle, for_circles);
  }
  return std::make_unique<HalfPlane>(obstacle);
}

}  // namespace contact_path::check
