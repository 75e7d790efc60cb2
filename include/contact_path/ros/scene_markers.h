// Draws the increments of a trace as markers for rviz, in the plane z = 0; z only says what lies over what.
//
// Every picture is the same list of markers, by namespace and id: each is added, or deleted where there is nothing of
// its kind. So a picture replaces the one before, whatever the scene, and is whole by itself.
//
//   namespace      id  what
//   obstacles       0  strips along the boundaries, on the forbidden side
//                   1  their boundaries
//                   2  strokes on the boundaries that move, which go along
//   initial         0  bars, all elements of two nodes, and beams, in the initial shape
//                   1  nodes, without the inner nodes of beams
//   superelements   0  lines from the nodes to their middle; of a single node, to its rest position
//                   1  these middles
//   structure       0  bars, and beams: curves with the directions that the rotations of the nodes give
//                   1  nodes, without the inner nodes of beams
//   solids          0  elements in the initial shape: their boundaries
//                   1  elements, from light where there is no energy to dark; the darkest colour is for 1 % of Young's
//                      modulus as energy per volume, or more
//                   2  their boundaries
//   supports        0  triangles away from the structure; with a stroke beyond where the node can slide along it
//   contacts        0  nodes of contact candidates: open grey, stick orange, slip+ yellow, slip- blue, closed green
//   cones           0  friction cones at contacts that touch
//   reactions       0  arrows of contacts, from the node
//   support_reactions  0  arrows of supports, from the node; of moments around it, as those of loads
//   loads           0  arrows, from the node; of moments around it, counterclockwise where they are positive; constant
//                      loads are lighter
//   caption         0  scene, stage, increment, load factor
//                   1  arrow of full length
//                   2  the force that this arrow stands for; where there are moments, also the moment that three
//                      quarters of a turn stand for
#ifndef CONTACT_PATH_ROS_SCENE_MARKERS_H_
#define CONTACT_PATH_ROS_SCENE_MARKERS_H_

#include <memory>
#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "contact_path/ros/messages.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct MarkerOptions {
  std::string frame_id = "contact_path";  // of all markers; their stamps are 0, the latest transform
  // 0: markers have the coordinates of the scene. Otherwise the scene is moved and scaled so that it has this size,
  // around the origin: any scene fits one view. >= 0 [length of the frame]
  double picture_size = 0.0;

  // Throws std::invalid_argument naming the field and its value.
  void Validate() const;
};

struct DrawnScene;

class SceneMarkers {
 public:
  // `request` and `options` must be sound (validate.h).
  SceneMarkers(const TraceRequest& request, const MarkerOptions& options);

  // Whether the increment is of a stage of the request and has as many positions, rotations and contacts as the
  // scene; increments that are thinned out (full_state_every) have none. Of reactions of supports it may have none.
  bool Fits(const contact_path_msgs::Increment& increment) const;

  // The largest of all loads and reactions of an increment that fits; a moment counts as a force at the distance of
  // the scene's size [force].
  double LargestForce(const contact_path_msgs::Increment& increment) const;

  // `increment` must fit. `largest_force` [force]: of the path so far. Arrows have one scale, which is halved each time
  // that this force outgrows it: the largest so far is drawn at half of the full length or more, and lengths can be
  // compared between increments. Forces below a thousandth of the characteristic force do not get there.
  visualization_msgs::MarkerArray Draw(const contact_path_msgs::Increment& increment, double largest_force) const;

  // The scene before its first increment: the initial shape, without reactions and with all contacts open.
  visualization_msgs::MarkerArray DrawInitial() const;

 private:
  visualization_msgs::MarkerArray Draw(const contact_path_msgs::Increment& increment, double largest_force,
                                       const std::string& caption) const;

  MarkerOptions options_;
  std::shared_ptr<const DrawnScene> scene_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_SCENE_MARKERS_H_
