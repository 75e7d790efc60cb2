#include "contact_path/scene/request_field.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace contact_path::request_field_test {
namespace {

// A node is called "1", as the place of another one; bars have no names.
TraceRequest MakeRequest() {
  TraceRequest request;
  request.scene.nodes = {{"a", 0.0, 5.0, true, true}, {"b", -5.0, 0.0}, {"1", 2.0, 0.0}};
  request.scene.bars.resize(2);
  request.scene.beams.resize(1);
  request.scene.beams[0].hinged = {false, false};
  request.scene.obstacles.push_back({"floor"});
  request.scene.obstacles[0].points = {0.0, 1.0, 2.0, 3.0};
  request.options.stop = {{"b.x", ">", 1.0}};
  request.program.resize(2);
  request.program[1].name = "push";
  request.program[1].loads = {{"b", 1.0}};
  return request;
}

TraceRequest Changed(const std::string& path, const std::string& value) {
  TraceRequest request = MakeRequest();
  SetField(path, value, &request);
  return request;
}

// What FindField() says of a path that leads nowhere.
std::string RuleOf(const std::string& path) {
  try {
    FindField(path, MakeRequest());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "is found";
}

std::string RuleOf(const std::string& path, const std::string& value) {
  try {
    Changed(path, value);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "is set";
}

TEST(SetField, FollowsNamesAndPlaces) {
  EXPECT_EQ(Changed("nodes.b.x", "7.5").scene.nodes[1].x, 7.5);
  EXPECT_EQ(Changed("nodes.0.y", "-1e-3").scene.nodes[0].y, -1e-3);
  EXPECT_EQ(Changed("bars.1.EA", "3").scene.bars[1].EA, 3.0);
  EXPECT_EQ(Changed("obstacles.floor.points.2", "8").scene.obstacles[0].points[2], 8.0);
  EXPECT_TRUE(Changed("beams.0.hinged.1", "true").scene.beams[0].hinged[1]);
  EXPECT_EQ(Changed("options.step", "0.25").options.step, 0.25);
  EXPECT_EQ(Changed("options.stop.0.value", "2").options.stop[0].value, 2.0);
  EXPECT_EQ(Changed("program.push.loads.0.fx", "9").program[1].loads[0].fx, 9.0);
  EXPECT_EQ(Changed("program.0.target", "4").program[0].target, 4.0);
}

TEST(SetField, TakesNamesBeforePlaces) { EXPECT_EQ(Changed("nodes.1.x", "7").scene.nodes[2].x, 7.0); }

TEST(SetField, ReadsValuesOfAllTypes) {
  EXPECT_EQ(Changed("options.max_increments", "12").options.max_increments, 12);
  EXPECT_TRUE(Changed("nodes.b.fixed_x", "yes").scene.nodes[1].fixed_x);
  EXPECT_EQ(Changed("options.method", "mpec").options.method, Method::kMpec);
  EXPECT_EQ(Changed("options.stop.0.when", "<").options.stop[0].when, "<");
  EXPECT_EQ(Changed("name", "yes").scene.name, "yes");  // text needs no quotes
}

TEST(SetField, RefusesValuesOfOtherTypes) {
  EXPECT_EQ(RuleOf("nodes.b.x", "far"), "must be a number");
  EXPECT_EQ(RuleOf("options.max_increments", "1.5"), "must be an integer");
  EXPECT_EQ(RuleOf("nodes.b.fixed_x", "maybe"), "must be true or false");
  EXPECT_EQ(RuleOf("options.method", "mpek"), "must be branch or mpec; did you mean mpec?");
}

TEST(FindField, GivesAllPathsToAFieldOneKey) {
  EXPECT_EQ(FindField("obstacles.floor.friction", MakeRequest()).key, "scene.obstacles[0].friction");
  EXPECT_EQ(FindField("obstacles.0.friction", MakeRequest()).key, "scene.obstacles[0].friction");
  EXPECT_EQ(FindField("program.push.target", MakeRequest()).key, "program[1].target");
}

TEST(FindField, TellsTheKind) {
  EXPECT_EQ(FindField("nodes.b.x", MakeRequest()).kind, "number");
  EXPECT_EQ(FindField("options.max_increments", MakeRequest()).kind, "integer");
  EXPECT_EQ(FindField("nodes.b.fixed_x", MakeRequest()).kind, "truth");
  EXPECT_EQ(FindField("options.method", MakeRequest()).kind, "text");
  EXPECT_EQ(FindField("nodes.b.name", MakeRequest()).kind, "text");
}

TEST(FindField, SaysWhatAPathMustDo) {
  EXPECT_EQ(RuleOf("obstacles.flor.friction"),
            "must name an element of obstacles, by its name or its place from 0 to 0; did you mean floor?");
  EXPECT_EQ(RuleOf("bars.2.EA"), "must name an element of bars, by its name or its place from 0 to 1");
  EXPECT_EQ(RuleOf("bars.-1.EA"), "must name an element of bars, by its name or its place from 0 to 1");
  EXPECT_EQ(RuleOf("bars..EA"), "must name an element of bars, by its name or its place from 0 to 1");
  EXPECT_EQ(RuleOf("solids.0.plane"), "must not name an element of solids, which has none");
  EXPECT_EQ(RuleOf("obstacles.floor.frction"), "must name a field of obstacles[0]; did you mean friction?");
  EXPECT_EQ(RuleOf("obstcles.floor.friction"), "must name a field of the scene; did you mean obstacles?");
  EXPECT_EQ(RuleOf("options.stop.0.limit"), "must name a field of options.stop[0]: quantity, when, value, exact");
  EXPECT_EQ(RuleOf("obstacles.floor.friction.x"), "must end at obstacles[0].friction, which has no fields");
  EXPECT_EQ(RuleOf("bars"), "must go on to one of the 2 elements of bars");
  EXPECT_EQ(RuleOf("options.stop.0"), "must go on to a field of options.stop[0]: quantity, when, value, exact");
  EXPECT_EQ(RuleOf("").substr(0, 33), "must name a field of the scene: n");
}

}  // namespace
}  // namespace contact_path::request_field_test
