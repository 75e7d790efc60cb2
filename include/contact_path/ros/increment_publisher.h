// The topics `increments` and `request`.
#ifndef CONTACT_PATH_ROS_INCREMENT_PUBLISHER_H_
#define CONTACT_PATH_ROS_INCREMENT_PUBLISHER_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include <ros/ros.h>

#include "contact_path/ros/messages.h"

namespace contact_path {

struct StreamOptions {
  std::uint32_t queue = 1;        // increments that roscpp keeps for a slow subscriber, > 0; it drops the oldest beyond
  std::size_t most_bytes = 0;     // of all increments in memory, waiting here or in roscpp
  double per_second = 0.0;        // increments sent in a second, >= 0; 0: no bound
  double bytes_per_second = 0.0;  // of increments sent, >= 0; 0: no bound
};

// Sends the increments of one trace after the other in order, at a bounded pace, from a queue and on a thread of its
// own: subscribers do not slow a trace. The pace is for subscribers that drop what they cannot take at once, as
// `rosbag record` does, which keeps 100 messages of a topic. Increments are neither kept nor paced while nobody
// subscribes.
class IncrementPublisher {
 public:
  // Asked every few milliseconds while a call waits; true: the call waits no longer.
  using Interrupted = std::function<bool()>;

  IncrementPublisher(ros::NodeHandle node, const StreamOptions& options);
  ~IncrementPublisher();  // drops what waits
  IncrementPublisher(const IncrementPublisher&) = delete;
  IncrementPublisher& operator=(const IncrementPublisher&) = delete;

  // Takes the request of the next trace. It is sent after the increments that were taken before.
  void PublishRequest(const contact_path_msgs::TraceRequest& request);

  // Takes an increment. Where most_bytes wait, the call waits until the pace has made room. Where subscribers that do
  // not read leave no room for a second, the increment is left out on the topic, and so are those behind it, at once,
  // until there is room. By one thread at a time.
  void Publish(const contact_path_msgs::Increment& increment, const Interrupted& interrupted);

  // Waits until roscpp has every increment that was taken.
  void Flush(const Interrupted& interrupted);

  // Drops the increments that wait for their turn; their number.
  std::size_t Discard();

  // Whether anything waits for its turn.
  bool IsSending() const;

  // Number of increments left out since the last call.
  std::size_t TakeLeftOut();

 private:
  using Seconds = std::chrono::duration<double>;
  struct Entry {
    ros::SerializedMessage increment;
    contact_path_msgs::TraceRequest::ConstPtr request;  // null: an increment
  };

  void Run();                        // on the thread
  Seconds Send(const Entry& entry);  // the time that it has at the pace; mutex_ is held
  void Skip();                       // counts an increment that nobody gets in header.seq; mutex_ is held
  void WaitUntil(const std::function<bool()>& condition, const Interrupted& interrupted,
                 std::unique_lock<std::mutex>* lock);

  const ros::Publisher request_publisher_;
  const ros::Publisher publisher_;
  const StreamOptions options_;
  // Memory of serialised increments, also of those that roscpp holds; it may hold them longer than this lives.
  const std::shared_ptr<std::atomic<std::size_t>> bytes_ = std::make_shared<std::atomic<std::size_t>>(0);

  mutable std::mutex mutex_;  // guards all of these, and the order on the topic
  std::deque<Entry> queue_;
  std::size_t left_out_ = 0;
  bool stuck_ = false;  // the last increment was left out for want of room
  bool ending_ = false;
  std::condition_variable filled_;   // the queue was empty, or the end has come
  std::condition_variable emptied_;  // the queue is shorter

  std::thread thread_;  // last, so that it does not run before the rest is there
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_INCREMENT_PUBLISHER_H_
