// Beams and moments in the pictures of SceneMarkers.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact_path/ros/scene_markers.h"
#include "read_markers.h"

namespace contact_path::beam_markers_test {
namespace {

namespace msgs = contact_path_msgs;
using Eigen::Vector2d;
using visualization_msgs::MarkerArray;

constexpr double kRounding = 1e-9;  // of lengths of order 1
const double kPi = std::acos(-1.0);

// A beam of length 1 along x.
TraceRequest Leg(int segments, std::vector<bool> hinged = {}) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "leg";
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}};
  Beam& leg = scene.beams.emplace_back();
  leg.name = "leg";
  leg.nodes = {"a", "b"};
  leg.EA = 1000.0;
  leg.EI = 1.0;
  leg.segments = segments;
  leg.hinged = std::move(hinged);
  return request;
}

// Bent to an arc of a circle that turns by `angle`, with nodes in the order of the scene: a, b, inner ones.
msgs::Increment BentLeg(int segments, double angle) {
  msgs::Increment increment;
  increment.load_factor = 1.0;
  const auto add = [&](int i) {
    const double turn = angle * i / segments;
    increment.x.push_back(std::sin(turn) / angle);
    increment.y.push_back((1.0 - std::cos(turn)) / angle);
    increment.rotation.push_back(turn);
  };
  add(0);
  add(segments);
  for (int i = 1; i < segments; ++i) add(i);
  return increment;
}

TEST(BeamMarkersTest, FourSegmentsMakeASmoothCircle) {
  const double angle = 1.5 * kPi;
  const MarkerArray picture = SceneMarkers(Leg(4), World()).Draw(BentLeg(4, angle), 1.0);
  ExpectSound(picture);
  const std::vector<Vector2d> points = Points(Find(picture, "structure", 0));
  ASSERT_EQ(points.size(), 2U * 4U * 16U);
  const double radius = 1.0 / angle;
  for (const Vector2d& point : points) EXPECT_NEAR((point - Vector2d(0.0, radius)).norm(), radius, 0.003 * radius);
  for (std::size_t i = 2; i < points.size(); i += 2) {
    const Vector2d before = points[i - 1] - points[i - 2], after = points[i + 1] - points[i];
    EXPECT_EQ(points[i], points[i - 1]);
    const double turn = std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    EXPECT_NEAR(turn, angle / 64.0, 0.1 * angle / 64.0) << i;
  }
  // Dots are at the ends alone.
  EXPECT_EQ(Find(picture, "structure", 1).points.size(), 2U);
  EXPECT_EQ(Find(picture, "initial", 1).points.size(), 2U);
}

TEST(BeamMarkersTest, StressFreeArcIsACircle) {
  for (const std::vector<bool>& hinged : {std::vector<bool>{}, {true, false}, {true, true}}) {
    TraceRequest request = Leg(3, hinged);
    request.scene.beams[0].angle = 2.5;
    const MarkerArray picture = SceneMarkers(request, World()).DrawInitial();
    const double radius = 0.5 / std::sin(1.25);
    for (const char* const name : {"initial", "structure"})
      for (const Vector2d& point : Points(Find(picture, name)))
        EXPECT_NEAR((point - Vector2d(0.5, 0.5 / std::tan(1.25))).norm(), radius, 0.001 * radius);
  }
}

TEST(BeamMarkersTest, HingedEndIsNotBent) {
  for (const double turns : {0.0, 4.0 * kPi}) {
    msgs::Increment increment;
    increment.x = {0.0, 1.0};
    increment.y = {0.0, 0.0};
    increment.rotation = {0.0, 0.1 + turns};
    const SceneMarkers markers(Leg(1, {true, false}), World());
    const std::vector<Vector2d> points = Points(Find(markers.Draw(increment, 1.0), "structure"));
    const auto slope = [&](std::size_t line) {
      const Vector2d along = points[2 * line + 1] - points[2 * line];
      return along.y() / along.x();
    };
    EXPECT_NEAR(slope(0), -0.05, 1e-3);
    EXPECT_NEAR(slope(15), 0.1, 1e-2);
    EXPECT_LT(std::abs(slope(1) - slope(0)), 0.15 * std::abs(slope(15) - slope(14)));
  }
}

TEST(BeamMarkersTest, IncrementsWithoutRotationsDoNotFit) {
  const SceneMarkers markers(Leg(4), World());
  msgs::Increment increment = BentLeg(4, 1.0);
  EXPECT_TRUE(markers.Fits(increment));
  increment.rotation.clear();
  EXPECT_FALSE(markers.Fits(increment));
}

// The angle that the arrow of a moment on a node goes around, > 0 to the left.
double TurnAround(const Vector2d& node, const std::vector<Vector2d>& points) {
  if (points.empty()) return 0.0;
  double turn = 0.0;
  Vector2d before = points.front() - node;
  for (const Vector2d& point : points) {
    const Vector2d now = point - node;
    turn += std::atan2(before.x() * now.y() - before.y() * now.x(), before.dot(now));
    before = now;
  }
  // The last corner is of the head, behind its tip.
  const Vector2d head = points[points.size() - 2] - node;
  return turn + std::atan2(before.x() * head.y() - before.y() * head.x(), before.dot(head));
}

// Of the moment at the tip.
double TurnAtTip(const MarkerArray& picture, const msgs::Increment& increment) {
  return TurnAround({increment.x[1], increment.y[1]}, Points(Find(picture, "loads")));
}

TEST(BeamMarkersTest, MomentsAreArrowsThatTurnByTheirSize) {
  for (const double sign : {1.0, -1.0}) {
    TraceRequest request = Leg(4);
    request.scene.loads = {{"b", 0.0, 0.0, false, sign * 2.0}};
    const SceneMarkers markers(request, World());
    msgs::Increment increment = BentLeg(4, 1.0);
    EXPECT_NEAR(markers.LargestForce(increment), 2.0, kRounding);  // the size of the scene is 1
    const MarkerArray picture = markers.Draw(increment, 2.0);
    ExpectSound(picture);
    const double turn = TurnAtTip(picture, increment);
    EXPECT_GT(sign * turn, 0.5 * 1.5 * kPi);  // half of the full turn, or more
    EXPECT_LE(sign * turn, 1.5 * kPi + kRounding);
    increment.load_factor = 0.5;
    EXPECT_NEAR(TurnAtTip(markers.Draw(increment, 2.0), increment), 0.5 * turn, kRounding);
    increment.load_factor = 0.0;
    EXPECT_EQ(Find(markers.Draw(increment, 2.0), "loads").action, visualization_msgs::Marker::DELETE);
    EXPECT_NE(Find(picture, "caption", 2).text.find("turned by 3/4: "), std::string::npos);
  }
}

// The moment of a clamp, in the scale of the moments of loads; the force of the clamp is an arrow besides.
TEST(BeamMarkersTest, MomentsOfClampsAreTurnedArrows) {
  TraceRequest request = Leg(4);
  request.scene.nodes[0].fixed_rotation = true;
  request.scene.loads = {{"b", 0.0, 0.0, false, 2.0}};
  const SceneMarkers markers(request, World());
  msgs::Increment increment = BentLeg(4, 1.0);
  increment.supports.resize(1);
  for (const double moment : {-2.0, 1.0}) {
    increment.supports[0].rm = moment;
    EXPECT_NEAR(markers.LargestForce(increment), 2.0, kRounding);
    const MarkerArray picture = markers.Draw(increment, 2.0);
    ExpectSound(picture);
    EXPECT_NEAR(TurnAround(Vector2d::Zero(), Points(Find(picture, "support_reactions"))),
                0.5 * moment * TurnAtTip(picture, increment), kRounding);
    EXPECT_NE(Find(picture, "caption", 2).text.find("turned by 3/4: "), std::string::npos);
  }
  const std::size_t points = Find(markers.Draw(increment, 2.0), "support_reactions").points.size();
  increment.supports[0].rx = 1.0;
  EXPECT_EQ(Find(markers.Draw(increment, 2.0), "support_reactions").points.size(), points + 9U);
}

}  // namespace
}  // namespace contact_path::beam_markers_test
