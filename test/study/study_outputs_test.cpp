#include "contact_path/study/study_outputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::study_outputs_test {
namespace {

TEST(StudyOutputs, OfTheRoughTrussAreItsClosedForms) {
  const TracedPath path = TraceIncrements(ReadExample("rough_truss"));
  StudyOutputs outputs({"limit_loads", "events", "end_reason", "max.load_factor", "final.dissipation",
                        "min.rn_foot@floor", "final.kind"},
                       path.request);
  for (const Increment& increment : path.increments) outputs.Add(increment);
  const std::vector<std::string> texts = outputs.Texts(path.result.reason);
  ASSERT_EQ(texts.size(), 7U);
  EXPECT_NEAR(std::stod(texts[0]), rough_truss::CornerLoad(), 1e-9);
  EXPECT_EQ(texts[1], "1");
  EXPECT_EQ(texts[2], "stop_criterion");
  EXPECT_EQ(texts[3], texts[0]);
  EXPECT_NEAR(std::stod(texts[4]), rough_truss::TotalDissipation(), 1e-6);
  EXPECT_NEAR(std::stod(texts[5]), 0.0, 1e-6);
  EXPECT_EQ(texts[6], "sample");  // the value of the stop criterion
}

// Increments of which only kind and load factor matter.
std::vector<std::string> TextsOf(const std::vector<std::string>& names, const std::vector<double>& limits) {
  StudyOutputs outputs(names, ReadExample("rough_truss"));
  for (const double load_factor : limits) {
    Increment increment;
    increment.kind = IncrementKind::kSmoothLimit;
    increment.load_factor = load_factor;
    outputs.Add(increment);
  }
  return outputs.Texts(EndReason::kPathEnd);
}

TEST(StudyOutputs, ListLimitLoadsInTheirOrder) {
  EXPECT_EQ(TextsOf({"limit_loads", "final.load_factor", "max.load_factor", "min.load_factor"}, {0.5, -2.0, 0.25}),
            (std::vector<std::string>{"0.5 -2 0.25", "0.25", "0.5", "-2"}));
}

TEST(StudyOutputs, ListJumpsAndWhereStabilityIsLost) {
  StudyOutputs outputs({"jumps", "released", "stable_range", "final.stability", "max.critical_stiffness"},
                       ReadExample("rough_truss"));
  const auto add = [&](IncrementKind kind, double load_factor, Verdict verdict, double stiffness, double released) {
    Increment increment;
    increment.kind = kind;
    increment.load_factor = load_factor;
    increment.stability.stability = verdict;
    increment.stability.critical_stiffness = stiffness;
    increment.jump.energy_released = released;
    outputs.Add(increment);
  };
  add(IncrementKind::kStart, 0.0, Verdict::kStable, 0.0, 0.0);
  add(IncrementKind::kCornerLimit, 0.5, Verdict::kNotProved, -1.0, 0.0);
  EXPECT_EQ(outputs.Texts(EndReason::kPathEnd), (std::vector<std::string>{"0", "", "", "not_proved", "0"}));
  add(IncrementKind::kRegular, 0.25, Verdict::kUnstable, 1.5, 0.0);
  add(IncrementKind::kJump, 0.25, Verdict::kStable, 0.0, 0.125);
  add(IncrementKind::kJump, 1.0, Verdict::kUnstable, 0.25, 2.0);
  EXPECT_EQ(outputs.Texts(EndReason::kPathEnd), (std::vector<std::string>{"2", "0.125 2", "0.5", "unstable", "1.5"}));
}

TEST(StudyOutputs, HaveSeventeenDigits) { EXPECT_EQ(TextsOf({"final.load_factor"}, {0.1})[0], "0.10000000000000001"); }

// Lists that no option asks for are there where an output needs them.
TEST(StudyOutputs, HaveTheListsThatTheyNeed) {
  TraceRequest request = ReadExample("rough_truss");
  const std::vector<std::string> names = {"final.bar1.N", "max.bar2.N", "final.left.ry", "final.floor.ry"};
  StudyOutputs outputs(names, request);
  EXPECT_TRUE(outputs.lists().sections);
  EXPECT_FALSE(outputs.lists().stresses || outputs.lists().pressures);
  request.options.record = {"sections"};
  const TracedPath path = TraceIncrements(request);
  for (const Increment& increment : path.increments) outputs.Add(increment);
  const std::vector<std::string> texts = outputs.Texts(path.result.reason);
  ASSERT_FALSE(path.increments.back().sections.empty());
  EXPECT_EQ(std::stod(texts[0]), path.increments.back().sections[0].N);
  double largest = -1e300;
  for (const Increment& increment : path.increments) largest = std::max(largest, increment.sections[1].N);
  EXPECT_EQ(std::stod(texts[1]), largest);
  EXPECT_EQ(std::stod(texts[2]), path.increments.back().supports[0].ry);
  EXPECT_EQ(std::stod(texts[3]), path.increments.back().boundaries[0].ry);
}

TEST(StudyOutputs, OfNoIncrementsAreEmpty) {
  EXPECT_EQ(TextsOf({"limit_loads", "events", "end_reason", "final.load_factor", "final.kind", "jumps", "released",
                     "stable_range"},
                    {}),
            (std::vector<std::string>{"", "", "path_end", "", "", "", "", ""}));
}

TEST(StudyOutputs, NameTheOneThatIsNotThere) {
  const auto rule_of = [](const std::string& name) -> std::string {
    try {
      const StudyOutputs outputs({"events", name}, ReadExample("rough_truss"));
    } catch (const UnknownOutput& error) {
      EXPECT_EQ(error.place(), 1U);
      return error.what();
    }
    return "is an output";
  };
  EXPECT_EQ(rule_of("limit_load"),
            "must be limit_loads, events, jumps, released, stable_range, end_reason, final.<column>, max.<column> or "
            "min.<column>; did you mean limit_loads?");
  EXPECT_EQ(rule_of("final.x_apx"), "must be of a node or an obstacle of the scene; did you mean apex?");
  EXPECT_EQ(rule_of("max.kind"), "must be of a column of numbers, or begin with final.");
  EXPECT_EQ(rule_of("final.kind"), "is an output");
}

}  // namespace
}  // namespace contact_path::study_outputs_test
