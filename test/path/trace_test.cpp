#include "contact_path/path/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "contact_path/path/mpec_method.h"
#include "contact_path/scene/validate.h"
#include "lattice.h"
#include "support/traced_path.h"

namespace contact_path::trace_test {
namespace {

TraceRequest SlidingBar(int max_increments) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.step = 0.1;
  request.options.max_increments = max_increments;
  return request;
}

TEST(EndReason, WordsAreThoseOfTheOutput) {
  const std::pair<EndReason, const char*> words[] = {{EndReason::kStopCriterion, "stop_criterion"},
                                                     {EndReason::kMaxIncrements, "max_increments"},
                                                     {EndReason::kPathEnd, "path_end"},
                                                     {EndReason::kStepTooSmall, "step_too_small"},
                                                     {EndReason::kCancelled, "cancelled"},
                                                     {EndReason::kNoSuchBranch, "no_such_branch"},
                                                     {EndReason::kNotDetermined, "not_determined"},
                                                     {EndReason::kNumericalFailure, "numerical_failure"}};
  for (const auto& [reason, word] : words) EXPECT_EQ(ToString(reason), word);
}

TEST(Trace, InvalidRequestThrowsBeforeAnyIncrement) {
  TraceRequest request = SlidingBar(2);
  request.scene.bars[0].EA = -1.0;
  TraceControl control;
  control.on_increment = [](const Increment&) { ADD_FAILURE() << "an increment of an invalid request"; };
  EXPECT_THROW(Trace(request, control), InvalidRequest);
  EXPECT_THROW(Trace(request, control), std::invalid_argument);
}

TEST(Trace, MpecIsRefusedWithoutItsLibrary) {
  TraceRequest request = SlidingBar(2);
  request.options.method = Method::kMpec;
  try {
    Trace(request, TraceControl());
    FAIL() << "nothing was thrown";
  } catch (const InvalidRequest& error) {
    EXPECT_STREQ(error.what(), "options.method = mpec: needs the library contact_path_mpec, which this program lacks");
  }
}

TEST(Trace, MaxIncrementsDoesNotCountIncrementZero) {
  for (const int increments : {1, 2, 5}) {
    const TracedPath path = TraceIncrements(SlidingBar(increments));
    EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements);
    EXPECT_EQ(path.increments.size(), static_cast<std::size_t>(increments) + 1);
    EXPECT_EQ(path.result.increments, increments + 1);
  }
}

TEST(Trace, MaxIncrementsDoesNotCountWhatBringsTheConstantLoadsOn) {
  TraceRequest request = ReadExample("two_dof_friction");
  request.options.max_increments = 1;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements) << path.result.message;
  EXPECT_EQ(path.increments.size(), 2u);
}

TEST(Trace, EveryIncrementNamesTheMethodOfTheRequest) {
  for (const Method method : kMethods) {
    TraceRequest request = ReadExample("press_slide_lift");  // several stages: several starts
    request.options.method = method;
    const TracedPath path = TraceIncrements(request);
    EXPECT_GT(IncrementsOfKind(path, IncrementKind::kStart).size(), 1U);
    for (const Increment& increment : path.increments)
      EXPECT_EQ(increment.solve.method, method) << "increment " << increment.index;
  }
}

TEST(Trace, StopCriterionHoldsInTheLastIncrementAndInNoneBefore) {
  TraceRequest request = SlidingBar(0);
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  EXPECT_EQ(path.result.message, "load_factor > 1");
  ASSERT_GE(path.increments.size(), 3u);
  EXPECT_NEAR(path.increments.back().load_factor, 1.0, 1e-12);
  for (std::size_t i = 0; i + 1 < path.increments.size(); ++i) EXPECT_LT(path.increments[i].load_factor, 1.0);
}

TEST(Trace, IncrementsArriveAsSoonAsTheyAreAccepted) {
  // Cancelled from within the first increments: the trace ends there, with these increments and no others.
  for (const int wanted : {1, 2, 4}) {
    int increments = 0;
    TraceControl control;
    control.on_increment = [&](const Increment& increment) { EXPECT_EQ(increment.index, increments++); };
    control.cancelled = [&] { return increments >= wanted; };
    const TraceResult result = Trace(SlidingBar(0), control);
    EXPECT_EQ(result.reason, EndReason::kCancelled);
    EXPECT_EQ(result.increments, wanted);
    EXPECT_EQ(increments, wanted);
    EXPECT_FALSE(result.message.empty());
  }
}

// Counts how often the question is asked before each increment, then says yes in the middle of the longest increment.
void ExpectCancelledInsideAnIncrement(const TraceRequest& request) {
  long asked = 0;
  std::vector<long> asked_at_increment;
  TraceControl count;
  count.on_increment = [&](const Increment&) { asked_at_increment.push_back(asked); };
  count.cancelled = [&] {
    ++asked;
    return false;
  };
  count.mpec = MakeMpecMethod;
  Trace(request, count);
  ASSERT_GE(asked_at_increment.size(), 2u);
  const auto before = [&](std::size_t increment) { return increment > 0 ? asked_at_increment[increment - 1] : 0; };
  std::size_t longest = 0;
  for (std::size_t increment = 1; increment < asked_at_increment.size(); ++increment)
    if (asked_at_increment[increment] - before(increment) > asked_at_increment[longest] - before(longest))
      longest = increment;
  ASSERT_GT(asked_at_increment[longest], before(longest) + 10);  // often, also inside an increment

  const long last_no = (before(longest) + asked_at_increment[longest]) / 2;
  asked = 0;
  std::size_t increments = 0;
  TraceControl cancel;
  cancel.on_increment = [&](const Increment&) { ++increments; };
  cancel.cancelled = [&] { return ++asked > last_no; };
  cancel.mpec = MakeMpecMethod;
  const TraceResult result = Trace(request, cancel);
  EXPECT_EQ(result.reason, EndReason::kCancelled);
  EXPECT_GE(increments, longest);
  EXPECT_LE(increments, longest + 1);  // an event that was reached stays, though its branches were being sought
  EXPECT_EQ(result.increments, static_cast<int>(increments));
  EXPECT_LE(asked, last_no + 3);  // once it was yes, nothing goes on
}

TEST(Trace, CancelledInsideAnIncrementKeepsTheIncrementsBefore) {
  TraceRequest request = SlidingBar(0);
  request.options.method = Method::kMpec;
  ExpectCancelledInsideAnIncrement(request);
}

TEST(Trace, CancelledWhileBranchesAreSoughtKeepsTheIncrementsBefore) {
  // Six feet on a rough floor: the start is sought among thousands of combinations of states.
  LatticeOptions options;
  options.columns = 5;
  options.rows = 2;
  TraceRequest request = LatticeRequest(options);
  request.options.method = Method::kBranch;
  request.options.max_increments = 3;
  ExpectCancelledInsideAnIncrement(request);
}

TEST(Trace, CancelledDuringThePreloadGivesNoIncrement) {
  TraceRequest request = ReadExample("two_dof_friction");
  TraceControl control;
  control.on_increment = [](const Increment&) { ADD_FAILURE() << "the constant loads are not on yet"; };
  control.cancelled = [] { return true; };
  const TraceResult result = Trace(request, control);
  EXPECT_EQ(result.reason, EndReason::kCancelled);
  EXPECT_EQ(result.increments, 0);
}

TEST(Trace, WhatTheSinkThrowsLeavesTheTrace) {
  TraceControl control;
  control.on_increment = [](const Increment& increment) {
    if (increment.index == 2) throw std::runtime_error("disk full");
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

TEST(Trace, SameRequestTwiceGivesTheSameIncrementsBitForBit) {
  const TracedPath first = TraceIncrements(SlidingBar(6)), second = TraceIncrements(SlidingBar(6));
  ASSERT_EQ(first.increments.size(), second.increments.size());
  for (std::size_t i = 0; i < first.increments.size(); ++i) {
    EXPECT_EQ(LargestDifference(first.increments[i], second.increments[i]), 0.0);
    EXPECT_EQ(first.increments[i].dissipation, second.increments[i].dissipation);
    EXPECT_EQ(first.increments[i].solve.iterations, second.increments[i].solve.iterations);
  }
}

TEST(Trace, DirectionIsTheSignOfTheFirstChangeOfTheLoadFactor) {
  TraceRequest request = ReadExample("von_mises");
  request.options.method = Method::kMpec;
  request.options.max_increments = 2;
  for (const double direction : {1.0, 0.0, -1.0, -0.1}) {
    request.options.direction = direction;
    const TracedPath path = TraceIncrements(request);
    ASSERT_EQ(path.increments.size(), 3u);
    EXPECT_EQ(path.increments[1].load_factor < 0.0, direction < 0.0);
    EXPECT_EQ(PositionY(path, path.increments[1], "apex") > 1.0, direction < 0.0);  // the load pushes down
  }
}

TEST(Trace, StepIsTheLengthOfIncrements) {
  TraceRequest request = ReadExample("von_mises");
  request.options.method = Method::kMpec;
  request.options.max_increments = 10;
  for (const double step : {0.01, 0.001}) {
    request.options.step = step;
    const TracedPath path = TraceIncrements(request);
    ASSERT_EQ(path.increments.size(), 11u);
    // Where the path bends, increments are shorter.
    double longest = 0.0;
    for (std::size_t i = 1; i < path.increments.size(); ++i)
      longest = std::max(longest, path.increments[i].arc_length - path.increments[i - 1].arc_length);
    EXPECT_LE(longest, 1.01 * step);
    EXPECT_GE(longest, 0.99 * step);
  }
}

TEST(Trace, SolveTimeIsTheWallTimeOfTheIncrement) {
  const TracedPath path = TraceIncrements(SlidingBar(3));
  for (const Increment& increment : path.increments) {
    EXPECT_GE(increment.solve.time, 0.0);
    EXPECT_LT(increment.solve.time, 60.0);
  }
  EXPECT_GT(path.increments[1].solve.time, 1e-5);
}

TEST(Trace, SceneThatCannotStandIsANumericalFailureWithoutIncrements) {
  // The constant load pulls the block up along the wall, and nothing holds it: a mechanism without equilibrium.
  TraceRequest request;
  request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, false}};
  request.scene.superelements = {{{"b"}, {1.0, 0.0, 0.0, 0.0}}};
  request.scene.loads = {{"b", 1.0, 0.0, false}, {"b", 0.0, 1.0, true}};
  const TracedPath path = TraceIncrements(request);
  EXPECT_TRUE(path.increments.empty());
  EXPECT_EQ(path.result.increments, 0);
  EXPECT_NE(path.result.reason, EndReason::kStopCriterion);
  EXPECT_NE(path.result.reason, EndReason::kMaxIncrements);
  EXPECT_FALSE(path.result.message.empty());
}

}  // namespace
}  // namespace contact_path::trace_test
