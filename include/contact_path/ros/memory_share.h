// How much memory the node may take.
#ifndef CONTACT_PATH_ROS_MEMORY_SHARE_H_
#define CONTACT_PATH_ROS_MEMORY_SHARE_H_

namespace contact_path {

// Data of this process, whether in memory or not [MB of 2^20 bytes]. 0 in a build with a sanitizer that reserves more
// than there is: then there is no limit either.
double DataMegabytes();
// Whether that, less what the allocator keeps free of earlier traces, is more.
bool TakesMoreThan(double megabytes);
// Gives what the allocator keeps free back to the system.
void ReturnFreeMemory();

// From now on the system refuses data beyond `megabytes` to threads WithinLimit: std::bad_alloc where more is asked
// for. Others, as those of roscpp, which a std::bad_alloc would end with the process, take what they need: messages
// have a limit of their own. 0: as much as there is. Throws std::invalid_argument where what is in use leaves too
// little for a small trace.
void LimitData(int megabytes);

// While it lives, the thread is held to the limit, which is anew what it was set to.
class WithinLimit {
 public:
  // 0: the limit stays as it is.
  explicit WithinLimit(int megabytes);
  ~WithinLimit();
  WithinLimit(const WithinLimit&) = delete;
  WithinLimit& operator=(const WithinLimit&) = delete;
};

// Of such a limit, as much as a trace may use before it is ended: what else the node does needs the rest.
constexpr double kShareOfTraces = 0.9;

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_MEMORY_SHARE_H_
