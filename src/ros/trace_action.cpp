#include "contact_path/ros/trace_action.h"

#include <exception>

#include <actionlib_msgs/GoalStatus.h>

#include "contact_path/ros/convert.h"
#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

using Response = TraceService::Response;

constexpr char kQueueParameter[] = "actionlib_server_pub_queue_size";  // of actionlib, 50 by default

}  // namespace

TraceAction::TraceAction(const ros::NodeHandle& private_node, const NodeParameters& parameters, TraceService* service)
    : service_(*service),
      server_(
          private_node, names::kTraceAction, [this](const Server::GoalHandle& goal) { TakeGoal(goal); },
          // The goal says so itself: see Trace().
          [](const Server::GoalHandle& /*goal*/) {}, /*auto_start=*/false) {
  ros::NodeHandle(private_node, names::kTraceAction).setParam(kQueueParameter, parameters.increments_queue);
  server_.start();
  thread_ = std::thread([this] { Work(); });
}

void TraceAction::Finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    finishing_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void TraceAction::TakeGoal(Server::GoalHandle goal) {
  Response response;
  try {
    if (!service_.Admit(NameOf(*goal.getGoal()), &response)) {
      goal.setRejected(ToResult<contact_path_msgs::TracePathResult>(response), response.message);
      return;
    }
  } catch (const std::exception& error) {  // where memory ends
    ROS_ERROR("a goal is not taken: %s", error.what());
    return;
  }
  {
    // Empty: whoever was admitted before has been traced.
    const std::lock_guard<std::mutex> lock(mutex_);
    admitted_ = goal;
  }
  changed_.notify_one();
}

void TraceAction::Work() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return admitted_ || finishing_; });
    if (!admitted_) return;
    Server::GoalHandle goal = *admitted_;
    admitted_.reset();
    lock.unlock();
    try {
      Trace(goal);
    } catch (const std::exception& error) {  // where memory ends; the node is free again
      ROS_ERROR("a goal is left without an answer: %s", error.what());
    }
    lock.lock();
  }
}

void TraceAction::Trace(Server::GoalHandle goal) {
  Response response;
  bool accepted = false;
  TraceObserver observer;
  observer.on_start = [&] {
    goal.setAccepted();
    accepted = true;
  };
  observer.on_increment = [&](const contact_path_msgs::TracePathFeedback& feedback) { goal.publishFeedback(feedback); };
  // RECALLING: asked for while the goal is still being checked. It is accepted then as one that is to be preempted.
  observer.cancelled = [&] {
    const std::uint8_t status = goal.getGoalStatus().status;
    return status == actionlib_msgs::GoalStatus::PREEMPTING || status == actionlib_msgs::GoalStatus::RECALLING;
  };
  service_.Run([&] { return ToRequest(*goal.getGoal()); }, observer, &response);

  const auto result = ToResult<contact_path_msgs::TracePathResult>(response);
  if (response.status == Response::ENDED_EARLY && response.end_reason == Response::END_CANCELLED) {
    goal.setCanceled(result, response.message);
  } else if (!accepted) {
    goal.setRejected(result, response.message);
  } else if (response.status == Response::OK) {
    goal.setSucceeded(result, response.message);
  } else {
    goal.setAborted(result, response.message);
  }
}

}  // namespace contact_path
