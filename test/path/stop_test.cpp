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

TEST_F(Stop, QuantitiesOfContacts) {
  EXPECT_EQ(ValueThatHolds({{"a@floor.gap", ">", 4.9}}), 4.9);
  EXPECT_EQ(ValueThatHolds({{"a@floor.gap", ">", 5.1}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"a@floor.rn", "<", 6.1}}), 6.1);
  EXPECT_EQ(ValueThatHolds({{"a@floor.rn", "<", 5.9}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"a@floor.rt", ">", 6.9}}), 6.9);
  EXPECT_EQ(ValueThatHolds({{"b@floor.gap", ">", 7.9}}), 7.9);
  EXPECT_EQ(ValueThatHolds({{"b@floor.rn", "<", 9.1}}), 9.1);
  EXPECT_EQ(ValueThatHolds({{"b@floor.rt", "<", -9.9}}), -9.9);
  EXPECT_EQ(ValueThatHolds({{"b@floor.rt", "<", -10.1}}), -1.0);
}

TEST_F(Stop, ColumnsOfTheTableAreTheSameQuantities) {
  EXPECT_EQ(ValueThatHolds({{"y_a", ">", 1.9}}), 1.9);
  EXPECT_EQ(ValueThatHolds({{"x_b", "<", 2.9}}), -1.0);
  EXPECT_EQ(ValueThatHolds({{"gap_b@floor", ">", 7.9}}), 7.9);
  EXPECT_EQ(ValueThatHolds({{"rn_a@floor", ">", 6.1}}), -1.0);
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
