// The same request gives the same bytes, whatever the process has traced before.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "contact_path/path/csv.h"
#include "contact_path/path/mpec_method.h"
#include "support/traced_path.h"

namespace contact_path::determinism_test {
namespace {

constexpr const char* kExamples[] = {"sliding_bar", "arch19",          "rough_truss",      "two_dof_friction",
                                     "rigid_stop",  "von_mises",       "stick_slip_cycle", "press_slide_lift",
                                     "gripper",     "cantilever_block"};
constexpr int kIncrements = 60;      // of branch
constexpr int kMpecIncrements = 12;  // these take longer

// The increments as CSV, but for the times.
std::string Csv(TraceRequest request, Method method) {
  request.options.method = method;
  request.options.max_increments = method == Method::kBranch ? kIncrements : kMpecIncrements;
  std::ostringstream csv;
  const CsvWriter writer(request);
  TraceControl control;
  control.on_increment = [&](Increment increment) {
    increment.solve.time = 0.0;
    writer.WriteRow(increment, csv);
  };
  control.mpec = MakeMpecMethod;
  const TraceResult result = Trace(request, control);
  return csv.str() + std::string(ToString(result.reason)) + result.message;
}

class DeterminismTest : public testing::TestWithParam<Method> {};

TEST_P(DeterminismTest, OtherTracesInBetweenLeaveNoMark) {
  std::string first[std::size(kExamples)];
  for (std::size_t i = 0; i < std::size(kExamples); ++i) first[i] = Csv(ReadExample(kExamples[i]), GetParam());
  for (std::size_t i = std::size(kExamples); i-- > 0;) {  // after others than at first
    EXPECT_EQ(Csv(ReadExample(kExamples[i]), GetParam()), first[i]) << kExamples[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, DeterminismTest, testing::Values(Method::kBranch, Method::kMpec));

}  // namespace
}  // namespace contact_path::determinism_test
