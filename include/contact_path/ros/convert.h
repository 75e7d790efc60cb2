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
TraceRequest FromMessage(const contact_path_msgs::Scene& scene, const contact_path_msgs::TraceOptions& options,
                         const std::vector<contact_path_msgs::Stage>& program);

// Words are written out, also where they are the default.
contact_path_msgs::TraceRequest ToMessage(const TraceRequest& request);

// The same fields.
contact_path_msgs::TraceRequest ToRequest(const contact_path_msgs::TracePathRequest& request);
contact_path_msgs::TraceRequest ToRequest(const contact_path_msgs::TracePathGoal& goal);

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

// The same fields.
contact_path_msgs::TraceResult ToResult(const contact_path_msgs::TracePathResponse& response);
contact_path_msgs::TracePathResult ToActionResult(const contact_path_msgs::TracePathResponse& response);

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_CONVERT_H_
