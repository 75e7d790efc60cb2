#include "contact_path/path/branch_options.h"

#include <gtest/gtest.h>

namespace contact_path::branch_options_test {
namespace {

TEST(BranchOptions, AnAccuratePathHasShorterSteps) {
  TraceOptions options;
  options.accuracy = Accuracy::kFast;
  const BranchOptions fast = BranchOptions::For(options, 1.0);
  options.accuracy = Accuracy::kAccurate;
  const BranchOptions accurate = BranchOptions::For(options, 1.0);
  EXPECT_LT(accurate.step, fast.step);
  EXPECT_LT(accurate.prediction, fast.prediction);
  EXPECT_GT(accurate.smallest_cosine, fast.smallest_cosine);
  options.step = 1e-7;
  options.direction = -1.0;
  const BranchOptions given = BranchOptions::For(options, 1.0);
  EXPECT_EQ(given.step, 1e-7);
  EXPECT_LT(given.smallest_step, given.step);
  EXPECT_EQ(given.direction, -1.0);
}

}  // namespace
}  // namespace contact_path::branch_options_test
