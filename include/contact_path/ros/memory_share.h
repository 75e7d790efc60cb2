// How much memory the node may take.
#ifndef CONTACT_PATH_ROS_MEMORY_SHARE_H_
#define CONTACT_PATH_ROS_MEMORY_SHARE_H_

#include <cstddef>

namespace contact_path {

constexpr std::size_t kMegabyte = std::size_t{1} << 20U;  // [bytes]

// Data of this process, whether in memory or not [MB]. 0 in a build with a sanitizer, which reserves terabytes: such a
// build has no limit either.
double DataMegabytes();
// Whether the data of this process, less the memory that the allocator keeps free, is more.
bool TakesMoreThan(double megabytes);
// Gives what the allocator keeps free back to the system.
void ReturnFreeMemory();

// From now on an allocation that takes the data of the process beyond `megabytes` throws std::bad_alloc in a thread
// WithinLimit. In all other threads, as of roscpp, a std::bad_alloc would end the process: there the limit is raised
// for the allocation. Messages have a limit of their own. megabytes = 0: no limit. Throws std::invalid_argument where
// the data in use leaves too little for a small trace.
void LimitData(int megabytes);

// While it lives, allocations of its thread are held to the limit; it first undoes what other threads raised.
class WithinLimit {
 public:
  // 0: the limit stays as it is.
  explicit WithinLimit(int megabytes);
  ~WithinLimit();
  WithinLimit(const WithinLimit&) = delete;
  WithinLimit& operator=(const WithinLimit&) = delete;
};

// The share of the limit that a trace may use before it is ended; the other work of the node needs the rest.
constexpr double kShareOfTraces = 0.9;

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_MEMORY_SHARE_H_
