#include "contact_path/ros/trace_service.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boost/make_shared.hpp>

#include "contact_path/linear/blas.h"
#include "contact_path/ros/bag_reader.h"
#include "contact_path/ros/convert.h"
#include "contact_path/ros/memory_share.h"
#include "contact_path/ros/names.h"
#include "contact_path/ros/read_parameter.h"
#include "contact_path/ros/resume.h"
#include "contact_path/ros/stamp.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/one_line.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/validate.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kStatusPeriod{200};
constexpr std::chrono::milliseconds kMemoryPeriod{10};
constexpr std::size_t kMegabyte = std::size_t{1} << 20U;

// A trace that is asked to end for its time has as much longer: a tenth of it, and so many seconds.
constexpr double kMoreTime = 0.1;
constexpr double kMoreSeconds = 10.0;

// `path` with a leading ~ replaced by the home directory.
std::string ExpandHome(const std::string& path) {
  const char* const home = std::getenv("HOME");
  const bool at_home = path == "~" || path.rfind("~/", 0) == 0;
  return at_home && home != nullptr ? home + path.substr(1) : path;
}

std::string InSeconds(double seconds) {
  std::ostringstream text;
  text << seconds << " s";
  return text.str();
}

std::string MemoryLimitText(const TraceLimits& limits) {
  return "the node admits " + std::to_string(limits.max_memory) + " MB of memory (~" + names::kMaxMemory + ")";
}

// Of the megabytes that the node may take, increments that wait take a quarter at most.
constexpr std::size_t kShareOfIncrements = 4;

StreamOptions StreamOptionsOf(const NodeParameters& parameters) {
  StreamOptions options;
  options.queue = static_cast<std::uint32_t>(parameters.increments_queue);
  options.most_bytes = static_cast<std::size_t>(parameters.increments_megabytes) * kMegabyte;
  if (parameters.limits.max_memory > 0)
    options.most_bytes = std::min(
        options.most_bytes, static_cast<std::size_t>(parameters.limits.max_memory) * kMegabyte / kShareOfIncrements);
  options.per_second = parameters.increments_per_second;
  options.bytes_per_second = parameters.increments_megabytes_per_second * static_cast<double>(kMegabyte);
  return options;
}

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

NodeParameters ReadParameters(const ros::NodeHandle& private_node) {
  NodeParameters parameters;
  ReadParameter(private_node, names::kBagDirectory, "a string", &parameters.bag_directory);
  ReadParameter(private_node, names::kIncrementsQueue, "an integer", &parameters.increments_queue);
  ReadParameter(private_node, names::kIncrementsMegabytes, "an integer", &parameters.increments_megabytes);
  ReadParameter(private_node, names::kIncrementsPerSecond, "a number", &parameters.increments_per_second);
  ReadParameter(private_node, names::kIncrementsMegabytesPerSecond, "a number",
                &parameters.increments_megabytes_per_second);
  parameters.markers = ReadMarkerOptions(private_node);
  ReadParameter(private_node, names::kMaxNodes, "an integer", &parameters.limits.max_nodes);
  ReadParameter(private_node, names::kMaxElements, "an integer", &parameters.limits.max_elements);
  ReadParameter(private_node, names::kMaxContacts, "an integer", &parameters.limits.max_contacts);
  ReadParameter(private_node, names::kMaxIncrements, "an integer", &parameters.limits.max_increments);
  ReadParameter(private_node, names::kMaxSeconds, "a number", &parameters.limits.max_seconds);
  ReadParameter(private_node, names::kMaxMemory, "an integer", &parameters.limits.max_memory);
  ReadParameter(private_node, names::kKeepFree, "an integer", &parameters.limits.keep_free);

  if (parameters.bag_directory.empty()) {
    throw std::invalid_argument("~" + std::string(names::kBagDirectory) + " = \"\": must not be empty");
  }
  parameters.bag_directory = std::filesystem::absolute(ExpandHome(parameters.bag_directory)).string();
  for (const auto& [name, value] : {std::pair(names::kIncrementsQueue, parameters.increments_queue),
                                    std::pair(names::kIncrementsMegabytes, parameters.increments_megabytes)}) {
    if (value <= 0)
      throw std::invalid_argument("~" + std::string(name) + " = " + std::to_string(value) + ": must be > 0");
  }
  for (const auto& [name, value] :
       {std::pair(names::kIncrementsPerSecond, parameters.increments_per_second),
        std::pair(names::kIncrementsMegabytesPerSecond, parameters.increments_megabytes_per_second)}) {
    if (!(value >= 0.0) || std::isinf(value)) {
      throw std::invalid_argument("~" + std::string(name) + " = " + std::to_string(value) +
                                  ": must be finite and >= 0");
    }
  }
  parameters.limits.Validate();
  return parameters;
}

TraceService::TraceService(ros::NodeHandle private_node, const NodeParameters& parameters)
    : parameters_(parameters),
      topic_prefix_(private_node.getNamespace()),
      increments_publisher_(private_node, StreamOptionsOf(parameters)),
      markers_(private_node, parameters.markers) {
  status_publisher_ = private_node.advertise<contact_path_msgs::TraceStatus>(names::kStatus, 10, /*latch=*/true);
  PublishStatus();
  trace_server_ = private_node.advertiseService(names::kTrace, &TraceService::HandleTrace, this);
  cancel_server_ = private_node.advertiseService(names::kCancel, &TraceService::HandleCancel, this);
}

void TraceService::Shutdown() {
  const std::lock_guard<std::mutex> lock(mutex_);
  shutting_down_ = true;
  RequestStop(StopCause::kShutdown);
  answer_at_once_ = true;
}

bool TraceService::IsRunning() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return running_;
}

bool TraceService::IsStuck() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double limit = parameters_.limits.max_seconds;
  return running_ && !streaming_ && limit > 0.0 &&
         SecondsSince(running_since_) > (1.0 + kMoreTime) * limit + kMoreSeconds;
}

void TraceService::FinishStream(double seconds) {
  const Clock::time_point start = Clock::now();
  increments_publisher_.Flush([&] { return !ros::ok() || SecondsSince(start) > seconds; });
  const std::size_t unsent = increments_publisher_.Discard();
  if (unsent > 0) ROS_WARN("%zu increments were not sent, for the node ends; the bag has them", unsent);
}

bool TraceService::Admit(const std::string& scene_name, Response* response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (shutting_down_) {
    response->status = Response::SHUTTING_DOWN;
    response->message = "the node is being shut down";
    return false;
  }
  if (running_) {
    response->status = Response::BUSY;
    response->message =
        std::string(streaming_ ? "the node is sending the last increments of \"" : "the node is tracing \"") +
        running_scene_ + "\": call ~cancel or wait for its end";
    return false;
  }
  running_scene_ = OneLine(scene_name);  // first: it may throw
  running_ = true;
  running_since_ = Clock::now();
  streaming_ = false;
  stop_cause_ = StopCause::kNone;
  answer_at_once_ = false;
  return true;
}

void TraceService::Run(const std::function<contact_path_msgs::TraceRequest()>& request, const TraceObserver& observer,
                       Response* response) {
  const WithinLimit within_limit(parameters_.limits.max_memory);
  // Where memory ends once more, in what follows, there is no message any more, but the node must become free.
  try {
    try {
      Serve(request(), observer, response);
    } catch (const std::bad_alloc&) {
      response->status = Response::LIMIT_EXCEEDED;
      response->message = MemoryLimitText(parameters_.limits);
    } catch (const std::exception& error) {
      response->status = Response::FAILED;
      response->message = error.what();
    }
    Log(*response);
  } catch (const std::exception&) {
    response->status = Response::FAILED;
  }

  // Whoever sees the status or the answer finds the node ready for the next request.
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    if (!response->bag.empty()) PublishEnd(*response);
  } catch (const std::exception&) {
    // The answer tells the end, too.
  }
  ReturnFreeMemory();
  running_ = false;
}

void TraceService::Log(const Response& response) const {
  if (response.status != Response::OK) {
    ROS_WARN("trace of \"%s\": %s", running_scene_.c_str(), response.message.c_str());
  } else {
    ROS_INFO("trace of \"%s\" to %s: %s", running_scene_.c_str(), response.bag.c_str(), response.message.c_str());
  }
}

bool TraceService::HandleTrace(Request& request, Response& response) {
  if (Admit(NameOf(request), &response)) Run([&] { return ToRequest(request); }, TraceObserver(), &response);
  return true;
}

bool TraceService::HandleCancel(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (running_) {
    RequestStop(StopCause::kCancel);
    answer_at_once_ = true;
    response.success = true;
    response.message =
        streaming_ ? "the caller is answered now; the last increments of \"" + running_scene_ + "\" are still sent"
                   : "cancelling the trace of \"" + running_scene_ + "\"";
    return true;
  }
  const std::size_t dropped = increments_publisher_.Discard();
  response.success = dropped > 0;
  response.message = "no trace is running";
  if (dropped > 0)
    response.message += "; " + std::to_string(dropped) + " increments that were still to be sent are dropped";
  return true;
}

void TraceService::Serve(const contact_path_msgs::TraceRequest& asked, const TraceObserver& observer,
                         Response* response) {
  std::optional<contact_path_msgs::TraceRequest> resumed;
  std::optional<std::vector<Increment>> increments;  // of the trace to go on with
  TraceRequest core_request;
  try {
    if (!asked.resume.empty()) {
      TraceSoFar so_far = ReadTraceSoFar(parameters_.bag_directory, asked, [&] { return StopWanted(observer); });
      resumed = ToMessage(so_far.request);
      resumed->resume = asked.resume;
      increments = std::move(so_far.increments);
    }
    const contact_path_msgs::TraceRequest& request = resumed ? *resumed : asked;
    const std::string exceeded = ExceededLimit(request.scene, request.options, request.program, parameters_.limits);
    if (!exceeded.empty()) {
      response->status = Response::LIMIT_EXCEEDED;
      response->message = exceeded;
      return;
    }
    core_request = FromMessage(request.scene, request.options, request.program);
    std::vector<Violation> violations = Validate(core_request);
    if (!violations.empty()) throw InvalidRequest(std::move(violations));
  } catch (const InvalidRequest& error) {
    response->status = Response::INVALID_REQUEST;
    response->message = error.what();
    return;
  } catch (const ReadingCancelled&) {
    response->message = "the caller asked for it while the bag to resume was read";
    TellStop(response);
    response->end_reason_name = EndReasonName(response->end_reason);
    return;
  }

  const contact_path_msgs::TraceRequest& request = resumed ? *resumed : asked;
  std::unique_ptr<BagRecorder> bag;
  try {
    bag = std::make_unique<BagRecorder>(parameters_.bag_directory, request.scene.name, topic_prefix_,
                                        static_cast<std::size_t>(parameters_.limits.keep_free) * kMegabyte);
    bag->WriteRequest(request);
  } catch (const BagError& error) {
    response->status = Response::BAG_FAILED;
    response->message = error.what();
    return;
  }
  response->bag = bag->file_name();

  status_ = contact_path_msgs::TraceStatus();
  status_.state = contact_path_msgs::TraceStatus::RUNNING;
  status_.trace_id = bag->number();
  status_.scene = request.scene.name;
  status_.bag = response->bag;
  increments_publisher_.PublishRequest(request);
  markers_.TakeRequest(core_request);
  PublishStatus();
  if (observer.on_start) observer.on_start();

  full_state_every_ = core_request.options.full_state_every;
  progress_.emplace(core_request);
  summary_ = PathSummary(ProgramScales(ExpandedRequest(core_request).Get()).load_factor);
  if (const std::string advice = BlasAdvice(core_request.scene.nodes.size()); !advice.empty())
    ROS_WARN_ONCE("%s", advice.c_str());
  RunTrace(core_request, increments, observer, bag.get(), response);
  response->increments = status_.increments;
  response->end_reason_name = EndReasonName(response->end_reason);
  response->limit_points = ToMessages(summary_.limit_points());
  response->message = EndMessage(response->end_reason_name, response->message, summary_, response->bag);
  try {
    markers_.Publish();  // who has the answer finds the last increment
  } catch (const std::exception& error) {
    ROS_ERROR("no picture of the last increment: %s", error.what());
  }
  try {
    bag->WriteResult(ToResult(*response));
    bag->Close();
  } catch (const BagError& error) {
    if (response->status != Response::BAG_FAILED) {
      response->status = Response::BAG_FAILED;
      response->message = error.what();
    }
  }
  WaitForStream(observer);
}

void TraceService::WaitForStream(const TraceObserver& observer) {
  if (increments_publisher_.IsSending() && !answer_at_once_) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      streaming_ = true;
    }
    PublishStatus();
    increments_publisher_.Flush(
        [&] { return answer_at_once_ || !ros::ok() || (observer.cancelled && observer.cancelled()); });
  }
  const std::size_t left_out = increments_publisher_.TakeLeftOut();
  if (left_out > 0)
    ROS_WARN("%zu increments were not sent: %d MB wait for subscribers that are too slow (~%s); the bag has them",
             left_out, parameters_.increments_megabytes, names::kIncrementsMegabytes);
}

void TraceService::RunTrace(const TraceRequest& request, const std::optional<std::vector<Increment>>& increments,
                            const TraceObserver& observer, BagRecorder* bag, Response* response) {
  TraceControl control;
  control.on_increment = [&](const Increment& increment) { TakeIncrement(increment, observer, bag); };
  control.cancelled = [&] { return StopWanted(observer); };
  try {
    const TraceResult result = increments ? ResumeTrace(request, *increments, control) : Trace(request, control);
    response->status = StatusOf(result.reason);
    response->end_reason = ToConstant(result.reason);
    response->message = result.message;
    if (result.reason == EndReason::kMemoryLimit) response->message = MemoryLimitText(parameters_.limits);
    if (result.reason == EndReason::kCancelled) TellStop(response);
  } catch (const std::bad_alloc&) {
    response->status = Response::ENDED_EARLY;
    response->end_reason = Response::END_MEMORY_LIMIT;
    response->message = MemoryLimitText(parameters_.limits);
  } catch (const BagError& error) {
    response->status = Response::BAG_FAILED;
    response->message = error.what();
  } catch (const std::exception& error) {
    response->status = Response::FAILED;
    response->message = error.what();
  }
}

void TraceService::TellStop(Response* response) const {
  response->status = Response::ENDED_EARLY;
  response->end_reason = Response::END_CANCELLED;
  if (stop_cause_ == StopCause::kTimeLimit) {
    response->end_reason = Response::END_TIME_LIMIT;
    response->message =
        "the node admits " + InSeconds(parameters_.limits.max_seconds) + " (~" + names::kMaxSeconds + ")";
  } else if (stop_cause_ == StopCause::kMemoryLimit) {
    response->end_reason = Response::END_MEMORY_LIMIT;
    response->message = MemoryLimitText(parameters_.limits);
  } else if (stop_cause_ == StopCause::kShutdown) {
    response->status = Response::SHUTTING_DOWN;
    response->message = "the node is being shut down";
  }
}

void TraceService::TakeIncrement(const Increment& increment, const TraceObserver& observer, BagRecorder* bag) {
  const auto message = boost::make_shared<contact_path_msgs::Increment>(ToMessage(increment, full_state_every_));
  message->header.stamp = StampNow();
  // What the publisher makes of it on the wire: the recorded message is the one that subscribers get.
  message->header.seq = increments_published_;
  message->trace_id = status_.trace_id;
  bag->WriteIncrement(*message);
  increments_publisher_.Publish(*message, [&] { return StopWanted(observer); });
  ++increments_published_;
  markers_.TakeIncrement(message);

  ++status_.increments;
  status_.stage = static_cast<std::uint32_t>(increment.stage);
  status_.load_factor = increment.load_factor;
  status_.arc_length = increment.arc_length;
  status_.progress = progress_->Add(increment);
  summary_.Add(increment);
  if (Clock::now() - status_time_ >= kStatusPeriod) PublishStatus();
  if (observer.on_increment) observer.on_increment(FeedbackOn(*message));
}

contact_path_msgs::TracePathFeedback TraceService::FeedbackOn(const contact_path_msgs::Increment& increment) const {
  contact_path_msgs::TracePathFeedback feedback;
  feedback.trace_id = increment.trace_id;
  feedback.index = increment.index;
  feedback.stage = increment.stage;
  feedback.load_factor = increment.load_factor;
  feedback.arc_length = increment.arc_length;
  feedback.kind = increment.kind;
  feedback.limit_points = static_cast<std::uint32_t>(summary_.limit_points().size());
  feedback.events = static_cast<std::uint32_t>(summary_.events());
  feedback.progress = status_.progress;
  return feedback;
}

void TraceService::PublishStatus() {
  status_.stamp = StampNow();
  status_publisher_.publish(status_);
  status_time_ = Clock::now();
}

void TraceService::PublishEnd(const Response& response) {
  status_.state = contact_path_msgs::TraceStatus::ENDED;
  status_.status = response.status;
  status_.end_reason = response.end_reason;
  status_.end_reason_name = response.end_reason_name;
  status_.message = response.message;
  PublishStatus();
}

void TraceService::RequestStop(StopCause cause) {
  StopCause none = StopCause::kNone;
  stop_cause_.compare_exchange_strong(none, cause);
}

bool TraceService::StopWanted(const TraceObserver& observer) {
  if (!ros::ok()) RequestStop(StopCause::kShutdown);
  if (observer.cancelled && observer.cancelled()) {
    RequestStop(StopCause::kCancel);
    answer_at_once_ = true;
  }
  const TraceLimits& limits = parameters_.limits;
  const Clock::time_point now = Clock::now();
  if (limits.max_seconds > 0.0 && SecondsSince(running_since_) > limits.max_seconds) RequestStop(StopCause::kTimeLimit);
  if (limits.max_memory > 0 && now - memory_time_ > kMemoryPeriod) {
    memory_time_ = now;
    if (TakesMoreThan(kShareOfTraces * limits.max_memory)) RequestStop(StopCause::kMemoryLimit);
  }
  return stop_cause_ != StopCause::kNone;
}

}  // namespace contact_path
