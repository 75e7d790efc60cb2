// Bytes as a valid request (varied_request.h): its trace ends with a named reason, soon after it was cancelled if need
// be, and all of its increments are proved.
#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/verify/verify_path.h"
#include "fuzz/target.h"
#include "fuzz/varied_request.h"

namespace contact_path {
namespace {

// The fuzzer tries many quick ones; the corpus, and its changes in the test, are long ones that once found something.
#ifdef CONTACT_PATH_QUICK_SCENES
constexpr bool kQuick = true;
#else
constexpr bool kQuick = false;
#endif

// Of the processor: other work on the machine does not count. Sanitizers and debuggers take their share.
constexpr double kSeconds = kQuick ? 1.0 : 4.0;  // until the trace is cancelled
constexpr double kSecondsToCancel = 10.0;        // until it has to be back then

double Now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void CheckTrace(const TraceRequest& request) {
  std::vector<Increment> increments;
  const double start = Now();
  bool cancelled = false;
  TraceControl control;
  control.on_increment = [&increments](const Increment& increment) { increments.push_back(increment); };
  control.cancelled = [&] { return cancelled = cancelled || Now() - start > kSeconds; };
  control.mpec = MakeMpecMethod;
  const TraceResult result = Trace(request, control);

  Require(Now() - start < kSeconds + kSecondsToCancel, "a cancelled trace ends soon");
  Require(!ToString(result.reason).empty(), "a trace ends for a named reason");
  RequireLine(result.message);
  Require(cancelled || result.reason != EndReason::kCancelled, "only what was cancelled ends as cancelled");
  Require(result.increments == static_cast<int>(increments.size()), "all increments are given and counted");
  const std::size_t stages = std::max<std::size_t>(request.program.size(), 1);
  Require(increments.size() <= request.options.MaxIncrements(stages) + stages, "no more increments than wanted");
  if (increments.empty()) {
    const bool expected = result.reason != EndReason::kStopCriterion && result.reason != EndReason::kMaxIncrements;
    return Require(expected, "a trace without increments ended early");
  }
  // Where increments of mpec may have cut off corners and the trace says so, the energy balance shows it.
  const bool may_cut = result.message.find("to be trusted only with a smaller step") != std::string::npos;
  const std::vector<Finding> findings = VerifyPath(request, increments).findings;
  const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) {
    return !may_cut || finding.what.rfind("energy balance", 0) != 0;
  });
  if (found == findings.end()) return;
  const Finding& finding = *found;
  throw std::logic_error("increment " + std::to_string(finding.increment) + " of " + std::to_string(increments.size()) +
                         ": " + finding.what + "\nended " + std::string(ToString(result.reason)) + ": " +
                         result.message + "\n" + WriteTraceRequest(request));
}

}  // namespace
}  // namespace contact_path

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using contact_path::kQuick;
  const contact_path::TraceRequest request = contact_path::VariedRequest(contact_path::BitsOf(data, size), kQuick);
  contact_path::Require(contact_path::Validate(request).empty(), "the generator makes valid requests");
  contact_path::CheckTrace(request);
  return 0;
}
