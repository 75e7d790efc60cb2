#include "contact_path/ros/increment_publisher.h"

#include <ros/topic_manager.h>
#include <boost/shared_array.hpp>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

using Bytes = std::atomic<std::size_t>;

// The increment as it is sent; it counts in `waiting` until the last subscriber has it.
ros::SerializedMessage Serialise(const contact_path_msgs::Increment& increment, const std::shared_ptr<Bytes>& waiting) {
  ros::SerializedMessage message = ros::serialization::serializeMessage(increment);
  *waiting += message.num_bytes;
  message.buf = boost::shared_array<std::uint8_t>(
      message.buf.get(),
      [kept = message.buf, size = message.num_bytes, waiting](const std::uint8_t*) { *waiting -= size; });
  return message;
}

}  // namespace

IncrementPublisher::IncrementPublisher(ros::NodeHandle node, std::uint32_t queue, std::size_t most_bytes)
    : publisher_(node.advertise<contact_path_msgs::Increment>(names::kIncrements, queue)), most_bytes_(most_bytes) {}

bool IncrementPublisher::Publish(const contact_path_msgs::Increment& increment) {
  // ros::Publisher does the same, with a buffer that cannot be watched.
  ros::TopicManager& topics = *ros::TopicManager::instance();
  if (*waiting_ > most_bytes_) {
    topics.incrementSequence(publisher_.getTopic());
    return false;
  }
  ros::SerializedMessage message;
  topics.publish(
      publisher_.getTopic(), [&] { return Serialise(increment, waiting_); }, message);
  return true;
}

}  // namespace contact_path
