// Which patches of a spline of nodes a point may touch, where the point may be one of these nodes.
#ifndef CONTACT_PATH_GEOMETRY_ADMISSIBLE_PATCHES_H_
#define CONTACT_PATH_GEOMETRY_ADMISSIBLE_PATCHES_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/geometry/nodal_spline.h"

namespace contact_path {

// All patches; or, for a node of the spline itself, all but those near to it along the curve. Then a closed curve is
// open there, and an open one has two parts, or one. Where patches are left out is an end of the curve.
class AdmissiblePatches {
 public:
  explicit AdmissiblePatches(const NodalSpline& spline) : spline_(spline) {}
  // Left out for nodes[node] are its patch, two patches on either side of it, so that no other patch nor the one beside
  // it has this node for a control node, and each patch that begins within pi times the radius, along the edges between
  // the nodes. A curve that bends no sharper than the radius returns to the distance `radius` of a point of itself
  // nowhere within this length.
  // nodes: places of the nodes at the start, neighbours are apart; at least 2, closed 3. radius >= 0 [length].
  AdmissiblePatches(const std::vector<Eigen::Vector2d>& nodes, bool closed, double radius, int node);

  // Whether the curve has the patch (geometry/surface.h), and the patch is not left out.
  bool Has(int patch) const;
  bool None() const { return left_out_ >= spline_.NumPatches(); }
  // The patch itself; of one that is left out beside one that is not, or of a number past an end: that one.
  int Beside(int patch) const;
  // Of a patch that is left out beside one that is not: how that one is prolonged, from its end or up to its begin.
  SplinePatch Patch(int patch) const;

 private:
  NodalSpline spline_;
  int first_ = 0;     // of those left out, up the curve; of a closed one, of any round
  int left_out_ = 0;  // how many
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_ADMISSIBLE_PATCHES_H_
