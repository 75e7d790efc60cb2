// The action ~trace_action: TraceService for clients that want feedback, and a way to cancel what they asked for.
#ifndef CONTACT_PATH_ROS_TRACE_ACTION_H_
#define CONTACT_PATH_ROS_TRACE_ACTION_H_

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include <actionlib/server/action_server.h>
#include <ros/ros.h>

#include "contact_path/ros/messages.h"
#include "contact_path/ros/trace_service.h"

namespace contact_path {

// A goal is refused at once while a trace runs, whoever asked for that: hence not a SimpleActionServer, where a new
// goal takes the place of the running one. Goals come in one after the other, so that a callback that traced would keep
// the next one waiting instead of refusing it: goals are traced on a thread of their own.
//
// Ends of a goal: REJECTED nothing was traced; SUCCEEDED as asked for (OK); PREEMPTED cancelled, by a client or by
// ~cancel, what was accepted is kept; ABORTED any other end. RECALLED: cancelled before it was traced.
class TraceAction {
 public:
  // Feedback is kept for a slow subscriber as increments are. `service` must outlive this.
  TraceAction(const ros::NodeHandle& private_node, const NodeParameters& parameters, TraceService* service);
  ~TraceAction() { Finish(); }
  TraceAction(const TraceAction&) = delete;
  TraceAction& operator=(const TraceAction&) = delete;

  // Waits for the goal that is being traced and sends its result. No more goals may come in.
  void Finish();

 private:
  using Server = actionlib::ActionServer<contact_path_msgs::TracePathAction>;

  void TakeGoal(Server::GoalHandle goal);
  void Work();  // on the thread that traces
  void Trace(Server::GoalHandle goal);

  TraceService& service_;

  std::mutex mutex_;                            // guards the next two
  std::optional<Server::GoalHandle> admitted_;  // not yet taken by the thread that traces
  bool finishing_ = false;
  std::condition_variable changed_;  // either of them

  Server server_;
  std::thread thread_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_TRACE_ACTION_H_
