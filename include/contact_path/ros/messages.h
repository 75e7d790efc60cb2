// The generated message types of this package, in the namespace `contact_path_msgs`.
//
// The generator declares them in `contact_path`, where the core has types of the same names (Scene, Increment, ...), so
// that one source file could not use both. Here the namespace is renamed while the generated headers are read; what
// they include from outside of the package is read before. Type names on the wire and in bags ("contact_path/Scene")
// are strings and stay as they are. Source files that use the core include the messages through this header only.
#ifndef CONTACT_PATH_ROS_MESSAGES_H_
#define CONTACT_PATH_ROS_MESSAGES_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/builtin_message_traits.h>
#include <ros/message_operations.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>
#include <ros/time.h>
#include <ros/types.h>
#include <std_msgs/Header.h>

#define contact_path contact_path_msgs
#include <contact_path/Increment.h>
#include <contact_path/TracePath.h>
#include <contact_path/TracePathAction.h>
#include <contact_path/TraceRequest.h>
#include <contact_path/TraceResult.h>
#include <contact_path/TraceStatus.h>
#undef contact_path

#include "contact_path/ros/memory_share.h"

namespace contact_path {

// Reads messages without trusting the lengths in them, and as ros::serialization::IStream otherwise.
//
// roscpp makes room for as many elements as an array says that it has before it looks whether they are there: four
// bytes of a message could take all memory. Here an array that says more than the rest of the message can hold is a
// ros::serialization::StreamOverrunException, which roscpp answers or logs as any message that is cut off.
class BoundedIStream : public ros::serialization::Stream {
 public:
  BoundedIStream(std::uint8_t* data, std::uint32_t size) : Stream(data, size) {}

  template <typename T>
  void next(T& value) {
    ros::serialization::deserialize(*this, value);
  }

  template <typename T, typename Allocator>
  void next(std::vector<T, Allocator>& values) {
    std::uint32_t count = 0;
    if (getLength() >= sizeof(count)) {
      std::memcpy(&count, getData(), sizeof(count));
      // Of an element whose texts and arrays are empty.
      const std::uint64_t least = ros::serialization::serializationLength(T());
      if (count * least > getLength() - sizeof(count)) ros::serialization::throwStreamOverrun();
    }
    ros::serialization::deserialize(*this, values);
  }
};

// As roscpp deserializes. Throws std::runtime_error, which tells a caller more than std::bad_alloc, where memory ends.
template <typename Message>
void ReadBounded(ros::serialization::IStream& stream, Message& message) {
  const WithinLimit within_limit(0);
  try {
    BoundedIStream(stream.getData(), stream.getLength()).next(message);
  } catch (const std::bad_alloc&) {
    message = Message();
    throw std::runtime_error("not enough MB of memory to read the message");
  }
}

// What actionlib takes of goals and cancels without looking: it computes with their times, and keeps their ids.
constexpr std::size_t kLongestGoalId = 256;
constexpr std::uint32_t kLatestGoal = 4'000'000'000;  // [s]: later, actionlib's sums go beyond 32 bits and end the node
constexpr double kCancelAhead = 5.0;                  // [s]

// Throws std::runtime_error for an id that is too long. A time is set back where it is beyond kLatestGoal.
inline void BoundGoalId(actionlib_msgs::GoalID* goal) {
  if (goal->id.size() > kLongestGoalId) throw std::runtime_error("the id of a goal must have at most 256 characters");
  goal->stamp = std::min(goal->stamp, ros::Time(kLatestGoal, 0));
}

// A cancel speaks of all goals up to its time. One far ahead would recall all that come until then: it is set back to
// five seconds from now, unless there is no clock.
inline void BoundCancel(actionlib_msgs::GoalID* cancel) {
  BoundGoalId(cancel);
  const ros::Time now = ros::Time::now();
  if (!now.isZero()) cancel->stamp = std::min(cancel->stamp, now + ros::Duration(kCancelAhead));
}

}  // namespace contact_path

// What comes from outside, by a service, an action, a topic or a bag, is read by BoundedIStream.
namespace ros {
namespace serialization {

template <>
inline void deserialize(IStream& stream, contact_path_msgs::TracePathRequest& t) {
  contact_path::ReadBounded(stream, t);
}
template <>
inline void deserialize(IStream& stream, contact_path_msgs::TracePathActionGoal& t) {
  contact_path::ReadBounded(stream, t);
  contact_path::BoundGoalId(&t.goal_id);
}
template <>
inline void deserialize(IStream& stream, actionlib_msgs::GoalID& t) {
  contact_path::ReadBounded(stream, t);
  contact_path::BoundCancel(&t);
}
template <>
inline void deserialize(IStream& stream, contact_path_msgs::TraceRequest& t) {
  contact_path::ReadBounded(stream, t);
}
template <>
inline void deserialize(IStream& stream, contact_path_msgs::Increment& t) {
  contact_path::ReadBounded(stream, t);
}

}  // namespace serialization
}  // namespace ros

#endif  // CONTACT_PATH_ROS_MESSAGES_H_
