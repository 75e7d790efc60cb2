// What tests read from a picture of markers.
#ifndef CONTACT_PATH_TEST_ROS_READ_MARKERS_H_
#define CONTACT_PATH_TEST_ROS_READ_MARKERS_H_

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include "contact_path/ros/scene_markers.h"

namespace contact_path {

inline MarkerOptions World() {
  MarkerOptions options;
  options.frame_id = "world";
  return options;
}

inline const visualization_msgs::Marker& Find(const visualization_msgs::MarkerArray& picture, const std::string& name,
                                              int id = 0) {
  for (const visualization_msgs::Marker& marker : picture.markers) {
    if (marker.ns == name && marker.id == id) return marker;
  }
  throw std::out_of_range(name);
}

inline std::vector<Eigen::Vector2d> Points(const visualization_msgs::Marker& marker) {
  std::vector<Eigen::Vector2d> points;
  for (const geometry_msgs::Point& point : marker.points) points.emplace_back(point.x, point.y);
  return points;
}

// The point that lies farthest from `from`: of an arrow, its tip.
inline Eigen::Vector2d Farthest(const visualization_msgs::Marker& marker, const Eigen::Vector2d& from) {
  Eigen::Vector2d farthest = from;
  for (const Eigen::Vector2d& point : Points(marker)) {
    if ((point - from).norm() > (farthest - from).norm()) farthest = point;
  }
  return farthest;
}

// What rviz asks of markers.
inline void ExpectSound(const visualization_msgs::MarkerArray& picture) {
  for (const visualization_msgs::Marker& marker : picture.markers) {
    SCOPED_TRACE(marker.ns + std::to_string(marker.id));
    EXPECT_EQ(marker.header.frame_id, "world");
    EXPECT_TRUE(marker.header.stamp.isZero());
    if (marker.action == visualization_msgs::Marker::DELETE) continue;
    EXPECT_EQ(marker.action, visualization_msgs::Marker::ADD);
    EXPECT_EQ(marker.pose.orientation.w, 1.0);
    const bool text = marker.type == visualization_msgs::Marker::TEXT_VIEW_FACING;
    const bool lines = marker.type == visualization_msgs::Marker::LINE_LIST;
    EXPECT_EQ(marker.scale.x > 0.0, !text);
    EXPECT_EQ(marker.scale.y > 0.0, !text && !lines);
    EXPECT_EQ(marker.scale.z > 0.0, !lines);
    EXPECT_GT(marker.color.a, 0.0F);
    if (text) {
      EXPECT_FALSE(marker.text.empty());
      continue;
    }
    const std::size_t group = marker.type == visualization_msgs::Marker::TRIANGLE_LIST ? 3 : lines ? 2 : 1;
    EXPECT_FALSE(marker.points.empty());
    EXPECT_EQ(marker.points.size() % group, 0U);
    EXPECT_TRUE(marker.colors.empty() || marker.colors.size() == marker.points.size());
    for (const geometry_msgs::Point& point : marker.points) {
      EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
    }
  }
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_ROS_READ_MARKERS_H_
