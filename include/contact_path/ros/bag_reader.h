// Reads traces back from their bags, to look at them or to go on with them.
#ifndef CONTACT_PATH_ROS_BAG_READER_H_
#define CONTACT_PATH_ROS_BAG_READER_H_

#include <filesystem>
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

// The only trace in a bag, whose increments, from increment 0, the bag proves. Throws std::runtime_error, one line, for
// a bag that cannot be read or holds several traces, and for one whose increments are not proved (verify/). `cancelled`
// is asked often: true throws ReadingCancelled. It may be empty.
RecordedTrace ReadTraceSoFar(const std::string& bag, const std::function<bool()>& cancelled);

// The same for a request of the node that names a bag to resume: a file in `directory`, by its plain name. The limit of
// the number of increments is the request's if it has one. Throws InvalidRequest (scene/validate.h) for any other name,
// for a bag as above, and for a request that also has a scene, a program or other options.
RecordedTrace ReadTraceSoFar(const std::filesystem::path& directory, const contact_path_msgs::TraceRequest& request,
                             const std::function<bool()>& cancelled);

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BAG_READER_H_
