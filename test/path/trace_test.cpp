#include "contact_path/path/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/scene/lattice.h"
#include "contact_path/scene/validate.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

TraceRequest SlidingBar(int max_increments) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  request.options.step = 0.1;
  request.options.max_increments = max_increments;
  return request;
}

TEST(EndReason, WordsAreThoseOfTheOutput) {
  EXPECT_EQ(ToString(EndReason::kStopCriterion), "stop_criterion");
  EXPECT_EQ(ToString(EndReason::kMaxIncrements), "max_increments");
  EXPECT_EQ(ToString(EndReason::kPathEnd), "path_end");
  EXPECT_EQ(ToString(EndReason::kStepTooSmall), "step_too_small");
  EXPECT_EQ(ToString(EndReason::kCancelled), "cancelled");
  EXPECT_EQ(ToString(EndReason::kNumericalFailure), "numerical_failure");
}

TEST(Trace, InvalidRequestThrowsBeforeAnyRow) {
  TraceRequest request = SlidingBar(2);
  request.scene.bars[0].EA = -1.0;
  TraceControl control;
  control.on_increment = [](const Increment&) { ADD_FAILURE() << "a row of an invalid request"; };
  EXPECT_THROW(Trace(request, control), InvalidRequest);
  EXPECT_THROW(Trace(request, control), std::invalid_argument);
}

TEST(Trace, MaxIncrementsCountsIncrementsAndNotRowZero) {
  for (const int increments : {1, 2, 5}) {
    const TracedPath path = TraceRows(SlidingBar(increments));
    EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements);
    EXPECT_EQ(path.rows.size(), static_cast<std::size_t>(increments) + 1);
    EXPECT_EQ(path.result.increments, increments + 1);
  }
}

TEST(Trace, MaxIncrementsDoesNotCountWhatBringsTheConstantLoadsOn) {
  TraceRequest request = ReadExample("two_dof_friction");
  request.options.method = Method::kMpec;
  request.options.max_increments = 1;
  const TracedPath path = TraceRows(request);
  EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements) << path.result.message;
  EXPECT_EQ(path.rows.size(), 2u);
}

TEST(Trace, StopCriterionHoldsInTheLastRowAndInNoneBefore) {
  TraceRequest request = SlidingBar(0);
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceRows(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  EXPECT_EQ(path.result.message, "load_factor > 1");
  ASSERT_GE(path.rows.size(), 3u);
  EXPECT_GT(path.rows.back().load_factor, 1.0);
  for (std::size_t i = 0; i + 1 < path.rows.size(); ++i) EXPECT_LE(path.rows[i].load_factor, 1.0);
}

TEST(Trace, StopCriterionThatHoldsAtTheStartDoesNotForbidIt) {
  TraceRequest request = SlidingBar(4);
  request.options.stop = {{"b.x", "<", 0.0}};
  const TracedPath path = TraceRows(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  EXPECT_EQ(path.rows.size(), 2u);
}

TEST(Trace, RowsArriveAsSoonAsTheyAreAccepted) {
  // Cancelled from within the first rows: the trace ends there, with these rows and no others.
  for (const int wanted : {1, 2, 4}) {
    int rows = 0;
    TraceControl control;
    control.on_increment = [&](const Increment& row) { EXPECT_EQ(row.index, rows++); };
    control.cancelled = [&] { return rows >= wanted; };
    const TraceResult result = Trace(SlidingBar(0), control);
    EXPECT_EQ(result.reason, EndReason::kCancelled);
    EXPECT_EQ(result.increments, wanted);
    EXPECT_EQ(rows, wanted);
    EXPECT_FALSE(result.message.empty());
  }
}

// Counts how often the question is asked before each row, then says yes in the middle of the longest increment.
void ExpectCancelledInsideAnIncrement(const TraceRequest& request) {
  long asked = 0;
  std::vector<long> asked_at_row;
  TraceControl count;
  count.on_increment = [&](const Increment&) { asked_at_row.push_back(asked); };
  count.cancelled = [&] {
    ++asked;
    return false;
  };
  Trace(request, count);
  ASSERT_GE(asked_at_row.size(), 2u);
  std::size_t longest = 1;
  for (std::size_t row = 2; row < asked_at_row.size(); ++row)
    if (asked_at_row[row] - asked_at_row[row - 1] > asked_at_row[longest] - asked_at_row[longest - 1]) longest = row;
  ASSERT_GT(asked_at_row[longest], asked_at_row[longest - 1] + 10);  // often, also inside an increment

  const long last_no = (asked_at_row[longest - 1] + asked_at_row[longest]) / 2;
  asked = 0;
  std::size_t rows = 0;
  TraceControl cancel;
  cancel.on_increment = [&](const Increment&) { ++rows; };
  cancel.cancelled = [&] { return ++asked > last_no; };
  const TraceResult result = Trace(request, cancel);
  EXPECT_EQ(result.reason, EndReason::kCancelled);
  EXPECT_GE(rows, longest);
  EXPECT_LE(rows, longest + 1);  // an event that was reached stays, though its ways on were being sought
  EXPECT_EQ(result.increments, static_cast<int>(rows));
  EXPECT_LE(asked, last_no + 3);  // once it was yes, nothing goes on
}

TEST(Trace, CancelledInsideAnIncrementKeepsTheRowsBefore) { ExpectCancelledInsideAnIncrement(SlidingBar(0)); }

TEST(Trace, CancelledWhileTheWaysOnAreSoughtKeepsTheRowsBefore) {
  // Eight feet on a rough floor: the start is sought among thousands of combinations of states.
  LatticeOptions options;
  options.columns = 7;
  options.rows = 2;
  TraceRequest request = LatticeRequest(options);
  request.options.method = Method::kBranch;
  request.options.max_increments = 3;
  ExpectCancelledInsideAnIncrement(request);
}

TEST(Trace, CancelledDuringThePreloadGivesNoRow) {
  TraceRequest request = ReadExample("two_dof_friction");
  request.options.method = Method::kMpec;
  TraceControl control;
  control.on_increment = [](const Increment&) { ADD_FAILURE() << "the constant loads are not on yet"; };
  control.cancelled = [] { return true; };
  const TraceResult result = Trace(request, control);
  EXPECT_EQ(result.reason, EndReason::kCancelled);
  EXPECT_EQ(result.increments, 0);
}

TEST(Trace, WhatTheSinkThrowsLeavesTheTrace) {
  TraceControl control;
  control.on_increment = [](const Increment& row) {
    if (row.index == 2) throw std::runtime_error("disk full");
  };
  try {
    Trace(SlidingBar(0), control);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "disk full");
  }
}

TEST(Trace, NeedsNeitherSinkNorCancellation) {
  const TraceResult result = Trace(SlidingBar(2), TraceControl());
  EXPECT_EQ(result.reason, EndReason::kMaxIncrements);
  EXPECT_EQ(result.increments, 3);
}

TEST(Trace, SameRequestTwiceGivesTheSameRowsBitForBit) {
  const TracedPath first = TraceRows(SlidingBar(6)), second = TraceRows(SlidingBar(6));
  ASSERT_EQ(first.rows.size(), second.rows.size());
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].load_factor, second.rows[i].load_factor);
    EXPECT_EQ(first.rows[i].positions, second.rows[i].positions);
    EXPECT_EQ(first.rows[i].contacts[0].rn, second.rows[i].contacts[0].rn);
    EXPECT_EQ(first.rows[i].contacts[0].rt, second.rows[i].contacts[0].rt);
    EXPECT_EQ(first.rows[i].dissipation, second.rows[i].dissipation);
    EXPECT_EQ(first.rows[i].solve.iterations, second.rows[i].solve.iterations);
  }
}

TEST(Trace, DirectionIsTheSignOfTheFirstChangeOfTheLoadFactor) {
  TraceRequest request = ReadExample("von_mises");
  request.options.method = Method::kMpec;
  request.options.max_increments = 2;
  for (const double direction : {1.0, 0.0, -1.0, -0.1}) {
    request.options.direction = direction;
    const TracedPath path = TraceRows(request);
    ASSERT_EQ(path.rows.size(), 3u);
    EXPECT_EQ(path.rows[1].load_factor < 0.0, direction < 0.0);
    EXPECT_EQ(PositionY(path, path.rows[1], "apex") > 1.0, direction < 0.0);  // the load pushes down
  }
}

TEST(Trace, StepIsTheLengthOfIncrements) {
  TraceRequest request = ReadExample("von_mises");
  request.options.method = Method::kMpec;
  request.options.max_increments = 10;
  for (const double step : {0.1, 0.01, 0.001}) {
    request.options.step = step;
    const TracedPath path = TraceRows(request);
    ASSERT_EQ(path.rows.size(), 11u);
    // The first increment, which has no direction from a last one, may be shorter. The others aim along the last chord.
    for (std::size_t i = 2; i < path.rows.size(); ++i)
      EXPECT_NEAR(path.rows[i].arc_length - path.rows[i - 1].arc_length, step, 0.1 * step) << i;
  }
}

TEST(Trace, SolveTimeIsTheWallTimeOfTheRow) {
  const TracedPath path = TraceRows(SlidingBar(3));
  for (const Increment& row : path.rows) {
    EXPECT_GE(row.solve.time, 0.0);
    EXPECT_LT(row.solve.time, 60.0);
  }
  EXPECT_GT(path.rows[1].solve.time, 1e-5);
}

TEST(Trace, SceneThatCannotStandIsANumericalFailureWithoutRows) {
  // The constant load pulls the block up along the wall, and nothing holds it: a mechanism without equilibrium.
  TraceRequest request;
  request.options.method = Method::kMpec;
  request.scene.name = "falling";
  request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, false}};
  request.scene.superelements = {{{"b"}, {1.0, 0.0, 0.0, 0.0}}};
  request.scene.loads = {{"b", 1.0, 0.0, false}, {"b", 0.0, 1.0, true}};
  const TracedPath path = TraceRows(request);
  EXPECT_TRUE(path.rows.empty());
  EXPECT_EQ(path.result.increments, 0);
  EXPECT_NE(path.result.reason, EndReason::kStopCriterion);
  EXPECT_NE(path.result.reason, EndReason::kMaxIncrements);
  EXPECT_FALSE(path.result.message.empty());
}

}  // namespace
}  // namespace contact_path
