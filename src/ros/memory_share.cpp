#include "contact_path/ros/memory_share.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

constexpr double kMegabyte = 1024.0 * 1024.0;
constexpr double kLeast = 128.0;  // MB: what the stacks of the threads reserve, and a small trace

// The shadow memory of these counts as data: terabytes.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCountable = false;
#else
constexpr bool kCountable = true;
#endif

}  // namespace

double DataMegabytes() {
  if (!kCountable) return 0.0;
  // Pages: size, resident, shared, text, lib, data.
  std::ifstream pages("/proc/self/statm");
  double value = 0.0;
  for (int column = 0; column < 6; ++column) pages >> value;
  return value * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMegabyte;
}

void LimitData(int megabytes) {
  if (megabytes == 0 || !kCountable) return;
  const double used = DataMegabytes();
  if (used + kLeast > kShareOfTraces * megabytes) {
    throw std::invalid_argument("~" + std::string(names::kMaxMemory) + " = " + std::to_string(megabytes) +
                                ": the node itself takes " + std::to_string(static_cast<int>(used)) +
                                ", most of it reserved by the BLAS, and needs " +
                                std::to_string(static_cast<int>(kLeast)) + " besides");
  }
  struct rlimit limit {};
  bool done = ::getrlimit(RLIMIT_DATA, &limit) == 0;
  limit.rlim_cur = static_cast<rlim_t>(megabytes * kMegabyte);
  done = done && ::setrlimit(RLIMIT_DATA, &limit) == 0;
  if (!done)
    throw std::invalid_argument("~" + std::string(names::kMaxMemory) + ": " + std::generic_category().message(errno));
}

}  // namespace contact_path
