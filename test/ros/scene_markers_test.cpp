#include "contact_path/ros/scene_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <visualization_msgs/Marker.h>

#include "lattice.h"
#include "read_markers.h"

namespace contact_path::scene_markers_test {
namespace {

namespace msgs = contact_path_msgs;
using Eigen::Vector2d;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kRounding = 1e-9;  // of lengths of order 1

// A bar from a support over a slope to a free node; the slope's normal is not of unit length.
TraceRequest Slope() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "slope";
  scene.nodes = {{"pin", 0.0, 2.0, true, true}, {"foot", 3.0, 1.0, false, false}, {"roll", 5.0, 3.0, false, true}};
  scene.bars = {{{"pin", "foot"}, 10.0, 0.0, StrainMeasure::kBiot},
                {{"foot", "roll"}, 10.0, 0.0, StrainMeasure::kBiot}};
  scene.loads = {{"roll", 2.0, 0.0, false}, {"foot", 0.0, -0.5, true}};
  scene.obstacles = {{"slope", ObstacleShape::kHalfPlane, 3.0, 1.0, -3.0, 4.0, 0.5},
                     {"wall", ObstacleShape::kHalfPlane, 7.0, 0.0, -1.0, 0.0, 0.0}};
  scene.contacts = {{"foot", "slope"}, {"roll", "wall"}};
  return request;
}

const Vector2d kNormal(-0.6, 0.8);
const Vector2d kTangent(0.8, 0.6);

msgs::ContactState State(std::uint8_t state, double rn = 0.0, double rt = 0.0) {
  msgs::ContactState contact;
  contact.state = state;
  contact.rn = rn;
  contact.rt = rt;
  return contact;
}

// The foot slides on the slope, the roll is free.
msgs::Increment SlopeIncrement(double load_factor = 1.0) {
  msgs::Increment increment;
  increment.index = 17;
  increment.kind = msgs::Increment::CORNER_LIMIT;
  increment.load_factor = load_factor;
  increment.x = {0.0, 3.8, 5.5};
  increment.y = {2.0, 1.6, 3.0};
  increment.contacts = {State(msgs::ContactState::SLIP_PLUS, 1.2, -0.6), State(msgs::ContactState::OPEN)};
  return increment;
}

// One node on a spring between two walls.
TraceRequest Spring() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "spring";
  scene.nodes = {{"p", 1.0, 1.0, false, false}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}, {}}};
  scene.loads = {{"p", 1.0, 0.0, false}};
  return request;
}

msgs::Increment SpringIncrement(double load_factor) {
  msgs::Increment increment;
  increment.load_factor = load_factor;
  increment.x = {1.0 + load_factor};
  increment.y = {1.0};
  return increment;
}

double ArrowLength(const MarkerArray& picture, const std::string& name, const Vector2d& from, int id = 0) {
  return (Farthest(Find(picture, name, id), from) - from).norm();
}

using Name = std::tuple<std::string, int, int>;  // namespace, id, type

std::vector<Name> Names(const MarkerArray& picture) {
  std::vector<Name> names;
  for (const Marker& marker : picture.markers) names.emplace_back(marker.ns, marker.id, marker.type);
  return names;
}

TEST(SceneMarkersTest, AnyPictureReplacesAnyOther) {
  const SceneMarkers slope(Slope(), World());
  const SceneMarkers spring(Spring(), World());
  const std::vector<Name> names = Names(slope.Draw(SlopeIncrement(), 2.0));
  EXPECT_EQ(std::set<Name>(names.begin(), names.end()).size(), names.size());
  for (const MarkerArray& picture : {slope.Draw(SlopeIncrement(), 2.0), slope.DrawInitial(),
                                     spring.Draw(SpringIncrement(0.0), 0.0), spring.DrawInitial()}) {
    EXPECT_EQ(Names(picture), names);
    ExpectSound(picture);
  }
  const MarkerArray picture = spring.Draw(SpringIncrement(0.0), 0.0);
  for (const char* const name : {"obstacles", "supports", "contacts", "cones", "reactions", "support_reactions",
                                 "unstable_direction", "loads"}) {
    EXPECT_EQ(Find(picture, name).action, Marker::DELETE) << name;
  }
  EXPECT_EQ(Find(picture, "structure").action, Marker::DELETE);  // no bars
  EXPECT_EQ(Find(picture, "structure", 1).action, Marker::ADD);
}

TEST(SceneMarkersTest, DrawsTheStructureNowAndAsItWas) {
  const MarkerArray picture = SceneMarkers(Slope(), World()).Draw(SlopeIncrement(), 2.0);
  const std::vector<Vector2d> was = {{0.0, 2.0}, {3.0, 1.0}, {5.0, 3.0}};
  const std::vector<Vector2d> is = {{0.0, 2.0}, {3.8, 1.6}, {5.5, 3.0}};
  EXPECT_EQ(Points(Find(picture, "initial", 1)), was);
  EXPECT_EQ(Points(Find(picture, "structure", 1)), is);
  EXPECT_EQ(Points(Find(picture, "initial", 0)), (std::vector<Vector2d>{was[0], was[1], was[1], was[2]}));
  EXPECT_EQ(Points(Find(picture, "structure", 0)), (std::vector<Vector2d>{is[0], is[1], is[1], is[2]}));
}

TEST(SceneMarkersTest, SupportsStandOnTheGroundAwayFromTheirBars) {
  const std::vector<Vector2d> points =
      Points(Find(SceneMarkers(Slope(), World()).Draw(SlopeIncrement(), 2.0), "supports"));
  ASSERT_EQ(points.size(), 3U + 9U);  // the pin, and the roll with its stroke
  EXPECT_EQ(points[0], Vector2d(0.0, 2.0));
  EXPECT_EQ(points[3], Vector2d(5.5, 3.0));
  for (std::size_t i = 1; i < 3; ++i) {  // its bar goes to the right, and down
    EXPECT_LT(points[i].x(), -0.1);
    EXPECT_NEAR(points[i].y(), 2.0, 0.3);
  }
  for (std::size_t i = 4; i < 12; ++i) {  // its bar comes from below, and it is free along x
    EXPECT_GT(points[i].y(), 3.1);
    EXPECT_NEAR(points[i].x(), 5.5, 0.3);
  }
}

TEST(SceneMarkersTest, ObstaclesAreOnTheForbiddenSideAlongAllNodes) {
  const SceneMarkers markers(Slope(), World());
  for (const double far : {5.5, 60.0}) {
    msgs::Increment increment = SlopeIncrement();
    increment.x[2] = far;
    const MarkerArray picture = markers.Draw(increment, 2.0);
    const std::vector<Vector2d> strips = Points(Find(picture, "obstacles", 0));
    ASSERT_EQ(strips.size(), 12U);
    double least = 0.0;
    double from = 0.0;
    double to = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {  // the slope
      const double height = kNormal.dot(strips[i] - Vector2d(3.0, 1.0));
      EXPECT_LE(height, kRounding);
      least = std::min(least, height);
      from = std::min(from, kTangent.dot(strips[i]));
      to = std::max(to, kTangent.dot(strips[i]));
    }
    EXPECT_LT(least, -0.1);
    for (std::size_t node = 0; node < 3; ++node) {
      const double along = kTangent.dot(Vector2d(increment.x[node], increment.y[node]));
      EXPECT_GT(along, from);
      EXPECT_LT(along, to);
    }
    for (std::size_t i = 6; i < 12; ++i) EXPECT_GE(strips[i].x(), 7.0 - kRounding);  // the wall
    const std::vector<Vector2d> boundaries = Points(Find(picture, "obstacles", 1));
    ASSERT_EQ(boundaries.size(), 4U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(kNormal.dot(boundaries[i] - Vector2d(3.0, 1.0)), 0.0, kRounding);
    for (std::size_t i = 2; i < 4; ++i) EXPECT_NEAR(boundaries[i].x(), 7.0, kRounding);
    EXPECT_EQ(Find(picture, "obstacles", 2).action, Marker::DELETE);  // they do not move
  }
}

// A disc, and a table that goes down behind its edge, in place of the slope and the wall; all of both is in reach.
TraceRequest Curves() {
  TraceRequest request = Slope();
  Obstacle disc, table;
  disc.name = "slope";
  disc.shape = ObstacleShape::kCircle;
  disc.px = 2.0;
  disc.py = -2.0;
  disc.radius = 1.0;
  table.name = "wall";
  table.shape = ObstacleShape::kPolyline;
  table.points = {0.0, -1.0, 2.0, -1.0, 4.0, -3.0};
  table.fillet = 0.5;
  request.scene.obstacles = {disc, table};
  return request;
}

TEST(SceneMarkersTest, CurvesAreDrawnFromEndToEnd) {
  const std::vector<Vector2d> boundaries =
      Points(Find(SceneMarkers(Curves(), World()).Draw(SlopeIncrement(), 2.0), "obstacles", 1));
  double around = 0.0, along = 0.0;
  std::size_t i = 0;
  for (; i < boundaries.size() && std::abs((boundaries[i] - Vector2d(2.0, -2.0)).norm() - 1.0) < kRounding; i += 2)
    around += (boundaries[i + 1] - boundaries[i]).norm();
  EXPECT_NEAR(around, 2.0 * std::acos(-1.0), 0.01);
  ASSERT_LT(i, boundaries.size());
  EXPECT_LT((boundaries[i] - Vector2d(0.0, -1.0)).norm(), kRounding);
  EXPECT_LT((boundaries.back() - Vector2d(4.0, -3.0)).norm(), kRounding);
  for (; i < boundaries.size(); i += 2) along += (boundaries[i + 1] - boundaries[i]).norm();
  const double turn = 0.25 * std::acos(-1.0);  // the fillet cuts off both edges, and is as long as its turn
  EXPECT_NEAR(along, 2.0 + 2.0 * std::sqrt(2.0) - 2.0 * 0.5 * std::tan(0.5 * turn) + 0.5 * turn, 1e-3);
}

TEST(SceneMarkersTest, ObstaclesTurnAndThenMove) {
  TraceRequest request = Curves();
  request.scene.obstacle_motions = {{"wall", 1.0, 0.5, 0.5 * std::acos(-1.0), 3.0, -1.0}};
  const SceneMarkers markers(request, World());
  const std::vector<Vector2d> before = Points(Find(markers.Draw(SlopeIncrement(0.0), 2.0), "obstacles", 1));
  const std::vector<Vector2d> after = Points(Find(markers.Draw(SlopeIncrement(1.0), 2.0), "obstacles", 1));
  for (const Vector2d& end : {Vector2d(0.0, -1.0), Vector2d(4.0, -3.0)}) {
    const Vector2d arm = end - Vector2d(3.0, -1.0);
    const Vector2d turned = Vector2d(3.0, -1.0) + Vector2d(-arm.y(), arm.x()) + Vector2d(1.0, 0.5);
    const auto has = [](const std::vector<Vector2d>& points, const Vector2d& place) {
      return std::any_of(points.begin(), points.end(),
                         [&](const Vector2d& x) { return (x - place).norm() < kRounding; });
    };
    EXPECT_TRUE(has(before, end));
    EXPECT_TRUE(has(after, turned));
  }
  EXPECT_GT(Find(markers.Draw(SlopeIncrement(1.0), 2.0), "obstacles", 2).points.size(), 2U);
}

TEST(SceneMarkersTest, SlidingReactionLiesOnTheEdgeOfItsCone) {
  const Vector2d foot(3.8, 1.6);
  for (const double sign : {1.0, -1.0}) {
    msgs::Increment increment = SlopeIncrement();
    increment.contacts[0] =
        State(sign > 0.0 ? msgs::ContactState::SLIP_PLUS : msgs::ContactState::SLIP_MINUS, 1.2, -sign * 0.6);
    const MarkerArray picture = SceneMarkers(Slope(), World()).Draw(increment, 2.0);
    const Vector2d reaction = Farthest(Find(picture, "reactions"), foot) - foot;
    EXPECT_LT((reaction.normalized() - (kNormal - sign * 0.5 * kTangent).normalized()).norm(), kRounding);
    const std::vector<Vector2d> cone = Points(Find(picture, "cones"));
    ASSERT_EQ(cone.size(), 3U);
    EXPECT_EQ(cone[0], foot);
    const Vector2d edge = (cone[sign > 0.0 ? 1 : 2] - foot).normalized();
    EXPECT_LT((edge - reaction.normalized()).norm(), kRounding);
  }
}

TEST(SceneMarkersTest, ConesAreWhereThereIsFrictionToLimit) {
  const SceneMarkers markers(Slope(), World());
  msgs::Increment increment = SlopeIncrement();
  increment.contacts = {State(msgs::ContactState::STICK, 1.0, 0.2), State(msgs::ContactState::CLOSED, 1.0)};
  EXPECT_EQ(Find(markers.Draw(increment, 2.0), "cones").points.size(), 3U);
  increment.contacts = {State(msgs::ContactState::OPEN), State(msgs::ContactState::CLOSED, 1.0)};
  EXPECT_EQ(Find(markers.Draw(increment, 2.0), "cones").action, Marker::DELETE);
}

TEST(SceneMarkersTest, EachContactStateHasItsColour) {
  const SceneMarkers markers(Slope(), World());
  std::set<std::tuple<float, float, float>> colours;
  for (const std::uint8_t state : {msgs::ContactState::OPEN, msgs::ContactState::STICK, msgs::ContactState::SLIP_PLUS,
                                   msgs::ContactState::SLIP_MINUS, msgs::ContactState::CLOSED}) {
    msgs::Increment increment = SlopeIncrement();
    increment.contacts = {State(state), State(msgs::ContactState::OPEN)};
    const Marker contacts = Find(markers.Draw(increment, 2.0), "contacts");
    EXPECT_EQ(Points(contacts), (std::vector<Vector2d>{{3.8, 1.6}, {5.5, 3.0}}));
    ASSERT_EQ(contacts.colors.size(), 2U);
    colours.emplace(contacts.colors[0].r, contacts.colors[0].g, contacts.colors[0].b);
    EXPECT_EQ(contacts.colors[0] == contacts.colors[1], state == msgs::ContactState::OPEN);
  }
  EXPECT_EQ(colours.size(), 5U);
}

TEST(SceneMarkersTest, LoadsFollowTheLoadFactorUnlessTheyAreConstant) {
  const SceneMarkers markers(Slope(), World());
  const auto tips = [&markers](double load_factor) {
    const std::vector<Vector2d> points = Points(Find(markers.Draw(SlopeIncrement(load_factor), 2.0), "loads"));
    std::pair<double, double> reach;  // of the load along x at (5.5, 3), of the constant one along y at (3.8, 1.6)
    for (const Vector2d& point : points) {
      if (std::abs(point.y() - 3.0) < 0.3 && std::abs(point.x() - 5.5) > std::abs(reach.first))
        reach.first = point.x() - 5.5;
      if (std::abs(point.x() - 3.8) < 0.3 && std::abs(point.y() - 1.6) > std::abs(reach.second))
        reach.second = point.y() - 1.6;
    }
    return reach;
  };
  const auto [full, constant] = tips(1.0);
  EXPECT_GT(full, 0.0);
  EXPECT_NEAR(constant, -0.25 * full, kRounding);  // 0.5 down against 2.0
  EXPECT_NEAR(tips(-0.5).first, -0.5 * full, kRounding);
  EXPECT_NEAR(tips(-0.5).second, constant, kRounding);
  EXPECT_EQ(tips(0.0).first, 0.0);
}

TEST(SceneMarkersTest, ArrowsReadWellAndKeepTheirScale) {
  const SceneMarkers markers(Spring(), World());
  double largest = 0.0;
  double scale = 0.0;
  int changes = 0;
  double full = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double load_factor = 1e-3 * i;
    const msgs::Increment increment = SpringIncrement(load_factor);
    EXPECT_NEAR(markers.LargestForce(increment), load_factor, kRounding);
    largest = std::max(largest, markers.LargestForce(increment));
    const MarkerArray picture = markers.Draw(increment, largest);
    if (i == 0) continue;
    const double length = ArrowLength(picture, "loads", {1.0 + load_factor, 1.0});
    const Marker& sample = Find(picture, "caption", 1);
    full = 0.0;
    for (const Vector2d& a : Points(sample)) {
      for (const Vector2d& b : Points(sample)) full = std::max(full, (a - b).norm());
    }
    EXPECT_LE(length, full * (1.0 + kRounding));
    EXPECT_GE(length, 0.5 * full * (1.0 - 1e-2));  // the shaft of the sample has a width
    changes += std::abs(length / load_factor - scale) > 1e-6 * scale;
    scale = length / load_factor;
    // The caption says what an arrow of full length is.
    EXPECT_NEAR(std::stod(Find(picture, "caption", 2).text) * scale, full, 1e-2 * full);
  }
  EXPECT_LE(changes, 11);
  // Smaller forces are drawn in the scale of the largest.
  const double before = ArrowLength(markers.Draw(SpringIncrement(1.0), largest), "loads", {2.0, 1.0});
  const double after = ArrowLength(markers.Draw(SpringIncrement(0.25), largest), "loads", {1.25, 1.0});
  EXPECT_NEAR(after, 0.25 * before, kRounding);
}

TEST(SceneMarkersTest, LargestForceIsThatOfReactionsAndLoads) {
  const SceneMarkers markers(Slope(), World());
  EXPECT_NEAR(markers.LargestForce(SlopeIncrement(3.0)), 6.0, kRounding);
  EXPECT_NEAR(markers.LargestForce(SlopeIncrement(0.0)), std::hypot(1.2, 0.6), kRounding);
}

msgs::Resultant Reaction(double rx, double ry, double rm = 0.0) {
  msgs::Resultant reaction;
  reaction.rx = rx;
  reaction.ry = ry;
  reaction.rm = rm;
  return reaction;
}

// Of the pin at (0, 2) and of the roll at (5.5, 3).
TEST(SceneMarkersTest, ReactionsOfSupportsHaveTheScaleOfTheOthers) {
  const SceneMarkers markers(Slope(), World());
  msgs::Increment increment = SlopeIncrement();
  increment.supports = {Reaction(-1.5, 2.0), Reaction(0.0, 0.0)};
  EXPECT_TRUE(markers.Fits(increment));
  EXPECT_NEAR(markers.LargestForce(increment), 2.5, kRounding);
  const Vector2d pin(0.0, 2.0), foot(3.8, 1.6), roll(5.5, 3.0);
  const MarkerArray picture = markers.Draw(increment, 2.5);
  ExpectSound(picture);
  ASSERT_EQ(Find(picture, "support_reactions").points.size(), 9U);  // the roll, which does not react, has no arrow
  const Vector2d arrow = Farthest(Find(picture, "support_reactions"), pin) - pin;
  const double scale = (Farthest(Find(picture, "reactions"), foot) - foot).norm() / std::hypot(1.2, 0.6);
  EXPECT_LT((arrow - scale * Vector2d(-1.5, 2.0)).norm(), kRounding);

  increment.supports = {Reaction(0.0, 0.0), Reaction(0.0, -1.0)};
  const MarkerArray at_roll = markers.Draw(increment, 2.5);
  ASSERT_EQ(Find(at_roll, "support_reactions").points.size(), 9U);
  EXPECT_LT((Farthest(Find(at_roll, "support_reactions"), roll) - roll - scale * Vector2d(0.0, -1.0)).norm(),
            kRounding);
}

// The node that moves most has an arrow half as long as that of the full force, whatever the forces are.
TEST(SceneMarkersTest, UnstableDirectionHasArrowsOfItsOwnScale) {
  const SceneMarkers markers(Slope(), World());
  msgs::Increment increment = SlopeIncrement();
  const Vector2d foot(3.8, 1.6);
  increment.unstable_direction = {0.0, 0.0, 0.48, 0.64, -0.6, 0.0};
  const MarkerArray picture = markers.Draw(increment, 2.0);
  ExpectSound(picture);
  const Marker& arrows = Find(picture, "unstable_direction");
  ASSERT_EQ(arrows.points.size(), 18U);  // of two nodes: the pin does not move
  Marker of_foot = arrows;
  of_foot.points.resize(9);
  const Vector2d arrow = Farthest(of_foot, foot) - foot;
  EXPECT_NEAR(arrow.x() / arrow.y(), 0.75, kRounding);
  const double full = 0.2 * std::hypot(5.0, 2.0);  // of the size of the scene
  EXPECT_NEAR(arrow.norm(), 0.5 * full, kRounding);
  EXPECT_NEAR((Farthest(Find(markers.Draw(increment, 20.0), "unstable_direction"), foot) - foot).norm(),
              (Farthest(arrows, foot) - foot).norm(), kRounding);
  increment.unstable_direction = {1.0};  // of another scene
  EXPECT_EQ(Find(markers.Draw(increment, 2.0), "unstable_direction").action, Marker::DELETE);
}

TEST(SceneMarkersTest, SupportsThatDoNotReactDrawNothing) {
  const SceneMarkers markers(Slope(), World());
  msgs::Increment increment = SlopeIncrement();
  EXPECT_EQ(Find(markers.Draw(increment, 2.0), "support_reactions").action, Marker::DELETE);  // none are told
  EXPECT_EQ(Find(markers.DrawInitial(), "support_reactions").action, Marker::DELETE);
  increment.supports = {Reaction(0.0, 0.0), Reaction(0.0, 0.0)};
  EXPECT_TRUE(markers.Fits(increment));
  EXPECT_EQ(Find(markers.Draw(increment, 2.0), "support_reactions").action, Marker::DELETE);
  increment.supports.pop_back();
  EXPECT_FALSE(markers.Fits(increment));
}

TEST(SceneMarkersTest, SuperelementsAreTiedToTheirMiddleOrToTheGround) {
  const MarkerArray spring = SceneMarkers(Spring(), World()).Draw(SpringIncrement(0.5), 1.0);
  EXPECT_EQ(Points(Find(spring, "superelements", 0)), (std::vector<Vector2d>{{1.5, 1.0}, {1.0, 1.0}}));
  EXPECT_EQ(Points(Find(spring, "superelements", 1)), (std::vector<Vector2d>{{1.0, 1.0}}));
  TraceRequest strained = Spring();
  strained.scene.superelements[0].rest_positions = {0.0, 0.5};
  const MarkerArray at_rest = SceneMarkers(strained, World()).Draw(SpringIncrement(0.5), 1.0);
  EXPECT_EQ(Points(Find(at_rest, "superelements", 1)), (std::vector<Vector2d>{{0.0, 0.5}}));

  TraceRequest request = Slope();
  request.scene.superelements = {{{"pin", "foot", "roll"}, std::vector<double>(36, 0.0), {}}};
  const MarkerArray picture = SceneMarkers(request, World()).Draw(SlopeIncrement(), 2.0);
  EXPECT_EQ(Find(picture, "superelements", 0).points.size(), 6U);
  const Vector2d middle = Points(Find(picture, "superelements", 1))[0];
  EXPECT_LT((middle - Vector2d(3.1, 2.2)).norm(), kRounding);
}

// Filled elements in the colour of their energy, with their boundaries now and as they were.
TEST(SceneMarkersTest, SolidsAreFilled) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}, {"c", 1.0, 1.0},
                 {"d", 0.0, 1.0, true, true}, {"e", 2.0, 0.0}, {"f", 2.0, 1.0}};
  scene.materials = {{"rubber", MaterialModel::kNeoHookean, 1.0, 0.3}};
  scene.solids = {{"block", "rubber", 0.5, PlaneState::kStrain, 4, {"a", "b", "c", "d", "b", "e", "f", "c"}}};
  scene.loads = {{"f", 1.0, 0.0}};
  msgs::Increment increment;
  increment.x = {0.0, 1.0, 1.0, 0.0, 4.0, 4.0};  // the second element is stretched, the first one is not
  increment.y = {0.0, 0.0, 1.0, 1.0, 0.0, 1.0};
  const MarkerArray picture = SceneMarkers(request, World()).Draw(increment, 1.0);
  ExpectSound(picture);
  EXPECT_EQ(Find(picture, "solids", 0).points.size(), 16U);
  EXPECT_EQ(Find(picture, "solids", 2).points.size(), 16U);
  const Marker& filled = Find(picture, "solids", 1);
  ASSERT_EQ(filled.points.size(), 24U);  // four triangles each
  const std::vector<Vector2d> corners = Points(filled);
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vector2d along = corners[i + 1] - corners[i], up = corners[i + 2] - corners[i];
    area += 0.5 * (along.x() * up.y() - along.y() * up.x());
  }
  EXPECT_NEAR(area, 4.0, 1e-6);
  EXPECT_GT(filled.colors.front().g, 0.8F);
  EXPECT_LT(filled.colors.back().g, 0.2F);
}

TEST(SceneMarkersTest, CaptionNamesSceneIncrementKindAndLoad) {
  const SceneMarkers markers(Slope(), World());
  const std::string text = Find(markers.Draw(SlopeIncrement(-0.125), 2.0), "caption").text;
  for (const char* const part : {"slope", "17", "corner limit point", "-0.125"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_NE(Find(markers.DrawInitial(), "caption").text.find("slope"), std::string::npos);
}

TEST(SceneMarkersTest, InitialShapeHasNoReactions) {
  const MarkerArray picture = SceneMarkers(Slope(), World()).DrawInitial();
  EXPECT_EQ(Points(Find(picture, "structure", 0)), Points(Find(picture, "initial", 0)));
  EXPECT_EQ(Find(picture, "reactions").action, Marker::DELETE);
  EXPECT_EQ(Find(picture, "cones").action, Marker::DELETE);
}

TEST(SceneMarkersTest, IncrementsThatAreNotOfTheSceneDoNotFit) {
  const SceneMarkers markers(Slope(), World());
  EXPECT_TRUE(markers.Fits(SlopeIncrement()));
  EXPECT_FALSE(markers.Fits(msgs::Increment()));  // thinned out
  EXPECT_FALSE(markers.Fits(SpringIncrement(1.0)));
  msgs::Increment increment = SlopeIncrement();
  increment.contacts.pop_back();
  EXPECT_FALSE(markers.Fits(increment));
  increment = SlopeIncrement();
  increment.y.pop_back();
  EXPECT_FALSE(markers.Fits(increment));
}

// The picture looks the same in any units of length and force.
TEST(SceneMarkersTest, PictureGrowsWithTheScene) {
  const double length = 1000.0;
  const double force = 1e-3;
  TraceRequest request = Slope();
  Scene& scene = request.scene;
  for (Node& node : scene.nodes) node = {node.name, length * node.x, length * node.y, node.fixed_x, node.fixed_y};
  for (Bar& bar : scene.bars) bar.EA *= force;
  for (Load& load : scene.loads) load = {load.node, force * load.fx, force * load.fy, load.constant};
  for (Obstacle& obstacle : scene.obstacles) {
    obstacle.px *= length;
    obstacle.py *= length;
  }
  msgs::Increment increment = SlopeIncrement();
  for (double& x : increment.x) x *= length;
  for (double& y : increment.y) y *= length;
  for (msgs::ContactState& contact : increment.contacts) {
    contact.rn *= force;
    contact.rt *= force;
  }
  const MarkerArray small = SceneMarkers(Slope(), World()).Draw(SlopeIncrement(), 2.0);
  const MarkerArray large = SceneMarkers(request, World()).Draw(increment, 2.0 * force);
  ASSERT_EQ(small.markers.size(), large.markers.size());
  for (std::size_t i = 0; i < small.markers.size(); ++i) {
    const std::vector<Vector2d> a = Points(small.markers[i]);
    const std::vector<Vector2d> b = Points(large.markers[i]);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t j = 0; j < a.size(); ++j) EXPECT_LT((length * a[j] - b[j]).norm(), kRounding * length);
  }
}

// The slope is turned into a belt, after a stage that presses the foot onto it.
TraceRequest Belt() {
  TraceRequest request = Slope();
  request.scene.loads.pop_back();
  request.scene.loads[0].constant = true;  // at the roll, 2.0 along x
  Stage press;
  press.name = "press";
  press.loads = {{"foot", 0.0, -1.0, false}};
  press.support_motions = {{"pin", 0.0, -0.5}};
  press.target = 3.0;
  Stage drive;
  drive.obstacle_motions = {{"slope", 0.8, 0.6}, {"wall", 1.0, 0.0}};
  drive.loads = {{"foot", 4.0, 0.0, false}};
  request.program = {press, drive};
  return request;
}

TEST(SceneMarkersTest, MovingObstaclesHaveABoundedNumberOfStrokes) {
  const SceneMarkers markers(Belt(), World());
  msgs::Increment increment = SlopeIncrement(0.5);
  increment.stage = 2;
  for (const double far : {1e3, 1e12, 1e90}) {
    increment.x[0] = far;
    const std::size_t points = Find(markers.Draw(increment, 3.0), "obstacles", 2).points.size();
    EXPECT_GE(points, 100U) << far;
    EXPECT_LE(points, 2U * 2U * 201U) << far;
  }
}

TEST(SceneMarkersTest, StagesHaveTheirLoadsAndObstacles) {
  const SceneMarkers markers(Belt(), World());
  msgs::Increment increment = SlopeIncrement(0.5);
  increment.contacts = {State(msgs::ContactState::OPEN), State(msgs::ContactState::OPEN)};
  EXPECT_FALSE(markers.Fits(increment));
  increment.stage = 3;
  EXPECT_FALSE(markers.Fits(increment));

  increment.stage = 1;
  ASSERT_TRUE(markers.Fits(increment));
  EXPECT_NEAR(markers.LargestForce(increment), 2.0, kRounding);
  const MarkerArray press = markers.Draw(increment, 3.0);
  EXPECT_NE(Find(press, "caption").text.find("press"), std::string::npos);
  EXPECT_EQ(Find(press, "loads").points.size(), 18U);  // two arrows
  EXPECT_NEAR(Points(Find(press, "obstacles", 1))[2].x(), 7.0, kRounding);

  increment.stage = 2;
  ASSERT_TRUE(markers.Fits(increment));
  EXPECT_NEAR(markers.LargestForce(increment), 3.0, kRounding);  // what was pressed on stays
  const MarkerArray drive = markers.Draw(increment, 3.0);
  EXPECT_NE(Find(drive, "caption").text.find("stage 2"), std::string::npos);
  EXPECT_EQ(Find(drive, "loads").points.size(), 27U);
  const std::vector<Vector2d> boundaries = Points(Find(drive, "obstacles", 1));
  EXPECT_NEAR(kNormal.dot(boundaries[0] - Vector2d(3.0, 1.0)), 0.0, kRounding);  // along itself
  EXPECT_NEAR(boundaries[2].x(), 7.5, kRounding);
  // A stroke sticks to the point of the slope, wherever it is.
  const auto has_stroke_at = [](const MarkerArray& picture, const Vector2d& place) {
    const std::vector<Vector2d> strokes = Points(Find(picture, "obstacles", 2));
    return std::any_of(strokes.begin(), strokes.end(),
                       [&](const Vector2d& point) { return (point - place).norm() < kRounding; });
  };
  EXPECT_TRUE(has_stroke_at(press, {3.0, 1.0}));
  EXPECT_TRUE(has_stroke_at(drive, {3.4, 1.3}));
  EXPECT_FALSE(has_stroke_at(drive, {3.0, 1.0}));
  ExpectSound(drive);
  EXPECT_EQ(Names(markers.DrawInitial()), Names(drive));

  // The size of the picture covers the motion of the supports, too: the pin goes down by 1.5.
  const std::vector<Vector2d> boundary = Points(Find(press, "obstacles", 1));
  EXPECT_NEAR((boundary[1] - boundary[0]).norm(), 2.0 * std::hypot(5.0, 2.5), kRounding);
}

// Distance of the two points of a boundary.
double BoundaryLength(const MarkerArray& picture) {
  const std::vector<Vector2d> points = Points(Find(picture, "obstacles", 1));
  return (points[1] - points[0]).norm();
}

TEST(SceneMarkersTest, SizeIsThatOfTheWayToTheStopCriterion) {
  TraceRequest request = Slope();
  request.options.stop = {{"roll.x", ">", 12.0}, {"load_factor", ">", 1e6}, {"foot.y", "<", -1e6}};
  const double size = (Vector2d(12.0, 3.0) - Vector2d(0.0, 1.0)).norm();
  EXPECT_NEAR(BoundaryLength(SceneMarkers(request, World()).DrawInitial()), 2.0 * size, kRounding);
  request.options.stop.clear();
  EXPECT_NEAR(BoundaryLength(SceneMarkers(request, World()).DrawInitial()), 2.0 * std::hypot(5.0, 2.0), kRounding);
}

TEST(SceneMarkersTest, PictureSizeMovesAndScalesEverything) {
  MarkerOptions fitting = World();
  fitting.picture_size = 10.0;
  const double scale = 10.0 / std::hypot(5.0, 2.0);
  const Vector2d centre(2.5, 2.0);
  const MarkerArray as_it_is = SceneMarkers(Slope(), World()).Draw(SlopeIncrement(), 2.0);
  const MarkerArray fitted = SceneMarkers(Slope(), fitting).Draw(SlopeIncrement(), 2.0);
  ExpectSound(fitted);
  ASSERT_EQ(Names(fitted), Names(as_it_is));
  for (std::size_t i = 0; i < fitted.markers.size(); ++i) {
    const Marker& before = as_it_is.markers[i];
    const Marker& after = fitted.markers[i];
    for (std::size_t j = 0; j < before.points.size(); ++j) {
      EXPECT_LT((scale * (Points(before)[j] - centre) - Points(after)[j]).norm(), kRounding);
      EXPECT_NEAR(scale * before.points[j].z, after.points[j].z, kRounding);
    }
    EXPECT_NEAR((before.type == Marker::TRIANGLE_LIST ? 1.0 : scale) * before.scale.x, after.scale.x, kRounding);
    if (before.type == Marker::TEXT_VIEW_FACING) {
      EXPECT_NEAR(scale * before.scale.z, after.scale.z, kRounding);
      EXPECT_NEAR(scale * (before.pose.position.y - centre.y()), after.pose.position.y, kRounding);
    }
  }
}

TEST(SceneMarkersTest, OptionsThatMakeNoSenseAreNamed) {
  MarkerOptions options;
  EXPECT_NO_THROW(options.Validate());
  for (const char* const frame_id : {"", "/map"}) {
    options.frame_id = frame_id;
    EXPECT_THROW(options.Validate(), std::invalid_argument) << frame_id;
  }
  options.frame_id = "map";
  for (const double size : {-1.0, std::nan("")}) {
    options.picture_size = size;
    EXPECT_THROW(options.Validate(), std::invalid_argument) << size;
  }
}

TEST(SceneMarkersTest, BigScenesHaveAsManyMarkersAsSmallOnes) {
  LatticeOptions options;
  options.columns = 60;
  options.rows = 15;
  const TraceRequest request = LatticeRequest(options);
  const MarkerArray picture = SceneMarkers(request, World()).DrawInitial();
  EXPECT_EQ(picture.markers.size(), SceneMarkers(Slope(), World()).DrawInitial().markers.size());
  EXPECT_EQ(Find(picture, "structure").points.size(), 2 * request.scene.bars.size());
  ExpectSound(picture);
}

}  // namespace
}  // namespace contact_path::scene_markers_test
