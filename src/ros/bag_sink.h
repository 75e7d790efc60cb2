// Records a trace of the command-line program to a bag, as the node does.
#ifndef CONTACT_PATH_ROS_BAG_SINK_H_
#define CONTACT_PATH_ROS_BAG_SINK_H_

#include <cstdint>
#include <string>

#include <ros/time.h>

#include "contact_path/path/increment.h"
#include "contact_path/path/path_summary.h"
#include "contact_path/path/trace.h"
#include "contact_path/ros/bag_recorder.h"
#include "contact_path/ros/convert.h"
#include "contact_path/ros/names.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"

namespace contact_path {

class BagSink {
 public:
  // Creates `file`, overwriting one that is there, and writes the request. All functions throw
  // std::runtime_error, one line, where the bag cannot be written.
  BagSink(const std::string& file, const TraceRequest& request)
      : recorder_(file, std::string("/") + names::kNode),
        summary_(ProgramScales(ExpandedRequest(request).Get()).load_factor),
        full_state_every_(request.options.full_state_every) {
    ros::Time::init();  // wall time: there is no node here
    recorder_.WriteRequest(ToMessage(request));
  }

  void Add(const Increment& increment) {
    contact_path_msgs::Increment message = ToMessage(increment, full_state_every_);
    message.header.stamp = StampNow();
    message.header.seq = increments_++;
    recorder_.WriteIncrement(message);
    summary_.Add(increment);
  }

  // Writes the result and closes the bag.
  void End(const TraceResult& result) {
    contact_path_msgs::TraceResult message;
    message.status = StatusOf(result);
    message.increments = increments_;
    message.end_reason = ToConstant(result.reason);
    message.end_reason_name = EndReasonName(message.end_reason);
    message.bag = recorder_.file_name();
    message.message = EndMessage(message.end_reason_name, result.message, summary_, message.bag);
    message.limit_points = ToMessages(summary_.limit_points());
    recorder_.WriteResult(message);
    recorder_.Close();
  }

 private:
  BagRecorder recorder_;
  PathSummary summary_;
  int full_state_every_;
  std::uint32_t increments_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BAG_SINK_H_
