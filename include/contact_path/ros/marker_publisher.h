// The latched topic `markers`: pictures of a trace as it goes.
#ifndef CONTACT_PATH_ROS_MARKER_PUBLISHER_H_
#define CONTACT_PATH_ROS_MARKER_PUBLISHER_H_

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>

#include <ros/ros.h>

#include "contact_path/ros/messages.h"
#include "contact_path/ros/scene_markers.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// The parameters `frame_id` and `picture_size`. Throws std::invalid_argument naming the one that has a wrong type or
// value.
MarkerOptions ReadMarkerOptions(const ros::NodeHandle& private_node);

// Draws on the threads that serve callbacks, not on the one that traces: of the increments that came in meanwhile the
// last one, at most 20 times a second and for at most a tenth of the time. Where nobody subscribes, only once no
// increment has come for a while, so that who comes late finds the last one.
class MarkerPublisher {
 public:
  // The topic is a topic of `node`.
  MarkerPublisher(ros::NodeHandle node, const MarkerOptions& options);

  // A new trace begins. `request` must be sound (validate.h).
  void TakeRequest(const TraceRequest& request);
  // The next increment of the trace; not to be changed any more. One that carries no state, or that is not of the
  // scene, gives no picture. Quick: nothing is drawn here.
  void TakeIncrement(const contact_path_msgs::Increment::ConstPtr& increment);
  // Publishes what is not published yet, at once.
  void Publish();

 private:
  using Clock = std::chrono::steady_clock;

  void Tick();

  const MarkerOptions options_;
  ros::Publisher publisher_;

  std::mutex drawing_;  // held while a picture is drawn and published, so that pictures keep their order

  std::mutex mutex_;  // guards all of these
  std::shared_ptr<const SceneMarkers> scene_;
  contact_path_msgs::Increment::ConstPtr increment_;  // null: none yet
  double largest_force_ = 0.0;                        // of the trace so far
  bool published_ = true;                             // this scene and increment
  std::uint64_t taken_ = 0;                           // scenes and increments
  std::uint64_t taken_before_ = 0;                    // at the last tick
  Clock::time_point next_;                            // the earliest time of the next picture

  ros::WallTimer timer_;  // last, so that it does not tick before the rest is there
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_MARKER_PUBLISHER_H_
