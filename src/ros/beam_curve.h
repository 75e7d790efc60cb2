// The curves that beams are drawn as: cubics through their nodes, with the directions that the rotations of the nodes
// give.
#ifndef CONTACT_PATH_SRC_ROS_BEAM_CURVE_H_
#define CONTACT_PATH_SRC_ROS_BEAM_CURVE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace contact_path {

// A segment of a beam.
struct DrawnSegment {
  std::array<std::size_t, 2> nodes = {};
  Eigen::Vector2d chord = Eigen::Vector2d::Zero();  // at the start, from the first node to the second [length]
  double turn = 0.0;                                // of its stress-free arc, > 0 to the left [rad]
  std::array<bool, 2> hinged = {};
};

// The ends of a segment now.
struct SegmentEnds {
  std::array<Eigen::Vector2d, 2> places;
  std::array<double, 2> rotations;  // of the nodes since the start [rad]
};

// `steps` + 1 points. Against the chord, the curve is turned at its ends by the rotations of the nodes less that of the
// chord, and by half of the turn of the arc. A hinged end turns as no moment acts on it: by half of the other end, the
// other way.
std::vector<Eigen::Vector2d> CurveOf(const DrawnSegment& segment, const SegmentEnds& ends, int steps);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_ROS_BEAM_CURVE_H_
