// The residuals of contacts with curves: the check's own geometry against the geometry of the solvers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/contact/scene_contacts.h"
#include "contact_path/scene/surface.h"
#include "contact_path/structure/structure.h"
#include "support/random.h"

namespace contact_path::curved_residuals_test {
namespace {

constexpr double kRounding = 1e-13;

Obstacle Shape(ObstacleShape shape) {
  Obstacle obstacle;
  obstacle.name = "shape";
  obstacle.shape = shape;
  obstacle.px = 0.2;
  obstacle.py = -0.1;
  obstacle.friction = 0.3;
  return obstacle;
}

std::vector<Obstacle> Shapes() {
  std::vector<Obstacle> shapes;
  for (const bool inside : {false, true}) {
    shapes.push_back(Shape(ObstacleShape::kCircle));
    shapes.back().radius = 0.7;
    shapes.back().inside = inside;
  }
  for (const ObstacleShape shape : {ObstacleShape::kPolyline, ObstacleShape::kSpline})
    for (const bool closed : {false, true}) {
      shapes.push_back(Shape(shape));
      shapes.back().points = {-0.6, 0.1, 0.1, 0.7, 0.8, 0.2, 0.5, -0.6, -0.4, -0.7};
      shapes.back().closed = closed;
    }
  shapes.push_back(shapes[2]);
  shapes.back().fillet = 0.05;
  shapes.push_back(Shape(ObstacleShape::kHalfPlane));
  shapes.back().nx = -0.3;
  shapes.back().ny = 1.0;
  return shapes;
}

// A node on two springs beside the shape.
Scene Beside(const Obstacle& obstacle) {
  Scene scene;
  scene.nodes = {{"p", 0.1, 1.0}};
  scene.superelements = {{{"p"}, {2.0, 0.0, 0.0, 3.0}}};
  scene.loads = {{"p", 1.0, 0.0}};
  scene.obstacles = {obstacle};
  scene.contacts = {{"p", obstacle.name}};
  return scene;
}

CheckedState StateAt(double x, double y, double load_factor) {
  CheckedState state;
  state.load_factor = load_factor;
  state.positions = {x, y};
  state.rn = state.rt = {0.0};
  return state;
}

TEST(CurvedResiduals, GapNormalAndSlipAreThoseOfTheGeometry) {
  Random random(4);
  for (const Obstacle& obstacle : Shapes()) {
    const Scene scene = Beside(obstacle);
    const ResidualCheck check(scene);
    const auto surface = MakeSurface(obstacle);
    Eigen::Vector2d before(0.1, 1.0);
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector2d x = random.Vector(2, -1.2, 1.2);
      const NearestFoot nearest = surface->Nearest(x);
      if (nearest.is_end || nearest.distance < 1e-3) continue;
      const Projection at = surface->Project(x, nearest.patch);
      const CheckedState state = StateAt(x.x(), x.y(), 0.0);
      EXPECT_NEAR(check.Gap(0, state), at.gap, kRounding);
      const std::array<double, 2> normal = check.Normal(0, state);
      EXPECT_NEAR(std::hypot(normal[0] - at.normal.x(), normal[1] - at.normal.y()), 0.0, 1e-11);
      if (surface->Nearest(before).is_end) {
        before = x;
        continue;
      }
      double slip = at.xi - surface->ProjectOnNearest(before).xi;
      if (surface->Closed()) {
        const double length = surface->RangeOf(surface->NumPatches()).begin - surface->RangeOf(0).begin;
        slip = std::remainder(slip, length);
      }
      EXPECT_NEAR(check.Slip(0, StateAt(before.x(), before.y(), 0.0), state), slip, 1e-11);
      before = x;
    }
  }
}

TEST(CurvedResiduals, PastAnEndTheGapIsTheDistance) {
  for (const Obstacle& obstacle : Shapes()) {
    if (obstacle.points.empty() || obstacle.closed) continue;
    const ResidualCheck check(Beside(obstacle));
    const auto surface = MakeSurface(obstacle);
    const Eigen::Vector2d x(-1.4, 0.1);
    ASSERT_TRUE(surface->Nearest(x).is_end);
    EXPECT_NEAR(check.Gap(0, StateAt(x.x(), x.y(), 0.0)), surface->Nearest(x).distance, kRounding);
  }
}

// Far from a curve, too, where its pieces need not be looked at.
TEST(CurvedResiduals, OfAnOpenContactAreItsPenetration) {
  std::vector<Obstacle> shapes = Shapes();
  for (const ObstacleShape shape : {ObstacleShape::kPolyline, ObstacleShape::kSpline}) {
    shapes.push_back(Shape(shape));
    shapes.back().points = {-0.6, 0.1, 0.1, 0.7, 0.8, 0.2, 1.5, 0.3};
  }
  for (std::size_t i = 0, count = shapes.size(); i < count; ++i) {  // walked the other way round
    if (shapes[i].points.empty()) continue;
    Obstacle other = shapes[i];
    for (std::size_t k = 0; k < other.points.size(); k += 2) {
      other.points[k] = shapes[i].points[other.points.size() - 2 - k];
      other.points[k + 1] = shapes[i].points[other.points.size() - 1 - k];
    }
    shapes.push_back(other);
  }
  Random random(5);
  int open = 0, closed = 0;
  for (const Obstacle& obstacle : shapes) {
    const Scene scene = Beside(obstacle);
    const ResidualCheck check(scene, Configuration::Of(scene), {});
    for (const double size : {1.2, 20.0})
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d x = random.Vector(2, -size, size);
        const CheckedState state = StateAt(x.x(), x.y(), 0.0);
        const double gap = check.Gap(0, state);
        ++(gap > 0.0 ? open : closed);
        const Residuals residuals = check.Check(state, state);
        EXPECT_EQ(residuals.penetration, std::max(-gap, 0.0));
        EXPECT_EQ(residuals.complementarity, std::max(-gap, 0.0));
      }
  }
  EXPECT_GT(open, 500);
  EXPECT_GT(closed, 500);
}

// What turns and moves: as the pairs of the solvers see it.
TEST(CurvedResiduals, ObstaclesMayTurn) {
  for (const Obstacle& obstacle : Shapes()) {
    Scene scene = Beside(obstacle);
    scene.obstacle_motions = {{"shape", 0.2, -0.1, 0.8, 0.4, 0.3}};
    const ResidualCheck check(scene);
    const Structure structure(scene);
    const ContactPairs contacts = BuildContacts(scene, structure);
    const Eigen::VectorXd u = Eigen::Vector2d(0.3, 1.1);
    for (const double s : {0.0, 0.4, -0.7}) {
      const int patch = contacts[0]->PatchAt(u, s);
      if (!contacts[0]->HasPatch(patch)) continue;
      CheckedState state = StateAt(u[0], u[1], s);
      EXPECT_NEAR(check.Gap(0, state), contacts[0]->Gap(u, s, patch), kRounding);
      PortsAt at;
      contacts[0]->Evaluate(u, s, patch, {}, &at);
      const std::array<double, 2> normal = check.Normal(0, state);
      EXPECT_NEAR(std::hypot(normal[0] - at[kNormal].gradient[0], normal[1] - at[kNormal].gradient[1]), 0.0, 1e-11);
      // The obstacle pushes with the opposite of the reaction's power.
      state.rn = {2.0};
      EXPECT_NEAR(check.DrivingForce(state), -2.0 * at[kNormal].gradient[2], 1e-11);
    }
  }
}

// A node that its springs pull into the disc slides over it by a thousandth of a turn.
TEST(CurvedResiduals, OfAnExactStateAreRounding) {
  Obstacle disc = Shape(ObstacleShape::kCircle);
  disc.radius = 0.7;
  Scene scene = Beside(disc);
  scene.superelements[0].rest_positions = {0.3, 0.1};
  const ResidualCheck check(scene);
  // Equilibrium along x gives the load factor, along y the reaction r_n (n_y - mu t_y).
  const auto state_at = [](double angle) {
    const double nx = std::sin(angle), ny = std::cos(angle);
    CheckedState state = StateAt(0.2 + 0.7 * nx, -0.1 + 0.7 * ny, 0.0);
    const double rn = 3.0 * (state.positions[1] - 0.1) / (ny + 0.3 * nx);
    state.rn = {rn};
    state.rt = {-0.3 * rn};
    state.load_factor = 2.0 * (state.positions[0] - 0.3) - rn * (nx - 0.3 * ny);
    return state;
  };
  const CheckedState now = state_at(0.301);
  ASSERT_GT(now.rn[0], 0.0);
  EXPECT_LE(check.Check(state_at(0.3), now).Largest(), 1e-14);
  // Sliding the other way it would not be.
  EXPECT_GT(check.Check(state_at(0.302), now).friction_law, 1e-4);
}

}  // namespace
}  // namespace contact_path::curved_residuals_test
