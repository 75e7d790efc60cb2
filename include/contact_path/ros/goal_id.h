// What actionlib takes of goals and cancels without looking: it computes with their times, and keeps their ids.
#ifndef CONTACT_PATH_ROS_GOAL_ID_H_
#define CONTACT_PATH_ROS_GOAL_ID_H_

#include <actionlib_msgs/GoalID.h>
#include <ros/time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace contact_path {

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

#endif  // CONTACT_PATH_ROS_GOAL_ID_H_
