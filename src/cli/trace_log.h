// A trace as JSON lines, for programs that read it.
#ifndef CONTACT_PATH_SRC_CLI_TRACE_LOG_H_
#define CONTACT_PATH_SRC_CLI_TRACE_LOG_H_

#include <ostream>
#include <string>

#include "contact_path/branch/trial_step.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// One object a line, doubles in the digits that tell them apart, each line written as soon as it is known. A number
// that is not finite is null. docs/log.md describes the fields.
class TraceLog {
 public:
  // `out` must outlive the log. request: expanded.
  TraceLog(const TraceRequest& request, std::ostream* out);

  void Add(const TrialStep& trial);
  // An event follows the increment where branches part.
  void Add(const Increment& increment);
  // summary: of the path, in one line for a person.
  void End(const TraceResult& result, const std::string& summary);

 private:
  std::ostream& out_;
  bool landing_checks_;
};

// 64 bits of FNV-1a over the request in the form in which it is written, as 16 hexadecimal digits.
std::string HashOf(const TraceRequest& request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_CLI_TRACE_LOG_H_
