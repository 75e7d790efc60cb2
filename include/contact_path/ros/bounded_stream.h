// Requests are read from the wire by a stream that believes no length.
//
// The stream of roscpp makes room for as many parts as a list says it has before it reads the first of them, so that a
// request of a few bytes could take all memory. Included by messages.h, for all who read requests.
#ifndef CONTACT_PATH_ROS_BOUNDED_STREAM_H_
#define CONTACT_PATH_ROS_BOUNDED_STREAM_H_

#include <cstdint>
#include <vector>

#include <ros/serialization.h>

namespace contact_path {

// Names are those that roscpp's serializers call.
class BoundedStream {
 public:
  static const ros::serialization::StreamType stream_type = ros::serialization::stream_types::Input;

  explicit BoundedStream(ros::serialization::IStream* in) : in_(*in) {}

  template <typename Value>
  void next(Value& value) {
    ros::serialization::deserialize(*this, value);
  }
  // Throws StreamOverrunException where the rest of the message is too short for the list.
  template <typename Part>
  void next(std::vector<Part>& list) {
    std::uint32_t size = 0;
    next(size);
    if (size > getLength() / ros::serialization::serializationLength(Part())) ros::serialization::throwStreamOverrun();
    list.resize(size);
    for (Part& part : list) next(part);
  }

  std::uint8_t* advance(std::uint32_t size) {
    if (size > getLength()) ros::serialization::throwStreamOverrun();
    return in_.advance(size);
  }
  std::uint32_t getLength() { return in_.getLength(); }

 private:
  ros::serialization::IStream& in_;
};

// For messages with the fields of a request.
template <typename Request>
struct RequestSerializer {
  static void read(ros::serialization::IStream& stream, Request& request) {
    BoundedStream bounded(&stream);
    AllInOne<BoundedStream, Request&>(bounded, request);
  }
  template <typename Stream>
  static void write(Stream& stream, const Request& request) {
    AllInOne<Stream, const Request&>(stream, request);
  }
  static std::uint32_t serializedLength(const Request& request) {
    ros::serialization::LStream stream;
    AllInOne<ros::serialization::LStream, const Request&>(stream, request);
    return stream.getLength();
  }

 private:
  template <typename Stream, typename Message>
  static void AllInOne(Stream& stream, Message message) {
    stream.next(message.scene);
    stream.next(message.options);
    stream.next(message.program);
    stream.next(message.resume);
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BOUNDED_STREAM_H_
