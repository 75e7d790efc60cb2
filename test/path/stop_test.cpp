#include "contact_path/path/stop.h"

#include <gtest/gtest.h>

namespace contact_path {
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
  }
  // The value of the criterion that holds, or -1.
  double ValueThatHolds(const std::vector<StopCriterion>& criteria) {
    request_.options.stop = criteria;
    const StopTest test(request_);
    const StopCriterion* criterion = test.FirstThatHolds(increment_);
    return criterion == nullptr ? -1.0 : criterion->value;
  }

  TraceRequest request_;
  Increment increment_;
};

TEST_F(Stop, EachQuantityIsItsOwn) {
  // Quantities are 1, 2, 3, 4 and 0.5: each lies just beyond or just short of the value.
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 0.9}}), 0.9);
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 1.1}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"a.y", ">", 1.9}}), 1.9);
  EXPECT_EQ(ValueThatHolds({{"a.y", ">", 2.1}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"b.x", "<", 3.1}}), 3.1);
  EXPECT_EQ(ValueThatHolds({{"b.x", "<", 2.9}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"b.y", "<", 4.1}}), 4.1);
  EXPECT_EQ(ValueThatHolds({{"b.y", "<", 3.9}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"load_factor", ">", 0.4}}), 0.4);
  EXPECT_EQ(ValueThatHolds({{"load_factor", "<", 0.4}}), -1.0);
}

TEST_F(Stop, TheValueItselfIsNotBeyond) {
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 1.0}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"a.x", "<", 1.0}}), -1.0);
  // Nor is rounding.
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 1.0 - 1e-15}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"load_factor", "<", 0.5 + 1e-15}}), -1.0);
}

TEST_F(Stop, TheFirstInTheListWins) {
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 7.0}, {"a.y", ">", 0.25}, {"load_factor", ">", 0.125}}), 0.25);
  EXPECT_EQ(ValueThatHolds({}), -1.0);
}

TEST_F(Stop, RoundingOfAProgramWithoutBars) {
  request_.scene.bars.clear();
  request_.scene.superelements = {{{"b"}, {1.0, 0.0, 0.0, 1.0}}};
  request_.scene.loads.clear();
  Stage stage;
  stage.loads = {{"b", 1.0, 0.0, false}};
  request_.program = {stage};
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 1.0 - 1e-15}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 0.9}}), 0.9);
}

TEST_F(Stop, RowZeroIsNotAsked) {
  increment_.index = 0;
  EXPECT_EQ(ValueThatHolds({{"a.x", ">", 0.9}}), -1.0);
}

TEST_F(Stop, TextIsWhatThePersonWrote) {
  EXPECT_EQ(ToText({"b.x", ">", 4.95}), "b.x > 4.95");
  EXPECT_EQ(ToText({"load_factor", "<", -1.0}), "load_factor < -1");
}

}  // namespace
}  // namespace contact_path
