// The look of the pictures: sizes, counts and bounds. Colours stand in scene_markers.cpp, layers in marker_picture.h.
#ifndef CONTACT_PATH_SRC_ROS_MARKER_STYLE_H_
#define CONTACT_PATH_SRC_ROS_MARKER_STYLE_H_

#include <cmath>
#include <cstddef>

namespace contact_path {

// The size of a scene is the diagonal of the box around it, its detail the diameter of a node.
struct MarkerStyle {
  // Parts of the size of the scene.
  double layer = 0.002;         // distance of two layers in z
  double full_arrow = 0.2;      // length of the arrow of the full force
  double moment_radius = 0.07;  // of the arrow of a moment
  double strip_depth = 0.05;    // of the ground below the boundary of an obstacle
  double text_height = 0.045;
  double most_cone = 0.12;     // edge of a friction cone, at most
  double farthest_stop = 5.0;  // distance from the start up to which a place that a node is to reach is in the picture

  // Parts of the detail.
  double bar_width = 0.35;  // also of beams, and of the boundary of an obstacle
  double thin_width = 0.2;  // of lines of the second rank: initial shape, edges of solids, surfaces, strokes
  double contact_diameter = 1.6;
  double support_height = 2.2;
  double cone_edge = 6.0;
  double shaft_width = 0.35;
  double head_width = 1.3;
  double head_length = 1.8;

  // Arrows.
  double most_head = 0.6;          // part of its arrow, where that is too short for the head
  double shortest = 1e-3;          // part of the full length: shorter arrows are left out
  double full_turn = 1.5 * M_PI;   // where the moment is the full force times the size of the scene [rad]
  double turned_head = 0.6;        // of the arrow of a moment: length of its head [rad]
  double turned_head_width = 0.5;  // part of the radius of the arrow
  int turned_steps = 24;           // lines along the shaft of the arrow of a moment

  // Lines and strokes.
  std::size_t most_lines = 4000;  // of all segments of beams together,
  std::size_t fewest_steps = 2;   // but of each segment at least so many
  std::size_t most_steps = 16;    // and at most so many
  int most_strokes = 200;         // of an obstacle that moves
  int patch_steps = 48;           // lines of a patch of a curve that is bent
  int surface_steps = 8;          // lines of a patch of a surface that deforms

  double full_energy = 0.01;  // energy per volume of a solid, of Young's modulus, that has the darkest colour
};

inline constexpr MarkerStyle kStyle;

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_ROS_MARKER_STYLE_H_
