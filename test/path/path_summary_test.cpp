#include "contact_path/path/path_summary.h"

#include <gtest/gtest.h>

namespace contact_path::path_summary_test {
namespace {

// Takes increments of which only kind, load factor and event matter, and numbers them.
class SummaryOfIncrements : public testing::Test {
 protected:
  void Add(IncrementKind kind, double load_factor = 0.0, int event = 0) {
    Increment increment;
    increment.index = summary_.increments();
    increment.kind = kind;
    increment.load_factor = load_factor;
    increment.event.number = event;
    summary_.Add(increment);
  }

  PathSummary summary_{1.0};
};

TEST_F(SummaryOfIncrements, OfNoIncrementsSaysSo) {
  EXPECT_EQ(summary_.ToText(), "0 increments; limit points: none; 0 events");
}

TEST_F(SummaryOfIncrements, NamesLimitPointsInTheirOrder) {
  Add(IncrementKind::kStart);
  Add(IncrementKind::kRegular, 1.0);
  Add(IncrementKind::kSmoothLimit, 2.191505308);
  Add(IncrementKind::kBifurcation, 1.5);
  Add(IncrementKind::kCornerLimit, -1.0 / 3.0, 1);
  ASSERT_EQ(summary_.limit_points().size(), 2U);
  EXPECT_EQ(summary_.limit_points()[0].index, 2);
  EXPECT_EQ(summary_.limit_points()[0].kind, IncrementKind::kSmoothLimit);
  EXPECT_EQ(summary_.limit_points()[0].load_factor, 2.191505308);
  EXPECT_EQ(summary_.limit_points()[1].index, 4);
  EXPECT_EQ(summary_.limit_points()[1].kind, IncrementKind::kCornerLimit);
  EXPECT_EQ(summary_.limit_points()[1].load_factor, -1.0 / 3.0);
  EXPECT_EQ(
      summary_.ToText(),
      "5 increments; limit points: smooth_limit at load factor 2.191505308 (increment 2), corner_limit at load factor "
      "-0.3333333333 (increment 4); another path crosses: bifurcation at load factor 1.5 (increment 3); 1 event");
}

TEST_F(SummaryOfIncrements, NamesLimitPointsWhereAnotherPathCrosses) {
  Increment limit;
  limit.kind = IncrementKind::kSmoothLimit;
  limit.load_factor = 2.5;
  limit.event.null_vector = {1.0, 0.0};
  summary_.Add(limit);
  EXPECT_EQ(summary_.ToText(),
            "1 increment; limit points: smooth_limit at load factor 2.5 (increment 0); another path crosses: "
            "smooth_limit at load factor 2.5 (increment 0); 0 events");
}

TEST_F(SummaryOfIncrements, CountsEventsThatTheMethodNumbersAndThoseThatTheStatesShow) {
  Add(IncrementKind::kStart);
  Add(IncrementKind::kRegular, 1.0, 1);       // branch: contacts could change and do not
  Add(IncrementKind::kContactEvent, 2.0, 2);  // branch
  Add(IncrementKind::kContactEvent, 3.0);     // mpec numbers none
  Add(IncrementKind::kCornerLimit, 4.0);
  Add(IncrementKind::kSmoothLimit, 4.5);  // no event
  EXPECT_EQ(summary_.events(), 4);
}

TEST_F(SummaryOfIncrements, ListsTenLimitPointsAndCountsTheRest) {
  for (int i = 0; i < 12; ++i) Add(IncrementKind::kSmoothLimit, i);
  ASSERT_EQ(summary_.limit_points().size(), 12U);
  EXPECT_EQ(summary_.limit_points()[11].index, 11);
  const std::string text = summary_.ToText();
  EXPECT_NE(text.find("smooth_limit at load factor 9 (increment 9) and 2 more; 0 events"), std::string::npos) << text;
}

TEST_F(SummaryOfIncrements, CountsJumps) {
  Add(IncrementKind::kStart);
  Add(IncrementKind::kJump, 1.0);
  EXPECT_EQ(summary_.jumps(), 1);
  EXPECT_EQ(summary_.ToText(), "2 increments; limit points: none; 0 events, 1 jump");
}

TEST_F(SummaryOfIncrements, TellsTheStageOfALimitPoint) {
  Increment increment;
  increment.kind = IncrementKind::kSmoothLimit;
  increment.stage = 3;
  summary_.Add(increment);
  ASSERT_EQ(summary_.limit_points().size(), 1U);
  EXPECT_EQ(summary_.limit_points()[0].stage, 3);
}

TEST_F(SummaryOfIncrements, FollowsTheReasonOfTheEnd) {
  Add(IncrementKind::kStart);
  EXPECT_EQ(summary_.ToText("stop_criterion", "b.x > 4.95"),
            "stop_criterion: b.x > 4.95; 1 increment; limit points: none; 0 events");
  EXPECT_EQ(summary_.ToText("", "the disk is full"), "the disk is full; 1 increment; limit points: none; 0 events");
}

}  // namespace
}  // namespace contact_path::path_summary_test
