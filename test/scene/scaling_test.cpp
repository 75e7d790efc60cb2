#include "contact_path/scene/scaling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/validate.h"
#include "support/beams.h"
#include "support/transformations.h"

namespace contact_path::scaling_test {
namespace {

// Rounding of a few operations on numbers of order 1.
constexpr double kRounding = 1e-14;

// Two bars and a superelement, several loads, an inclined obstacle. No node is fixed along one axis only, so that the
// scene may be turned.
Scene SceneWithBars() {
  Scene scene;
  scene.name = "bars";
  scene.nodes = {{"a", 0.3, 5.1, true, true}, {"b", -5.2, 0.4}, {"c", 7.7, -1.3}, {"d", 2.1, 2.2}};
  scene.bars = {{{"a", "b"}, 3.1},
                {{"b", "c"}, 0.7, 11.0, StrainMeasure::kGreenLagrange},
                {{"c", "d"}, 5.9, 0.0, StrainMeasure::kLogarithmic}};
  scene.superelements = {{{"c", "d"},
                          {2.0, 0.5, -1.0, 0.3, 0.5, 3.0, 0.1, -0.7,  //
                           -1.0, 0.1, 4.0, 0.2, 0.3, -0.7, 0.2, 1.0}}};
  scene.loads = {{"b", 1.3, 0.2}, {"c", 0.1, -0.9, true}, {"d", 0.3, -0.4},
                 {"b", 0.7, 1.1}, {"a", 9.0, -8.0},       {"b", -0.6, 0.1}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, -0.5, -4.0, 0.3, 2.0, 0.4}};
  scene.contacts = {{"b", "floor"}, {"c", "floor"}};
  return scene;
}

Scene SceneWithoutBars() {
  Scene scene = SceneWithBars();
  scene.name = "no bars";
  scene.bars.clear();
  scene.superelements.push_back({{"b"}, {1.0, -1.5, -1.5, 4.0}});
  return scene;
}

// Two stiff nodes and a soft one: the soft one moves far.
Scene SceneOfSoftParts() {
  Scene scene = SceneWithoutBars();
  scene.name = "soft parts";
  scene.superelements = {{{"b", "c"},
                          {9e4, 5e3, -1e3, 3e3, 5e3, 8e4, 1e3, -7e3,  //
                           -1e3, 1e3, 7e4, 2e3, 3e3, -7e3, 2e3, 6e4}},
                         {{"d"}, {1.0, -1.5, -1.5, 4.0}}};
  return scene;
}

TraceRequest RequestOf(const Scene& scene) {
  TraceRequest request;
  request.scene = scene;
  return request;
}

void ExpectNear(double actual, double expected, const std::string& what) {
  EXPECT_NEAR(actual, expected, kRounding * std::max(1.0, std::abs(expected))) << what;
}

void ExpectSame(const Scaling& actual, const Scaling& expected) {
  EXPECT_NEAR(actual.length / expected.length, 1.0, kRounding);
  EXPECT_NEAR(actual.force / expected.force, 1.0, kRounding);
  EXPECT_NEAR(actual.load_factor / expected.load_factor, 1.0, kRounding);
}

void ExpectSame(const Scene& actual, const Scene& expected) {
  ASSERT_EQ(actual.nodes.size(), expected.nodes.size());
  for (std::size_t i = 0; i < expected.nodes.size(); ++i) {
    EXPECT_EQ(actual.nodes[i].name, expected.nodes[i].name);
    ExpectNear(actual.nodes[i].x, expected.nodes[i].x, "x");
    ExpectNear(actual.nodes[i].y, expected.nodes[i].y, "y");
  }
  ASSERT_EQ(actual.bars.size(), expected.bars.size());
  for (std::size_t i = 0; i < expected.bars.size(); ++i) {
    ExpectNear(actual.bars[i].EA, expected.bars[i].EA, "EA");
    ExpectNear(actual.bars[i].rest_length, expected.bars[i].rest_length, "rest_length");
  }
  ASSERT_EQ(actual.superelements.size(), expected.superelements.size());
  for (std::size_t i = 0; i < expected.superelements.size(); ++i) {
    for (std::size_t k = 0; k < expected.superelements[i].stiffness.size(); ++k) {
      ExpectNear(actual.superelements[i].stiffness[k], expected.superelements[i].stiffness[k], "stiffness");
    }
  }
  ASSERT_EQ(actual.loads.size(), expected.loads.size());
  for (std::size_t i = 0; i < expected.loads.size(); ++i) {
    ExpectNear(actual.loads[i].fx, expected.loads[i].fx, "fx");
    ExpectNear(actual.loads[i].fy, expected.loads[i].fy, "fy");
  }
  ASSERT_EQ(actual.obstacles.size(), expected.obstacles.size());
  for (std::size_t i = 0; i < expected.obstacles.size(); ++i) {
    ExpectNear(actual.obstacles[i].px, expected.obstacles[i].px, "px");
    ExpectNear(actual.obstacles[i].py, expected.obstacles[i].py, "py");
    ExpectNear(actual.obstacles[i].nx, expected.obstacles[i].nx, "nx");
    ExpectNear(actual.obstacles[i].ny, expected.obstacles[i].ny, "ny");
    ExpectNear(actual.obstacles[i].friction, expected.obstacles[i].friction, "friction");
  }
}

class ScalingTest : public testing::TestWithParam<std::function<Scene()>> {};

INSTANTIATE_TEST_SUITE_P(Scenes, ScalingTest, testing::Values(SceneWithBars, SceneWithoutBars, SceneOfSoftParts));

TEST_P(ScalingTest, SceneIsSound) {
  for (const Violation& violation : Validate(RequestOf(GetParam()()))) ADD_FAILURE() << violation.ToLine();
}

TEST_P(ScalingTest, UnitsChangeTheScalesAndNotTheScaledScene) {
  const Scene scene = GetParam()();
  const Scaling scaling = CharacteristicScales(scene);
  for (const double length : {1.0, 1000.0, 1.0 / 0.0254, 1e-40}) {
    for (const double force : {1.0, 4.4482216152605, 1e-3, 1e40}) {
      const Scene other = ChangeUnits(RequestOf(scene), length, force).scene;
      const Scaling other_scaling = CharacteristicScales(other);
      ExpectSame(other_scaling, {scaling.length * length, scaling.force * force, scaling.load_factor});
      ExpectSame(ScaleScene(other, other_scaling), ScaleScene(scene, scaling));
    }
  }
}

TEST_P(ScalingTest, RotationAndReflectionLeaveTheScales) {
  const Scene scene = GetParam()();
  const Scaling scaling = CharacteristicScales(scene);
  for (const double angle : {0.1, 0.7853981633974483, 2.0, -3.0}) {
    ExpectSame(CharacteristicScales(Rotate(RequestOf(scene), angle).scene), scaling);
    ExpectSame(CharacteristicScales(Rotate(Mirror(RequestOf(scene)), angle).scene), scaling);
  }
}

TEST_P(ScalingTest, OrderLeavesTheScalesExactly) {
  const Scene scene = GetParam()();
  const Scaling scaling = CharacteristicScales(scene);
  Scene other = scene;
  for (std::size_t turn = 0; turn < 6; ++turn) {
    std::next_permutation(other.loads.begin(), other.loads.end(),
                          [](const Load& a, const Load& b) { return a.fx < b.fx; });
    std::reverse(other.nodes.begin(), other.nodes.end());
    if (!other.bars.empty()) std::rotate(other.bars.begin(), other.bars.begin() + 1, other.bars.end());
    std::rotate(other.superelements.begin(), other.superelements.begin() + 1, other.superelements.end());
    for (Bar& bar : other.bars) std::swap(bar.nodes[0], bar.nodes[1]);
    const Scaling other_scaling = CharacteristicScales(other);
    EXPECT_EQ(other_scaling.length, scaling.length);
    EXPECT_EQ(other_scaling.force, scaling.force);
    EXPECT_EQ(other_scaling.load_factor, scaling.load_factor);
  }
}

TEST_P(ScalingTest, ScaledSceneHasUnitScales) {
  const Scene scene = GetParam()();
  const Scene scaled = ScaleScene(scene, CharacteristicScales(scene));
  ExpectSame(CharacteristicScales(scaled), {1.0, 1.0, 1.0});
}

TEST_P(ScalingTest, NamesOrderAndSupportsAreKept) {
  const Scene scene = GetParam()();
  const Scene scaled = ScaleScene(scene, CharacteristicScales(scene));
  EXPECT_EQ(scaled.name, scene.name);
  ASSERT_EQ(scaled.nodes.size(), scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    EXPECT_EQ(scaled.nodes[i].name, scene.nodes[i].name);
    EXPECT_EQ(scaled.nodes[i].fixed_x, scene.nodes[i].fixed_x);
    EXPECT_EQ(scaled.nodes[i].fixed_y, scene.nodes[i].fixed_y);
  }
  ASSERT_EQ(scaled.bars.size(), scene.bars.size());
  for (std::size_t i = 0; i < scene.bars.size(); ++i) {
    EXPECT_EQ(scaled.bars[i].nodes, scene.bars[i].nodes);
    EXPECT_EQ(scaled.bars[i].strain, scene.bars[i].strain);
  }
  // One of each kind for a node, in the order of the first ones.
  std::vector<std::pair<std::string, bool>> kinds;
  for (const Load& load : scene.loads)
    if (std::find(kinds.begin(), kinds.end(), std::make_pair(load.node, load.constant)) == kinds.end())
      kinds.emplace_back(load.node, load.constant);
  ASSERT_EQ(scaled.loads.size(), kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    EXPECT_EQ(scaled.loads[i].node, kinds[i].first);
    EXPECT_EQ(scaled.loads[i].constant, kinds[i].second);
  }
  ASSERT_EQ(scaled.contacts.size(), scene.contacts.size());
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    EXPECT_EQ(scaled.contacts[i].Name(), scene.contacts[i].Name());
  }
}

TEST(ScaleSceneTest, LoadsOfANodeCancelBeforeTheyAreRounded) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {3.0, 0.0, 0.0, 3.0}}};
  scene.loads = {{"p", 1.0 + 1e-9, 0.0}, {"p", 0.0, 7.0, true}, {"p", -1.0, 0.0}};
  const Scaling scaling = CharacteristicScales(scene);
  const Scene scaled = ScaleScene(scene, scaling);
  ASSERT_EQ(scaled.loads.size(), 2u);
  EXPECT_DOUBLE_EQ(scaled.loads[0].fx * scaling.force / scaling.load_factor, (1.0 + 1e-9) - 1.0);
  EXPECT_DOUBLE_EQ(scaled.loads[1].fy * scaling.force, 7.0);
}

// Three bars of length 3, 4 and 5 with EA 1, 4 and 16; a load of norm 5 after summing, one on a support, one constant.
TEST(CharacteristicScalesTest, WithBarsByHand) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 3.0, 0.0}, {"c", 3.0, 4.0, false, true}};
  scene.bars = {{{"a", "b"}, 1.0, 100.0, {}}, {{"b", "c"}, 4.0}, {{"a", "c"}, 16.0}};
  // By far stiffer, and of no influence beside bars.
  scene.superelements = {{{"b"}, {1e9, 0.0, 0.0, 1e9}}};
  scene.loads = {{"b", 2.0, 0.0}, {"b", 1.0, 0.0}, {"c", -4.0, 7.0}, {"a", 8.0, 8.0}, {"b", 50.0, 0.0, true}};
  const Scaling scaling = CharacteristicScales(scene);
  EXPECT_NEAR(scaling.length, 4.0, kRounding);
  EXPECT_NEAR(scaling.force, 4.0, kRounding);
  EXPECT_NEAR(scaling.load_factor, 4.0 / 5.0, kRounding);
}

// sqrt((21.5 + 4) / (2 + 2)) is the mean stiffness.
TEST(CharacteristicScalesTest, WithoutBarsByHand) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}, {"q", 1.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, -1.5, -1.5, 4.0}}, {{"q"}, {2.0, 0.0, 0.0, 0.0}}};
  scene.loads = {{"p", 0.0, 3.0}, {"q", 4.0, 0.0}};
  const Scaling scaling = CharacteristicScales(scene);
  EXPECT_NEAR(scaling.force, 5.0, kRounding);
  EXPECT_NEAR(scaling.length, 5.0 / std::sqrt(25.5 / 4.0), kRounding);
  EXPECT_NEAR(scaling.load_factor, 1.0, kRounding);
}

// The mean stiffness is k sqrt(1/2), to rounding. Of F / k alone the soft node would move thousands.
TEST(CharacteristicScalesTest, WithoutBarsASoftPartGivesTheLength) {
  for (const double k : {1e2, 1e4, 1e6}) {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0}, {"q", 10.0, 0.0}};
    scene.superelements = {{{"p"}, {k, 0.0, 0.0, k}}, {{"q"}, {1.0, 0.0, 0.0, 1.0}}};
    scene.loads = {{"q", 1.0, 0.0}};
    const Scaling scaling = CharacteristicScales(scene);
    EXPECT_DOUBLE_EQ(scaling.force, 1.0);
    EXPECT_GT(scaling.length, 0.5);
    EXPECT_LT(scaling.length, 2.0);
  }
}

// A spring that is too soft to hold its node within the scene, or none: no farther than the scene is large.
TEST(CharacteristicScalesTest, WithoutBarsNothingMovesFartherThanTheSceneIsLarge) {
  for (const double soft : {1e-6, 0.0}) {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0}, {"q", 3.0, 4.0}};
    scene.superelements = {{{"p"}, {1e4, 0.0, 0.0, 1e4}}, {{"q"}, {1.0, 0.0, 0.0, soft}}};
    scene.loads = {{"q", 0.0, 1.0}};
    const Scaling scaling = CharacteristicScales(scene);
    EXPECT_GT(scaling.length, 2.5) << soft;
    EXPECT_LT(scaling.length, 10.0) << soft;
  }
}

TEST(CharacteristicScalesTest, WithoutBarsMotionsCountBesideLoads) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {2.0, 0.0, 0.0, 2.0}}};
  scene.loads = {{"p", 1e-3, 0.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}};
  scene.obstacle_motions = {{"floor", 3.0, 4.0}};
  const Scaling scaling = CharacteristicScales(scene);
  EXPECT_DOUBLE_EQ(scaling.force, 10.0);
  EXPECT_DOUBLE_EQ(scaling.length, 5.0);
}

// EI / l^2 = 1. Loads far beyond bend no further: F is a tenth of their sum.
TEST(ProgramScalesTest, LoadsFarBeyondBendingGiveTheForce) {
  for (const int segments : {1, 20, 80}) {
    TraceRequest request;
    request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 2.0, 0.0}};
    request.scene.beams = {Between("leg", "a", "b", 1e6, 4.0, segments)};
    Stage light, heavy;
    light.loads = {{"b", 3.0, 4.0}};
    Load line;
    line.group = "leg";
    line.py = 10.0;
    heavy.loads = {line, {"b", -20.0, 0.0}};
    heavy.target = -2.0;
    const auto scales = [&](const std::vector<Stage>& program) {
      request.program = program;
      const ExpandedRequest expanded(request);
      return ProgramScales(expanded.Get(), SceneIndex(expanded.Get().scene));
    };
    EXPECT_NEAR(scales({light}).length, 2.0, kRounding);
    EXPECT_NEAR(scales({light}).force, 1.0, kRounding);
    const double end = 10.0 / segments;  // of the line load, on the last node
    EXPECT_NEAR(scales({light, heavy}).force, 0.2 * (20.0 - 2.0 * end + std::hypot(20.0, end)), 1e-12);
    EXPECT_NEAR(scales({light, heavy}).length, 2.0, kRounding);
  }
}

TEST(ScaleSceneTest, ByHand) {
  Scene scene;
  scene.nodes = {{"a", 1.0, 2.0, true, true}, {"b", 4.0, 6.0}};
  scene.bars = {{{"a", "b"}, 20.0}, {{"b", "a"}, 30.0, 8.0, {}}};
  scene.superelements = {{{"b"}, {10.0, 5.0, 5.0, 20.0}}};
  scene.loads = {{"b", 6.0, 8.0}, {"b", 0.0, -40.0, true}};
  scene.obstacles = {{"wall", ObstacleShape::kHalfPlane, 6.0, -2.0, -30.0, 40.0, 0.5}};
  // Length 2, force 20, reference load 10.
  const Scene scaled = ScaleScene(scene, {2.0, 20.0, 2.0});
  EXPECT_EQ(scaled.nodes[1].x, 2.0);
  EXPECT_EQ(scaled.nodes[1].y, 3.0);
  EXPECT_EQ(scaled.bars[0].EA, 1.0);
  EXPECT_EQ(scaled.bars[0].rest_length, 0.0);  // the distance, in any unit
  EXPECT_EQ(scaled.bars[1].EA, 1.5);
  EXPECT_EQ(scaled.bars[1].rest_length, 4.0);
  EXPECT_EQ(scaled.superelements[0].stiffness, (std::vector<double>{1.0, 0.5, 0.5, 2.0}));
  EXPECT_NEAR(scaled.loads[0].fx, 0.6, kRounding);
  EXPECT_NEAR(scaled.loads[0].fy, 0.8, kRounding);
  EXPECT_EQ(scaled.loads[1].fy, -2.0);
  EXPECT_EQ(scaled.obstacles[0].px, 3.0);
  EXPECT_EQ(scaled.obstacles[0].py, -1.0);
  EXPECT_NEAR(scaled.obstacles[0].nx, -0.6, kRounding);
  EXPECT_NEAR(scaled.obstacles[0].ny, 0.8, kRounding);
  EXPECT_EQ(scaled.obstacles[0].friction, 0.5);
}

// k = 1, a load of 1e-3 that the load factor scales.
Scene Spring(double constant, double gap) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 1e-3, 0.0}, {"p", constant, 0.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, -gap, 0.0, 2.0, 0.0},
                     {"touched", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}};
  scene.contacts = {{"p", "floor"}, {"p", "touched"}};
  return scene;
}

TEST(CharacteristicScales, WithoutBarsTheLargestOfAllLoads) {
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(1e-4, 1.0)).force, 1e-3);
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(-1e6, 1.0)).force, 1e6);
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(-1e6, 1.0)).length, 1e6);
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(-1e6, 1.0)).load_factor, 1e9);
}

TEST(CharacteristicScales, WithoutBarsNoContactIsFartherThanTenThousandLengths) {
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(0.0, 9.0)).length, 1e-3);
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(0.0, 1e3)).length, 0.1);
  EXPECT_DOUBLE_EQ(CharacteristicScales(Spring(0.0, 1e3)).force, 0.1);
}

// A node on a slanted plane may have a gap of rounding, and is as good as one at a gap of zero.
TEST(CharacteristicScales, WithoutBarsRoundingOfATouchingContactIsNoGap) {
  Scene scene = Spring(0.0, 1e3);
  scene.obstacles.push_back({"slanted", ObstacleShape::kHalfPlane, 0.0, 0.0, 3.0, -1.0, 0.0});
  scene.nodes.push_back({"touches", 0.1, 0.3});
  scene.contacts.push_back({"touches", "slanted"});
  ASSERT_GT(3.0 * scene.nodes.back().x - scene.nodes.back().y, 0.0);
  EXPECT_DOUBLE_EQ(CharacteristicScales(scene).length, 0.1);
}

}  // namespace
}  // namespace contact_path::scaling_test
