// Surfaces that contacts touch, in pictures.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "contact_path/ros/scene_markers.h"
#include "read_markers.h"

namespace contact_path::surface_markers_test {
namespace {

namespace msgs = contact_path_msgs;
using Eigen::Vector2d;
using visualization_msgs::Marker;

// A node p over the middle of three nodes that two bars join, with a thickness.
TraceRequest Bridge() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"p", 1.0, 2.0}, {"l", 0.0, 0.0, true, true}, {"m", 1.0, 0.0, true}, {"r", 2.0, 0.0, true, true}};
  scene.bars = {{{"l", "m"}, 10.0}, {{"m", "r"}, 10.0}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.surfaces = {{"top", {"l", "m", "r"}, false, 0.5}, {"for_tractions", {"r", "m"}}};
  scene.loads = {{"p", 0.0, -1.0}};
  scene.contacts.resize(1);
  scene.contacts[0].node = "p";
  scene.contacts[0].surface = "top";
  scene.contacts[0].friction = 0.3;
  return request;
}

// The middle has come down by 0.8; the curve passes it at an eighth of the second difference, 0.2.
msgs::Increment Bent() {
  msgs::Increment increment;
  increment.x = {1.0, 0.0, 1.0, 2.0};
  increment.y = {-0.1, 0.0, -0.8, 0.0};
  increment.contacts.resize(1);
  increment.contacts[0].state = msgs::ContactState::STICK;
  increment.contacts[0].rn = 1.0;
  return increment;
}

TEST(SurfaceMarkersTest, AreDrawnAtTheirRadiusWhereTheirNodesAre) {
  const std::vector<Vector2d> points = Points(Find(SceneMarkers(Bridge(), World()).Draw(Bent(), 1.0), "surfaces"));
  ASSERT_FALSE(points.empty());
  const auto has = [&](const Vector2d& place) {
    return std::any_of(points.begin(), points.end(), [&](const Vector2d& x) { return (x - place).norm() < 1e-12; });
  };
  EXPECT_TRUE(has({1.0, -0.6 + 0.5}));
  const Vector2d normal = Vector2d(0.8, 1.0).normalized();  // of the straight half edges at both ends
  EXPECT_TRUE(has(0.5 * normal));
  EXPECT_TRUE(has(Vector2d(2.0, 0.0) + 0.5 * Vector2d(-normal.x(), normal.y())));
}

TEST(SurfaceMarkersTest, ReactionsAndConesStandOnThem) {
  const visualization_msgs::MarkerArray picture = SceneMarkers(Bridge(), World()).Draw(Bent(), 1.0);
  const Vector2d node(1.0, -0.1), tip = Farthest(Find(picture, "reactions"), node);
  EXPECT_NEAR(tip.x(), node.x(), 1e-12);
  EXPECT_GT(tip.y(), node.y());
  EXPECT_EQ(Find(picture, "cones").action, Marker::ADD);
}

TEST(SurfaceMarkersTest, OfTractionsAreNotDrawn) {
  TraceRequest request = Bridge();
  request.scene.contacts.clear();
  msgs::Increment increment = Bent();
  increment.contacts.clear();
  EXPECT_EQ(Find(SceneMarkers(request, World()).Draw(increment, 1.0), "surfaces").action, Marker::DELETE);
}

}  // namespace
}  // namespace contact_path::surface_markers_test
