// Smooth curves through points.
#ifndef CONTACT_PATH_GEOMETRY_SPLINE_H_
#define CONTACT_PATH_GEOMETRY_SPLINE_H_

#include <memory>

#include "contact_path/geometry/curve.h"
#include "contact_path/geometry/polyline.h"

namespace contact_path {

// The cubic spline through the points, whose parameter grows by the distance from point to point. Its second derivative
// by the parameter is continuous, and so is the curvature; it is zero at the ends of an open curve ("natural"). Each
// piece from point to point is a patch. At least two points, closed three, no neighbours equal.
std::unique_ptr<const Curve> MakeSpline(const PlanePoints& points, bool closed);

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_SPLINE_H_
