#include "contact_path/path/stop.h"

#include <gtest/gtest.h>

#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::stop_test {
namespace {

class Stop : public testing::Test {
 protected:
  Stop() {
    request_.scene.nodes = {{"a", 0.0, 0.0, false, false}, {"b", 1.0, 0.0, false, false}};
    request_.scene.bars = {{{"a", "b"}, 1.0}};
    request_.scene.loads = {{"b", 1.0, 0.0, false}};
    increment_.index = 1;
    increment_.load_factor = 0.5;
    increment_.positions = {1.0, 2.0, 3.0, 4.0};
    request_.scene.obstacles = {{"wall"}, {"floor"}};
    request_.scene.contacts = {{"a", "floor"}, {"b", "floor"}};
    increment_.contacts = {{5.0, 6.0, 7.0, ContactState::kStick}, {8.0, 9.0, -10.0, ContactState::kStick}};
  }
  // The value of the criterion that holds, or -1.
  double ValueThatHolds(const std::vector<StopCriterion>& criteria) {
    request_.options.stop = criteria;
    const StopTest test(request_, SceneIndex(request_.scene));
    const StopCriterion* criterion = test.FirstThatHolds(increment_);
    return criterion == nullptr ? -1.0 : criterion->value;
  }

  // Each of them alone.
  void ExpectHold(const std::vector<StopCriterion>& criteria) {
    for (const StopCriterion& criterion : criteria)
      EXPECT_EQ(ValueThatHolds({criterion}), criterion.value) << ToText(criterion);
  }

  void ExpectNotToHold(const std::vector<StopCriterion>& criteria) {
    for (const StopCriterion& criterion : criteria) EXPECT_EQ(ValueThatHolds({criterion}), -1.0) << ToText(criterion);
  }

  TraceRequest request_;
  Increment increment_;
};

TEST_F(Stop, EachQuantityIsItsOwn) {
  // Quantities are 1, 2, 3, 4 and 0.5: each lies just beyond or just short of the value.
  ExpectHold({{"a.x", ">", 0.9}, {"a.y", ">", 1.9}, {"b.x", "<", 3.1}, {"b.y", "<", 4.1}, {"load_factor", ">", 0.4}});
  ExpectNotToHold(
      {{"a.x", ">", 1.1}, {"a.y", ">", 2.1}, {"b.x", "<", 2.9}, {"b.y", "<", 3.9}, {"load_factor", "<", 0.4}});
}

TEST_F(Stop, QuantitiesOfContacts) {
  ExpectHold({{"a@floor.gap", ">", 4.9},
              {"a@floor.rn", "<", 6.1},
              {"a@floor.rt", ">", 6.9},
              {"b@floor.gap", ">", 7.9},
              {"b@floor.rn", "<", 9.1},
              {"b@floor.rt", "<", -9.9}});
  ExpectNotToHold({{"a@floor.gap", ">", 5.1}, {"a@floor.rn", "<", 5.9}, {"b@floor.rt", "<", -10.1}});
}

TEST_F(Stop, ColumnsOfTheTableAreTheSameQuantities) {
  ExpectHold({{"y_a", ">", 1.9}, {"gap_b@floor", ">", 7.9}});
  ExpectNotToHold({{"x_b", "<", 2.9}, {"rn_a@floor", ">", 6.1}});
}

TEST_F(Stop, TheValueItselfIsNotBeyond) {
  ExpectNotToHold({{"a.x", ">", 1.0}, {"a.x", "<", 1.0}});
  ExpectNotToHold({{"a.x", ">", 1.0 - 1e-15}, {"load_factor", "<", 0.5 + 1e-15}});  // nor is rounding
}

// The last digit of a coordinate of 391 is 6e-14.
TEST_F(Stop, RoundingOfALargeCoordinate) {
  increment_.positions[2] = 391.27803160855876;
  for (const double digits : {1.0, 2.0}) {
    const double beside = increment_.positions[2] - digits * 5.7e-14;
    EXPECT_EQ(ValueThatHolds({{"b.x", ">", beside}}), -1.0) << digits;
  }
  EXPECT_EQ(ValueThatHolds({{"b.x", ">", 391.278031608}}), 391.278031608);
}

TEST_F(Stop, TheFirstInTheListWins) {
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 7.0}, {"a.y", ">", 0.25}, {"load_factor", ">", 0.125}}), 0.25);
  EXPECT_EQ(ValueThatHolds({}), -1.0);
}

TEST_F(Stop, RoundingOfAProgramWithoutBars) {
  request_.scene.bars.clear();
  request_.scene.superelements = {{{"b"}, {1.0, 0.0, 0.0, 1.0}}};
  request_.scene.loads.clear();
  request_.program = {LoadingStage({{"b", 1.0, 0.0}})};
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 1.0 - 1e-15}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 0.9}}), 0.9);
}

TEST_F(Stop, IncrementZeroIsNotAsked) {
  increment_.index = 0;
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 0.9}}), -1.0);
}

TEST_F(Stop, TextIsWhatThePersonWrote) {
  EXPECT_EQ(ToText({"b.x", ">", 4.95}), "b.x > 4.95");
  EXPECT_EQ(ToText({"load_factor", "<", -1.0}), "load_factor < -1");
}

constexpr double kRounding = 1e-9;  // a criterion holds beyond its value by more than that

// A block of weight 1 on a rough floor with mu = 0.5, on a spring of stiffness 2, under the load s (fx, fy).
TraceRequest Block(double fx, double fy, const StopCriterion& stop) {
  TraceRequest request;
  request.scene = NodeOnFloor("p", 2.0, 0.5);
  request.scene.loads = {{"p", 0.0, -1.0, true}, {"p", fx, fy, false}};
  request.options.stop = {stop};
  return request;
}

// Lifted, the block leaves the floor at s = 1 and goes up by (s - 1) / 2; pushed, it slips from s = 0.5 on.
TEST(StopOfATrace, QuantitiesOfContactsEndItWhereTheyPassTheValue) {
  struct Case {
    double fx, fy;
    StopCriterion stop;
    double ContactRecord::*value;
    double load, tolerance;  // of the load factor
  };
  const Case cases[] = {{0.0, 1.0, {"p@floor.rn", "<", 0.4}, &ContactRecord::rn, 0.6, kRounding},
                        {0.0, 1.0, {"gap_p@floor", ">", 0.1}, &ContactRecord::gap, 1.2, 1e-6},
                        {1.0, 0.0, {"p@floor.rt", "<", -0.3}, &ContactRecord::rt, 0.3, kRounding}};
  for (const Case& of : cases) {
    SCOPED_TRACE(ToText(of.stop));
    const TracedPath path = TraceIncrements(Block(of.fx, of.fy, of.stop));
    ExpectEnd(path, EndReason::kStopCriterion);
    const Increment &last = path.increments.back(), &before = path.increments[path.increments.size() - 2];
    EXPECT_NEAR(last.contacts[0].*of.value, of.stop.value, kRounding);
    const double short_of = of.stop.value - before.contacts[0].*of.value;
    EXPECT_GE(of.stop.when == ">" ? short_of : -short_of, -kRounding);
    EXPECT_NEAR(last.load_factor, of.load, of.tolerance);
  }
  // Friction is never larger than 0.5: this criterion is not met.
  TraceRequest never = Block(1.0, 0.0, {"p@floor.rt", "<", -0.51});
  never.options.max_increments = 30;
  EXPECT_EQ(TraceIncrements(never).result.reason, EndReason::kMaxIncrements);
}

}  // namespace
}  // namespace contact_path::stop_test
