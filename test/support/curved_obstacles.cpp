#include "support/curved_obstacles.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/random.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

// In the frame of the foot: along the tangent, along the normal, in units of the size of the part.
struct FootFrame {
  Vector2d At(double along, double above) const { return foot + size * (along * tangent + above * normal); }

  Vector2d foot, tangent, normal;
  double size = 1.0;
};

void PutPoints(const std::vector<Vector2d>& points, Obstacle* obstacle) {
  obstacle->px = obstacle->py = 0.0;
  for (const Vector2d& point : points) obstacle->points.insert(obstacle->points.end(), {point.x(), point.y()});
}

void MakeCircle(const FootFrame& frame, double radius, bool inside, Obstacle* obstacle) {
  const Vector2d centre = frame.At(0.0, inside ? radius : -radius);
  obstacle->shape = ObstacleShape::kCircle;
  obstacle->px = centre.x();
  obstacle->py = centre.y();
  obstacle->radius = frame.size * radius;
  obstacle->inside = inside;
}

// The foot is on the second edge, the others lead away from it upwards or downwards.
void MakeBentLine(const FootFrame& frame, Random* random, Obstacle* obstacle) {
  const double left = random->Number(0.05, 0.4), right = random->Number(0.05, 0.4);
  const double before = random->Number(-0.8, 0.8), after = random->Number(-0.8, 0.8);
  obstacle->shape = ObstacleShape::kPolyline;
  PutPoints({frame.At(-left - 3.0 * std::cos(before), 3.0 * std::sin(before)), frame.At(-left, 0.0),
             frame.At(right, 0.0), frame.At(right + 3.0 * std::cos(after), 3.0 * std::sin(after))},
            obstacle);
  // Half of the second edge is left straight; the foot may be on it or on a fillet.
  const double largest =
      0.5 * (left + right) / std::max(std::tan(0.5 * std::abs(before)) + std::tan(0.5 * std::abs(after)), 0.1);
  obstacle->fillet = frame.size * std::min(random->Number(0.02, 0.3), 0.5 * largest);
}

// Through the foot, where a wave has its crest or its trough.
void MakeWave(const FootFrame& frame, Random* random, Obstacle* obstacle) {
  const double height = random->Number(-0.05, 0.05), number = random->Number(1.0, 4.0);
  std::vector<Vector2d> points;
  for (int i = -12; i <= 12; ++i) {
    const double along = 0.2 * i;
    points.push_back(frame.At(along, height * (1.0 - std::cos(number * along))));
  }
  obstacle->shape = ObstacleShape::kSpline;
  PutPoints(points, obstacle);
}

}  // namespace

Obstacle CurveThrough(ObstacleShape shape, const std::vector<double>& points, bool closed) {
  Obstacle obstacle;
  obstacle.name = "curve";
  obstacle.shape = shape;
  obstacle.points = points;
  obstacle.closed = closed;
  return obstacle;
}

void MakeCurve(const Node& node, double size, Random* random, Obstacle* obstacle) {
  FootFrame frame;
  frame.size = size;
  frame.normal = Vector2d(obstacle->nx, obstacle->ny).normalized();
  frame.tangent = {frame.normal.y(), -frame.normal.x()};
  const Vector2d x(node.x, node.y);
  const double gap = frame.normal.dot(x - Vector2d(obstacle->px, obstacle->py));
  frame.foot = x - gap * frame.normal;
  obstacle->nx = obstacle->ny = 0.0;
  const double kind = random->Number(0.0, 1.0);
  if (kind < 0.3)
    MakeCircle(frame, random->Number(0.1, 2.0), false, obstacle);
  else if (kind < 0.5)
    MakeCircle(frame, random->Number(0.5, 3.0), true, obstacle);
  else if (kind < 0.8)
    MakeBentLine(frame, random, obstacle);
  else
    MakeWave(frame, random, obstacle);
}

TraceRequest OnCurves(TraceRequest request, unsigned seed) {
  Random random(seed);
  for (const ContactCandidate& contact : request.scene.contacts) {
    const auto obstacle = std::find_if(request.scene.obstacles.begin(), request.scene.obstacles.end(),
                                       [&](const Obstacle& other) { return other.name == contact.obstacle; });
    const auto node = std::find_if(request.scene.nodes.begin(), request.scene.nodes.end(),
                                   [&](const Node& other) { return other.name == contact.node; });
    MakeCurve(*node, 1.0, &random, &*obstacle);
  }
  return request;
}

}  // namespace contact_path
