// Boundaries that deform as the check sees them: written from the definition of the curve (scene/solid_parts.h), apart
// from contact/. Forces of contacts come from gap and foot by automatic differentiation.
#ifndef CONTACT_PATH_SRC_CHECK_BOUNDARY_H_
#define CONTACT_PATH_SRC_CHECK_BOUNDARY_H_

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "check/nearest_piece.h"
#include "check/plane.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// A part of the curve: y = sum of N_j(tau) x_j over its nodes, tau in [0, 1].
struct BoundaryPatch {
  template <typename T>
  using PerNode = std::array<T, 3>;
  // N_j = sum of weights[j][k] tau^k; zero for a node that has no share.
  using Weights = PerNode<std::array<Real, 3>>;

  PerNode<std::size_t> nodes{};  // of the scene
  Weights weights{};
  // At an axis of symmetry through nodes[1], x = const or y = const: nodes[image] stands for its mirror image. Nothing:
  // none does.
  std::optional<std::size_t> image = {};
  bool across_x = false;  // the axis is x = const
};

struct BoundaryFoot {
  std::size_t patch = 0;
  Real tau = 0.0L;
  Real distance = std::numeric_limits<Real>::infinity();  // of the point from the foot [length]
  bool is_end = false;    // the point is past an end of the boundary, or so deep behind it that it came round an end
  bool over_end = false;  // it is over an end to rounding, and need not be past it
};

// By patch, whether it is left out for a node of the surface itself: it is the patch of the node or one of the two on
// either side, or it begins within pi times the radius of the node, along the edges between the places. places: of the
// nodes of the surface at the start [length].
std::vector<bool> PatchesLeftOut(const BoundarySurface& surface, const std::vector<Vector>& places, std::size_t node);

// Across which axis of symmetry an end of a surface is held.
enum class Axis { kNone, kAcrossX, kAcrossY };
// An end of an open surface is on an axis where its node is held in one component, and moves along the axis without a
// turn; the next node is farther from the axis than along it.
Axis SymmetryOf(const Node& end, const Node& next, const Scene& scene);

// Which nodes the patches of a surface of a scene have.
class Boundary {
 public:
  // nodes: of the surface, by their places in the scene. axes: SymmetryOf() both ends. elements: of the solids that it
  // bounds, the nodes round each.
  Boundary(const BoundarySurface& surface, const std::vector<std::size_t>& nodes, const std::array<Axis, 2>& axes,
           std::vector<std::vector<std::size_t>> elements);

  const std::vector<BoundaryPatch>& Patches() const { return patches_; }
  bool Closed() const { return closed_; }
  Real Radius() const { return radius_; }
  const std::vector<std::vector<std::size_t>>& Elements() const { return elements_; }

 private:
  std::vector<BoundaryPatch> patches_;
  std::vector<std::vector<std::size_t>> elements_;
  bool closed_;
  Real radius_;
};

// A boundary where its nodes are. Both arguments must outlive it.
class BoundaryShape {
 public:
  // positions: x0, y0, x1, ... of all nodes of the scene [length].
  BoundaryShape(const Boundary& boundary, const std::vector<double>& positions);

  // The nearest point of the curve, which has ends where patches are left out. left_out: by patch; empty: none is.
  BoundaryFoot Nearest(const Vector& x, const std::vector<bool>& left_out) const;
  // Of length 1, on the left of the curve.
  Vector Normal(const BoundaryFoot& foot) const;
  // (x - y) . n - radius; past an end the distance from it [length].
  Real Gap(const Vector& x, const BoundaryFoot& foot) const;
  // Length of the curve at the distance of the radius from one foot to another, along t; the shorter way round a closed
  // curve [length].
  Real Walked(const BoundaryFoot& from, const BoundaryFoot& to) const;

  // The forces of r_n and r_t: on a node at x with its foot, and on the nodes of the patch [force].
  struct Forces {
    Vector on_node;
    BoundaryPatch::PerNode<Vector> on_patch;
  };
  Forces ForcesOf(const Vector& x, const BoundaryFoot& foot, Real rn, Real rt) const;
  // Where these forces act: an image has a place and a force of its own.
  Vector PlaceOf(const BoundaryPatch& patch, std::size_t node) const;
  // A force on an image, as the node has it.
  static Vector Reflected(const BoundaryPatch& patch, std::size_t node, const Vector& force);
  const BoundaryPatch& PatchOf(const BoundaryFoot& foot) const { return boundary_.Patches()[foot.patch]; }

 private:
  // y(tau) = at + tau first + tau^2 / 2 second.
  struct Parabola {
    Vector at, first, second;
  };

  static Vector Place(const Parabola& curve, Real tau);
  static Vector Direction(const Parabola& curve, Real tau);
  static BoundaryFoot FootOn(const Parabola& curve, const Vector& x);
  // Whether a point is deeper behind an open boundary than an edge is long there and than a beam of this radius is
  // thick, and in none of the elements. One with a corner at the point does not count.
  bool IsAway(const Vector& x, const BoundaryFoot& foot) const;
  // Of a part of a patch.
  Real Walked(std::size_t patch, Real from, Real to) const;

  const Boundary& boundary_;
  const std::vector<double>& positions_;
  std::vector<Parabola> curves_;  // by patch
  NearestPiece search_;
};

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_BOUNDARY_H_
