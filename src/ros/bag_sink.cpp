#include "ros/bag_sink.h"

#include <ros/time.h>

#include "contact_path/path/path_summary.h"
#include "contact_path/ros/bag_recorder.h"
#include "contact_path/ros/convert.h"
#include "contact_path/ros/names.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"

namespace contact_path {

struct BagSink::Implementation {
  Implementation(const std::string& file, const TraceRequest& request)
      : recorder(file, std::string("/") + names::kNode),
        summary(ProgramScales(ExpandedRequest(request).Get()).load_factor) {}

  BagRecorder recorder;
  PathSummary summary;
  int full_state_every = 0;
  std::uint32_t increments = 0;
};

BagSink::BagSink(const std::string& file, const TraceRequest& request) {
  ros::Time::init();  // wall time: there is no node here
  implementation_ = std::make_unique<Implementation>(file, request);
  implementation_->full_state_every = request.options.full_state_every;
  implementation_->recorder.WriteRequest(ToMessage(request));
}

BagSink::~BagSink() = default;

void BagSink::Add(const Increment& increment) {
  contact_path_msgs::Increment message = ToMessage(increment, implementation_->full_state_every);
  message.header.stamp = StampNow();
  message.header.seq = implementation_->increments++;
  implementation_->recorder.WriteIncrement(message);
  implementation_->summary.Add(increment);
}

void BagSink::End(const TraceResult& result) {
  contact_path_msgs::TraceResult message;
  message.status = StatusOf(result);
  message.increments = implementation_->increments;
  message.end_reason = ToConstant(result.reason);
  message.end_reason_name = EndReasonName(message.end_reason);
  message.bag = implementation_->recorder.file_name();
  message.message = EndMessage(message.end_reason_name, result.message, implementation_->summary, message.bag);
  message.limit_points = ToMessages(implementation_->summary.limit_points());
  implementation_->recorder.WriteResult(message);
  implementation_->recorder.Close();
}

}  // namespace contact_path
