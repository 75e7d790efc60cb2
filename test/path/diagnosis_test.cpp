#include "contact_path/path/diagnosis.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::diagnosis_test {
namespace {

Scene TwoBars() {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 2.0, 0.0, false, false}, {"c", 2.0, 1.0, false, false}};
  scene.bars = {{{"a", "b"}, 1.0}, {{"b", "c"}, 1.0}};
  return scene;
}

std::string Collapsed(const std::vector<double>& positions) {
  const Scene scene = TwoBars();
  return EndText(CollapsedPart(scene, SceneIndex(scene), positions));
}

TEST(CollapsedPart, NamesTheOneThatHasShrunkMost) {
  EXPECT_EQ(Collapsed({0.0, 0.0, 0.015, 0.0, 0.015, 1e-3}), "bar 1 (b, c) has shrunk to 0.001 of its initial length");
  EXPECT_EQ(Collapsed({0.0, 0.0, 0.0, 1e-7, 0.0, 1e-3}), "bar 0 (a, b) has shrunk to 5e-08 of its initial length");
}

TEST(CollapsedPart, NamesTheSpanOfATendon) {
  Scene scene;
  scene.nodes = {{"a", -1.0, 0.0}, {"b", 1.0, 0.0}, {"c", 3.0, 0.0, true, true}, {"d", -3.0, 0.0, true, true}};
  scene.superelements = {{{"a"}, {1.0, 0.0, 0.0, 1.0}}, {{"b"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.tendons = {{"cord", {"d", "a", "b", "c"}, 10.0}};
  scene.loads = {{"a", 1.0, 0.0}, {"b", -1.0, 0.0}};
  const TracedPath path = TraceIncrements(RequestUntil({"load_factor", ">", 10.0}, scene));
  EXPECT_FALSE(path.result.reached);
  EXPECT_NE(path.result.message.find("what tendon cord (a, b) has between two nodes has shrunk to "), std::string::npos)
      << path.result.message;
}

TEST(CollapsedPart, SaysNothingOfLongOnes) { EXPECT_EQ(Collapsed({0.0, 0.0, 0.1, 0.0, 0.1, 0.1}), ""); }

// A soft bar with a contact and a stiff one without: F = 1e4.
TEST(ContactTooSoft, NamesTheContact) {
  Scene scene = TwoBars();
  scene.nodes[2].fixed_x = scene.nodes[2].fixed_y = true;
  scene.bars[0].EA = 1e-4;
  scene.bars[1] = {{"a", "c"}, 1e12};
  scene.loads = {{"b", 1.0, 0.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  scene.contacts = {{"b", "floor"}};
  const Model model(scene, CharacteristicScales(scene));
  const PathPoint point = model.InitialPoint();
  EXPECT_EQ(
      EndText(ContactTooSoft(model, point, 1e-7)),
      "the sign of the stiffness of the parts at contact b@floor is not known: its value is 5e-05, its error 0.00047");
  EXPECT_TRUE(ContactTooSoft(model, point, 1e-9).empty());
}

constexpr double kFriction = 0.3;

// A node at (x, 0) that is pressed with the characteristic force onto an obstacle, on springs of 1, and is about to
// slide towards +t.
struct Pressed {
  Pressed(const Obstacle& obstacle, double x)
      : scene(SceneWith(obstacle, x)), model(scene, CharacteristicScales(scene)), point(model.InitialPoint()) {
    SetReaction(0, 1.0, -kFriction, &point);
  }

  static Scene SceneWith(Obstacle obstacle, double x) {
    obstacle.friction = kFriction;
    Scene scene;
    scene.nodes = {{"p", x, 0.0, false, false}};
    scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
    scene.loads = {{"p", 1.0, 0.0}};
    scene.obstacles = {obstacle};
    scene.contacts = {{"p", obstacle.name}};
    return scene;
  }

  Scene scene;
  Model model;
  PathPoint point;
};

Obstacle Table(double fillet) {
  Obstacle table{"table", ObstacleShape::kPolyline};
  table.points = {-1.0, 0.0, 0.2, 0.0, 0.2, -1.0};
  table.fillet = fillet;
  return table;
}

Obstacle Disc(double radius) { return Circle("disc", 0.0, -radius, radius, 0.0); }

// The fillet takes its radius off of the edge, and begins there.
TEST(CurveTooSharp, NamesTheContactWhereTheCurveBegins) {
  const auto text = [](double fillet, double x) {
    const Pressed at(Table(fillet), x);
    return EndText(CurveTooSharp(at.model, at.point));
  };
  EXPECT_EQ(
      text(1e-9, 0.2 - 1e-9),
      "contact p@table is pressed onto a curve of the radius 1e-09: rounding of the coordinates turns its reaction "
      "by 2.7e-07 rad");
  EXPECT_EQ(text(1e-9, 0.1), "");
  EXPECT_EQ(text(1e-3, 0.2 - 1e-3), "");
}

TEST(CurveTooSharp, NamesADiscNextToTheOriginOnlyWhereItHidesTheParts) {
  const Pressed small(Disc(1e-9), 0.0);
  EXPECT_TRUE(CurveTooSharp(small.model, small.point).empty());
  const Pressed smaller(Disc(1e-12), 0.0);
  EXPECT_EQ(EndText(CurveTooSharp(smaller.model, smaller.point)),
            "contact p@disc is pressed onto a curve of the radius 1e-12: reaction over radius is 1e+12 of the "
            "characteristic stiffness, which is lost in rounding beside it");
}

TEST(HiddenSlip, NamesAContactThatIsAboutToSlide) {
  Pressed at(Disc(1e-10), 0.0);
  EXPECT_EQ(
      EndText(HiddenSlip(at.model, at.point)),
      "the sign of the slip per load factor of contact p@disc is not known: its value is 9.2e-11, its error 1e-09; "
      "contact p@disc is pressed onto a curve of the radius 1e-10");
  at.point.forces[1] = -0.29;
  EXPECT_TRUE(HiddenSlip(at.model, at.point).empty());
}

TEST(HiddenSlip, SaysNothingOfALargerDisc) {
  const Pressed at(Disc(1e-8), 0.0);
  EXPECT_TRUE(HiddenSlip(at.model, at.point).empty());
}

// The sign of a reaction is known beyond 1e-11 F, or beyond the rounding of the point where that is larger.
TEST(PullingContact, TellsASignThatIsNotKnownFromAFailure) {
  Pressed at(Disc(1.0), 0.0);
  at.point.forces[0] = -1.2e-12;
  EXPECT_FALSE(PullingContact(at.model, at.point, 1.0));
  const std::optional<End> small = PullingContact(at.model, at.point, 5e-12);
  ASSERT_TRUE(small);
  EXPECT_EQ(small->reason, EndReason::kNotDetermined);
  EXPECT_EQ(EndText(small->causes),
            "the sign of the reaction of contact p@disc is not known: its value is -1.2e-12, its error 1e-11");
  at.point.forces[0] = -1e-3;
  const std::optional<End> large = PullingContact(at.model, at.point, 1e-2);
  ASSERT_TRUE(large);
  EXPECT_EQ(large->reason, EndReason::kNumericalFailure);
  EXPECT_EQ(EndText(large->causes), "contact p@disc pulls with 0.001, and the error of its reaction is 1e-11");
}

}  // namespace
}  // namespace contact_path::diagnosis_test
