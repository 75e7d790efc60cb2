#include "contact_path/geometry/spline.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace contact_path {
namespace {

using Eigen::Vector2d;
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

}  // namespace

std::unique_ptr<const Curve> MakeSpline(const PlanePoints& points, bool closed) {
  const std::size_t n = points.size(), count = closed ? n : n - 1;
  std::vector<double> lengths;   // of the intervals of the parameter
  std::vector<Vector2d> slopes;  // mean derivatives on them
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d edge = points[(i + 1) % n] - points[i];
    lengths.push_back(std::hypot(edge.x(), edge.y()));
    slopes.push_back(edge / lengths.back());
  }
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
  std::vector<std::unique_ptr<const CurvePiece>> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d from = bends.row(static_cast<Eigen::Index>(i)),
                   to = bends.row(static_cast<Eigen::Index>((i + 1) % n));
    const double h = lengths[i];
    pieces.push_back(std::make_unique<CubicPiece>(points[i], h * slopes[i] - h * h / 6.0 * (2.0 * from + to),
                                                  0.5 * h * h * from, h * h / 6.0 * (to - from)));
  }
  return std::make_unique<Curve>(std::move(pieces), closed);
}

}  // namespace contact_path
