// The quadratic B-spline of a sequence of nodes: the smooth curve of a boundary that its nodes carry along.
#ifndef CONTACT_PATH_GEOMETRY_NODAL_SPLINE_H_
#define CONTACT_PATH_GEOMETRY_NODAL_SPLINE_H_

#include <Eigen/Core>
#include <array>

namespace contact_path {

// y(tau) = sum of N_k(tau) x_k over up to three control nodes, tau from `begin` to `end`; beyond, the patch is
// prolonged.
struct SplinePatch {
  std::array<int, 3> nodes = {-1, -1, -1};            // ascending along the curve; -1: none, and its N_k is 0
  Eigen::Matrix3d weights = Eigen::Matrix3d::Zero();  // N_k(tau) = row k . (1, tau, tau^2)
  double knot = 0.0;                                  // where tau is 0
  double begin = 0.0;
  double end = 0.0;  // 1, or 1/2 for half of an edge

  Eigen::Vector3d At(double tau) const { return weights * Eigen::Vector3d(1.0, tau, tau * tau); }
};

// Knots are uniform: 0 at the first node, 1 at the second one, and so on; dy/dknot is continuous. Patch i belongs to
// node i and is a parabola from the middle of the edge before to the middle of the edge after, tangent to both. Of an
// open curve the first and the last patch are halves of the edges there, which are straight.
class NodalSpline {
 public:
  // nodes: at least 2; closed: at least 3.
  NodalSpline(int nodes, bool closed) : nodes_(nodes), closed_(closed) {}

  int NumPatches() const { return nodes_; }
  bool Closed() const { return closed_; }
  // Of a closed curve any number is a patch, in its round (geometry/surface.h); of an open one, the first or the last
  // patch stands for numbers beyond.
  SplinePatch Patch(int patch) const;
  // The patch within a round, and where it is on the open curve.
  int Within(int patch) const;

 private:
  int nodes_;
  bool closed_;
};

// A patch with its control nodes in place: y = a + b tau + c tau^2.
struct Parabola {
  Eigen::Vector2d a, b, c;

  // places: x_k; anything finite for a node that does not exist.
  Parabola(const SplinePatch& patch, const std::array<Eigen::Vector2d, 3>& places);

  Eigen::Vector2d At(double tau) const { return a + tau * (b + tau * c); }
  // tau of a local minimum of the distance from x. Of two minima, the minimum nearer to begin <= tau <= end; if both
  // are equally near, the minimum nearer to x. Either begin or end may be infinite.
  double FootOf(const Eigen::Vector2d& x, double begin, double end) const;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_NODAL_SPLINE_H_
