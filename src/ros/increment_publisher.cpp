#include "contact_path/ros/increment_publisher.h"

#include <algorithm>
#include <new>
#include <utility>

#include <ros/topic_manager.h>
#include <boost/make_shared.hpp>
#include <boost/shared_array.hpp>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

using Bytes = std::atomic<std::size_t>;
using Seconds = std::chrono::duration<double>;

constexpr Seconds kBatch{0.005};        // what one batch sends is sent in such a time
constexpr Seconds kAsk{0.01};           // between two questions whether a call is to wait longer
constexpr Seconds kPatience{1.0};       // with subscribers that do not read, once
constexpr std::size_t kOverhead = 256;  // memory of an increment besides its text on the wire [bytes]

// The increment as it is sent; it counts in `bytes` until the last subscriber has it.
ros::SerializedMessage Serialise(const contact_path_msgs::Increment& increment, const std::shared_ptr<Bytes>& bytes) {
  ros::SerializedMessage message = ros::serialization::serializeMessage(increment);
  const std::size_t size = message.num_bytes + kOverhead;
  *bytes += size;
  message.buf = boost::shared_array<std::uint8_t>(
      message.buf.get(), [kept = message.buf, size, bytes](const std::uint8_t*) { *bytes -= size; });
  return message;
}

// How long it takes to send so much at a rate; a rate of 0 is no bound.
Seconds TimeFor(std::size_t amount, double per_second) {
  return Seconds(per_second > 0.0 ? static_cast<double>(amount) / per_second : 0.0);
}

}  // namespace

IncrementPublisher::IncrementPublisher(ros::NodeHandle node, const StreamOptions& options)
    : request_publisher_(node.advertise<contact_path_msgs::TraceRequest>(names::kRequest, 1, /*latch=*/true)),
      publisher_(node.advertise<contact_path_msgs::Increment>(names::kIncrements, options.queue)),
      options_(options),
      thread_([this] { Run(); }) {}

IncrementPublisher::~IncrementPublisher() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  filled_.notify_all();
  thread_.join();
}

void IncrementPublisher::PublishRequest(const contact_path_msgs::TraceRequest& request) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (queue_.empty()) {
    request_publisher_.publish(request);
  } else {
    queue_.push_back({ros::SerializedMessage(), boost::make_shared<const contact_path_msgs::TraceRequest>(request)});
  }
}

void IncrementPublisher::Publish(const contact_path_msgs::Increment& increment, const Interrupted& interrupted) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (queue_.empty() && publisher_.getNumSubscribers() == 0) {
    Skip();
    return;
  }
  const auto has_room = [this] { return *bytes_ <= options_.most_bytes; };
  const auto patient_until = std::chrono::steady_clock::now() + (stuck_ ? Seconds(0.0) : kPatience);
  WaitUntil([&] { return has_room() || (queue_.empty() && std::chrono::steady_clock::now() >= patient_until); },
            interrupted, &lock);
  stuck_ = queue_.empty() && !has_room();
  if (stuck_) {
    Skip();
    ++left_out_;
    return;
  }
  lock.unlock();
  ros::SerializedMessage message = Serialise(increment, bytes_);
  lock.lock();
  queue_.push_back({std::move(message), nullptr});
  if (queue_.size() == 1) filled_.notify_one();
}

void IncrementPublisher::Flush(const Interrupted& interrupted) {
  std::unique_lock<std::mutex> lock(mutex_);
  WaitUntil([this] { return queue_.empty(); }, interrupted, &lock);
}

std::size_t IncrementPublisher::Discard() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t count = 0;
  for (const Entry& entry : queue_) {
    if (entry.request) {
      Send(entry);
    } else {
      Skip();
      ++count;
    }
  }
  queue_.clear();
  return count;
}

bool IncrementPublisher::IsSending() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !queue_.empty();
}

std::size_t IncrementPublisher::TakeLeftOut() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(left_out_, 0);
}

void IncrementPublisher::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    filled_.wait(lock, [this] { return ending_ || !queue_.empty(); });
    if (ending_) return;
    Seconds pause(0.0);
    while (!queue_.empty() && pause < kBatch) {
      const Entry entry = std::move(queue_.front());
      queue_.pop_front();
      pause += Send(entry);
    }
    emptied_.notify_all();
    // No batch makes up for one that was late: a machine that is busy is so for the subscribers, too.
    filled_.wait_for(lock, pause, [this] { return ending_; });
  }
}

IncrementPublisher::Seconds IncrementPublisher::Send(const Entry& entry) {
  try {
    if (entry.request) {
      request_publisher_.publish(entry.request);
      return Seconds(0.0);
    }
    if (publisher_.getNumSubscribers() == 0) {
      Skip();
      return Seconds(0.0);
    }
    // ros::Publisher does the same, with a buffer that cannot be watched.
    ros::SerializedMessage sent;
    ros::TopicManager::instance()->publish(
        publisher_.getTopic(), [&entry] { return entry.increment; }, sent);
  } catch (const std::bad_alloc&) {
    if (entry.request) return Seconds(0.0);
    Skip();
    ++left_out_;
  }
  return std::max(TimeFor(1, options_.per_second), TimeFor(entry.increment.num_bytes, options_.bytes_per_second));
}

void IncrementPublisher::Skip() { ros::TopicManager::instance()->incrementSequence(publisher_.getTopic()); }

void IncrementPublisher::WaitUntil(const std::function<bool()>& condition, const Interrupted& interrupted,
                                   std::unique_lock<std::mutex>* lock) {
  while (!condition()) {
    lock->unlock();
    const bool enough = interrupted();
    lock->lock();
    if (enough) return;
    emptied_.wait_for(*lock, kAsk);
  }
}

}  // namespace contact_path
