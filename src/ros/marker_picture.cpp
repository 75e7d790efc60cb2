#include "ros/marker_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact_path {
namespace {

using Eigen::Vector2d;
using std_msgs::ColorRGBA;
using visualization_msgs::Marker;

constexpr double kLayer = 0.002;  // distance in z, in parts of the scene's size

// Lengths in parts of the detail.
constexpr double kShaftWidth = 0.35;
constexpr double kHeadWidth = 1.3;
constexpr double kHeadLength = 1.8;

// Where an arrow is too short for its head, the head is this part of it.
constexpr double kMostHead = 0.6;

// Of the arrow of a moment.
constexpr double kTurnedHead = 0.6;       // [rad]
constexpr double kTurnedHeadWidth = 0.5;  // in parts of the radius
constexpr int kTurnedSteps = 24;

}  // namespace

MarkerPicture::MarkerPicture(double size, double detail) : layer_(kLayer * size), detail_(detail) {}

void MarkerPicture::AddArrow(const Vector2d& from, const Vector2d& vector, const ColorRGBA& colour) {
  const double length = vector.norm();
  const Vector2d along = vector / length;
  const Vector2d across = Tangent(along);
  const double head = std::min(kHeadLength * detail_, kMostHead * length);
  const Vector2d head_side = (0.5 * kHeadWidth / kHeadLength * head) * across;
  const Vector2d shaft_side = (0.5 * kShaftWidth / kHeadLength * head) * across;
  const Vector2d neck = from + (length - head) * along;
  AddTriangle(from - shaft_side, neck - shaft_side, neck + shaft_side, colour);
  AddTriangle(from - shaft_side, neck + shaft_side, from + shaft_side, colour);
  AddTriangle(neck - head_side, from + vector, neck + head_side, colour);
}

void MarkerPicture::AddTurnedArrow(const Vector2d& centre, double radius, double turn, const ColorRGBA& colour) {
  const auto at = [&](double angle, double distance) {
    return Vector2d(centre.x() + distance * std::cos(angle), centre.y() + distance * std::sin(angle));
  };
  const double head = std::min(kTurnedHead, kMostHead * std::abs(turn));
  const double begin = 0.5 * M_PI - 0.5 * turn, end = 0.5 * M_PI + 0.5 * turn;  // around upwards
  const double neck = end - std::copysign(head, turn);
  const double half = 0.5 * std::min(kShaftWidth * detail_, 0.2 * radius);
  for (int i = 0; i < kTurnedSteps; ++i) {
    const double a = begin + (neck - begin) * i / kTurnedSteps, b = begin + (neck - begin) * (i + 1) / kTurnedSteps;
    AddTriangle(at(a, radius - half), at(a, radius + half), at(b, radius + half), colour);
    AddTriangle(at(a, radius - half), at(b, radius + half), at(b, radius - half), colour);
  }
  const double side = 0.5 * kTurnedHeadWidth * head / kTurnedHead * radius;
  AddTriangle(at(neck, radius - side), at(end, radius), at(neck, radius + side), colour);
}

void MarkerPicture::AddText(const char* name, int id, const Vector2d& centre, double height, const ColorRGBA& colour,
                            const std::string& text) {
  Marker& marker = Begin(name, id, Marker::TEXT_VIEW_FACING, colour, kText);
  marker.scale.z = height;
  marker.pose.position.x = centre.x();
  marker.pose.position.y = centre.y();
  marker.pose.position.z = height_;
  marker.text = text;
}

visualization_msgs::MarkerArray MarkerPicture::Finish(const std::string& frame_id, const Vector2d& centre,
                                                      double scale) {
  const auto place = [&](geometry_msgs::Point* point) {
    point->x = scale * (point->x - centre.x());
    point->y = scale * (point->y - centre.y());
    point->z *= scale;
  };
  for (Marker& marker : array_.markers) {
    marker.header.frame_id = frame_id;
    if (marker.points.empty() && marker.text.empty()) marker.action = Marker::DELETE;
    for (geometry_msgs::Point& point : marker.points) place(&point);
    if (marker.type == Marker::TEXT_VIEW_FACING) place(&marker.pose.position);
    if (marker.type == Marker::TRIANGLE_LIST) continue;  // points alone
    marker.scale.x *= scale;
    marker.scale.y *= scale;
    marker.scale.z *= scale;
  }
  return std::move(array_);
}

Marker& MarkerPicture::Begin(const char* name, int id, int type, const ColorRGBA& colour, Layer layer) {
  Marker& marker = array_.markers.emplace_back();
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color = colour;
  height_ = layer_ * static_cast<double>(layer);
  return marker;
}

void MarkerPicture::AddPointAt(const Vector2d& place, double height) {
  geometry_msgs::Point& point = Last().points.emplace_back();
  point.x = place.x();
  point.y = place.y();
  point.z = height;
}

}  // namespace contact_path
