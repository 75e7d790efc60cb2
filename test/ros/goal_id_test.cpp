#include "contact_path/ros/messages.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bytes.h"

namespace contact_path::goal_id_test {
namespace {

// As roscpp reads it from a connection.
template <typename Message>
Message Received(const Message& sent) {
  std::vector<std::uint8_t> bytes = Bytes(sent);
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  Message message;
  ros::serialization::deserialize(in, message);
  return message;
}

actionlib_msgs::GoalID IdAt(const ros::Time& stamp) {
  actionlib_msgs::GoalID id;
  id.id = "goal";
  id.stamp = stamp;
  return id;
}

TEST(GoalIdTest, UsualOnesStay) {
  const ros::Time now = ros::Time::now();
  for (const ros::Time& stamp : {ros::Time(), ros::Time(1.5), now, now + ros::Duration(3.0)})
    EXPECT_EQ(Received(IdAt(stamp)).stamp, stamp);
  contact_path_msgs::TracePathActionGoal goal;
  goal.goal_id = IdAt(now + ros::Duration(7200.0));
  goal.goal_id.id = std::string(256, 'x');
  EXPECT_EQ(Received(goal), goal);
}

// A cancel that would recall all goals of the next hours, and one at whose time actionlib's sums throw.
TEST(GoalIdTest, CancelsAreSetBackToFiveSecondsFromNow) {
  const ros::Time now = ros::Time::now();
  for (const ros::Time& stamp : {now + ros::Duration(7200.0), ros::TIME_MAX}) {
    const ros::Duration ahead = Received(IdAt(stamp)).stamp - now;
    EXPECT_GE(ahead.toSec(), 5.0);
    EXPECT_LT(ahead.toSec(), 10.0);
  }
}

TEST(GoalIdTest, GoalsHaveTimesThatCanBeAddedTo) {
  contact_path_msgs::TracePathActionGoal goal;
  goal.goal_id = IdAt(ros::TIME_MAX);
  EXPECT_NO_THROW(Received(goal).goal_id.stamp + ros::Duration(1e6));
}

TEST(GoalIdTest, LongIdsAreRefused) {
  actionlib_msgs::GoalID id;
  id.id = std::string(257, 'x');
  EXPECT_THROW(Received(id), std::runtime_error);
}

}  // namespace
}  // namespace contact_path::goal_id_test
