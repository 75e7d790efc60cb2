// The topic `increments`.
#ifndef CONTACT_PATH_ROS_INCREMENT_PUBLISHER_H_
#define CONTACT_PATH_ROS_INCREMENT_PUBLISHER_H_

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <ros/ros.h>

#include "contact_path/ros/messages.h"

namespace contact_path {

// roscpp keeps a number of messages for each subscriber that is slower than the publisher. How much memory that is
// depends on the messages: here it is bounded, too.
class IncrementPublisher {
 public:
  // queue: messages kept for a subscriber, > 0; the oldest are dropped beyond. most_bytes: of all messages that wait
  // for some subscriber.
  IncrementPublisher(ros::NodeHandle node, std::uint32_t queue, std::size_t most_bytes);

  // False where more than most_bytes wait: then nobody gets this increment.
  bool Publish(const contact_path_msgs::Increment& increment);

 private:
  ros::Publisher publisher_;
  const std::size_t most_bytes_;
  // Of serialised increments that roscpp still holds; they may outlive this.
  std::shared_ptr<std::atomic<std::size_t>> waiting_ = std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_INCREMENT_PUBLISHER_H_
