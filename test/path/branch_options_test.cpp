#include "contact_path/path/branch_options.h"

#include <gtest/gtest.h>

namespace contact_path::branch_options_test {
namespace {

BranchOptions WithChoices() {
  BranchOptions options;
  options.choices = {{2, 0, 1}, {0, 7, 2}, {3, 0, 3}};
  return options;
}

TEST(BranchOptions, AChoiceForTheIncrementComesFirst) {
  const BranchOptions options = WithChoices();
  ASSERT_NE(options.ChoiceAt(7, 2), nullptr);
  EXPECT_EQ(options.ChoiceAt(7, 2)->branch, 2);
  ASSERT_NE(options.ChoiceAt(8, 2), nullptr);
  EXPECT_EQ(options.ChoiceAt(8, 2)->branch, 1);
  EXPECT_EQ(options.ChoiceAt(8, 0), nullptr);
  EXPECT_EQ(options.ChoiceAt(0, 0), nullptr);
  EXPECT_EQ(options.ChoiceAt(8, 4), nullptr);
}

TEST(BranchOptions, WhetherAChoiceIsAhead) {
  const BranchOptions options = WithChoices();
  EXPECT_TRUE(options.HasChoiceAfter(6, 3));
  EXPECT_TRUE(options.HasChoiceAfter(7, 2));
  EXPECT_FALSE(options.HasChoiceAfter(7, 3));
  EXPECT_FALSE(BranchOptions().HasChoiceAfter(0, 0));
}

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

TEST(BranchOptions, PlacesAsMessagesNameThem) {
  EXPECT_EQ(PlaceOf({3, 0, 1}), "event 3");
  EXPECT_EQ(PlaceOf({0, 40, 1}), "increment 40");
}

}  // namespace
}  // namespace contact_path::branch_options_test
