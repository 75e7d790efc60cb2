#include "contact_path/path/path_summary.h"

#include <gtest/gtest.h>

namespace contact_path::progress_estimate_test {
namespace {

Increment MakeIncrement(int index, double load_factor, double x) {
  Increment increment;
  increment.index = index;
  increment.load_factor = load_factor;
  increment.positions = {0.0, 0.0, x, 7.0};
  return increment;
}

TraceRequest WithNodes() {
  TraceRequest request;
  request.scene.nodes = {Node{"a"}, Node{"b.c"}};
  return request;
}

TEST(ProgressEstimate, IsThatOfTheNearestEnd) {
  TraceRequest request = WithNodes();
  request.options.max_increments = 10;
  request.options.stop = {{"b.c.x", ">", 5.0}, {"load_factor", "<", -2.0}};
  ProgressEstimate estimate(request);
  EXPECT_TRUE(estimate.HasEnd());
  EXPECT_EQ(estimate.Add(MakeIncrement(0, 0.0, 1.0)), 0.0);
  EXPECT_EQ(estimate.Add(MakeIncrement(1, -0.1, 1.0)), 0.1);   // one of ten
  EXPECT_EQ(estimate.Add(MakeIncrement(2, -1.0, 1.0)), 0.5);   // half of the load
  EXPECT_EQ(estimate.Add(MakeIncrement(3, -0.1, 4.0)), 0.75);  // three of the four from 1 to 5
  EXPECT_EQ(estimate.Add(MakeIncrement(4, 0.5, 0.0)), 0.4);    // back: the number is nearest again
  EXPECT_EQ(estimate.Add(MakeIncrement(5, -3.0, 1.0)), 1.0);
}

TEST(ProgressEstimate, IncrementsWithoutStateTellByTheLoadFactor) {
  TraceRequest request = WithNodes();
  request.options.stop = {{"b.c.x", ">", 5.0}, {"load_factor", "<", -2.0}};
  ProgressEstimate estimate(request);
  EXPECT_EQ(estimate.Add(MakeIncrement(0, 0.0, 1.0)), 0.0);
  Increment increment = MakeIncrement(1, -1.0, 4.0);
  increment.positions.clear();
  EXPECT_EQ(estimate.Add(increment), 0.5);
  EXPECT_EQ(estimate.Add(MakeIncrement(2, -1.0, 4.0)), 0.75);
}

TEST(ProgressEstimate, StartOnTheCriterionCountsForNothing) {
  TraceRequest request = WithNodes();
  request.options.stop = {{"b.c.y", ">", 7.0}};
  ProgressEstimate estimate(request);
  EXPECT_EQ(estimate.Add(MakeIncrement(0, 0.0, 0.0)), 0.0);
  EXPECT_EQ(estimate.Add(MakeIncrement(1, 1.0, 1.0)), 0.0);
}

}  // namespace
}  // namespace contact_path::progress_estimate_test
