#include "contact_path/ros/shutdown_signal.h"

#include <ctime>

namespace contact_path {

ShutdownSignal::ShutdownSignal() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
}

bool ShutdownSignal::WaitFor(double seconds) const {
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(seconds);
  timeout.tv_nsec = static_cast<long>(1e9 * (seconds - static_cast<double>(timeout.tv_sec)));
  return sigtimedwait(&signals_, nullptr, &timeout) > 0;
}

}  // namespace contact_path
