// Curves through points: polylines with rounded corners, and smooth ones.
#ifndef CONTACT_PATH_GEOMETRY_POINT_CURVES_H_
#define CONTACT_PATH_GEOMETRY_POINT_CURVES_H_

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "contact_path/geometry/curve.h"

namespace contact_path {

using PlanePoints = std::vector<Eigen::Vector2d>;

// The first point that is the same as the next one; of closed polylines the first point follows the last one.
std::optional<std::size_t> FindEqualPoints(const PlanePoints& points, bool closed);

// Two edges of a closed polyline, by their first points, that meet other than at a corner which they share.
std::optional<std::pair<std::size_t, std::size_t>> FindCrossing(const PlanePoints& points);

// The largest radius of fillets, the same at each corner, that leaves no edge less than nothing; infinite where all
// edges are in line, 0 where an edge leads straight back. No two neighbouring points may be equal.
double LargestFillet(const PlanePoints& points, bool closed);

// Edges and fillets in turn, each a patch, from the first point to the last; closed, from the fillet of the first
// point, its end, round to the same place. At least two points, closed three, no neighbours equal; fillets: by point,
// > 0, for which no edge is TooShort(). distance: of the curve, on the left of this one, where the centres of circles
// of this radius are that touch it, an open one at its ends, too; less than the radius of each Hollow.
std::unique_ptr<const Curve> MakePolyline(const PlanePoints& points, bool closed, const std::vector<double>& fillets,
                                          double distance = 0.0);

// The first point whose edge to the next one has no room for the fillets at both of its ends, but for `rounding` of its
// length.
std::optional<std::size_t> TooShort(const PlanePoints& points, bool closed, const std::vector<double>& fillets,
                                    double rounding);

// The cubic spline through the points, whose parameter grows by the distance from point to point. Its second derivative
// by the parameter is continuous, and so is the curvature; it is zero at the ends of an open curve ("natural"). Each
// piece from point to point is a patch. At least two points, closed three, no neighbours equal. distance: as of a
// polyline.
std::unique_ptr<const Curve> MakeSpline(const PlanePoints& points, bool closed, double distance = 0.0);

// Where a curve turns to the left, its admissible side.
struct Hollow {
  std::size_t point = 0;  // of a polyline its corner, of a spline where the piece begins
  double radius = 0.0;    // of the curve there, the least [length]
};

// The sharpest one; nothing: there is none.
std::optional<Hollow> HollowOfPolyline(const PlanePoints& points, bool closed, const std::vector<double>& fillets);
std::optional<Hollow> HollowOfSpline(const PlanePoints& points, bool closed);

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_POINT_CURVES_H_
