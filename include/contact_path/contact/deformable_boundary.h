// The boundary of a deformable part, which the nodes of the structure carry along.
#ifndef CONTACT_PATH_CONTACT_DEFORMABLE_BOUNDARY_H_
#define CONTACT_PATH_CONTACT_DEFORMABLE_BOUNDARY_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "contact_path/geometry/admissible_patches.h"
#include "contact_path/geometry/nodal_spline.h"
#include "contact_path/geometry/surface.h"

namespace contact_path {

// Where a node is: its dofs in u, of x and y, or where a component is held its place [length].
struct NodePlace {
  std::array<int, 2> dofs = {-1, -1};  // -1 = held
  Eigen::Vector2d held = Eigen::Vector2d::Zero();

  Eigen::Vector2d At(const Eigen::VectorXd& u) const {
    return {dofs[0] >= 0 ? u[dofs[0]] : held[0], dofs[1] >= 0 ? u[dofs[1]] : held[1]};
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

  const NodalSpline& Spline() const { return spline_; }
  const std::vector<NodePlace>& Nodes() const { return nodes_; }
  double Radius() const { return radius_; }
  double LengthPerKnot() const { return length_per_knot_; }  // d xi / d knot
  // Where the control nodes of a patch are.
  std::array<Eigen::Vector2d, 3> Places(const SplinePatch& patch, const Eigen::VectorXd& u) const;

 private:
  std::vector<NodePlace> nodes_;
  NodalSpline spline_;
  double radius_;
  double length_per_knot_;
};

// A boundary at u, as a surface: its gaps are less by the radius than distances from the spline. The boundary and u
// must outlive it. Of the curvature, the derivatives are left out.
class BoundaryAt : public Surface {
 public:
  // patches: of the spline of the boundary.
  BoundaryAt(const DeformableBoundary& boundary, const Eigen::VectorXd& u, const AdmissiblePatches& patches)
      : boundary_(boundary), u_(u), patches_(patches) {}

  bool Flat() const override { return false; }
  bool Closed() const override { return boundary_.Spline().Closed(); }
  int NumPatches() const override { return boundary_.Spline().NumPatches(); }
  bool HasPatch(int patch) const override { return patches_.Has(patch); }
  XiRange RangeOf(int patch) const override;
  // The distance from the spline.
  NearestFoot Nearest(const Eigen::Vector2d& x) const override;
  Projection Project(const Eigen::Vector2d& x, int patch) const override;
  Eigen::Vector2d PointAt(double xi) const override;

 private:
  Parabola ParabolaOf(const SplinePatch& patch) const { return {patch, boundary_.Places(patch, u_)}; }

  const DeformableBoundary& boundary_;
  const Eigen::VectorXd& u_;
  AdmissiblePatches patches_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_DEFORMABLE_BOUNDARY_H_
