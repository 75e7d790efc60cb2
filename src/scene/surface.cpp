#include "contact_path/scene/surface.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "contact_path/geometry/curve.h"
#include "contact_path/geometry/point_curves.h"
#include "contact_path/scene/text.h"
#include "scene/input_bounds.h"

namespace contact_path {
namespace {

constexpr double kFilletShare = 0.1;  // of the largest fillet, where none is given

std::string Text(double value) { return RoundedText(value, 12); }

std::string Text(const Eigen::Vector2d& point) { return "[" + Text(point.x()) + ", " + Text(point.y()) + "]"; }

// Points are told from 1, as people count them.
std::string Number(std::size_t point) { return std::to_string(point + 1); }

// Counted from (px, py).
PlanePoints PointsOf(const Obstacle& obstacle) {
  PlanePoints points;
  for (std::size_t i = 0; i + 1 < obstacle.points.size(); i += 2)
    points.push_back({obstacle.points[i], obstacle.points[i + 1]});
  return points;
}

PlanePoints PlacedPoints(const Obstacle& obstacle) {
  PlanePoints points = PointsOf(obstacle);
  for (Eigen::Vector2d& point : points) point += Eigen::Vector2d(obstacle.px, obstacle.py);
  return points;
}

// By point.
std::vector<double> FilletsOf(const Obstacle& obstacle, const PlanePoints& points) {
  double fillet = obstacle.fillet;
  if (!(fillet > 0.0)) {
    const double largest = LargestFillet(points, obstacle.closed);
    fillet = std::isfinite(largest) ? kFilletShare * largest : 1.0;  // without corners any radius does
  }
  std::vector<double> fillets = obstacle.fillets;
  fillets.resize(points.size());
  for (double& of : fillets)
    if (!(of > 0.0)) of = fillet;
  return fillets;
}

ShapeFault FindPointFault(const Obstacle& obstacle, const PlanePoints& points) {
  const std::size_t fewest = obstacle.closed ? 3 : 2;
  if (obstacle.points.size() % 2 != 0)
    return {"points", "must have x and y in turn: an even number of numbers",
            std::to_string(obstacle.points.size()) + " numbers"};
  if (points.size() < fewest)
    return {"points", obstacle.closed ? "must be at least three where the curve is closed" : "must be at least two",
            std::to_string(points.size()) + (points.size() == 1 ? " point" : " points")};
  if (!std::all_of(obstacle.points.begin(), obstacle.points.end(),
                   [](double number) { return std::abs(number) <= kLargestInput; }))
    return {"points", "must be finite and at most 1e100 in magnitude", "a number"};
  if (const auto equal = FindEqualPoints(points, obstacle.closed))
    return {"points",
            "neighbours must differ: point " + Number(*equal) + " is point " + Number((*equal + 1) % points.size()),
            Text(points[*equal])};
  return {};
}

ShapeFault FindPolylineFault(const Obstacle& obstacle, const PlanePoints& points) {
  if (obstacle.closed) {
    if (const auto crossing = FindCrossing(points))
      return {"points",
              "a closed polyline must not cross itself: the edge from point " + Number(crossing->first) +
                  " meets the edge from point " + Number(crossing->second),
              Text(points[crossing->second])};
  }
  const double largest = LargestFillet(points, obstacle.closed);
  if (largest == 0.0) return {"points", "an edge must not lead straight back", "a corner"};
  if (obstacle.fillet > (1.0 + kCancelled) * largest)
    return {"fillet", "must be at most " + Text(largest) + ": the edges have no room for larger fillets",
            NumberText(obstacle.fillet)};
  if (obstacle.fillets.empty()) return {};
  if (obstacle.fillets.size() != points.size())
    return {"fillets", "must be empty or have " + std::to_string(points.size()) + " entries, one for each point",
            std::to_string(obstacle.fillets.size()) + " entries"};
  if (obstacle.fillet > 0.0) return {"fillet", "must be 0 where fillets are given", NumberText(obstacle.fillet)};
  if (const auto edge = TooShort(points, obstacle.closed, FilletsOf(obstacle, points), kCancelled))
    return {"fillets", "the edge from point " + Number(*edge) + " must have room for those at both of its ends",
            "a radius"};
  return {};
}

}  // namespace

ShapeFault FindShapeFault(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane:
      if (std::hypot(obstacle.nx, obstacle.ny) < kSmallestInput)  // false for a normal that is not finite
        return {"nx", "the normal (nx, ny) must not be zero (length at least 1e-100)", NumberText(obstacle.nx)};
      return {};
    case ObstacleShape::kCircle:
      if (!(obstacle.radius >= kSmallestInput))
        return {"radius", "must be > 0 where the shape is circle", NumberText(obstacle.radius)};
      return {};
    case ObstacleShape::kPolyline:
    case ObstacleShape::kSpline: break;
  }
  const PlanePoints points = PointsOf(obstacle);
  ShapeFault fault = FindPointFault(obstacle, points);
  if (!fault.field.empty() || obstacle.shape == ObstacleShape::kSpline) return fault;
  return FindPolylineFault(obstacle, points);
}

std::string FindMisfit(const Obstacle& obstacle, double radius) {
  const PlanePoints points = PointsOf(obstacle);
  std::optional<Hollow> hollow;
  const bool spline = obstacle.shape == ObstacleShape::kSpline;
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane:
    case ObstacleShape::kCircle: break;
    case ObstacleShape::kPolyline:
      hollow = HollowOfPolyline(points, obstacle.closed, FilletsOf(obstacle, points));
      break;
    case ObstacleShape::kSpline: hollow = HollowOfSpline(points, obstacle.closed); break;
  }
  if (!hollow || radius < (1.0 - kCancelled) * hollow->radius) return {};
  return "its radius " + Text(radius) + " must be less than the " + (spline ? "radius of curvature " : "fillet ") +
         Text(hollow->radius) + " of the hollow of " + obstacle.name + (spline ? " behind point " : " at point ") +
         Number(hollow->point) + ": where it does not fit it touches twice, and that is two obstacles";
}

std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle, double radius) {
  Eigen::Vector2d point(obstacle.px, obstacle.py);
  switch (obstacle.shape) {
    case ObstacleShape::kHalfPlane: break;
    case ObstacleShape::kCircle:
      return MakeCircle(point, obstacle.radius + (obstacle.inside ? -radius : radius), obstacle.inside);
    case ObstacleShape::kPolyline: {
      const PlanePoints points = PlacedPoints(obstacle);
      return MakePolyline(points, obstacle.closed, FilletsOf(obstacle, points), radius);
    }
    case ObstacleShape::kSpline: return MakeSpline(PlacedPoints(obstacle), obstacle.closed, radius);
  }
  const Eigen::Vector2d normal(obstacle.nx, obstacle.ny);
  if (radius > 0.0) point += radius / std::hypot(normal.x(), normal.y()) * normal;
  return std::make_unique<HalfPlane>(point, normal);
}

}  // namespace contact_path
