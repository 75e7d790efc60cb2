#include "contact_path/scene/quantity.h"

#include <gtest/gtest.h>

#include <string>

namespace contact_path::quantity_test {
namespace {

using Kind = Quantity::Kind;

class QuantityTest : public testing::Test {
 protected:
  QuantityTest() {
    scene_.nodes = {{"a"}, {"x_b"}, {"load_factor"}};
    scene_.obstacles = {{"floor"}, {"gap_c"}};
    scene_.contacts = {{"a", "floor"}, {"x_b", "gap_c"}};
  }
  void ExpectQuantity(const std::string& text, Kind kind, std::size_t part) {
    const std::optional<Quantity> quantity = FindQuantity(text, SceneIndex(scene_));
    ASSERT_TRUE(quantity.has_value()) << text;
    EXPECT_EQ(quantity->kind, kind) << text;
    EXPECT_EQ(quantity->part, part) << text;
  }

  Scene scene_;
};

TEST_F(QuantityTest, BothSpellings) {
  ExpectQuantity("load_factor", Kind::kLoadFactor, 0);
  ExpectQuantity("a.x", Kind::kX, 0);
  ExpectQuantity("x_a", Kind::kX, 0);
  ExpectQuantity("a.y", Kind::kY, 0);
  ExpectQuantity("y_a", Kind::kY, 0);
  ExpectQuantity("x_b.y", Kind::kY, 1);
  ExpectQuantity("x_x_b", Kind::kX, 1);
  ExpectQuantity("load_factor.x", Kind::kX, 2);
  ExpectQuantity("y_load_factor", Kind::kY, 2);
  ExpectQuantity("a@floor.gap", Kind::kGap, 0);
  ExpectQuantity("gap_a@floor", Kind::kGap, 0);
  ExpectQuantity("a@floor.rn", Kind::kRn, 0);
  ExpectQuantity("rn_x_b@gap_c", Kind::kRn, 1);
  ExpectQuantity("x_b@gap_c.rt", Kind::kRt, 1);
  ExpectQuantity("rt_a@floor", Kind::kRt, 0);
}

TEST_F(QuantityTest, PlacesOfObstacles) {
  ExpectQuantity("floor.x", Kind::kObstacleX, 0);
  ExpectQuantity("y_gap_c", Kind::kObstacleY, 1);
  ExpectQuantity("gap_c.turn", Kind::kTurn, 1);
  scene_.obstacles[1].name = "x_b";  // the node is meant
  ExpectQuantity("x_b.y", Kind::kY, 1);
  ExpectQuantity("turn_x_b", Kind::kTurn, 1);
  EXPECT_EQ(FindQuantity("a.turn", SceneIndex(scene_)), std::nullopt);
  EXPECT_EQ(NearestPart(*ReadQuantity("flor.y"), scene_).Get(), "floor");
}

TEST_F(QuantityTest, SupportsBoundariesAndSections) {
  scene_.nodes[1].fixed_y = true;
  scene_.bars = {{{"a", "x_b"}, 1.0}};
  ExpectQuantity("x_b.ry", Kind::kForceY, 0);
  ExpectQuantity("ry_x_b", Kind::kForceY, 0);
  ExpectQuantity("gap_c.rx", Kind::kForceX, 1);
  ExpectQuantity("rm_floor", Kind::kMoment, 0);
  ExpectQuantity("floor.width", Kind::kWidth, 0);
  ExpectQuantity("a@floor.pressure", Kind::kPressure, 0);
  ExpectQuantity("traction_x_b@gap_c", Kind::kTraction, 1);
  ExpectQuantity("bar1.N", Kind::kN, 0);
  ExpectQuantity("N_bar1", Kind::kN, 0);
  EXPECT_EQ(FindQuantity("floor.rx", SceneIndex(scene_))->of, Quantity::Of::kBoundary);
  EXPECT_EQ(FindQuantity("x_b.ry", SceneIndex(scene_))->of, Quantity::Of::kSupport);
  // A free component has no reaction, a node without a beam no moment, a bar that is not there no section.
  for (const char* text : {"x_b.rx", "x_b.rm", "a.ry", "load_factor.rx", "bar0.N", "bar2.N", "bar1.sxx", "wall.rx"})
    EXPECT_EQ(FindQuantity(text, SceneIndex(scene_)), std::nullopt) << text;
}

TEST_F(QuantityTest, OtherTextsAreNone) {
  for (const char* text : {"",
                           ".",
                           "_",
                           "a",
                           "x",
                           ".x",
                           "x_",
                           "a.",
                           "a.z",
                           "z_a",
                           "a.rn",
                           "rn_a",
                           "a@floor",
                           "a@floor.x",
                           "x_a@floor",
                           "a@floor.state",
                           "state_a@floor",
                           "q.x",
                           "x_q",
                           "a@wall.gap",
                           "Load_factor",
                           "a .x",
                           "a.x.y",
                           "index",
                           "arc_length"})
    EXPECT_EQ(FindQuantity(text, SceneIndex(scene_)), std::nullopt) << text;
}

TEST_F(QuantityTest, UnitsAreThoseOfTheColumns) {
  for (const Kind kind : {Kind::kX, Kind::kY, Kind::kGap}) EXPECT_EQ(UnitOf(kind).length, 1);
  for (const Kind kind : {Kind::kRn, Kind::kRt}) EXPECT_EQ(UnitOf(kind).force, 1);
  EXPECT_EQ(UnitOf(Kind::kLoadFactor).load_factor, 1);
}

TEST_F(QuantityTest, IsSpelledAsItIsRead) {
  for (const std::string text : {"load_factor", "a.x", "y_a", "a@floor.gap", "rt_x_b@gap_c"}) {
    const std::optional<SpelledQuantity> spelled = ReadQuantity(text);
    ASSERT_TRUE(spelled.has_value()) << text;
    EXPECT_EQ(QuantityText(spelled->kind, spelled->name, spelled->is_column), text);
  }
}

}  // namespace
}  // namespace contact_path::quantity_test
