#include "contact_path/ros/bounded_stream.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "contact_path/ros/messages.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;

// A list of each kind, none of them empty.
template <typename Request>
Request FullRequest() {
  Request request;
  request.scene.name = "full";
  request.scene.nodes.resize(2);
  request.scene.nodes[1].name = "b";
  request.scene.bars.resize(1);
  request.scene.bars[0].nodes = {"a", "b"};
  request.scene.superelements.resize(1);
  request.scene.superelements[0].nodes = {"b"};
  request.scene.superelements[0].stiffness = {1.0, 2.0, 2.0, 3.0};
  request.scene.superelements[0].rest_positions = {4.0, 5.0};
  request.scene.loads.resize(1);
  request.scene.obstacles.resize(1);
  request.scene.contacts.resize(1);
  request.scene.support_motions.resize(1);
  request.scene.obstacle_motions.resize(1);
  request.options.stop.resize(1);
  request.options.branch_choices.resize(1);
  request.program.resize(1);
  request.program[0].loads.resize(1);
  request.program[0].support_motions.resize(1);
  request.program[0].obstacle_motions.resize(1);
  request.resume = "000001_full.bag";
  return request;
}

template <typename Message>
std::vector<std::uint8_t> Bytes(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  return bytes;
}

template <typename Message>
Message Read(std::vector<std::uint8_t> bytes) {
  Message message;
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, message);
  return message;
}

long LargestMemory() {  // [KiB], so far
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

template <typename Request>
class BoundedStreamTest : public testing::Test {};
using Requests = testing::Types<msgs::TracePathRequest, msgs::TracePathGoal, msgs::TraceRequest>;
TYPED_TEST_SUITE(BoundedStreamTest, Requests);

TYPED_TEST(BoundedStreamTest, ReadsWhatWasWritten) {
  const std::vector<std::uint8_t> bytes = Bytes(FullRequest<TypeParam>());
  EXPECT_EQ(Bytes(Read<TypeParam>(bytes)), bytes);
}

TYPED_TEST(BoundedStreamTest, RefusesWhatIsCutOff) {
  std::vector<std::uint8_t> bytes = Bytes(FullRequest<TypeParam>());
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_THROW(Read<TypeParam>(bytes), ros::serialization::StreamOverrunException) << bytes.size();
  }
}

// Four bytes anywhere, lengths of lists among them, replaced by a large number: with 16 million parts a list would take
// hundreds of MiB before anything of it is read; 2^29 + 1 numbers have 8 bytes, by 32 bits.
TYPED_TEST(BoundedStreamTest, TakesNoMoreRoomThanTheMessage) {
  constexpr long kRoom = 32 * 1024;  // [KiB]
  const std::vector<std::uint8_t> bytes = Bytes(FullRequest<TypeParam>());
  const long before = LargestMemory();
  int refused = 0;
  for (const std::uint32_t length :
       {std::uint32_t{1} << 24U, (std::uint32_t{1} << 29U) + 1U, std::numeric_limits<std::uint32_t>::max()}) {
    for (std::size_t at = 0; at + sizeof(length) <= bytes.size(); ++at) {
      std::vector<std::uint8_t> forged = bytes;
      std::memcpy(&forged[at], &length, sizeof(length));
      try {
        Read<TypeParam>(forged);
      } catch (const ros::serialization::StreamOverrunException&) {
        ++refused;
      }
    }
  }
  EXPECT_GE(refused, 3 * 19);  // lists
  EXPECT_LE(LargestMemory() - before, kRoom);
}

}  // namespace
}  // namespace contact_path
