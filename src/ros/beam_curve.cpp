#include "ros/beam_curve.h"

#include <algorithm>
#include <cmath>

namespace contact_path {
namespace {

using Eigen::Vector2d;

double Heading(const Vector2d& along) { return std::atan2(along.y(), along.x()); }

}  // namespace

std::vector<Vector2d> CurveOf(const DrawnSegment& segment, const SegmentEnds& ends, int steps) {
  const Vector2d chord = ends.places[1] - ends.places[0];
  const double heading = Heading(chord);
  const double turned = heading - Heading(segment.chord);
  std::array<double, 2> bends = {};
  for (std::size_t k = 0; k < 2; ++k) {
    if (!segment.hinged[k]) bends[k] = std::remainder(ends.rotations[k] - turned, 2.0 * M_PI);
  }
  for (std::size_t k = 0; k < 2; ++k)
    if (segment.hinged[k] && !segment.hinged[1 - k]) bends[k] = -0.5 * bends[1 - k];
  bends[0] -= 0.5 * segment.turn;
  bends[1] += 0.5 * segment.turn;
  // With tangents of this length a segment that is bent evenly is drawn as an arc of a circle, to 0.1 % at a right
  // angle.
  const double cosine = std::cos(0.25 * (bends[1] - bends[0]));
  const double speed = chord.norm() / std::max(cosine * cosine, 0.25);
  const auto tangent = [&](double bend) {
    return Vector2d(speed * std::cos(heading + bend), speed * std::sin(heading + bend));
  };
  const Vector2d begin = tangent(bends[0]), end = tangent(bends[1]);
  std::vector<Vector2d> points;
  points.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps, left = 1.0 - t;
    points.emplace_back((1.0 + 2.0 * t) * left * left * ends.places[0] + t * left * left * begin +
                        t * t * (3.0 - 2.0 * t) * ends.places[1] - t * t * left * end);
  }
  return points;
}

}  // namespace contact_path
