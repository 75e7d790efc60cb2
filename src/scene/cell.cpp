#include "contact_path/scene/cell.h"

#include <cmath>
#include <map>
#include <utility>

namespace contact_path {
namespace {

// Corners of the square, counterclockwise.
constexpr double kCorners[4][2] = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};

constexpr CellGradients kLinearTriangle = {{{-1.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}};

// N = L (2 L - 1) at a corner with the area coordinate L, 4 L M between two corners.
CellPoint QuadraticTriangle(double xi, double eta) {
  const std::array<double, 3> area = {1.0 - xi - eta, xi, eta};
  CellPoint point;
  auto& [weight, values, gradients] = point;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    values[i] = area[i] * (2.0 * area[i] - 1.0);
    values[3 + i] = 4.0 * area[i] * area[next];
    for (std::size_t k = 0; k < 2; ++k) {
      gradients[i][k] = (4.0 * area[i] - 1.0) * kLinearTriangle[i][k];
      gradients[3 + i][k] = 4.0 * (area[next] * kLinearTriangle[i][k] + area[i] * kLinearTriangle[next][k]);
    }
  }
  return point;
}

// N = (1 + a xi) (1 + b eta) / 4 at the corner (a, b).
CellPoint BilinearSquare(double xi, double eta) {
  CellPoint point;
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = kCorners[i][0], b = kCorners[i][1];
    point.values[i] = 0.25 * (1.0 + a * xi) * (1.0 + b * eta);
    point.gradients[i] = {0.25 * a * (1.0 + b * eta), 0.25 * b * (1.0 + a * xi)};
  }
  return point;
}

// N = (1 + a xi) (1 + b eta) (a xi + b eta - 1) / 4 at the corner (a, b), (1 - xi^2) (1 + b eta) / 2 and
// (1 + a xi) (1 - eta^2) / 2 between two corners.
CellPoint SerendipitySquare(double xi, double eta) {
  CellPoint point;
  auto& [weight, values, gradients] = point;
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = kCorners[i][0], b = kCorners[i][1];
    values[i] = 0.25 * (1.0 + a * xi) * (1.0 + b * eta) * (a * xi + b * eta - 1.0);
    gradients[i] = {0.25 * a * (1.0 + b * eta) * (2.0 * a * xi + b * eta),
                    0.25 * b * (1.0 + a * xi) * (a * xi + 2.0 * b * eta)};
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double sign = i == 0 ? -1.0 : 1.0;
    values[4 + 2 * i] = 0.5 * (1.0 - xi * xi) * (1.0 + sign * eta);
    values[7 - 2 * i] = 0.5 * (1.0 + sign * xi) * (1.0 - eta * eta);
  }
  gradients[4] = {-xi * (1.0 - eta), -0.5 * (1.0 - xi * xi)};
  gradients[5] = {0.5 * (1.0 - eta * eta), -eta * (1.0 + xi)};
  gradients[6] = {-xi * (1.0 + eta), 0.5 * (1.0 - xi * xi)};
  gradients[7] = {-0.5 * (1.0 - eta * eta), -eta * (1.0 - xi)};
  return point;
}

CellPoint Weighted(double weight, CellPoint point) {
  point.weight = weight;
  return point;
}

std::vector<CellPoint> TrianglePoints() {
  std::vector<CellPoint> points;
  for (const auto& [xi, eta] :
       {std::pair(1.0 / 6.0, 1.0 / 6.0), std::pair(2.0 / 3.0, 1.0 / 6.0), std::pair(1.0 / 6.0, 2.0 / 3.0)})
    points.push_back(Weighted(1.0 / 6.0, QuadraticTriangle(xi, eta)));
  return points;
}

std::vector<CellPoint> SquarePoints(CellPoint (*point_at)(double, double)) {
  const double at = 1.0 / std::sqrt(3.0);
  std::vector<CellPoint> points;
  for (const auto& [a, b] : kCorners) points.push_back(Weighted(1.0, point_at(at * a, at * b)));
  return points;
}

struct Cell {
  std::vector<CellPoint> points;
  std::vector<std::size_t> boundary;
};

// By number of nodes.
const std::map<std::size_t, Cell>& Cells() {
  static const std::map<std::size_t, Cell> cells = {
      {3, {{{0.5, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, kLinearTriangle}}, {0, 1, 2}}},
      {4, {SquarePoints(BilinearSquare), {0, 1, 2, 3}}},
      {6, {TrianglePoints(), {0, 3, 1, 4, 2, 5}}},
      {8, {SquarePoints(SerendipitySquare), {0, 4, 1, 5, 2, 6, 3, 7}}}};
  return cells;
}

}  // namespace

bool IsCellShape(std::size_t nodes) { return Cells().count(nodes) > 0; }

const std::vector<CellPoint>& CellPoints(std::size_t nodes) { return Cells().at(nodes).points; }

const std::vector<std::size_t>& CellBoundary(std::size_t nodes) { return Cells().at(nodes).boundary; }

std::vector<PlacedPoint> PlacePoints(const std::vector<double>& positions) {
  const std::size_t nodes = positions.size() / 2;
  std::vector<PlacedPoint> placed;
  for (const CellPoint& point : CellPoints(nodes)) {
    // Derivatives of x and y by the coordinates of the cell.
    double by_xi[2] = {0.0, 0.0}, by_eta[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        // From the first node, so that the distance from the origin costs no digits.
        const double from_first = positions[2 * i + k] - positions[k];
        by_xi[k] += point.gradients[i][0] * from_first;
        by_eta[k] += point.gradients[i][1] * from_first;
      }
    const double jacobian = by_xi[0] * by_eta[1] - by_xi[1] * by_eta[0];
    PlacedPoint at;
    at.area = point.weight * jacobian;
    at.values = point.values;
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto& [of_xi, of_eta] = point.gradients[i];
      at.gradients[i] = {(by_eta[1] * of_xi - by_xi[1] * of_eta) / jacobian,
                         (by_xi[0] * of_eta - by_eta[0] * of_xi) / jacobian};
    }
    placed.push_back(at);
  }
  return placed;
}

std::array<double, 3> ShapeLengths(const std::array<double, 2>& first, const std::array<double, 2>& middle,
                                   const std::array<double, 2>& last) {
  std::array<double, 3> lengths = {};
  for (const auto& [xi, weight] :
       {std::pair(-std::sqrt(0.6), 5.0 / 9.0), std::pair(0.0, 8.0 / 9.0), std::pair(std::sqrt(0.6), 5.0 / 9.0)}) {
    const double slope_a = xi - 0.5, slope_m = -2.0 * xi, slope_b = xi + 0.5;
    const double speed = std::hypot(slope_a * first[0] + slope_m * middle[0] + slope_b * last[0],
                                    slope_a * first[1] + slope_m * middle[1] + slope_b * last[1]);
    lengths[0] += weight * speed * 0.5 * xi * (xi - 1.0);
    lengths[1] += weight * speed * (1.0 - xi * xi);
    lengths[2] += weight * speed * 0.5 * xi * (xi + 1.0);
  }
  return lengths;
}

}  // namespace contact_path
