// Messages as they come and go by a connection.
#ifndef CONTACT_PATH_TEST_ROS_BYTES_H_
#define CONTACT_PATH_TEST_ROS_BYTES_H_

#include <cstdint>
#include <vector>

#include <ros/serialization.h>

namespace contact_path {

template <typename Message>
std::vector<std::uint8_t> Bytes(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  return bytes;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_ROS_BYTES_H_
