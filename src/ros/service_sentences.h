// What the node answers, besides the sentences about paths: EndText() puts in names and numbers.
#ifndef CONTACT_PATH_ROS_SERVICE_SENTENCES_H_
#define CONTACT_PATH_ROS_SERVICE_SENTENCES_H_

#include "contact_path/path/sentences.h"

namespace contact_path::sentences {

inline constexpr Sentence kShutDown = "the node is being shut down";
inline constexpr Sentence kBusyTracing = "the node is tracing \"<name>\": call ~cancel or wait for its end";
inline constexpr Sentence kBusySending =
    "the node is sending the last increments of \"<name>\": call ~cancel or wait for its end";
inline constexpr Sentence kCancelling = "cancelling the trace of \"<name>\"";
inline constexpr Sentence kAnsweredNow = "the caller is answered now; the last increments of \"<name>\" are still sent";
inline constexpr Sentence kNotRunning = "no trace is running";
inline constexpr Sentence kDropped = "no trace is running; <value> increments that were still to be sent are dropped";
inline constexpr Sentence kStoppedReading = "the caller asked for it while the bag to resume was read";
inline constexpr Sentence kAdmitsMemory = "the node admits <value> MB of memory (~<name>)";
inline constexpr Sentence kAdmitsTime = "the node admits <digits> s (~<name>)";

}  // namespace contact_path::sentences

#endif  // CONTACT_PATH_ROS_SERVICE_SENTENCES_H_
