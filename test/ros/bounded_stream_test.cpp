#include "contact_path/ros/messages.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "bytes.h"

namespace contact_path::bounded_stream_test {
namespace {

namespace msgs = contact_path_msgs;
namespace ser = ros::serialization;

// As roscpp reads what comes in.
template <typename Message>
Message Read(std::vector<std::uint8_t> bytes) {
  ser::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  Message message;
  ser::deserialize(stream, message);
  return message;
}

msgs::TracePathRequest SmallRequest() {
  msgs::TracePathRequest request;
  request.scene.name = "small";
  request.scene.nodes.resize(2);
  request.scene.nodes[1].name = "b";
  request.scene.superelements.resize(1);
  request.scene.superelements[0].nodes = {"a", "", "b"};
  request.scene.superelements[0].stiffness = {1.0, 2.0, 3.0};
  request.program.resize(3);
  request.program[2].loads.resize(1);
  request.resume = "end";
  return request;
}

TEST(BoundedStreamTest, ReadsWhatWasWritten) {
  const std::vector<std::uint8_t> bytes = Bytes(SmallRequest());
  EXPECT_EQ(Bytes(Read<msgs::TracePathRequest>(bytes)), bytes);
  msgs::TracePathActionGoal goal;
  goal.goal_id.id = "goal";
  goal.goal.scene = SmallRequest().scene;
  EXPECT_EQ(Bytes(Read<msgs::TracePathActionGoal>(Bytes(goal))), Bytes(goal));
  msgs::Increment increment;
  increment.x = {1.0, 2.0};
  increment.event.branches.resize(2);
  increment.event.branches[1].states = {1, 2, 3};
  EXPECT_EQ(Bytes(Read<msgs::Increment>(Bytes(increment))), Bytes(increment));
}

TEST(BoundedStreamTest, RefusesWhatIsCutOffAnywhere) {
  const std::vector<std::uint8_t> bytes = Bytes(SmallRequest());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::uint8_t> part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(Read<msgs::TracePathRequest>(part), ser::StreamOverrunException) << size;
  }
}

// Whatever four bytes of a message say, room is made for no more than the message can hold.
TEST(BoundedStreamTest, MakesNoRoomForWhatIsNotThere) {
  const std::vector<std::uint8_t> bytes = Bytes(SmallRequest());
  for (const std::uint32_t lie : {0xFFFFFFFFU, 0x20000001U, 0x10000000U, 1000000U}) {
    for (std::size_t place = 0; place + sizeof(lie) <= bytes.size(); ++place) {
      std::vector<std::uint8_t> changed = bytes;
      std::memcpy(&changed[place], &lie, sizeof(lie));
      try {
        // Numbers and characters may be anything.
        const auto request = Read<msgs::TracePathRequest>(changed);
        EXPECT_LE(request.scene.nodes.size() + request.program.size() + request.scene.superelements.size(), 6U);
        for (const auto& part : request.scene.superelements) EXPECT_LE(part.stiffness.capacity(), bytes.size());
      } catch (const ser::StreamOverrunException&) {
        SUCCEED();
      }
    }
  }
}

}  // namespace
}  // namespace contact_path::bounded_stream_test
