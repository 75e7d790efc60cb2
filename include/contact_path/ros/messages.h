// The generated message types of this package, in the namespace `contact_path_msgs`.
//
// The generator declares them in `contact_path`, where the core has types of the same names (Scene, Increment, ...), so
// that one source file could not use both. Here the namespace is renamed while the generated headers are read; what
// they include from outside of the package is read before. Type names on the wire and in bags ("contact_path/Scene")
// are strings and stay as they are. Source files that use the core include the messages through this header only.
#ifndef CONTACT_PATH_ROS_MESSAGES_H_
#define CONTACT_PATH_ROS_MESSAGES_H_

#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/builtin_message_traits.h>
#include <ros/message_operations.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>
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

#include "contact_path/ros/bounded_stream.h"
#include "contact_path/ros/goal_id.h"

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
