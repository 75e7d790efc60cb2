// Scenes on half planes made scenes on curves.
#ifndef CONTACT_PATH_TEST_SUPPORT_CURVED_OBSTACLES_H_
#define CONTACT_PATH_TEST_SUPPORT_CURVED_OBSTACLES_H_

#include <memory>
#include <vector>

#include "contact_path/geometry/point_curves.h"
#include "contact_path/scene/scene.h"
#include "support/random.h"

namespace contact_path {

// The obstacle "curve" through these points: x, y, x, y, ...
Obstacle CurveThrough(ObstacleShape shape, const std::vector<double>& points, bool closed = false);

// A half plane becomes a disc, the inside of a circle, a polyline with fillets or a wavy spline, which has the same
// tangent at the foot of the node. size: of the part [length].
void MakeCurve(const Node& node, double size, Random* random, Obstacle* obstacle);

// Each obstacle, a half plane with a single candidate, becomes a curve: the gap of the candidate stays what it was. The
// same request for the same seed on every system.
TraceRequest OnCurves(TraceRequest request, unsigned seed);

// A polyline with equal fillets.
inline std::unique_ptr<const Curve> RoundedPolyline(const PlanePoints& points, bool closed, double fillet) {
  return MakePolyline(points, closed, std::vector<double>(points.size(), fillet));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_CURVED_OBSTACLES_H_
