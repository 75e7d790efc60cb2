#include "contact_path/ros/trace_service.h"

#include <algorithm>
#include <new>
#include <utility>

#include "contact_path/linear/blas.h"
#include "contact_path/path/end.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/ros/bag_reader.h"
#include "contact_path/ros/convert.h"
#include "contact_path/ros/memory_share.h"
#include "contact_path/ros/names.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kStatusPeriod{200};
constexpr std::chrono::milliseconds kMemoryPeriod{10};

constexpr char kShutDown[] = "the node is being shut down";

// A trace that is asked to end for its time has as much longer: a tenth of it, and so many seconds.
constexpr double kMoreTime = 0.1;
constexpr double kMoreSeconds = 10.0;

void Tell(std::uint8_t status, const std::string& message, TraceService::Response* response) {
  response->status = status;
  response->message = message;
}

void TellEnd(std::uint8_t end_reason, const std::string& message, TraceService::Response* response) {
  Tell(TraceService::Response::ENDED_EARLY, message, response);
  response->end_reason = end_reason;
}

std::string MemoryText(const TraceLimits& limits) {
  return "the node admits " + std::to_string(limits.max_memory) + " MB of memory (~" + names::kMaxMemory + ")";
}

StreamOptions StreamOptionsOf(const NodeParameters& parameters) {
  StreamOptions options;
  options.queue = static_cast<std::uint32_t>(parameters.increments_queue);
  options.most_bytes = static_cast<std::size_t>(parameters.increments_megabytes) * kMegabyte;
  // Of the memory that the node may take, increments that wait take a quarter at most.
  if (parameters.limits.max_memory > 0)
    options.most_bytes =
        std::min(options.most_bytes, static_cast<std::size_t>(parameters.limits.max_memory) * kMegabyte / 4);
  options.per_second = parameters.increments_per_second;
  options.bytes_per_second = parameters.increments_megabytes_per_second * static_cast<double>(kMegabyte);
  return options;
}

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

TraceService::TraceService(ros::NodeHandle private_node, const NodeParameters& parameters)
    : parameters_(parameters),
      topic_prefix_(private_node.getNamespace()),
      increments_publisher_(private_node, StreamOptionsOf(parameters)) {
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
    Tell(Response::SHUTTING_DOWN, kShutDown, response);
    return false;
  }
  if (running_) {
    const std::string work = streaming_ ? "sending the last increments of" : "tracing";
    Tell(Response::BUSY, "the node is " + work + " \"" + running_scene_ + "\": call ~cancel or wait for its end",
         response);
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
    } catch (const LimitExceeded& error) {
      Tell(Response::LIMIT_EXCEEDED, error.what(), response);
    } catch (const InvalidRequest& error) {
      Tell(Response::INVALID_REQUEST, error.what(), response);
    } catch (const BagError& error) {
      Tell(Response::BAG_FAILED, error.what(), response);
    } catch (const ReadingCancelled&) {
      TellStop("the caller asked for it while the bag to resume was read", response);
      response->end_reason_name = EndReasonName(response->end_reason);
    } catch (const std::bad_alloc&) {
      Tell(Response::LIMIT_EXCEEDED, MemoryText(parameters_.limits), response);
    } catch (const std::exception& error) {
      Tell(Response::FAILED, error.what(), response);
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
    const std::string scene = '"' + running_scene_ + '"';
    response.message = streaming_ ? "the caller is answered now; the last increments of " + scene + " are still sent"
                                  : "cancelling the trace of " + scene;
    return true;
  }
  const std::size_t dropped = increments_publisher_.Discard();
  response.success = dropped > 0;
  response.message = "no trace is running";
  if (dropped > 0)
    response.message += "; " + std::to_string(dropped) + " increments that were still to be sent are dropped";
  return true;
}

void TraceService::Serve(contact_path_msgs::TraceRequest asked, const TraceObserver& observer, Response* response) {
  const Job job = Accept(std::move(asked), observer);
  BagRecorder bag(parameters_.bag_directory, job.message.scene.name, topic_prefix_,
                  static_cast<std::size_t>(parameters_.limits.keep_free) * kMegabyte);
  bag.WriteRequest(job.message);
  response->bag = bag.file_name();
  Announce(job, bag, observer);
  RunTrace(job, observer, &bag, response);
  response->increments = status_.increments;
  response->end_reason_name = EndReasonName(response->end_reason);
  response->limit_points = ToMessages(summary_.limit_points());
  response->message = EndMessage(response->end_reason_name, response->message, summary_, response->bag);
  try {
    bag.WriteResult(ToResult<contact_path_msgs::TraceResult>(*response));
    bag.Close();
  } catch (const BagError& error) {
    if (response->status != Response::BAG_FAILED) Tell(Response::BAG_FAILED, error.what(), response);
  }
  WaitForStream(observer);
}

// Reads what is to be gone on with, and refuses what is too large or breaks a rule.
TraceService::Job TraceService::Accept(contact_path_msgs::TraceRequest asked, const TraceObserver& observer) {
  Job job;
  if (asked.resume.empty()) {
    job.message = std::move(asked);
  } else {
    RecordedTrace so_far = ReadTraceSoFar(parameters_.bag_directory, asked, [&] { return StopWanted(observer); });
    job.message = ToMessage(so_far.request);
    job.message.resume = asked.resume;
    job.so_far = std::move(so_far.increments);
  }
  CheckLimits(job.message, parameters_.limits);
  job.request = FromMessage(job.message);
  std::vector<Violation> violations = Validate(job.request);
  if (!violations.empty()) throw InvalidRequest(std::move(violations));
  return job;
}

void TraceService::Announce(const Job& job, const BagRecorder& bag, const TraceObserver& observer) {
  status_ = contact_path_msgs::TraceStatus();
  status_.state = contact_path_msgs::TraceStatus::RUNNING;
  status_.trace_id = bag.number();
  status_.scene = job.message.scene.name;
  status_.bag = bag.file_name();
  full_state_every_ = job.request.options.full_state_every;
  progress_.emplace(job.request);
  summary_ = PathSummary(ProgramScales(ExpandedRequest(job.request).Get()).load_factor);
  increments_publisher_.PublishRequest(job.message);
  PublishStatus();
  if (observer.on_start) observer.on_start();
  if (const std::string advice = BlasAdvice(job.request.scene.nodes.size()); !advice.empty())
    ROS_WARN_ONCE("%s", advice.c_str());
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

void TraceService::RunTrace(const Job& job, const TraceObserver& observer, BagRecorder* bag, Response* response) {
  TraceControl control;
  control.on_increment = [&](const Increment& increment) { TakeIncrement(increment, observer, bag); };
  control.cancelled = [&] { return StopWanted(observer); };
  control.mpec = MakeMpecMethod;
  const auto out_of_memory = [&] { TellEnd(Response::END_MEMORY_LIMIT, MemoryText(parameters_.limits), response); };
  try {
    const TraceResult result =
        job.so_far ? ResumeTrace(job.request, *job.so_far, control) : Trace(job.request, control);
    Tell(StatusOf(result), result.message, response);
    response->end_reason = ToConstant(result.reason);
    if (result.reason == EndReason::kMemoryLimit) out_of_memory();
    if (result.reason == EndReason::kCancelled) TellStop(result.message, response);
  } catch (const std::bad_alloc&) {
    out_of_memory();
  } catch (const BagError& error) {
    Tell(Response::BAG_FAILED, error.what(), response);
  } catch (const std::exception& error) {
    Tell(Response::FAILED, error.what(), response);
  }
}

void TraceService::TellStop(const std::string& cancelled, Response* response) const {
  const TraceLimits& limits = parameters_.limits;
  TellEnd(Response::END_CANCELLED, cancelled, response);
  if (stop_cause_ == StopCause::kTimeLimit)
    TellEnd(Response::END_TIME_LIMIT,
            "the node admits " + RoundedText(limits.max_seconds, 6) + " s (~" + names::kMaxSeconds + ")", response);
  if (stop_cause_ == StopCause::kMemoryLimit) TellEnd(Response::END_MEMORY_LIMIT, MemoryText(limits), response);
  if (stop_cause_ == StopCause::kShutdown) Tell(Response::SHUTTING_DOWN, kShutDown, response);
}

void TraceService::TakeIncrement(const Increment& increment, const TraceObserver& observer, BagRecorder* bag) {
  contact_path_msgs::Increment message = ToMessage(increment, full_state_every_);
  message.header.stamp = StampNow();
  // What the publisher makes of it on the wire: the recorded message is the one that subscribers get.
  message.header.seq = increments_published_;
  message.trace_id = status_.trace_id;
  bag->WriteIncrement(message);
  increments_publisher_.Publish(message, [&] { return StopWanted(observer); });
  ++increments_published_;

  ++status_.increments;
  status_.stage = static_cast<std::uint32_t>(increment.stage);
  status_.load_factor = increment.load_factor;
  status_.arc_length = increment.arc_length;
  status_.progress = progress_->Add(increment);
  summary_.Add(increment);
  if (Clock::now() - status_time_ >= kStatusPeriod) PublishStatus();
  if (observer.on_increment) observer.on_increment(FeedbackOn(message));
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
