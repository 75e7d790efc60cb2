// The curve of a surface of the scene that contacts touch, with its nodes in place.
#ifndef CONTACT_PATH_SCENE_BOUNDARY_CURVE_H_
#define CONTACT_PATH_SCENE_BOUNDARY_CURVE_H_

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/geometry/nodal_spline.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/solid_parts.h"

namespace contact_path {

// The quadratic B-spline of the nodes (geometry/nodal_spline.h), and the curve at the distance `radius` on its left.
class BoundaryCurve {
 public:
  // given: places of the nodes of the surface, in their order [length]. across: as SymmetryAxes() tells.
  BoundaryCurve(const std::vector<Eigen::Vector2d>& given, bool closed, double radius,
                const std::array<int, 2>& across = {-1, -1});

  struct Foot {
    double gap = 0.0;  // from the curve at the distance; past an end the distance from that end [length]
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();  // of length 1, on the left
    bool is_end = false;                               // past an end of the curve
    double edge = 0.0;                                 // of the length of an edge at the foot [length]
  };
  // Where the whole curve is nearest to x.
  Foot Nearest(const Eigen::Vector2d& x) const { return Nearest(x, AdmissiblePatches(spline_)); }
  // Where the patches that x may touch are nearest to it; there must be some. patches: of as many nodes.
  Foot Nearest(const Eigen::Vector2d& x, const AdmissiblePatches& patches) const;

 private:
  struct Patch {
    Parabola curve;
    double end;  // of its parameter
  };

  NodalSpline spline_;
  std::vector<Patch> patches_;
  double radius_;
};

// The patches of a surface that a node may touch: all patches, or, for a node of the surface itself, the patches that
// are not near to the node. places: of the nodes of the surface at the start [length]. across: as SymmetryAxes()
// tells.
AdmissiblePatches PatchesFor(const std::string& node, const BoundarySurface& surface,
                             const std::vector<Eigen::Vector2d>& places, const std::array<int, 2>& across);

// Of the first and the last node of an open surface, the axis of symmetry that it lies on: 0, it is held across an axis
// x = const, 1, across an axis y = const; -1, it lies on none. It is held in this component alone, and the edge there
// leads from the axis rather than along it. A solid has it, or its rotation is held: an end that turns stands on a
// slide. node_of: the node of a name.
std::array<int, 2> SymmetryAxes(const BoundarySurface& surface, const Scene& scene,
                                const std::function<const Node&(const std::string&)>& node_of);

// By element of a solid, the names of the nodes round it, counterclockwise. They must outlive the result. Nothing where
// the elements have no shape that there is.
std::vector<std::vector<std::string_view>> NodesRoundElements(const Solid& solid);

// Those of the elements of the solids that have edges of the surface.
std::vector<std::vector<std::string_view>> ElementsBehind(const BoundarySurface& surface, const Scene& scene);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_BOUNDARY_CURVE_H_
