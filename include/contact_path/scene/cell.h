// Shapes of the plane elements of solids: their nodes, shape functions and integration points.
#ifndef CONTACT_PATH_SCENE_CELL_H_
#define CONTACT_PATH_SCENE_CELL_H_

#include <array>
#include <cstddef>
#include <vector>

namespace contact_path {

// Of each node's shape function, by two coordinates.
using CellGradients = std::array<std::array<double, 2>, 8>;
using CellValues = std::array<double, 8>;

// An integration point of the reference cell: the triangle (0, 0), (1, 0), (0, 1), or the square [-1, 1]^2.
struct CellPoint {
  double weight = 0.0;  // of the area of the reference cell
  CellValues values{};
  CellGradients gradients{};  // by the coordinates of the cell
};

// The shapes that there are: 3 (linear triangle, one point), 4 (bilinear, 2 x 2 points), 6 (quadratic triangle, three
// points), 8 (serendipity, 2 x 2 points, which keeps it from locking where the material is nearly incompressible).
bool IsCellShape(std::size_t nodes);

// nodes: a shape that there is.
const std::vector<CellPoint>& CellPoints(std::size_t nodes);

// The nodes in the order of a walk along the boundary, counterclockwise from the first corner.
const std::vector<std::size_t>& CellBoundary(std::size_t nodes);

// Lengths that stand for the integrals of the shape functions of an edge with a node in the middle: first, middle,
// last. Places x, y of these nodes [length].
std::array<double, 3> ShapeLengths(const std::array<double, 2>& first, const std::array<double, 2>& middle,
                                   const std::array<double, 2>& last);

// An integration point of an element whose nodes are at `positions`: x0, y0, x1, ... [length].
struct PlacedPoint {
  double area = 0.0;  // weight x Jacobian [length^2]; > 0 where the element is sound
  CellValues values{};
  CellGradients gradients{};  // by x and y [1/length]
};

// As many points as the shape has; gradients that are not finite where the Jacobian is zero.
std::vector<PlacedPoint> PlacePoints(const std::vector<double>& positions);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_CELL_H_
