// The boundary of a deformable part, which the nodes of the structure carry along.
#ifndef CONTACT_PATH_CONTACT_DEFORMABLE_BOUNDARY_H_
#define CONTACT_PATH_CONTACT_DEFORMABLE_BOUNDARY_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "contact_path/geometry/nodal_spline.h"
#include "contact_path/geometry/surface.h"
#include "contact_path/structure/place.h"

namespace contact_path {

// Where a node is: its dofs in u, of x and y, or where a component is held its place [length]. Or where its mirror
// image is.
struct NodePlace {
  std::array<int, 2> dofs = {-1, -1};  // -1 = held
  Eigen::Vector2d held = Eigen::Vector2d::Zero();
  std::array<double, 2> sign = {1.0, 1.0};               // of the dof in the place: -1 across the axis of a mirror
  Eigen::Vector2d twice_axis = Eigen::Vector2d::Zero();  // twice the place of that axis [length]

  Eigen::Vector2d At(const Eigen::VectorXd& u) const { return {Component(u, 0), Component(u, 1)}; }
  // The image of the node, with the axis at this x (across = 0) or at this y (across = 1).
  NodePlace Mirrored(int across, double axis) const {
    NodePlace image = *this;
    image.sign[static_cast<std::size_t>(across)] = -1.0;
    image.twice_axis[across] = 2.0 * axis;
    return image;
  }

 private:
  double Component(const Eigen::VectorXd& u, int axis) const {
    const auto k = static_cast<std::size_t>(axis);
    return twice_axis[axis] + sign[k] * (dofs[k] >= 0 ? u[dofs[k]] : held[axis]);
  }
};

// The quadratic B-spline of the nodes where they are, and beside it, on its left at the distance `radius`, the surface.
// The coordinate xi stays with the material: knots times the mean length of an edge at the start.
class DeformableBoundary {
 public:
  // nodes: in order, the material on the right; at least 2, closed 3. start: places of the nodes at the start, of which
  // neighbours are apart. radius >= 0 [length].
  DeformableBoundary(std::vector<NodePlace> nodes, const std::vector<Eigen::Vector2d>& start, bool closed,
                     double radius);

  // elements: of the solid that the curve bounds, the nodes round each.
  void SetSolid(std::vector<std::vector<MovingPlace>> elements) { elements_ = std::move(elements); }
  // across: of each end of an open curve the axis of symmetry that it lies on, 0 across x and 1 across y; -1: none.
  void SetMirroredEnds(const std::array<int, 2>& across);

  const NodalSpline& Spline() const { return spline_; }
  // Those of the curve, and after them the images of its second and of its last but one node.
  const std::vector<NodePlace>& Nodes() const { return nodes_; }
  double Radius() const { return radius_; }
  double LengthPerKnot() const { return length_per_knot_; }  // d xi / d knot
  // Where the control nodes of a patch are.
  std::array<Eigen::Vector2d, 3> Places(const SplinePatch& patch, const Eigen::VectorXd& u) const;
  // Whether x is inside the solid.
  bool InSolid(const Eigen::Vector2d& x, const Eigen::VectorXd& u) const;

 private:
  std::vector<NodePlace> nodes_;
  NodalSpline spline_;
  double radius_;
  double length_per_knot_;
  std::vector<std::vector<MovingPlace>> elements_;
};

// A boundary at u, as a surface: its gaps are less by the radius than distances from the spline. The boundary and u
// must outlive it. Of the curvature, the derivatives are left out.
class BoundaryAt : public Surface {
 public:
  // patches: of the spline of the boundary.
  BoundaryAt(const DeformableBoundary& boundary, const Eigen::VectorXd& u, const AdmissiblePatches& patches)
      : boundary_(boundary), u_(u), patches_(patches) {}

  bool Closed() const override { return boundary_.Spline().Closed(); }
  int NumPatches() const override { return boundary_.Spline().NumPatches(); }
  bool HasPatch(int patch) const override { return patches_.Has(patch); }
  XiRange RangeOf(int patch) const override;
  // The distance from the spline.
  NearestFoot Nearest(const Eigen::Vector2d& x) const override;
  Projection Project(const Eigen::Vector2d& x, int patch) const override;
  Eigen::Vector2d PointAt(double xi) const override;

 private:
  struct Foot;
  Parabola ParabolaOf(const SplinePatch& patch) const { return {patch, boundary_.Places(patch, u_)}; }
  // Whether x, which has its foot on the patch, is deep behind the curve and not in its part.
  bool IsAway(const Eigen::Vector2d& x, int patch) const;

  const DeformableBoundary& boundary_;
  const Eigen::VectorXd& u_;
  AdmissiblePatches patches_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_DEFORMABLE_BOUNDARY_H_
