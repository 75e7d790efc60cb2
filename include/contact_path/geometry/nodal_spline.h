// The quadratic B-spline of a sequence of nodes, the smooth curve of a boundary that its nodes carry along; and which
// of its patches a point may touch, where the point may be one of these nodes.
#ifndef CONTACT_PATH_GEOMETRY_NODAL_SPLINE_H_
#define CONTACT_PATH_GEOMETRY_NODAL_SPLINE_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

namespace contact_path {

// y(tau) = sum of N_k(tau) x_k over up to three control nodes, tau from `begin` to `end`; beyond, the patch is
// prolonged.
struct SplinePatch {
  std::array<int, 3> nodes = {-1, -1, -1};            // in order along the curve; -1: none, and its N_k is 0
  Eigen::Matrix3d weights = Eigen::Matrix3d::Zero();  // N_k(tau) = row k . (1, tau, tau^2)
  double knot = 0.0;                                  // where tau is 0
  double begin = 0.0;
  double end = 0.0;  // 1, or 1/2 for half of an edge

  Eigen::Vector3d At(double tau) const { return weights * Eigen::Vector3d(1.0, tau, tau * tau); }
};

// Which ends of an open curve lie on an axis of symmetry, over which the curve goes on as its mirror image: the nodes
// `nodes` and `nodes + 1` of a spline are then the images of its second and of its last but one node.
struct MirroredEnds {
  bool first = false;
  bool last = false;
};

// Knots are uniform: 0 at the first node, 1 at the second one, and so on; dy/dknot is continuous. Patch i belongs to
// node i and is a parabola from the middle of the edge before to the middle of the edge after, tangent to both. Of an
// open curve the first and the last patch are halves of the edges there, which are straight; at a mirrored end, the
// half on this side of the patch that it would have inside a curve.
class NodalSpline {
 public:
  // nodes: at least 2; closed: at least 3. ends: of an open curve.
  NodalSpline(int nodes, bool closed, const MirroredEnds& ends = {}) : nodes_(nodes), closed_(closed), ends_(ends) {}

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
  MirroredEnds ends_;
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

// A point that is deeper behind an open curve has come round one of its ends, and the part of the curve is not there,
// unless it is a solid that reaches so far [length]. radius: of the beam whose axis the curve is. edge: |dy/dknot| at
// the foot, the length of an edge there.
inline double DepthBehind(double radius, double edge) { return std::max(2.0 * radius, edge); }

// The patches of a curve that a node may touch: all patches, or, for a node of the spline itself, all except the
// patches near to the node along the curve. Where patches are left out, the curve ends: a closed curve is open there,
// and an open curve has two parts, or one.
class AdmissiblePatches {
 public:
  explicit AdmissiblePatches(const NodalSpline& spline) : spline_(spline) {}
  // Left out for nodes[node] are its patch, two patches on either side, and each patch that begins within pi times the
  // radius, along the edges between the nodes. With two patches on either side, nodes[node] is a control node neither
  // of an admissible patch nor of the patch beside an admissible patch. A curve that bends no sharper than the radius
  // does not return to the distance `radius` of one of its points within this length. nodes: places of the nodes at the
  // start, neighbours are apart; at least 2, closed 3. radius >= 0 [length]. ends: of an open curve.
  AdmissiblePatches(const std::vector<Eigen::Vector2d>& nodes, bool closed, double radius, int node,
                    const MirroredEnds& ends = {});

  // Whether the curve has the patch (geometry/surface.h), and the patch is not left out.
  bool Has(int patch) const;
  bool None() const { return left_out_ >= spline_.NumPatches(); }
  // The patch itself if it is admissible, else the admissible patch beside it; `patch` where neither neighbour is
  // admissible. patch: may be one past an end of the curve.
  int Beside(int patch) const;
  // The patch; where it is not admissible, the prolongation of the patch Beside() it, from its end or up to its begin.
  SplinePatch Patch(int patch) const;

 private:
  NodalSpline spline_;
  int first_ = 0;     // first patch that is left out, up the curve; on a closed curve in any round
  int left_out_ = 0;  // number of patches that are left out
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_NODAL_SPLINE_H_
