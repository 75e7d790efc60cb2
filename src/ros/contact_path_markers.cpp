// Draws a trace that comes over topics: one that `rosbag play` plays, or that a node elsewhere streams. Subscribes to
// `request` and `increments` and publishes `markers`, all in the namespace contact_path, as the node itself does.
// Parameters: ~frame_id, ~picture_size.
#include <cstdint>
#include <exception>
#include <vector>

#include <ros/ros.h>

#include "contact_path/ros/convert.h"
#include "contact_path/ros/marker_publisher.h"
#include "contact_path/ros/messages.h"
#include "contact_path/ros/names.h"
#include "contact_path/scene/validate.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;

constexpr std::uint32_t kIncrementsQueue = 10000;

// Request and increments have connections of their own: the first increments of a trace may overtake its request.
class Listener {
 public:
  Listener(ros::NodeHandle node, const MarkerOptions& options)
      : markers_(node, options),
        requests_(node.subscribe(names::kRequest, 1, &Listener::TakeRequest, this)),
        increments_(node.subscribe(names::kIncrements, kIncrementsQueue, &Listener::TakeIncrement, this)) {}

 private:
  void TakeRequest(const msgs::TraceRequest::ConstPtr& message) {
    awaits_request_ = false;
    valid_ = false;
    received_ = 0;
    const msgs::Increment::ConstPtr early = early_increment_;
    early_increment_ = nullptr;
    try {
      const TraceRequest request = FromMessage(message->scene, message->options, message->program);
      const std::vector<Violation> violations = Validate(request);
      if (!violations.empty()) throw InvalidRequest(violations);
      markers_.TakeRequest(request);
    } catch (const InvalidRequest& error) {
      ROS_WARN("no pictures of \"%s\": %s", message->scene.name.c_str(), error.what());
      return;
    }
    valid_ = true;
    if (early) TakeIncrement(early);
  }

  void TakeIncrement(const msgs::Increment::ConstPtr& increment) {
    if (increment->index == 0 && received_ > 0) awaits_request_ = true;  // of a new trace
    if (awaits_request_) {
      if (!increment->x.empty()) early_increment_ = increment;
      return;
    }
    ++received_;
    if (valid_) markers_.TakeIncrement(increment);
  }

  MarkerPublisher markers_;
  bool awaits_request_ = true;                 // of the increments that come in
  bool valid_ = false;                         // the last request
  std::uint64_t received_ = 0;                 // increments of it
  msgs::Increment::ConstPtr early_increment_;  // the last one that came before its request; null: none

  ros::Subscriber requests_;
  ros::Subscriber increments_;
};

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  ros::init(argc, argv, "contact_path_markers");
  const ros::NodeHandle node(contact_path::names::kNode);
  try {
    contact_path::Listener listener(node, contact_path::ReadMarkerOptions(ros::NodeHandle("~")));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
