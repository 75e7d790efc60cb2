#include "contact_path/response/reactions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/csv.h"
#include "contact_path/path/model.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scene_index.h"
#include "response/cantilever.h"
#include "support/traced_path.h"

namespace contact_path::reactions_test {
namespace {

// Sums of forces, and of their moments about the origin of the coordinates.
struct Balance {
  void Add(double x, double y, double fx, double fy, double moment) {
    sum[0] += fx;
    sum[1] += fy;
    sum[2] += moment + x * fy - y * fx;
    largest = std::max({largest, std::abs(fx), std::abs(fy)});
    reach = std::max({reach, std::abs(x), std::abs(y)});
  }
  std::array<double, 3> sum = {};
  double largest = 0.0, reach = 0.0;
};

// Where a point of the scene that moves with an obstacle is.
std::array<double, 2> MovedPoint(const Scene& scene, const Obstacle& obstacle, double load_factor) {
  std::array<double, 2> point = {obstacle.px, obstacle.py};
  for (const ObstacleMotion& motion : scene.obstacle_motions) {
    if (motion.obstacle != obstacle.name) continue;
    const double angle = motion.turn * load_factor, x = point[0] - motion.about_x, y = point[1] - motion.about_y;
    point = {motion.about_x + std::cos(angle) * x - std::sin(angle) * y + motion.dx * load_factor,
             motion.about_y + std::sin(angle) * x + std::cos(angle) * y + motion.dy * load_factor};
  }
  return point;
}

// Loads and the reactions of an increment; a superelement may stand on the ground, whose forces are -K (x - X). scene:
// of the stage.
Balance BalanceOf(const Scene& scene, const Increment& increment) {
  const SceneIndex index(scene);
  const std::vector<double>& x = increment.positions;
  Balance balance;
  for (const Load& load : scene.loads) {
    const std::size_t node = index.Node(load.node);
    const double factor = load.constant ? 1.0 : increment.load_factor;
    balance.Add(x[2 * node], x[2 * node + 1], factor * load.fx, factor * load.fy, factor * load.moment);
  }
  const std::vector<SupportedNode> supports = SupportedNodes(scene);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const Resultant& of = increment.supports[i];
    balance.Add(x[2 * supports[i].node], x[2 * supports[i].node + 1], of.rx, of.ry, of.rm);
  }
  const std::vector<TouchedBoundary> boundaries = TouchedBoundaries(scene);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    // Both sides are of the structure.
    if (boundaries[i].is_surface || !scene.obstacles[boundaries[i].place].body.empty()) continue;
    const std::array<double, 2> at = MovedPoint(scene, scene.obstacles[boundaries[i].place], increment.load_factor);
    const Resultant& of = increment.boundaries[i];
    balance.Add(at[0], at[1], of.rx, of.ry, of.rm);
  }
  for (const Superelement& element : scene.superelements) {
    const std::size_t size = 2 * element.nodes.size();
    std::vector<double> displacement;
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const std::size_t node = index.Node(element.nodes[i]);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double initial = axis == 0 ? scene.nodes[node].x : scene.nodes[node].y;
        displacement.push_back(x[2 * node + axis] -
                               (element.rest_positions.empty() ? initial : element.rest_positions[2 * i + axis]));
      }
    }
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      std::array<double, 2> force = {};
      for (std::size_t axis = 0; axis < 2; ++axis)
        for (std::size_t k = 0; k < size; ++k)
          force[axis] -= element.stiffness[(2 * i + axis) * size + k] * displacement[k];
      const std::size_t node = index.Node(element.nodes[i]);
      balance.Add(x[2 * node], x[2 * node + 1], force[0], force[1], 0.0);
    }
  }
  return balance;
}

// Loads, supports and obstacles of every increment of a path, and the answers of check/, which shares no equations.
void ExpectBalance(const TracedPath& path) {
  const ExpandedRequest expanded(path.request);
  const TraceRequest& request = expanded.Get();
  const SceneIndex index(request.scene);
  double largest = 0.0, reach = 0.0;
  std::array<double, 3> off = {};
  double difference = 0.0;
  for (const Increment& increment : path.increments) {
    const auto stage = static_cast<std::size_t>(std::max(increment.stage, 1) - 1);
    const Scene scene = StageScene(request, index, stage);
    const Balance balance = BalanceOf(scene, increment);
    largest = std::max(largest, balance.largest);
    reach = std::max(reach, balance.reach);
    for (std::size_t k = 0; k < 3; ++k) off[k] = std::max(off[k], std::abs(balance.sum[k]));
    const Configuration configuration = StageConfiguration(request, index, stage);
    const ResidualCheck check(scene, configuration, CharacteristicScales(scene));
    const CheckedForces forces = check.Forces(StateOf(increment));
    ASSERT_EQ(forces.supports.size(), increment.supports.size());
    ASSERT_EQ(forces.boundaries.size(), increment.boundaries.size());
    const double uncertain = check.Uncertain(StateOf(increment));
    const auto compare = [&](const Resultant& of, const std::array<double, 3>& other) {
      difference = std::max({difference, std::abs(of.rx - other[0]) - uncertain, std::abs(of.ry - other[1]) - uncertain,
                             std::abs(of.rm - other[2]) / std::max(balance.reach, 1e-300) - uncertain});
    };
    for (std::size_t i = 0; i < forces.supports.size(); ++i) compare(increment.supports[i], forces.supports[i]);
    for (std::size_t i = 0; i < forces.boundaries.size(); ++i) compare(increment.boundaries[i], forces.boundaries[i]);
  }
  EXPECT_LE(off[0], 1e-9 * largest);
  EXPECT_LE(off[1], 1e-9 * largest);
  EXPECT_LE(off[2], 1e-9 * largest * reach);
  EXPECT_LE(difference, 1e-9 * largest);
}

// A linear element keeps the balance of moments where its nodes were, and not where they are.
bool KeepsMoments(const Scene& scene) {
  return std::none_of(scene.materials.begin(), scene.materials.end(),
                      [](const Material& of) { return of.model == MaterialModel::kLinear; });
}

TEST(Reactions, HoldTheLoadsOfAllExampleScenes) {
  std::size_t scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(CONTACT_PATH_SCENES)) {
    if (file.path().extension() != ".yaml") continue;
    SCOPED_TRACE(file.path().stem().string());
    const TraceRequest request = ReadExample(file.path().stem().string());
    if (!KeepsMoments(request.scene)) continue;
    ExpectBalance(TraceIncrements(request));
    ++scenes;
  }
  EXPECT_GE(scenes, 20U);
}

// Whatever bends, the root carries the moment of the force at the tip where the tip is.
TEST(Reactions, CantileverCarriesTheMomentAtItsRoot) {
  const TracedPath path = TraceIncrements(Cantilever({"tip", 4.0, 2.0}));
  const Increment& last = path.increments.back();
  const double s = last.load_factor, x = PositionX(path, last, "tip"), y = PositionY(path, last, "tip");
  ASSERT_EQ(last.supports.size(), 1U);
  EXPECT_NEAR(last.supports[0].rx, -0.3 * s, 1e-10);
  EXPECT_NEAR(last.supports[0].ry, s, 1e-10);
  EXPECT_NEAR(last.supports[0].rm, s * (x - 1.0) + 0.3 * s * (y - 2.0), 1e-9);
}

// The force that drives a support is that of a spring in its place: F = k (support - node).
TEST(Reactions, OfASupportThatMovesIsTheForceThatDrivesIt) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"wall", 0.0, 0.0, true, true}, {"hand", 2.0, 0.0, true, true}, {"middle", 1.0, 0.0, false, true}};
  scene.bars = {{{"wall", "middle"}, 3.0}, {{"middle", "hand"}, 1.5}};
  scene.support_motions = {{"hand", 0.2, 0.0}};
  request.options.stop = {{"hand.x", ">", 2.1}};
  const TracedPath path = TraceIncrements(request);
  for (const Increment& increment : path.increments) {
    const double force = increment.load_factor * 0.2 / (1.0 / 3.0 + 1.0 / 1.5);  // two springs in a row
    EXPECT_NEAR(increment.supports[0].rx, -force, 1e-12);
    EXPECT_NEAR(increment.supports[1].rx, force, 1e-12);
    EXPECT_EQ(increment.supports[2].rx, 0.0);  // free there
  }
}

TEST(Reactions, OfObstaclesAreTheSumOfTheirContacts) {
  const TracedPath path = TraceIncrements(ReadExample("portal_frame"));
  for (const Increment& increment : path.increments) {
    double tangential = 0.0;
    for (const ContactRecord& contact : increment.contacts) tangential += contact.rt;
    ASSERT_EQ(increment.boundaries.size(), 1U);
    EXPECT_NEAR(increment.boundaries[0].ry, SumOfNormals(increment), 1e-12);
    EXPECT_NEAR(increment.boundaries[0].rx, tangential, 1e-12);
  }
}

// The moment is about the point p of the obstacle, wherever it has gone.
TEST(Reactions, MomentIsAboutThePointOfAnObstacleThatTurns) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"a", 0.0, 2.0, true, true}, {"b", 1.0, 0.0}, {"c", 2.5, 1.5, true, true}};
  scene.bars = {{{"a", "b"}, 3.0}, {{"b", "c"}, 2.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.5, 0.0, 0.0, 1.0, 0.3}};
  scene.contacts = {{"b", "floor"}};
  scene.obstacle_motions = {{"floor", 0.1, 0.05, 0.3, 0.1, 0.4}};
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  for (const Increment& increment : path.increments) {
    const double angle = 0.3 * increment.load_factor;
    const std::array<double, 2> p = MovedPoint(scene, scene.obstacles[0], increment.load_factor);
    const double rn = increment.contacts[0].rn, rt = increment.contacts[0].rt;
    const double fx = -rn * std::sin(angle) + rt * std::cos(angle), fy = rn * std::cos(angle) + rt * std::sin(angle);
    const Resultant& of = increment.boundaries[0];
    EXPECT_NEAR(of.rx, fx, 1e-12);
    EXPECT_NEAR(of.ry, fy, 1e-12);
    EXPECT_NEAR(of.rm, (increment.positions[2] - p[0]) * fy - (increment.positions[3] - p[1]) * fx, 1e-12);
  }
}

TEST(Reactions, AreColumnsAndQuantities) {
  TraceRequest request = ReadExample("portal_frame");
  const ExpandedRequest expanded(request);
  const SceneIndex index(expanded.Get().scene);
  std::ostringstream header;
  CsvWriter(request).WriteHeader(header);
  const TracedPath path = TraceIncrements(request);
  for (const SupportedNode& support : SupportedNodes(expanded.Get().scene)) {
    const std::string name = expanded.Get().scene.nodes[support.node].name;
    EXPECT_EQ(header.str().find(",rx_" + name + ",") != std::string::npos, support.x);
    EXPECT_EQ(FindQuantity(name + ".rx", index).has_value(), support.x);
    EXPECT_EQ(FindQuantity(name + ".rm", index).has_value(), support.rotation);
  }
  EXPECT_NE(header.str().find(",rx_floor,ry_floor,rm_floor"), std::string::npos);
  const Quantity load = FindQuantity("floor.ry", index).value();
  EXPECT_EQ(ValueOf(load, path.increments.back()), path.increments.back().boundaries[0].ry);
}

// Of a supported node and an obstacle with one name, the node is meant.
TEST(Reactions, SupportHidesABoundaryOfItsName) {
  TraceRequest request;
  request.scene.nodes = {{"floor", 0.0, 1.0, true, true}, {"b", 1.0, 0.0}};
  request.scene.bars = {{{"floor", "b"}, 1.0}};
  request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  request.scene.contacts = {{"b", "floor"}};
  const SceneIndex index(request.scene);
  const std::optional<Quantity> quantity = FindQuantity("floor.rx", index);
  ASSERT_TRUE(quantity.has_value());
  EXPECT_EQ(quantity->of, Quantity::Of::kSupport);
  EXPECT_EQ(FindQuantity("floor.rm", index), std::nullopt);
  std::ostringstream header;
  CsvWriter(request).WriteHeader(header);
  const std::string columns = header.str();
  EXPECT_EQ(columns.find("rx_floor"), columns.rfind("rx_floor"));
  EXPECT_EQ(columns.find("rm_floor"), std::string::npos);
}

}  // namespace
}  // namespace contact_path::reactions_test
