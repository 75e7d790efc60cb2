#include "contact_path/geometry/point_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contact_path/geometry/plane.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

double LengthOf(const Vector2d& v) { return std::hypot(v.x(), v.y()); }

// The edges of a polyline with their corners.
struct Edges {
  Edges(const PlanePoints& points, bool closed) {
    const std::size_t n = points.size(), count = closed ? n : n - 1;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d edge = points[(i + 1) % n] - points[i];
      lengths.push_back(LengthOf(edge));
      directions.push_back(edge / lengths.back());
    }
    turns.assign(count, 0.0);
    for (std::size_t i = closed ? 0 : 1; i < count; ++i) {
      const Vector2d &from = directions[(i + count - 1) % count], &to = directions[i];
      turns[i] = std::atan2(Cross(from, to), from.dot(to));
    }
  }

  // Of a fillet with the radius 1 at the corner where edge i begins: what it takes from both edges.
  double Share(std::size_t i) const {
    return i >= turns.size() || std::abs(turns[i]) <= tolerances::kRounding ? 0.0 : std::tan(0.5 * std::abs(turns[i]));
  }
  // The corner where edge i ends; past the last one there is none.
  std::size_t EndCorner(std::size_t i, bool closed) const { return closed ? (i + 1) % turns.size() : i + 1; }

  std::vector<double> lengths;
  std::vector<Vector2d> directions;
  std::vector<double> turns;  // at the begin of the edge, to the left > 0 [rad]
};

// Whether two segments have a point in common.
bool Meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double c_side = Cross(b - a, c - a), d_side = Cross(b - a, d - a);
  const double a_side = Cross(d - c, a - c), b_side = Cross(d - c, b - c);
  if (c_side == 0.0 && d_side == 0.0) return true;  // in line, and their boxes meet
  return c_side * d_side <= 0.0 && a_side * b_side <= 0.0;
}

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2>;

// Solves the symmetric tridiagonal equations with these diagonals for each column of `right`, without pivoting: the
// diagonal is dominant.
Columns SolveTridiagonal(std::vector<double> diagonal, const std::vector<double>& beside, Columns right) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  const auto at = [](Eigen::Index i) { return static_cast<std::size_t>(i); };
  for (Eigen::Index i = 1; i < n; ++i) {
    const double factor = beside[at(i - 1)] / diagonal[at(i - 1)];
    diagonal[at(i)] -= factor * beside[at(i - 1)];
    right.row(i) -= factor * right.row(i - 1);
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    if (i + 1 < n) right.row(i) -= beside[at(i)] * right.row(i + 1);
    right.row(i) /= diagonal[at(i)];
  }
  return right;
}

// The same with `corner` in the last place of the first row and the first place of the last one, by the formula of
// Sherman and Morrison.
Columns SolveCyclic(std::vector<double> diagonal, const std::vector<double>& beside, double corner,
                    const Columns& right) {
  const Eigen::Index last = right.rows() - 1;
  const double shift = -diagonal.front();
  diagonal.front() -= shift;
  diagonal.back() -= corner * corner / shift;
  Columns bordered = Columns::Zero(right.rows(), 2);
  bordered(0, 0) = shift;
  bordered(last, 0) += corner;
  const Columns solved = SolveTridiagonal(diagonal, beside, right);
  const Eigen::VectorXd change = SolveTridiagonal(std::move(diagonal), beside, bordered).col(0);
  const double ratio = corner / shift;
  const Eigen::RowVector2d share =
      (solved.row(0) + ratio * solved.row(last)) / (1.0 + change[0] + ratio * change[last]);
  return solved - change * share;
}

// The pieces of a spline, at a distance.
std::vector<CubicPiece> SplinePieces(const PlanePoints& points, bool closed, double distance) {
  const std::size_t n = points.size(), count = closed ? n : n - 1;
  // Lengths of the intervals of the parameter, and mean derivatives on them.
  const Edges edges(points, closed);
  const std::vector<double>& lengths = edges.lengths;
  const std::vector<Vector2d>& slopes = edges.directions;
  // Second derivatives at the points, from continuous first ones.
  Columns bends = Columns::Zero(static_cast<Eigen::Index>(n), 2);
  const std::size_t first = closed ? 0 : 1, equations = closed ? n : n - 2;
  if (equations > 0) {
    std::vector<double> diagonal, beside;
    Columns right(static_cast<Eigen::Index>(equations), 2);
    for (std::size_t k = 0; k < equations; ++k) {
      const std::size_t after = first + k, before = (after + count - 1) % count;
      diagonal.push_back(2.0 * (lengths[before] + lengths[after]));
      if (k + 1 < equations) beside.push_back(lengths[after]);
      right.row(static_cast<Eigen::Index>(k)) = 6.0 * (slopes[after] - slopes[before]).transpose();
    }
    bends.middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(equations)) =
        closed ? SolveCyclic(std::move(diagonal), beside, lengths.back(), right)
               : SolveTridiagonal(std::move(diagonal), beside, std::move(right));
  }
  std::vector<CubicPiece> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d from = bends.row(static_cast<Eigen::Index>(i)),
                   to = bends.row(static_cast<Eigen::Index>((i + 1) % n));
    const double h = lengths[i];
    pieces.emplace_back(points[i], h * slopes[i] - h * h / 6.0 * (2.0 * from + to), 0.5 * h * h * from,
                        h * h / 6.0 * (to - from), distance);
  }
  return pieces;
}

// A curve of pieces at a distance from another one. Of an open one, half a circle about either end of that curve is
// part of what is at the distance.
std::unique_ptr<const Curve> Joined(std::vector<std::unique_ptr<const CurvePiece>> pieces, bool closed,
                                    double distance) {
  if (closed || distance == 0.0) return std::make_unique<Curve>(std::move(pieces), closed);
  const auto round_end = [&](const CurvePiece& piece, double xi, double sense) {
    const Vector2d at = piece.PointAt(xi), normal = piece.Project(at).normal;
    return std::make_unique<ArcPiece>(at - distance * normal, distance, sense * TangentOf(normal), M_PI,
                                      ArcPiece::Side::kOutside);
  };
  auto begin = round_end(*pieces.front(), pieces.front()->Range().begin, -1.0);
  auto end = round_end(*pieces.back(), pieces.back()->Range().end, 1.0);
  pieces.insert(pieces.begin(), std::move(begin));
  pieces.push_back(std::move(end));
  return std::make_unique<Curve>(std::move(pieces), closed, -M_PI * distance);
}

}  // namespace

std::optional<std::size_t> FindEqualPoints(const PlanePoints& points, bool closed) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + 1 < n + (closed ? 1 : 0); ++i)
    if (points[i] == points[(i + 1) % n]) return i;
  return std::nullopt;
}

std::optional<std::pair<std::size_t, std::size_t>> FindCrossing(const PlanePoints& points) {
  const std::size_t n = points.size();
  const auto end = [&](std::size_t i) -> const Vector2d& { return points[(i + 1) % n]; };
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t i = 0; i < n; ++i) boxes.emplace_back(points[i].cwiseMin(end(i)), points[i].cwiseMax(end(i)));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return boxes[a].min().x() < boxes[b].min().x(); });
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    for (std::size_t l = k + 1; l < n && boxes[order[l]].min().x() <= boxes[i].max().x(); ++l) {
      const std::size_t j = order[l];
      if (boxes[j].min().y() > boxes[i].max().y() || boxes[j].max().y() < boxes[i].min().y()) continue;
      const bool before = (i + 1) % n == j, after = (j + 1) % n == i;
      // Neighbours meet at their corner. They meet elsewhere only where the second leads straight back.
      const bool meet = before || after ? Cross(end(i) - points[i], end(j) - points[j]) == 0.0 &&
                                              (end(i) - points[i]).dot(end(j) - points[j]) < 0.0
                                        : Meet(points[i], end(i), points[j], end(j));
      if (meet) return std::minmax(i, j);
    }
  }
  return std::nullopt;
}

double LargestFillet(const PlanePoints& points, bool closed) {
  const Edges edges(points, closed);
  double largest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < edges.lengths.size(); ++i) {
    const double share = edges.Share(i) + edges.Share(edges.EndCorner(i, closed));
    if (share > 0.0) largest = std::min(largest, edges.lengths[i] / share);
  }
  // The tangent of a quarter of a turn is large, and not infinite.
  for (std::size_t i = 0; i < edges.turns.size(); ++i)
    if (edges.Share(i) > 1.0 / tolerances::kRounding) return 0.0;
  return largest;
}

std::optional<std::size_t> TooShort(const PlanePoints& points, bool closed, const std::vector<double>& fillets,
                                    double rounding) {
  const Edges edges(points, closed);
  for (std::size_t i = 0; i < edges.lengths.size(); ++i) {
    const std::size_t corner = edges.EndCorner(i, closed);
    const double cut = fillets[i] * edges.Share(i) + fillets[corner] * edges.Share(corner);
    if (cut > (1.0 + rounding) * edges.lengths[i]) return i;
  }
  return std::nullopt;
}

std::unique_ptr<const Curve> MakePolyline(const PlanePoints& points, bool closed, const std::vector<double>& fillets,
                                          double distance) {
  const Edges edges(points, closed);
  std::vector<std::unique_ptr<const CurvePiece>> pieces;
  const std::size_t count = edges.lengths.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d& direction = edges.directions[i];
    const std::size_t corner = edges.EndCorner(i, closed);
    const double fillet = fillets[corner], from = fillets[i] * edges.Share(i), cut = fillet * edges.Share(corner);
    const double length = edges.lengths[i] - from - cut;
    if (length > tolerances::kRounding * edges.lengths[i])
      pieces.push_back(
          std::make_unique<LinePiece>(points[i] + from * direction + distance * LeftOf(direction), direction, length));
    if (cut == 0.0) continue;
    const double turn = edges.turns[corner], sign = turn > 0.0 ? 1.0 : -1.0;
    const Vector2d& next = edges.directions[corner];
    const Vector2d left = LeftOf(direction);
    // From the centre to the corner: the more exact of two ways to say it.
    const Vector2d bisector = direction.dot(next) > 0.0 ? Vector2d(-sign * (left + LeftOf(next))) : direction - next;
    const Vector2d middle = bisector / LengthOf(bisector);
    const Vector2d centre = points[corner % points.size()] - cut * direction + sign * fillet * left;
    const auto side = turn > 0.0 ? ArcPiece::Side::kInside : ArcPiece::Side::kOutside;
    pieces.push_back(std::make_unique<ArcPiece>(centre, fillet - sign * distance, middle, std::abs(turn), side));
  }
  return Joined(std::move(pieces), closed, distance);
}

std::optional<Hollow> HollowOfPolyline(const PlanePoints& points, bool closed, const std::vector<double>& fillets) {
  const Edges edges(points, closed);
  std::optional<Hollow> sharpest;
  for (std::size_t i = 0; i < edges.turns.size(); ++i)
    if (edges.Share(i) > 0.0 && edges.turns[i] > 0.0 && (!sharpest || fillets[i] < sharpest->radius))
      sharpest = {i, fillets[i]};
  return sharpest;
}

std::unique_ptr<const Curve> MakeSpline(const PlanePoints& points, bool closed, double distance) {
  std::vector<std::unique_ptr<const CurvePiece>> pieces;
  for (CubicPiece& piece : SplinePieces(points, closed, distance))
    pieces.push_back(std::make_unique<CubicPiece>(std::move(piece)));
  return Joined(std::move(pieces), closed, distance);
}

std::optional<Hollow> HollowOfSpline(const PlanePoints& points, bool closed) {
  double largest = 0.0;
  std::size_t at = 0;
  const std::vector<CubicPiece> pieces = SplinePieces(points, closed, 0.0);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (const double curvature = pieces[i].LargestCurvature(); curvature > largest) {
      largest = curvature;
      at = i;
    }
  if (largest == 0.0) return std::nullopt;
  return Hollow{at, 1.0 / largest};
}

}  // namespace contact_path
