// Which patches of a spline of nodes a point may touch, where the point may be one of these nodes.
#ifndef CONTACT_PATH_GEOMETRY_ADMISSIBLE_PATCHES_H_
#define CONTACT_PATH_GEOMETRY_ADMISSIBLE_PATCHES_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/geometry/nodal_spline.h"

namespace contact_path {

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

#endif  // CONTACT_PATH_GEOMETRY_ADMISSIBLE_PATCHES_H_
