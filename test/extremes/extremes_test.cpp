// The cases at the extremes that take no time: by branch with all presets, by mpec with its default as far as it comes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "extremes/run_case.h"

namespace contact_path {
namespace {

std::vector<ExtremeCase> ShortCases() {
  std::vector<ExtremeCase> all = ExtremeCases(), cases;
  std::copy_if(all.begin(), all.end(), std::back_inserter(cases),
               [](const ExtremeCase& extreme) { return !extreme.long_run; });
  return cases;
}

class Extremes : public testing::TestWithParam<ExtremeCase> {};
INSTANTIATE_TEST_SUITE_P(Cases, Extremes, testing::ValuesIn(ShortCases()), [](const auto& test) {
  std::string name = test.param.group + "_" + test.param.value;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
  return name + "_" + std::to_string(test.index);
});

TEST_P(Extremes, AreRightOrEndByName) {
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced, Accuracy::kAccurate}) {
    const Outcome outcome = RunCase(GetParam(), Method::kBranch, accuracy, 20.0);
    EXPECT_EQ(outcome.fault, "") << "branch, " << ToString(accuracy) << ", " << outcome.increments << " increments";
    EXPECT_FALSE(outcome.out_of_time);
  }
  const Outcome outcome = RunCase(GetParam(), Method::kMpec, Accuracy::kBalanced, 0.2);
  EXPECT_EQ(outcome.fault, "") << "mpec, " << outcome.increments << " increments";
}

}  // namespace
}  // namespace contact_path
