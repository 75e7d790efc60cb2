#include "contact_path/scene/cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace contact_path::cell_test {
namespace {

// Corners, then mid-sides, of a cell with the side 2.
std::vector<double> Nodes(std::size_t nodes) {
  std::vector<double> corners = {-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0};
  if (nodes % 3 == 0) corners = {0.0, 0.0, 2.0, 0.0, 0.0, 2.0};
  std::vector<double> positions = corners;
  const std::size_t count = corners.size() / 2;
  for (std::size_t i = 0; i < count && nodes > 4; ++i) {
    const std::size_t next = (i + 1) % count;
    positions.push_back(0.5 * (corners[2 * i] + corners[2 * next]));
    positions.push_back(0.5 * (corners[2 * i + 1] + corners[2 * next + 1]));
  }
  return positions;
}

class Cells : public testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(Shapes, Cells, testing::Values(3, 4, 6, 8));

// Gradients of the functions 1, x, y and, of shapes with mid-sides, x^2, x y and y^2.
TEST_P(Cells, GradientsAreThoseOfThePolynomials) {
  const std::vector<double> at = Nodes(GetParam());
  const std::vector<PlacedPoint> points = PlacePoints(at);
  double area = 0.0, moment = 0.0;
  for (const PlacedPoint& point : points) {
    area += point.area;
    double one[2] = {}, x[2] = {}, y[2] = {}, xx[2] = {}, xy[2] = {}, yy[2] = {};
    for (std::size_t i = 0; i < GetParam(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const double gradient = point.gradients[i][k], px = at[2 * i], py = at[2 * i + 1];
        one[k] += gradient;
        x[k] += gradient * px;
        y[k] += gradient * py;
        xx[k] += gradient * px * px;
        xy[k] += gradient * px * py;
        yy[k] += gradient * py * py;
      }
    EXPECT_NEAR(one[0], 0.0, 1e-15);
    EXPECT_NEAR(one[1], 0.0, 1e-15);
    EXPECT_NEAR(x[0], 1.0, 1e-15);
    EXPECT_NEAR(x[1], 0.0, 1e-15);
    EXPECT_NEAR(y[0], 0.0, 1e-15);
    EXPECT_NEAR(y[1], 1.0, 1e-15);
    if (GetParam() <= 4) continue;
    // d(x^2)/dx = 2x and d(x y)/dy = x, at the same point.
    EXPECT_NEAR(xx[0], 2.0 * xy[1], 1e-15);
    EXPECT_NEAR(yy[1], 2.0 * xy[0], 1e-15);
    EXPECT_NEAR(xx[1], 0.0, 1e-15);
    EXPECT_NEAR(yy[0], 0.0, 1e-15);
    moment += point.area * xy[1] * xy[1];
  }
  const bool triangle = GetParam() % 3 == 0;
  EXPECT_NEAR(area, triangle ? 2.0 : 4.0, 1e-15);
  // Integral of x^2.
  EXPECT_NEAR(moment, GetParam() > 4 ? 4.0 / 3.0 : 0.0, 1e-14);
}

TEST_P(Cells, JacobianOfAnElementTheOtherWayRoundIsNegative) {
  std::vector<double> at = Nodes(GetParam());
  for (std::size_t i = 0; i < at.size(); i += 2) at[i] = -at[i];
  for (const PlacedPoint& point : PlacePoints(at)) EXPECT_LT(point.area, 0.0);
}

TEST_P(Cells, BoundaryGoesRoundAllNodes) {
  std::vector<std::size_t> boundary = CellBoundary(GetParam());
  const std::vector<double> at = Nodes(GetParam());
  double area = 0.0;
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const std::size_t a = boundary[k], b = boundary[(k + 1) % boundary.size()];
    area += 0.5 * (at[2 * a] * at[2 * b + 1] - at[2 * b] * at[2 * a + 1]);
  }
  EXPECT_DOUBLE_EQ(area, GetParam() % 3 == 0 ? 2.0 : 4.0);
  std::sort(boundary.begin(), boundary.end());
  for (std::size_t k = 0; k < GetParam(); ++k) EXPECT_EQ(boundary[k], k);
}

TEST(CellShapes, AreFour) {
  for (std::size_t nodes = 0; nodes < 12; ++nodes)
    EXPECT_EQ(IsCellShape(nodes), nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8);
}

}  // namespace
}  // namespace contact_path::cell_test
