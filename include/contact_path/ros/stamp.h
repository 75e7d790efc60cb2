// Time stamps of messages and of bag entries.
#ifndef CONTACT_PATH_ROS_STAMP_H_
#define CONTACT_PATH_ROS_STAMP_H_

#include <ros/time.h>

namespace contact_path {

// ROS time; wall time as long as a simulated clock has not started, since bags refuse time zero.
inline ros::Time StampNow() {
  const ros::Time now = ros::Time::now();
  if (!now.isZero()) return now;
  const ros::WallTime wall = ros::WallTime::now();
  return ros::Time(wall.sec, wall.nsec);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_STAMP_H_
