// The markers of one picture as they come to be: lines, triangles, dots, arrows and text in the plane.
#ifndef CONTACT_PATH_SRC_ROS_MARKER_PICTURE_H_
#define CONTACT_PATH_SRC_ROS_MARKER_PICTURE_H_

#include <Eigen/Core>
#include <string>

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

namespace contact_path {

// From below to above.
enum Layer { kStrips, kBoundaries, kInitial, kCones, kSprings, kBars, kNodes, kCandidates, kTouching, kArrows, kText };

inline std_msgs::ColorRGBA Colour(float red, float green, float blue, float alpha = 1.0F) {
  std_msgs::ColorRGBA colour;
  colour.r = red;
  colour.g = green;
  colour.b = blue;
  colour.a = alpha;
  return colour;
}

// t of a normal n.
inline Eigen::Vector2d Tangent(const Eigen::Vector2d& normal) { return {normal.y(), -normal.x()}; }

class MarkerPicture {
 public:
  // size: of the scene [length]; detail: diameter of a node [length].
  MarkerPicture(double size, double detail);

  // Each begins a marker, to be filled by what follows.
  void BeginLines(const char* name, int id, double width, const std_msgs::ColorRGBA& colour, Layer layer) {
    Begin(name, id, visualization_msgs::Marker::LINE_LIST, colour, layer).scale.x = width;
  }
  void BeginTriangles(const char* name, int id, const std_msgs::ColorRGBA& colour, Layer layer) {
    visualization_msgs::Marker& marker = Begin(name, id, visualization_msgs::Marker::TRIANGLE_LIST, colour, layer);
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  }
  // `type`: SPHERE_LIST or CUBE_LIST.
  void BeginDots(const char* name, int id, int type, double diameter, const std_msgs::ColorRGBA& colour, Layer layer) {
    visualization_msgs::Marker& marker = Begin(name, id, type, colour, layer);
    marker.scale.x = marker.scale.y = marker.scale.z = diameter;
  }

  void AddPoint(const Eigen::Vector2d& place) { AddPointAt(place, height_); }
  void AddPoint(const Eigen::Vector2d& place, const std_msgs::ColorRGBA& colour, Layer layer) {
    AddPointAt(place, layer_ * static_cast<double>(layer));
    Last().colors.push_back(colour);
  }
  void AddLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    AddPoint(from);
    AddPoint(to);
  }
  // Colours by vertex keep rviz from shading what is flat.
  void AddTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const std_msgs::ColorRGBA& colour) {
    for (const Eigen::Vector2d& corner : {a, b, c}) {
      AddPoint(corner);
      Last().colors.push_back(colour);
    }
  }
  void AddTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    AddTriangle(a, b, c, Last().color);
  }
  void AddArrow(const Eigen::Vector2d& from, const Eigen::Vector2d& vector, const std_msgs::ColorRGBA& colour);
  // On a circle, its middle above the centre. turn: to the left where it is positive, not 0 [rad].
  void AddTurnedArrow(const Eigen::Vector2d& centre, double radius, double turn, const std_msgs::ColorRGBA& colour);
  void AddText(const char* name, int id, const Eigen::Vector2d& centre, double height,
               const std_msgs::ColorRGBA& colour, const std::string& text);

  // The picture in its frame: `centre` at the origin, all lengths times `scale`. The last call.
  visualization_msgs::MarkerArray Finish(const std::string& frame_id, const Eigen::Vector2d& centre, double scale);

 private:
  visualization_msgs::Marker& Begin(const char* name, int id, int type, const std_msgs::ColorRGBA& colour, Layer layer);
  visualization_msgs::Marker& Last() { return array_.markers.back(); }
  void AddPointAt(const Eigen::Vector2d& place, double height);

  const double layer_;
  const double detail_;
  double height_ = 0.0;
  visualization_msgs::MarkerArray array_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_ROS_MARKER_PICTURE_H_
