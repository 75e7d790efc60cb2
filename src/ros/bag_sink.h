// Records a trace of the command-line program to a bag, as the node does.
#ifndef CONTACT_PATH_ROS_BAG_SINK_H_
#define CONTACT_PATH_ROS_BAG_SINK_H_

#include <memory>
#include <string>

#include "contact_path/path/increment.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

class BagSink {
 public:
  // Creates `file`, overwriting one that is there, and writes the request. All functions throw
  // std::runtime_error, one line, where the bag cannot be written.
  BagSink(const std::string& file, const TraceRequest& request);
  ~BagSink();

  void Add(const Increment& increment);
  // Writes the result and closes the bag.
  void End(const TraceResult& result);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BAG_SINK_H_
