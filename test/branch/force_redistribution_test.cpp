#include "contact_path/branch/force_redistribution.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "contact_path/path/model.h"
#include "contact_path/scene/scaling.h"
#include "support/kinematics.h"

namespace contact_path::force_redistribution_test {
namespace {

constexpr ObstacleShape kHalfPlane = ObstacleShape::kHalfPlane;
// One node at the origin that touches these obstacles through it.
struct Corner {
  explicit Corner(const std::vector<Obstacle>& obstacles, bool fixed_x = false)
      : Corner(SceneOf(obstacles, fixed_x), obstacles.size(), {}) {}
  // By the total law of friction, where the node has slipped by this much in x.
  Corner(const std::vector<Obstacle>& obstacles, double slipped)
      : Corner(SceneOf(obstacles, false), obstacles.size(), slipped) {}
  Corner(const Scene& scene, std::size_t contacts, std::optional<double> slipped)
      : model(scene, ConfigurationOf(scene, contacts, slipped), Scaling()), point(model.InitialPoint()) {
    point.forces.setZero();
  }

  static Scene SceneOf(const std::vector<Obstacle>& obstacles, bool fixed_x) {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0, fixed_x, false}};
    scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
    scene.loads = {{"p", 1.0, 0.0}};
    scene.obstacles = obstacles;
    for (const Obstacle& obstacle : obstacles) scene.contacts.push_back({"p", obstacle.name});
    return scene;
  }

  static Configuration ConfigurationOf(const Scene& scene, std::size_t contacts, std::optional<double> slipped) {
    Configuration configuration = Configuration::Of(scene);
    for (std::size_t i = 0; slipped && i < contacts; ++i)
      configuration.slip_origins.insert(configuration.slip_origins.end(), {-*slipped, 0.0});
    return configuration;
  }

  Eigen::Vector2d Force(const PathPoint& with) const {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(2);
    for (std::size_t i = 0; i < model.contacts.size(); ++i) {
      const PortsAt at = KinematicsAt(*model.contacts[i], with.u, with.s);
      at.AddForce(at[kNormal].gradient, NormalReaction(with, i), &force);
      at.AddForce(at[kTangent].gradient, TangentialReaction(with, i), &force);
    }
    return force;
  }

  // What is found; each must hold the same force within all cones.
  std::vector<PathPoint> Others() const {
    const ForceRedistributions found = FindForceRedistributions(model.laws, point, ActiveSetTolerance());
    EXPECT_TRUE(found.complete);
    for (const PathPoint& other : found.points) {
      EXPECT_NEAR((Force(other) - Force(point)).norm(), 0.0, 1e-12);
      for (std::size_t i = 0; i < model.contacts.size(); ++i) {
        const double rn = NormalReaction(other, i);
        EXPECT_GE(rn, 0.0);
        EXPECT_LE(std::abs(TangentialReaction(other, i)), model.contacts[i]->Friction() * rn * (1.0 + 1e-12));
      }
      EXPECT_EQ(other.u, point.u);
      EXPECT_EQ(other.s, point.s);
    }
    return found.points;
  }

  Model model;
  PathPoint point;
};

// rn and rt of both contacts.
bool Holds(const std::vector<PathPoint>& points, const std::array<double, 4>& reactions) {
  return std::any_of(points.begin(), points.end(), [&](const PathPoint& point) {
    return (point.forces - Eigen::Map<const Eigen::Vector4d>(reactions.data())).lpNorm<1>() < 1e-12;
  });
}

TEST(ForceRedistributions, NoneWhereReactionsAreUnique) {
  Corner rough({{"floor", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}});
  rough.point.forces.head<2>() << 2.0, 0.3;
  EXPECT_TRUE(rough.Others().empty());
  Corner smooth({{"floor", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}, {"wall", kHalfPlane, 0.0, 0.0, 1.0, 0.0, 0.0}});
  smooth.point.forces << 2.0, 0.0, 1.0, 0.0;
  EXPECT_TRUE(smooth.Others().empty());
}

TEST(ForceRedistributions, NoneOfWhatDoesNotTouch) {
  Corner corner({{"floor", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}, {"deep", kHalfPlane, 0.0, -1.0, 0.0, 1.0, 0.0}});
  corner.point.forces[0] = 1.0;
  EXPECT_TRUE(corner.Others().empty());
}

// By the total law of friction the slip tells the force on the belt, and with it the one at the stop.
TEST(ForceRedistributions, TotalLawThatHasSlipped) {
  const std::vector<Obstacle> obstacles = {{"belt", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3},
                                           {"stop", kHalfPlane, 0.0, 0.0, -1.0, 0.0, 0.0}};
  Corner back(obstacles, -0.5);
  back.point.forces << 2.0, 0.6, 0.6, 0.0;
  EXPECT_TRUE(back.Others().empty());
  Corner forth(obstacles, 0.5);
  forth.point.forces << 2.0, -0.6, 0.0, 0.0;
  EXPECT_TRUE(forth.Others().empty());
  Corner rest(obstacles, 0.0);
  rest.point.forces << 2.0, 0.6, 0.6, 0.0;
  EXPECT_TRUE(Holds(rest.Others(), {2.0, 0.0, 0.0, 0.0}));
}

// A lift at a table, along both of which the node has slipped: the lift takes over the force that it would have, too.
TEST(ForceRedistributions, TotalLawOnBothSides) {
  const std::vector<Obstacle> obstacles = {{"table", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3},
                                           {"lift", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  for (const double slipped : {-0.5, 0.5}) {
    Corner corner(obstacles, slipped);
    const double friction = slipped > 0.0 ? -0.6 : 0.6;
    corner.point.forces << 2.0, friction, 0.0, 0.0;
    EXPECT_TRUE(Holds(corner.Others(), {0.0, 0.0, 2.0, friction})) << slipped;
  }
}

// A smooth slope and a rough floor: once the node has slipped along the floor, its friction is at an edge of the cone,
// and is no longer what holds the force inside of the cone.
TEST(ForceRedistributions, TotalLawOfTheOneThatWouldTakeOver) {
  const std::vector<Obstacle> obstacles = {{"smooth", kHalfPlane, 0.0, 0.0, -1.0, 1.0, 0.0},
                                           {"rough", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 1.2}};
  for (const double slipped : {-0.5, 0.0, 0.5}) {
    Corner corner(obstacles, slipped);
    corner.point.forces << std::sqrt(2.0), 0.0, 0.0, 0.0;
    EXPECT_EQ(Holds(corner.Others(), {0.0, 0.0, 1.0, -1.0}), slipped == 0.0) << slipped;
  }
}

// A friction of rounding bears nothing that a frictionless contact would not.
TEST(ForceRedistributions, FrictionOfRounding) {
  Corner corner({{"one", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 1e-12}, {"other", kHalfPlane, 0.0, 0.0, 1e-4, 1.0, 1e-12}});
  corner.point.forces << 1.0, 1e-12, 0.0, 0.0;
  EXPECT_TRUE(corner.Others().empty());
}

// Between two walls that face each other nothing need press; what they press is not bounded, but its vertices are.
TEST(ForceRedistributions, Wedge) {
  Corner corner({{"left", kHalfPlane, 0.0, 0.0, 1.0, 0.0, 0.5}, {"right", kHalfPlane, 0.0, 0.0, -1.0, 0.0, 0.5}});
  corner.point.forces << 1.0, 0.0, 1.0, 0.0;
  const std::vector<PathPoint> others = corner.Others();
  ASSERT_EQ(others.size(), 1u);
  EXPECT_TRUE(Holds(others, {0.0, 0.0, 0.0, 0.0}));
}

// Friction along a component that is free, a normal along one that is not: the floor presses with nothing or anything.
TEST(ForceRedistributions, HalfFixedNode) {
  Corner corner({{"slope", kHalfPlane, 0.0, 0.0, 1.0, 1.0, 0.5}}, true);
  corner.point.forces[0] = 1.0;
  const std::vector<PathPoint> others = corner.Others();
  const double force = corner.Force(corner.point)[0];
  EXPECT_FALSE(others.empty());
  for (const PathPoint& other : others) EXPECT_NEAR(corner.Force(other)[0], force, 1e-12);
}

TEST(ForceRedistributions, CombinationsOfTwoNodes) {
  Scene scene = Corner::SceneOf(
      {{"belt", kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}, {"stop", kHalfPlane, 0.0, 0.0, -1.0, 0.0, 0.0}}, false);
  scene.nodes.push_back({"q", 0.0, 0.0});
  scene.superelements.push_back({{"q"}, {1.0, 0.0, 0.0, 1.0}});
  scene.contacts.push_back({"q", "belt"});
  scene.contacts.push_back({"q", "stop"});
  const Model model(scene, Scaling());
  PathPoint point = model.InitialPoint();
  point.forces.setZero();
  point.forces[0] = 1.0;
  point.forces[4] = 2.0;
  const ForceRedistributions found = FindForceRedistributions(model.laws, point, ActiveSetTolerance());
  const auto holds = [&](double first, double second) {
    return std::any_of(found.points.begin(), found.points.end(), [&](const PathPoint& other) {
      return std::abs(NormalReaction(other, 1) - first) + std::abs(NormalReaction(other, 3) - second) < 1e-12;
    });
  };
  EXPECT_TRUE(holds(0.3, 0.0));
  EXPECT_TRUE(holds(0.0, 0.6));
  EXPECT_TRUE(holds(0.3, 0.6));
  EXPECT_FALSE(holds(0.0, 0.0));
}

}  // namespace
}  // namespace contact_path::force_redistribution_test
