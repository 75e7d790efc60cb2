// Reads messages without trusting the lengths in them.
//
// roscpp makes room for as many elements as an array says that it has before it looks whether they are there: four
// bytes of a message could take all memory. Here an array that says more than the rest of the message can hold is a
// ros::serialization::StreamOverrunException, which roscpp answers or logs as any message that is cut off.
#ifndef CONTACT_PATH_ROS_BOUNDED_STREAM_H_
#define CONTACT_PATH_ROS_BOUNDED_STREAM_H_

#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <vector>

#include <ros/serialization.h>

#include "contact_path/ros/memory_share.h"

namespace contact_path {

// As ros::serialization::IStream otherwise.
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

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BOUNDED_STREAM_H_
