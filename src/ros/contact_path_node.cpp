// The ROS node: reads its parameters and serves until it is told to stop. See trace_service.h and trace_action.h.
#include <csignal>
#include <ctime>
#include <exception>

#include <ros/ros.h>

#include "contact_path/ros/memory_share.h"
#include "contact_path/ros/names.h"
#include "contact_path/ros/trace_action.h"
#include "contact_path/ros/trace_service.h"
#include "process/process.h"

namespace {

// SIGINT and SIGTERM as something to wait for, in place of handlers that interrupt whatever runs. Blocks both in the
// calling thread and in all that it starts later: construct it before any other thread.
class ShutdownSignal {
 public:
  ShutdownSignal() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }

  // True as soon as one of the signals is there, false after `seconds` without.
  bool WaitFor(double seconds) const {
    timespec timeout{};
    timeout.tv_sec = static_cast<time_t>(seconds);
    timeout.tv_nsec = static_cast<long>(1e9 * (seconds - static_cast<double>(timeout.tv_sec)));
    return sigtimedwait(&signals_, nullptr, &timeout) > 0;
  }

 private:
  sigset_t signals_;
};

}  // namespace

int main(int argc, char** argv) {
  contact_path::UseOneThread(argv);
  const ShutdownSignal shutdown;
  std::signal(SIGXFSZ, SIG_IGN);  // a bag beyond a limit on the size of files is an error of writing
  ros::init(argc, argv, contact_path::names::kNode, ros::init_options::NoSigintHandler);
  while (!ros::master::check()) {
    if (shutdown.WaitFor(0.5)) return 0;
  }
  const ros::NodeHandle node("~");  // the log works as long as it lives
  try {
    const contact_path::NodeParameters parameters = contact_path::ReadParameters(node);
    contact_path::LimitData(parameters.limits.max_memory);
    contact_path::TraceService service(node, parameters);
    contact_path::TraceAction action(node, parameters, &service);
    ros::AsyncSpinner spinner(4);  // one thread traces for ~trace, three answer ~cancel and further requests
    spinner.start();
    ROS_INFO("ready: %s, bags in %s", node.resolveName(contact_path::names::kTrace).c_str(),
             parameters.bag_directory.c_str());
    while (ros::ok() && !shutdown.WaitFor(0.05)) {
      if (!service.IsStuck()) continue;
      ROS_FATAL("a step of the trace goes on far beyond ~%s: the node ends; `rosbag reindex` saves the bag",
                contact_path::names::kMaxSeconds);
      std::_Exit(1);
    }
    service.Shutdown();
    // The running trace ends after its step. Who does not want to wait for that sends another signal.
    while (service.IsRunning()) {
      if (!shutdown.WaitFor(0.05)) continue;
      ROS_FATAL("ended in the middle of a step; `rosbag reindex` saves the bag");
      std::_Exit(1);
    }
    spinner.stop();   // waits for its caller to be answered
    action.Finish();  // likewise
    // What is left of the stream of a trace that was just cut short has 0.3 s; the rest of a long one is dropped.
    service.FinishStream(0.3);
    // What was published is sent by a thread of roscpp that cannot be waited for. It needs far less than 0.1 s.
    ros::WallDuration(0.1).sleep();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
