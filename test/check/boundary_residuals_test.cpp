// The residuals of contacts with surfaces that deform: closed forms, and forces against differences of gap and slip.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/check/residuals.h"
#include "support/random.h"

namespace contact_path::boundary_residuals_test {
namespace {

constexpr double kRounding = 1e-13;
constexpr double kPi = 3.14159265358979323846;

// A node p and the nodes of a surface, each on a spring of the same stiffness to where it is at the start.
Scene BesideSurface(const std::vector<Eigen::Vector2d>& places, bool closed, double radius, double stiffness) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  BoundarySurface surface{"top", {}, closed, radius};
  for (std::size_t i = 0; i < places.size(); ++i) {
    scene.nodes.push_back({std::to_string(i), places[i].x(), places[i].y()});
    surface.nodes.push_back(scene.nodes.back().name);
  }
  for (const Node& node : scene.nodes) scene.superelements.push_back({{node.name}, {stiffness, 0.0, 0.0, stiffness}});
  scene.surfaces = {surface};
  scene.contacts = {{"p", "", "", "top", 0.3}};
  return scene;
}

CheckedState StateOf(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& places) {
  CheckedState state;
  state.positions = {p.x(), p.y()};
  for (const Eigen::Vector2d& place : places) state.positions.insert(state.positions.end(), {place.x(), place.y()});
  state.rn = state.rt = {0.0};
  return state;
}

// The forces of the reactions of the only contact, x0, y0, x1, ...
std::vector<double> ForcesOf(const ResidualCheck& check, CheckedState state, double rn, double rt) {
  std::vector<double> forces = check.Unbalance(state);
  state.rn = {rn};
  state.rt = {rt};
  const std::vector<double> with = check.Unbalance(state);
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] -= with[i];
  return forces;
}

std::vector<Eigen::Vector2d> Ring(int nodes) {
  std::vector<Eigen::Vector2d> places;  // clockwise: the outside is admissible
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2.0 * kPi * i / nodes;
    places.push_back({std::sin(angle), std::cos(angle)});
  }
  return places;
}

TEST(BoundaryResiduals, OfAStraightSurfaceThatIsStretched) {
  const std::vector<Eigen::Vector2d> before = {{0.0, 0.0}, {2.0, 0.0}}, after = {{0.0, 1.0}, {3.0, 1.0}};
  for (const double radius : {0.0, 0.25}) {
    const Scene scene = BesideSurface(before, false, radius, 0.0);
    const ResidualCheck check(scene, Configuration::Of(scene), {});
    const CheckedState from = StateOf({0.6, 0.1}, before), to = StateOf({1.5, 1.5}, after);
    EXPECT_NEAR(check.Gap(0, from), 0.1 - radius, kRounding);
    EXPECT_NEAR(check.Gap(0, to), 0.5 - radius, kRounding);
    EXPECT_NEAR(check.Normal(0, to)[0], 0.0, kRounding);
    EXPECT_NEAR(check.Normal(0, to)[1], 1.0, kRounding);
    // From the share 0.3 of the material to 0.5, of a length between 2 and 3.
    EXPECT_NEAR(check.Slip(0, from, to), 0.2 * 2.5, kRounding);
    EXPECT_NEAR(check.Slip(0, from, StateOf({0.9, 1.0}, after)), 0.0, kRounding);
    EXPECT_NEAR(check.Slip(0, to, from), -0.2 * 2.5, kRounding);

    // Lever arms: of 2 up on p, 2 down on the foot at 0.4 of the surface; friction acts at the height of the radius.
    const std::vector<double> forces = ForcesOf(check, StateOf({1.2, 1.0 + radius}, after), 2.0, 0.5);
    const double couple = 0.5 * radius / 3.0;
    const std::vector<double> expected = {0.5, 2.0, -0.3, -1.2 - couple, -0.2, -0.8 + couple};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(forces[i], expected[i], kRounding) << i;
  }
}

// A parabola between the middles of two edges of a regular polygon passes its node at an eighth of the second
// difference, and its own circle at the middles at cos(pi / N).
TEST(BoundaryResiduals, OfARingOfNodesTendToThoseOfACircle) {
  double last = 0.0;
  for (const int nodes : {12, 24, 48}) {
    const std::vector<Eigen::Vector2d> places = Ring(nodes);
    const Scene scene = BesideSurface(places, true, 0.1, 0.0);
    const ResidualCheck check(scene, Configuration::Of(scene), {});
    const double step = 2.0 * kPi / nodes;
    const auto at = [&](double angle) { return StateOf({1.5 * std::sin(angle), 1.5 * std::cos(angle)}, places); };
    EXPECT_NEAR(check.Gap(0, at(3.0 * step)), 0.5 + 0.25 * (1.0 - std::cos(step)) - 0.1, kRounding);
    EXPECT_NEAR(check.Gap(0, at(3.5 * step)), 1.5 - std::cos(0.5 * step) - 0.1, kRounding);
    // A third of the circle at the distance of the radius, over the place where the surface begins, and back.
    const double third = check.Slip(0, at(-0.25 * 2.0 * kPi), at((1.0 / 3.0 - 0.25) * 2.0 * kPi));
    EXPECT_NEAR(third + check.Slip(0, at((1.0 / 3.0 - 0.25) * 2.0 * kPi), at(-0.25 * 2.0 * kPi)), 0.0, kRounding);
    const double error = std::abs(third - 1.1 * 2.0 * kPi / 3.0);
    if (last > 0.0) {
      EXPECT_NEAR(error / last, 0.25, 0.02);
    }
    last = error;
  }
}

// The force of r_n is the gradient of the gap, that of r_t the gradient of the slip.
TEST(BoundaryResiduals, ForcesAreGradientsAndBalance) {
  Random random(3);
  int compared = 0;
  for (int example = 0; example < 60; ++example) {
    const bool closed = example % 2 == 0;
    const double radius = example % 3 == 0 ? 0.0 : 0.05;
    std::vector<Eigen::Vector2d> places = Ring(7);
    for (Eigen::Vector2d& place : places) place += random.Vector(2, -0.12, 0.12);
    const Scene scene = BesideSurface(places, closed, radius, 0.0);
    const ResidualCheck check(scene, Configuration::Of(scene), {});
    const double angle = random.Number(0.3, 5.0);
    const CheckedState state =
        StateOf(random.Number(1.0, 1.3) * Eigen::Vector2d(std::sin(angle), std::cos(angle)), places);
    if (std::abs(check.Gap(0, state)) > 0.5) continue;
    ++compared;
    const std::vector<double> normal = ForcesOf(check, state, 1.0, 0.0), tangential = ForcesOf(check, state, 0.0, 1.0);
    for (const std::vector<double>& forces : {normal, tangential}) {
      double fx = 0.0, fy = 0.0, moment = 0.0;
      for (std::size_t i = 0; i < forces.size(); i += 2) {
        fx += forces[i];
        fy += forces[i + 1];
        moment += state.positions[i] * forces[i + 1] - state.positions[i + 1] * forces[i];
      }
      EXPECT_NEAR(fx, 0.0, kRounding);
      EXPECT_NEAR(fy, 0.0, kRounding);
      EXPECT_NEAR(moment, 0.0, kRounding);
    }
    constexpr double kStep = 1e-5;
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      CheckedState more = state, less = state;
      more.positions[i] += kStep;
      less.positions[i] -= kStep;
      EXPECT_NEAR(normal[i], (check.Gap(0, more) - check.Gap(0, less)) / (2.0 * kStep), 1e-8) << i;
      EXPECT_NEAR(tangential[i], (check.Slip(0, state, more) - check.Slip(0, state, less)) / (2.0 * kStep), 1e-8) << i;
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(BoundaryResiduals, OfAnExactStateAreRounding) {
  const std::vector<Eigen::Vector2d> start = {{-1.0, 0.0}, {1.0, 0.0}};
  Scene scene = BesideSurface(start, false, 0.0, 4.0);
  scene.superelements[0].stiffness = {0.0, 0.0, 0.0, 0.0};
  scene.loads = {{"p", 0.6, -2.0, true}};
  const ResidualCheck check(scene, Configuration::Of(scene), {});
  // Over the middle, both springs carry a half of the load.
  CheckedState now = StateOf({0.075, -0.25}, {{-0.925, -0.25}, {1.075, -0.25}}), before = now;
  now.rn = {2.0};
  now.rt = {-0.6};
  before.positions[0] -= 0.01;
  EXPECT_LE(check.Check(before, now).Largest(), 1e-15);
  // Pulled the other way, the node does not slip.
  before.positions[0] += 0.02;
  EXPECT_NEAR(check.Check(before, now).friction_law, 0.01, kRounding);
  // Nor is a node in balance that the surface does not touch.
  now.positions[1] += 0.01;
  EXPECT_NEAR(check.Check(now, now).complementarity, 0.01, kRounding);
}

TEST(BoundaryResiduals, BehindTheSurfaceIsPenetrationAndPastAnEndNothing) {
  const std::vector<Eigen::Vector2d> places = {{0.0, 0.0}, {1.0, 0.2}, {2.0, 0.0}};
  const Scene scene = BesideSurface(places, false, 0.3, 1.0);
  const ResidualCheck check(scene, Configuration::Of(scene), {});
  const auto residuals_at = [&](double x, double y) {
    CheckedState state = StateOf({x, y}, places);
    return check.Check(state, state);
  };
  EXPECT_EQ(residuals_at(1.0, 0.5).penetration, 0.0);
  EXPECT_NEAR(residuals_at(1.0, 0.1).penetration, 0.35, kRounding);  // the curve is at 0.15 there
  EXPECT_EQ(residuals_at(-0.4, -0.3).penetration, 0.0);
  EXPECT_NEAR(check.Gap(0, StateOf({-0.4, -0.3}, places)), 0.5, kRounding);
}

// Edges are 1 long: as deep behind an open surface, and as deep as a beam of this radius is thick.
TEST(BoundaryResiduals, FarBehindAnOpenSurfaceIsNoPenetration) {
  const std::vector<Eigen::Vector2d> places = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  for (const double radius : {0.0, 0.2, 0.8}) {
    const Scene scene = BesideSurface(places, false, radius, 1.0);
    const ResidualCheck check(scene, Configuration::Of(scene), {});
    const auto penetration_at = [&](double gap) {
      const CheckedState state = StateOf({1.0, radius + gap}, places);
      return check.Check(state, state).penetration;
    };
    const double depth = std::max(1.0, 2.0 * radius);
    EXPECT_NEAR(penetration_at(-0.99 * depth), 0.99 * depth, kRounding);
    EXPECT_EQ(penetration_at(-1.01 * depth), 0.0);
  }
}

// Where a path ends since the node is about to slide over an end, rounding does not take the contact away.
TEST(BoundaryResiduals, AtAnEndToRoundingTheSurfaceIsTouched) {
  const std::vector<Eigen::Vector2d> places = {{0.0, 0.0}, {1.0, 0.0}};
  const Scene scene = BesideSurface(places, false, 0.02, 1.0);
  const ResidualCheck check(scene, Configuration::Of(scene), {});
  for (const double past : {-1e-14, 0.0, 1e-14}) {
    EXPECT_NEAR(check.Gap(0, StateOf({-past, 0.02}, places)), 0.0, kRounding);
    EXPECT_NEAR(check.Gap(0, StateOf({1.0 + past, 0.02}, places)), 0.0, kRounding);
  }
  EXPECT_NEAR(check.Gap(0, StateOf({-1e-6, 0.02}, places)), 0.02, 1e-9);
}

// A ring of nodes on springs, walked counterclockwise, is pressed flat: its node at the top against the ring itself.
class OwnSurface : public testing::Test {
 protected:
  static constexpr int kNodes = 24;

  OwnSurface() {
    for (const Eigen::Vector2d& place : Ring(kNodes)) places_.insert(places_.begin(), place);  // the first is the last
    scene_ = BesideSurface(places_, true, 0.1, 1.0);
    scene_.contacts[0].node = std::to_string(kNodes - 1);
  }
  // y times a factor.
  std::vector<Eigen::Vector2d> Flattened(double factor) const {
    std::vector<Eigen::Vector2d> flat = places_;
    for (Eigen::Vector2d& place : flat) place.y() *= factor;
    return flat;
  }
  Eigen::Vector2d MiddleAfter(std::size_t node) const {
    return 0.5 * (places_[node % kNodes] + places_[(node + 1) % kNodes]);
  }

  std::vector<Eigen::Vector2d> places_;
  Scene scene_;
};

TEST_F(OwnSurface, IsTouchedWhereItIsFarAlongIt) {
  const ResidualCheck check(scene_, Configuration::Of(scene_), {});
  const double opposite = -0.2 * (0.75 + 0.25 * std::cos(2.0 * kPi / kNodes));
  const CheckedState flat = StateOf({3.0, 3.0}, Flattened(0.2));
  EXPECT_NEAR(check.Gap(0, flat), 0.2 - opposite - 0.1, kRounding);
  EXPECT_NEAR(check.Normal(0, flat)[1], 1.0, kRounding);
  // Of the circle nothing but an end is near: pi times the radius is 1.2 edges, so that two patches are left out.
  const double end = (places_[kNodes - 1] - MiddleAfter(kNodes + 1)).norm();
  EXPECT_NEAR(check.Gap(0, StateOf({3.0, 3.0}, places_)), end, kRounding);
}

TEST_F(OwnSurface, IsLeftOutWithinPiTimesItsRadius) {
  const double edge = (places_[1] - places_[0]).norm();
  for (const double edges : {3.4, 3.6, 4.6}) {
    scene_.surfaces[0].radius = edges * edge / kPi;
    const ResidualCheck check(scene_, Configuration::Of(scene_), {});
    const double end = (places_[kNodes - 1] - MiddleAfter(kNodes + static_cast<std::size_t>(edges - 0.5))).norm();
    EXPECT_NEAR(check.Gap(0, StateOf({3.0, 3.0}, places_)), end, kRounding);
  }
}

// Pressed on by its opposite side with 2 and pushed aside by 0.5, the node is in balance; with another reaction not.
TEST_F(OwnSurface, WrongReactionsAreRefuted) {
  const double opposite = -0.75 - 0.25 * std::cos(2.0 * kPi / kNodes), touching = 0.1 / (1.0 - opposite);
  const std::vector<Eigen::Vector2d> flat = Flattened(touching);
  CheckedState now = StateOf({0.0, 0.0}, flat);
  now.rn = {2.0};
  now.rt = {-0.5};
  // Constant loads hold the rest: they are what the check itself finds missing, node by node, but of the forces of the
  // contact what follows from the weights of the spline and the lever of the radius.
  const ResidualCheck without(scene_, Configuration::Of(scene_), {});
  CheckedState free = now;
  free.rn = free.rt = {0.0};
  const std::vector<double> springs = without.Unbalance(free);
  const int top = kNodes - 1, bottom = kNodes / 2 - 1;
  const double side = (flat[bottom + 1] - flat[bottom]).x();
  const double couple = 0.1 * 0.5 / (2.0 * side);  // friction acts at the distance of the radius
  std::vector<double> forces(springs.size(), 0.0);
  const auto add = [&](int node, double fx, double fy) {
    forces[static_cast<std::size_t>(2 * node + 2)] += fx;
    forces[static_cast<std::size_t>(2 * node + 3)] += fy;
  };
  add(top, -0.5, 2.0);
  add(bottom, 0.75 * 0.5, -0.75 * 2.0);
  for (const int sense : {-1, 1}) add(bottom + sense, 0.125 * 0.5, -0.125 * 2.0 - sense * couple);
  for (std::size_t i = 0; i < springs.size(); i += 2)
    scene_.loads.push_back({scene_.nodes[i / 2].name, springs[i] - forces[i], springs[i + 1] - forces[i + 1], true});
  const ResidualCheck check(scene_, Configuration::Of(scene_), {});
  EXPECT_LE(check.Check(now, now).Largest(), kRounding);
  for (const auto& [rn, rt] : {std::pair(2.1, -0.5), std::pair(2.0, -0.4), std::pair(2.0, -0.7)}) {
    CheckedState wrong = now;
    wrong.rn = {rn};
    wrong.rt = {rt};
    EXPECT_GT(check.Check(wrong, wrong).Largest(), 0.01) << rn << " " << rt;
  }
}

}  // namespace
}  // namespace contact_path::boundary_residuals_test
