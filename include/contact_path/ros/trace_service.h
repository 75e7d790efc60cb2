// The node's traces: for the service ~trace, and for the action (trace_action.h). Streams increments and status, and
// records every trace.
#ifndef CONTACT_PATH_ROS_TRACE_SERVICE_H_
#define CONTACT_PATH_ROS_TRACE_SERVICE_H_

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include "contact_path/path/path_summary.h"
#include "contact_path/path/trace.h"
#include "contact_path/ros/bag_recorder.h"
#include "contact_path/ros/increment_publisher.h"
#include "contact_path/ros/messages.h"
#include "contact_path/ros/node_parameters.h"

namespace contact_path {

// What a trace is called before it runs: its scene, or the bag that it goes on with.
template <typename Request>
const std::string& NameOf(const Request& request) {
  return request.resume.empty() ? request.scene.name : request.resume;
}

// How the one who asked for a trace takes part besides the answer. Called on the thread that traces; each may be empty.
struct TraceObserver {
  std::function<void()> on_start;  // the request is sound and its bag is open
  std::function<void(const contact_path_msgs::TracePathFeedback&)> on_increment;
  std::function<bool()> cancelled;  // asked often; true ends the trace as ~cancel does
};

// Traces one request at a time, on the thread that asks for it: ~cancel and the refusal of further requests need
// threads besides it. No request, and no trouble with the bag, leaves it other than as an answer.
class TraceService {
 public:
  using Response = contact_path_msgs::TracePathResponse;

  TraceService(ros::NodeHandle private_node, const NodeParameters& parameters);

  // Takes the node for a trace of this scene. False where another one has it, or while shutting down: `response` tells.
  bool Admit(const std::string& scene_name, Response* response);

  // Traces what was admitted, and gives the node free, whatever happens. `request` is called once; it may throw.
  // `response->bag` is empty where nothing was traced.
  void Run(const std::function<contact_path_msgs::TraceRequest()>& request, const TraceObserver& observer,
           Response* response);

  // Refuses what comes from now on and asks the running trace to end; does not wait for it.
  void Shutdown();

  bool IsRunning();

  // Whether the running trace is far beyond its time: a single step of it takes so long, and steps cannot be
  // interrupted. Only the end of the process ends it.
  bool IsStuck();

  // Waits until the increments of traces that were cut short are sent, or dropped after so many seconds.
  void FinishStream(double seconds);

 private:
  using Request = contact_path_msgs::TracePathRequest;
  enum class StopCause { kNone, kCancel, kTimeLimit, kMemoryLimit, kShutdown };

  bool HandleTrace(Request& request, Response& response);
  bool HandleCancel(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  struct Job {
    contact_path_msgs::TraceRequest message;
    TraceRequest request;                          // the same
    std::optional<std::vector<Increment>> so_far;  // of the trace to go on with; nothing: from the start
  };
  // The steps of Serve() before the bag is open throw, for Run() to answer.
  void Serve(contact_path_msgs::TraceRequest asked, const TraceObserver& observer, Response* response);
  Job Accept(contact_path_msgs::TraceRequest asked, const TraceObserver& observer);
  void Announce(const Job& job, const BagRecorder& bag, const TraceObserver& observer);
  void RunTrace(const Job& job, const TraceObserver& observer, BagRecorder* bag, Response* response);
  void TakeIncrement(const Increment& increment, const TraceObserver& observer, BagRecorder* bag);
  contact_path_msgs::TracePathFeedback FeedbackOn(const contact_path_msgs::Increment& increment) const;
  void Log(const Response& response) const;
  void PublishStatus();
  void PublishEnd(const Response& response);

  void RequestStop(StopCause cause);  // the first cause stays
  // What was asked to stop. cancelled: the message where ~cancel asked.
  void TellStop(const std::string& cancelled, Response* response) const;
  bool StopWanted(const TraceObserver& observer);
  void WaitForStream(const TraceObserver& observer);  // until the last increment is sent, or the caller will not wait

  const NodeParameters parameters_;
  const std::string topic_prefix_;  // of the bags' topics: the name of the node
  IncrementPublisher increments_publisher_;
  ros::Publisher status_publisher_;

  std::mutex mutex_;  // guards the next five
  bool running_ = false;
  bool streaming_ = false;  // the running trace has ended, and its last increments are being sent
  std::chrono::steady_clock::time_point running_since_;
  bool shutting_down_ = false;
  std::string running_scene_;

  std::atomic<StopCause> stop_cause_{StopCause::kNone};
  std::atomic<bool> answer_at_once_{false};  // the increments that wait are sent afterwards

  // Of the thread that traces.
  contact_path_msgs::TraceStatus status_;
  std::chrono::steady_clock::time_point status_time_;
  std::chrono::steady_clock::time_point memory_time_;  // when it was looked at
  std::uint32_t increments_published_ = 0;
  int full_state_every_ = 0;  // as in the request
  std::optional<ProgressEstimate> progress_;
  PathSummary summary_{1.0};

  // Last, so that no call comes in before the rest is there.
  ros::ServiceServer trace_server_;
  ros::ServiceServer cancel_server_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_TRACE_SERVICE_H_
