// Reads a trace back from its bag.
#ifndef CONTACT_PATH_ROS_BAG_READER_H_
#define CONTACT_PATH_ROS_BAG_READER_H_

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/ros/messages.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// The caller wanted no more of a bag; what() is one line for a person.
class ReadingCancelled : public std::runtime_error {
 public:
  explicit ReadingCancelled(const std::string& file)
      : std::runtime_error("cancelled: the caller asked for it while " + file + " was read") {}
};

struct RecordedTrace {
  TraceRequest request;                                  // valid
  std::vector<Increment> increments;                     // in the order of the bag
  std::optional<contact_path_msgs::TraceResult> result;  // none: the trace did not come to its end
};

// All traces in a bag, in its order: `rosbag record` may have been there for several. A request of which nothing
// followed, as the latched one of the trace before, is left out if there is another. Throws BagError (bag_recorder.h),
// one line for a person: for a file that is no bag, a bag without index (its node was killed; `rosbag reindex` mends
// it), a bag without a trace, a request that is not valid, and a message that cannot be read. `cancelled` is asked
// before each message: true throws ReadingCancelled. It may be empty.
std::vector<RecordedTrace> ReadTraces(const std::string& file, const std::function<bool()>& cancelled = {});

// The only trace in a bag. Throws BagError where there are several, too.
RecordedTrace ReadTrace(const std::string& file, const std::function<bool()>& cancelled = {});

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BAG_READER_H_
