#include "ros/marker_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/marker_style.h"

namespace contact_path {

using Eigen::Vector2d;
using std_msgs::ColorRGBA;
using visualization_msgs::Marker;

MarkerPicture::MarkerPicture(double size, double detail) : layer_(kStyle.layer * size), detail_(detail) {}

void MarkerPicture::AddArrow(const Vector2d& from, const Vector2d& vector, const ColorRGBA& colour) {
  const double length = vector.norm();
  const Vector2d along = vector / length;
  const Vector2d across = Tangent(along);
  const double head = std::min(kStyle.head_length * detail_, kStyle.most_head * length);
  const Vector2d head_side = (0.5 * kStyle.head_width / kStyle.head_length * head) * across;
  const Vector2d shaft_side = (0.5 * kStyle.shaft_width / kStyle.head_length * head) * across;
  const Vector2d neck = from + (length - head) * along;
  AddTriangle(from - shaft_side, neck - shaft_side, neck + shaft_side, colour);
  AddTriangle(from - shaft_side, neck + shaft_side, from + shaft_side, colour);
  AddTriangle(neck - head_side, from + vector, neck + head_side, colour);
}

void MarkerPicture::AddTurnedArrow(const Vector2d& centre, double radius, double turn, const ColorRGBA& colour) {
  const auto at = [&](double angle, double distance) {
    return Vector2d(centre.x() + distance * std::cos(angle), centre.y() + distance * std::sin(angle));
  };
  const double head = std::min(kStyle.turned_head, kStyle.most_head * std::abs(turn));
  const double begin = 0.5 * M_PI - 0.5 * turn, end = 0.5 * M_PI + 0.5 * turn;  // around upwards
  const double neck = end - std::copysign(head, turn);
  const double half = 0.5 * std::min(kStyle.shaft_width * detail_, 0.2 * radius);
  const int steps = kStyle.turned_steps;
  for (int i = 0; i < steps; ++i) {
    const double a = begin + (neck - begin) * i / steps, b = begin + (neck - begin) * (i + 1) / steps;
    AddTriangle(at(a, radius - half), at(a, radius + half), at(b, radius + half), colour);
    AddTriangle(at(a, radius - half), at(b, radius + half), at(b, radius - half), colour);
  }
  const double side = 0.5 * kStyle.turned_head_width * head / kStyle.turned_head * radius;
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
