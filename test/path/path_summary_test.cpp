#include "contact_path/path/path_summary.h"

#include <gtest/gtest.h>

namespace contact_path {
namespace {

// Takes rows of which only kind, load factor and event matter, and numbers them.
class SummaryOfRows : public testing::Test {
 protected:
  void Add(RowKind kind, double load_factor = 0.0, int event = 0) {
    Increment row;
    row.index = summary_.rows();
    row.kind = kind;
    row.load_factor = load_factor;
    row.event.number = event;
    summary_.Add(row);
  }

  PathSummary summary_;
};

TEST_F(SummaryOfRows, OfNoRowsSaysSo) { EXPECT_EQ(summary_.ToText(), "0 rows; limit points: none; 0 events"); }

TEST_F(SummaryOfRows, NamesLimitPointsInTheirOrder) {
  Add(RowKind::kStart);
  Add(RowKind::kRegular, 1.0);
  Add(RowKind::kSmoothLimit, 2.191505308);
  Add(RowKind::kBifurcation, 1.5);
  Add(RowKind::kCornerLimit, -1.0 / 3.0, 1);
  EXPECT_EQ(summary_.limit_points(), 2);
  EXPECT_EQ(summary_.ToText(),
            "5 rows; limit points: smooth_limit at load factor 2.191505308 (row 2), corner_limit at load factor "
            "-0.3333333333 (row 4); 1 event");
}

TEST_F(SummaryOfRows, CountsEventsThatTheMethodNumbersAndThoseThatTheStatesShow) {
  Add(RowKind::kStart);
  Add(RowKind::kRegular, 1.0, 1);       // branch: contacts could change and do not
  Add(RowKind::kContactEvent, 2.0, 2);  // branch
  Add(RowKind::kContactEvent, 3.0);     // mpec numbers none
  Add(RowKind::kCornerLimit, 4.0);
  Add(RowKind::kSmoothLimit, 4.5);  // no event
  EXPECT_EQ(summary_.events(), 4);
}

TEST_F(SummaryOfRows, ListsTenLimitPointsAndCountsTheRest) {
  for (int i = 0; i < 12; ++i) Add(RowKind::kSmoothLimit, i);
  EXPECT_EQ(summary_.limit_points(), 12);
  const std::string text = summary_.ToText();
  EXPECT_NE(text.find("smooth_limit at load factor 9 (row 9) and 2 more; 0 events"), std::string::npos) << text;
}

TEST_F(SummaryOfRows, FollowsTheReasonOfTheEnd) {
  Add(RowKind::kStart);
  EXPECT_EQ(summary_.ToText("stop_criterion", "b.x > 4.95"),
            "stop_criterion: b.x > 4.95; 1 row; limit points: none; 0 events");
  EXPECT_EQ(summary_.ToText("", "the disk is full"), "the disk is full; 1 row; limit points: none; 0 events");
}

}  // namespace
}  // namespace contact_path
