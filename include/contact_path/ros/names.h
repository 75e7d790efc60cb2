// Names of the node, of what it offers and of its parameters. All but the node's are private to the node ("~").
#ifndef CONTACT_PATH_ROS_NAMES_H_
#define CONTACT_PATH_ROS_NAMES_H_

namespace contact_path {
namespace names {

inline constexpr char kNode[] = "contact_path";  // unless it is remapped

// Services.
inline constexpr char kTrace[] = "trace";    // TracePath
inline constexpr char kCancel[] = "cancel";  // std_srvs/Trigger

inline constexpr char kTraceAction[] = "trace_action";  // action TracePath

// Topics.
inline constexpr char kIncrements[] = "increments";  // Increment, also in the bags
inline constexpr char kStatus[] = "status";          // TraceStatus, latched

inline constexpr char kRequest[] = "request";  // TraceRequest, latched; the first message of a bag

// Topic of the bags only.
inline constexpr char kResult[] = "result";  // TraceResult, the last one

// Parameters (trace_service.h).
inline constexpr char kBagDirectory[] = "bag_directory";
inline constexpr char kIncrementsQueue[] = "increments_queue";
inline constexpr char kIncrementsMegabytes[] = "increments_megabytes";
inline constexpr char kIncrementsPerSecond[] = "increments_per_second";
inline constexpr char kIncrementsMegabytesPerSecond[] = "increments_megabytes_per_second";
inline constexpr char kMaxNodes[] = "max_nodes";
inline constexpr char kMaxElements[] = "max_elements";
inline constexpr char kMaxContacts[] = "max_contacts";
inline constexpr char kMaxIncrements[] = "max_increments";
inline constexpr char kMaxSeconds[] = "max_seconds";
inline constexpr char kMaxMemory[] = "max_memory_megabytes";
inline constexpr char kKeepFree[] = "keep_free_megabytes";

}  // namespace names
}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_NAMES_H_
