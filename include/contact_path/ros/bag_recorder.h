// Records one trace to one bag: first the request, then every increment in order, last the result. The request is
// marked as latched: `rosbag play` keeps it for subscribers that come late.
#ifndef CONTACT_PATH_ROS_BAG_RECORDER_H_
#define CONTACT_PATH_ROS_BAG_RECORDER_H_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <ros/time.h>

#include "contact_path/ros/messages.h"

namespace rosbag {
class Bag;
}

namespace contact_path {

// The bag cannot be created, written or closed; what() is one line for a person.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// `scene_name` as part of a file name: A-Z, a-z, 0-9, _ and - stay, any other byte becomes _; at most 64 characters;
// "scene" for an empty name.
std::string FileNamePart(const std::string& scene_name);

// A bag of the node is DIRECTORY/NUMBER_SCENE.bag: NUMBER has six digits or more and is one more than the largest in
// the directory, so that nothing is ever overwritten; SCENE is FileNamePart().
//
// Entries reach the file in chunks: the request at once, increments when there are 16 KiB of them or with the first one
// after a tenth of a second. After a crash the bag has no index; `rosbag reindex` restores every complete chunk. Not
// for use by several threads at a time.
class BagRecorder {
 public:
  // Room left on the file system so that the result and the index can always be written.
  static constexpr std::uintmax_t kDefaultReserve = std::uintmax_t{16} << 20U;  // [bytes]

  // Creates `directory` if it is missing. Topics are `topic_prefix` + "/request" and so on.
  // Throws BagError, also where less than `reserve` bytes are free.
  BagRecorder(const std::filesystem::path& directory, const std::string& scene_name, const std::string& topic_prefix,
              std::uintmax_t reserve = kDefaultReserve);
  // The bag is `file`, which is overwritten if it is there; its number is 0.
  BagRecorder(const std::filesystem::path& file, const std::string& topic_prefix);
  ~BagRecorder();  // closes; what goes wrong then is lost
  BagRecorder(const BagRecorder&) = delete;
  BagRecorder& operator=(const BagRecorder&) = delete;

  std::uint32_t number() const { return number_; }
  const std::string& file_name() const { return file_name_; }  // relative to the directory

  // Throw BagError; what was written before stays. All but the result also where the reserve would be touched.
  void WriteRequest(const contact_path_msgs::TraceRequest& request);
  void WriteIncrement(const contact_path_msgs::Increment& increment);
  void WriteResult(const contact_path_msgs::TraceResult& result);

  // Writes the index. Throws BagError. Nothing can be written after.
  void Close();

 private:
  using Clock = std::chrono::steady_clock;

  void Open();
  void CreateFile(const std::string& scene_name);  // an empty one; sets number_ and file_name_
  void CheckSpace() const;
  void EndChunk(std::uint32_t next_threshold);  // [bytes]
  template <typename Message>
  void Write(const char* topic, const Message& message, bool latched = false);

  std::filesystem::path directory_;
  std::string topic_prefix_;
  std::uintmax_t reserve_;
  std::uint32_t number_ = 0;
  std::string file_name_;
  ros::Time last_stamp_;
  Clock::time_point chunk_time_;  // when the last chunk ended
  std::size_t chunk_bytes_ = 0;   // in the one that is open
  std::uintmax_t whole_ = 0;      // of the file: whole chunks with their index [bytes]
  std::unique_ptr<rosbag::Bag> bag_;
};

// ROS time; wall time as long as a simulated clock has not started, since bags refuse time zero.
inline ros::Time StampNow() {
  const ros::Time now = ros::Time::now();
  if (!now.isZero()) return now;
  const ros::WallTime wall = ros::WallTime::now();
  return ros::Time(wall.sec, wall.nsec);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BAG_RECORDER_H_
