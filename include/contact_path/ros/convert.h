// Between messages and the data of the core: pure functions, field by field, nothing computed.
#ifndef CONTACT_PATH_ROS_CONVERT_H_
#define CONTACT_PATH_ROS_CONVERT_H_

#include <cstdint>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/path/path_summary.h"
#include "contact_path/path/trace.h"
#include "contact_path/ros/messages.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Throws InvalidRequest (scene/validate.h) for words that are not known, with keys such as "scene.bars[0].strain".
// Every other rule is left to Validate().
TraceRequest FromMessage(const contact_path_msgs::TraceRequest& message);

// Words are written out, also where they are the default.
contact_path_msgs::TraceRequest ToMessage(const TraceRequest& request);

// The same fields: of TracePathRequest, or of TracePathGoal.
template <typename Request>
contact_path_msgs::TraceRequest ToRequest(const Request& request) {
  contact_path_msgs::TraceRequest same;
  same.scene = request.scene;
  same.options = request.options;
  same.program = request.program;
  same.resume = request.resume;
  return same;
}

// Leaves `header` and `trace_id` to the caller. full_state_every: as in TraceOptions.
contact_path_msgs::Increment ToMessage(const Increment& increment, int full_state_every = 1);

// Drops `header`, `trace_id` and `complementarity_residual`, which follows from the other residuals.
// Throws std::invalid_argument for arrays of different lengths and for constants that are not known.
Increment FromMessage(const contact_path_msgs::Increment& message);

std::vector<contact_path_msgs::LimitPoint> ToMessages(const std::vector<CriticalPoint>& points);

// END_* of the response of TracePath.
std::uint8_t ToConstant(EndReason reason);

// "stop_criterion", ..., "time_limit", "memory_limit"; "" for END_NONE.
// Throws std::invalid_argument for a constant that is not known.
std::string EndReasonName(std::uint8_t end_reason);

// The field `message` of a trace that has a bag: "stop_criterion: b.x > 4.95; 98 increments; ...; bag 000001_bar.bag".
// name: as by EndReasonName(); why: one line.
std::string EndMessage(const std::string& name, const std::string& why, const PathSummary& path,
                       const std::string& bag);

// OK, ENDED_EARLY, or INVALID_REQUEST for a branch that does not exist.
std::uint8_t StatusOf(const TraceResult& result);

// The same fields, as TraceResult, or as TracePathResult.
template <typename Result>
Result ToResult(const contact_path_msgs::TracePathResponse& response) {
  Result result;
  result.status = response.status;
  result.message = response.message;
  result.increments = response.increments;
  result.end_reason = response.end_reason;
  result.end_reason_name = response.end_reason_name;
  result.bag = response.bag;
  result.limit_points = response.limit_points;
  return result;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_CONVERT_H_
