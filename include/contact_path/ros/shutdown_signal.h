// SIGINT and SIGTERM as something to wait for, in place of handlers that interrupt whatever runs.
#ifndef CONTACT_PATH_ROS_SHUTDOWN_SIGNAL_H_
#define CONTACT_PATH_ROS_SHUTDOWN_SIGNAL_H_

#include <csignal>

namespace contact_path {

// Blocks both signals in the calling thread and in all that it starts later: construct it before any other thread.
class ShutdownSignal {
 public:
  ShutdownSignal();

  // True as soon as one of the signals is there, false after `seconds` without.
  bool WaitFor(double seconds) const;

 private:
  sigset_t signals_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_SHUTDOWN_SIGNAL_H_
