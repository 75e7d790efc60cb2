// Bytes as a scene file: it is read, or refused with lines that tell where and why. What was read is valid, and is the
// same after it was written and read again.
#include <algorithm>

#include "contact_path/scene/read_scene.h"
#include "fuzz/target.h"
#include "support/same_request.h"

namespace contact_path {
namespace {

void CheckRefusal(const std::string& text, const std::vector<Violation>& violations) {
  Require(!violations.empty(), "a refused file breaks a rule");
  RequireLines(violations);
  const auto ends = std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
  for (const Violation& violation : violations) {
    Require(violation.file == "scene.yaml" && !violation.rule.empty(), "a violation names the file and the rule");
    Require(violation.line >= 0 && violation.line <= static_cast<int>(ends) + 1, "a violation stands in the file");
  }
}

void CheckReader(const std::string& text) {
  TraceRequest request;
  try {
    request = ReadTraceRequest(text, "scene.yaml");
  } catch (const InvalidRequest& refused) {
    return CheckRefusal(text, refused.violations());
  }
  Require(Validate(request).empty(), "what was read is valid");
  const TraceRequest again = ReadTraceRequest(WriteTraceRequest(request), "written");
  const std::string difference = FirstDifference(request, again);
  if (!difference.empty()) throw std::logic_error("not the same after writing and reading: " + difference);
}

}  // namespace
}  // namespace contact_path

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  contact_path::CheckReader(std::string(data, data + size));
  return 0;
}
