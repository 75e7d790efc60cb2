#include "contact_path/ros/marker_publisher.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <visualization_msgs/MarkerArray.h>

#include "contact_path/ros/names.h"
#include "contact_path/ros/read_parameter.h"

namespace contact_path {
namespace {

constexpr double kPeriod = 0.05;  // [s] between pictures, at least
constexpr int kPause = 9;         // times as long as a picture takes, until the next one

}  // namespace

MarkerOptions ReadMarkerOptions(const ros::NodeHandle& private_node) {
  MarkerOptions options;
  ReadParameter(private_node, names::kFrameId, "a string", &options.frame_id);
  ReadParameter(private_node, names::kPictureSize, "a number", &options.picture_size);
  try {
    options.Validate();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("~") + error.what());
  }
  return options;
}

MarkerPublisher::MarkerPublisher(ros::NodeHandle node, const MarkerOptions& options) : options_(options) {
  publisher_ = node.advertise<visualization_msgs::MarkerArray>(names::kMarkers, 1, /*latch=*/true);
  timer_ = node.createWallTimer(ros::WallDuration(kPeriod), [this](const ros::WallTimerEvent&) { Tick(); });
}

void MarkerPublisher::TakeRequest(const TraceRequest& request) {
  auto markers = std::make_shared<const SceneMarkers>(request, options_);
  const std::lock_guard<std::mutex> lock(mutex_);
  scene_ = std::move(markers);
  increment_ = nullptr;
  largest_force_ = 0.0;
  published_ = false;
  ++taken_;
}

void MarkerPublisher::TakeIncrement(const contact_path_msgs::Increment::ConstPtr& increment) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!scene_ || !scene_->Fits(*increment)) return;
  largest_force_ = std::max(largest_force_, scene_->LargestForce(*increment));
  increment_ = increment;
  published_ = false;
  ++taken_;
}

void MarkerPublisher::Publish() {
  const std::lock_guard<std::mutex> drawing(drawing_);
  std::unique_lock<std::mutex> lock(mutex_);
  if (published_) return;
  const std::shared_ptr<const SceneMarkers> scene = scene_;
  const contact_path_msgs::Increment::ConstPtr increment = increment_;
  const double largest_force = largest_force_;
  published_ = true;
  lock.unlock();
  publisher_.publish(increment ? scene->Draw(*increment, largest_force) : scene->DrawInitial());
}

void MarkerPublisher::Tick() {
  const Clock::time_point start = Clock::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool at_rest = taken_ == taken_before_;
    taken_before_ = taken_;
    if (published_ || start < next_ || (!at_rest && publisher_.getNumSubscribers() == 0)) return;
  }
  try {
    Publish();
  } catch (const std::exception& error) {  // where memory ends: nobody else would catch it
    ROS_ERROR("no picture: %s", error.what());
  }
  const Clock::time_point end = Clock::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  next_ = end + kPause * (end - start);
}

}  // namespace contact_path
