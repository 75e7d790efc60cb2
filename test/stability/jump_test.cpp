#include "contact_path/stability/jump.h"
#include "contact_path/path/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "contact_path/branch/mode_arc.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/tolerances.h"
#include "support/traced_path.h"

namespace contact_path::jump_test {
namespace {

// ----- a node with a coupled stiffness on a rough floor: K = [[1, -1.5], [-1.5, 4]], mu = 1, constant load (0, -1)

class TwoDofFriction : public testing::Test {
 protected:
  // Where it begins to slide.
  PathPoint Threshold() const {
    PathPoint point = model_.InitialPoint();
    point.s = 1.0 / model_.scaling.load_factor;
    SetReaction(0, 1.0 / model_.scaling.force, -1.0 / model_.scaling.force, &point);
    return point;
  }
  double Energy(double scaled) const { return scaled * model_.scaling.force * model_.scaling.length; }

  const Scene scene_ = ReadExample("two_dof_friction").scene;
  const Model model_{scene_, CharacteristicScales(scene_)};
};

TEST_F(TwoDofFriction, LandsOffTheFloorWhateverTheDrag) {
  const PathPoint from = Threshold();
  ASSERT_LE(model_.Check(from, from).Largest(), 1e-14);
  const JumpResult jump = Jump(model_.structure, model_.laws, from, Eigen::Vector2d(1.0, 0.0), {}, true, nullptr);
  EXPECT_TRUE(jump.robust);
  for (const std::optional<Landing>& landing : jump.landings) {
    ASSERT_TRUE(landing);
    const Eigen::Vector2d u = landing->point.u * model_.scaling.length;
    EXPECT_NEAR(u.x(), 10.0 / 7.0, 1e-12);
    EXPECT_NEAR(u.y(), 2.0 / 7.0, 1e-12);
    EXPECT_EQ(StateOf(landing->point, 0), ContactState::kOpen);
    EXPECT_NEAR(Energy(landing->dissipated), 1.0 / 3.0, 1e-9);
    EXPECT_NEAR(Energy(landing->energy_released() + landing->dissipated), 4.0 / 7.0, 1e-11);
  }
}

TEST_F(TwoDofFriction, FindsTheSignByItself) {
  const JumpResult jump =
      Jump(model_.structure, model_.laws, Threshold(), Eigen::Vector2d(-1.0, 0.0), {}, true, nullptr);
  ASSERT_TRUE(jump.landing);
  EXPECT_NEAR(jump.landing->point.u.x() * model_.scaling.length, 10.0 / 7.0, 1e-12);
}

TEST_F(TwoDofFriction, IsHeldBelowTheThreshold) {
  PathPoint from = Threshold();
  from.s *= 0.9;
  from.forces[1] *= 0.9;
  const JumpResult jump = Jump(model_.structure, model_.laws, from, Eigen::Vector2d(1.0, 0.0), {}, true, nullptr);
  EXPECT_FALSE(jump.landing);
  EXPECT_TRUE(jump.came_back);
  EXPECT_LE(jump.followed, 1e-4);
}

// k_c = 0.5: a stiffer machine holds it, a softer one does not.
TEST_F(TwoDofFriction, AMachineHoldsItFromItsCriticalStiffness) {
  const double unit = model_.scaling.force / model_.scaling.length;  // per unit of f scaled
  const double f = model_.structure.Loads().Reference().norm();
  const auto by_machine = [&](double k) {
    Machine machine;
    machine.stiffness = k / unit / (f * f);
    return Jump(model_.structure, model_.laws, Threshold(), Eigen::Vector2d(1.0, 0.0), machine, true, nullptr);
  };
  EXPECT_TRUE(by_machine(0.51).came_back);
  EXPECT_TRUE(by_machine(std::numeric_limits<double>::infinity()).came_back);
  EXPECT_TRUE(by_machine(0.49).landing);
}

// ----- von Mises truss, Green-Lagrange, half span 1, height 1.2, EA = 1: energy c (y^2 - h^2)^2 / 4

constexpr double kHeight = 1.2;
const double kC = std::pow(1.0 + kHeight * kHeight, -1.5);
const double kLimitY = kHeight / std::sqrt(3.0);
const double kLimit = 2.0 * kC * std::pow(kHeight, 3) / (3.0 * std::sqrt(3.0));

Scene VonMises() {
  Scene scene;
  scene.name = "von_mises";
  scene.nodes = {{"left", -1.0, 0.0, true, true}, {"apex", 0.0, kHeight}, {"right", 1.0, 0.0, true, true}};
  scene.bars = {{{"left", "apex"}, 1.0, 0.0, StrainMeasure::kGreenLagrange},
                {{"apex", "right"}, 1.0, 0.0, StrainMeasure::kGreenLagrange}};
  scene.loads = {{"apex", 0.0, -1.0}};
  return scene;
}

class Snap : public testing::Test {
 protected:
  PathPoint At(double y, double load) const {
    PathPoint point = model_.InitialPoint();
    point.u = Eigen::Vector2d(0.0, y) / model_.scaling.length;
    point.s = load / model_.scaling.load_factor;
    return point;
  }
  const Scene scene_ = VonMises();
  const Model model_{scene_, CharacteristicScales(scene_)};
};

TEST_F(Snap, LandsWhereTheLoadIsTheSame) {
  for (const double sign : {1.0, -1.0}) {
    const JumpResult jump =
        Jump(model_.structure, model_.laws, At(kLimitY, kLimit), Eigen::Vector2d(0.0, sign), {}, true, nullptr);
    EXPECT_TRUE(jump.robust);
    for (const std::optional<Landing>& landing : jump.landings) {
      ASSERT_TRUE(landing);
      EXPECT_NEAR(landing->point.u.y() * model_.scaling.length, -2.0 * kLimitY, 1e-8);
      EXPECT_NEAR(landing->energy_released() * model_.scaling.force * model_.scaling.length,
                  0.75 * kC * std::pow(kHeight, 4), 1e-8);
      EXPECT_EQ(landing->dissipated, 0.0);
    }
  }
}

// From the top, s = 0 and y = 0, which is unstable; a machine of half the critical stiffness c h^2.
TEST_F(Snap, ASoftMachineDrivesIt) {
  const double f = model_.structure.Loads().Reference().norm(), unit = model_.scaling.force / model_.scaling.length;
  Machine machine;
  machine.stiffness = 0.5 * kC * kHeight * kHeight / unit / (f * f);
  const PathPoint from = At(0.0, 0.0);
  const JumpResult jump = Jump(model_.structure, model_.laws, from, Eigen::Vector2d(0.0, -1.0), machine, true, nullptr);
  ASSERT_TRUE(jump.landing);
  EXPECT_TRUE(jump.robust);
  // W' = -k y with W' = c y (y^2 - h^2): y^2 = h^2 / 2.
  const PathPoint& to = jump.landing->point;
  EXPECT_NEAR(to.u.y() * model_.scaling.length, -kHeight / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(to.s - from.s, -machine.stiffness * model_.structure.Loads().Reference().dot(to.u - from.u), 1e-13);
  const double mean = 0.5 * (from.s + to.s) * model_.structure.Loads().Reference().dot(to.u - from.u);
  EXPECT_NEAR(jump.landing->loads, mean, 1e-12);
  EXPECT_GT(jump.landing->energy_released(), 0.0);
  machine.stiffness *= 2.1;
  EXPECT_TRUE(Jump(model_.structure, model_.laws, from, Eigen::Vector2d(0.0, -1.0), machine, true, nullptr).came_back);
}

// ----- the truss lies on its side on a rough floor, pressed onto it by the constant load N

// The apex moves along x from h, with the friction force mu N = `friction_force` and mu = 0.5. It slides where s - mu N
// = -W'(x): the limit is mu N above that of the truss.
JumpResult SnapOnFloor(double friction_force, const Model& model) {
  PathPoint from = model.InitialPoint();
  from.u = Eigen::Vector2d(kLimitY, 0.0) / model.scaling.length;
  from.s = (kLimit + friction_force) / model.scaling.load_factor;
  SetReaction(0, 2.0 * friction_force / model.scaling.force, friction_force / model.scaling.force, &from);
  from.modes[0].state = NumberOf(ContactState::kSlipMinus);
  EXPECT_LE(model.Check(from, from).Largest(), 1e-14);
  return Jump(model.structure, model.laws, from, Eigen::Vector2d(-1.0, 0.0), {}, true, nullptr);
}

Scene OnFloor(double friction_force) {
  Scene scene;
  scene.name = "snap_on_floor";
  scene.nodes = {{"up", 0.0, 1.0, true, true}, {"apex", kHeight, 0.0}, {"down", 0.0, -1.0, true, true}};
  scene.bars = {{{"up", "apex"}, 1.0, 0.0, StrainMeasure::kGreenLagrange},
                {{"apex", "down"}, 1.0, 0.0, StrainMeasure::kGreenLagrange}};
  scene.loads = {{"apex", -1.0, 0.0}, {"apex", 0.0, -2.0 * friction_force, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  scene.contacts = {{"apex", "floor"}};
  return scene;
}

// Over-damped, the way down to -2 h / sqrt 3 is the same with friction mu N over the whole of it. With inertia the apex
// swings past it, at most to -sqrt(3) h, and sticks where the spring pulls back with less than 2 mu N: everywhere, for
// mu N >= 8 c h^3 / (3 sqrt 3).
TEST(SnapOnAFloor, WithInertiaItStopsBeyond) {
  const double h3 = kC * std::pow(kHeight, 3), friction_force = 1.6 * h3;
  const Scene scene = OnFloor(friction_force);
  const Model model(scene, CharacteristicScales(scene));
  const JumpResult jump = SnapOnFloor(friction_force, model);
  EXPECT_FALSE(jump.robust);
  for (const Drag drag : {Drag::kUniform, Drag::kStiffness}) {
    const std::optional<Landing>& landing = jump.landings[static_cast<std::size_t>(drag)];
    ASSERT_TRUE(landing);
    EXPECT_NEAR(landing->point.u.x() * model.scaling.length, -2.0 * kLimitY, 1e-9);
    EXPECT_NEAR(landing->dissipated * model.scaling.force * model.scaling.length, friction_force * 3.0 * kLimitY, 1e-9);
    EXPECT_NEAR(landing->energy_released() * model.scaling.force * model.scaling.length,
                0.75 * kC * std::pow(kHeight, 4), 1e-9);
  }
  ASSERT_TRUE(jump.landings[2]);
  const double x = jump.landings[2]->point.u.x() * model.scaling.length;
  EXPECT_LT(x, -2.0 * kLimitY - 0.1);
  EXPECT_GT(x, -std::sqrt(3.0) * kHeight);
  EXPECT_EQ(StateOf(jump.landings[2]->point, 0), ContactState::kStick);
  EXPECT_NEAR(jump.largest_difference * model.scaling.length, -2.0 * kLimitY - x, 1e-9);
}

// ----- nothing to land on

// A bar with logarithmic strain bears at most EA / e, at the length e l0.
TEST(Jump, ReportsHowFarSomethingFliesOff) {
  Scene scene;
  scene.name = "tear";
  scene.nodes = {{"wall", 0.0, 0.0, true, true}, {"end", 1.0, 0.0}};
  scene.bars = {{{"wall", "end"}, 1.0, 0.0, StrainMeasure::kLogarithmic}};
  scene.loads = {{"end", 1.0, 0.0}};
  const Model model(scene, CharacteristicScales(scene));
  PathPoint from = model.InitialPoint();
  const double e = std::exp(1.0);
  from.u = Eigen::Vector2d(e, 0.0) / model.scaling.length;
  from.s = 1.0 / e / model.scaling.load_factor;
  const JumpResult jump = Jump(model.structure, model.laws, from, Eigen::Vector2d(1.0, 0.0), {}, true, nullptr);
  EXPECT_FALSE(jump.landing);
  EXPECT_FALSE(jump.robust);
  EXPECT_FALSE(jump.came_back);
  EXPECT_GT(jump.followed, 1e3);
}

TEST(Jump, CanBeCancelled) {
  const Scene scene = VonMises();
  const Model model(scene, CharacteristicScales(scene));
  PathPoint from = model.InitialPoint();
  from.u = Eigen::Vector2d(0.0, 0.0);
  int asked = 0;
  const JumpResult jump =
      Jump(model.structure, model.laws, from, Eigen::Vector2d(0.0, -1.0), {}, true, [&asked] { return ++asked > 20; });
  EXPECT_TRUE(jump.cancelled);
  EXPECT_FALSE(jump.landing);
}

// ----- limit points of examples

// Newton's method stays at an equilibrium that is one to rounding.
void ExpectEquilibrium(const Model& model, const PathPoint& point) {
  EXPECT_LE(model.Check(point, point).Largest(), tolerances::kAccepted);
  ModeArc arc(model.structure, model.laws);
  arc.SetModes(point);
  const Eigen::VectorXd at = arc.system().Pack(point);
  const Correction again = arc.Correct(at, Eigen::VectorXd::Unit(at.size(), arc.NumMotion() - 1), point.s);
  EXPECT_TRUE(again.converged);
  EXPECT_LE((again.x - at).norm(), 1e-9);
}

// Jumps under dead loads from the first limit points of the traced path, towards where the path goes on.
void ExpectLandings(const std::string& name, int most) {
  const TraceRequest request = ReadExample(name);
  const TracedPath path = TraceIncrements(request);
  const ExpandedRequest expanded(request);
  int jumps = 0;
  for (std::size_t i = 0; i + 1 < path.increments.size() && jumps < most; ++i) {
    const Increment &limit = path.increments[i], &after = path.increments[i + 1];
    if (limit.kind != IncrementKind::kSmoothLimit && limit.kind != IncrementKind::kCornerLimit) continue;
    if (std::abs(after.load_factor) > std::abs(limit.load_factor) || limit.stage != after.stage) continue;
    SCOPED_TRACE(name + ", increment " + std::to_string(i));
    const auto stage = static_cast<std::size_t>(std::max(limit.stage, 1) - 1);
    const Model model(StageScene(expanded.Get(), stage), StageConfiguration(expanded.Get(), stage),
                      StageScales(expanded.Get(), stage));
    const PathPoint from = model.FromIncrement(limit);
    const JumpResult jump =
        Jump(model.structure, model.laws, from, model.FromIncrement(after).u - from.u, {}, true, nullptr);
    ++jumps;
    EXPECT_TRUE(jump.landing);
    for (const std::optional<Landing>& landing : jump.landings) {
      ASSERT_TRUE(landing);
      ExpectEquilibrium(model, landing->point);
      EXPECT_EQ(landing->point.s, from.s);
      EXPECT_GT(landing->energy_released(), 0.0);
      EXPECT_GT(landing->dissipated, 0.0);
    }
  }
  EXPECT_GT(jumps, 0);
}

// At the corner the load and the apex turn back, so that no machine holds the truss. Where the apex is held, at the
// height 1, the foot slides until the bars have their rest length: the half span is sqrt(l0^2 - 1) = 1.2.
TEST(JumpOfAnExample, RoughTrussUnderDisplacementControl) {
  const TracedPath path = TraceIncrements(ReadExample("rough_truss"));
  const auto corner = std::find_if(path.increments.begin(), path.increments.end(), [](const Increment& increment) {
    return increment.kind == IncrementKind::kCornerLimit;
  });
  ASSERT_NE(corner, path.increments.end());
  const Scene& scene = path.request.scene;
  const Model model(scene, CharacteristicScales(scene));
  const PathPoint from = model.FromIncrement(*corner);
  Machine machine;
  machine.stiffness = std::numeric_limits<double>::infinity();
  const JumpResult jump =
      Jump(model.structure, model.laws, from, model.FromIncrement(*(corner + 1)).u - from.u, machine, true, nullptr);
  for (const Drag drag : {Drag::kUniform, Drag::kStiffness}) {
    const std::optional<Landing>& landing = jump.landings[static_cast<std::size_t>(drag)];
    ASSERT_TRUE(landing);
    const CheckedState to = model.InSceneUnits(landing->point);
    EXPECT_NEAR(to.load_factor, 0.0, 1e-9);
    const std::size_t left = NodeNumber(scene, "left"), foot = NodeNumber(scene, "foot");
    EXPECT_NEAR(to.positions[2 * foot] - to.positions[2 * left], 2.4, 1e-9);
    EXPECT_NEAR(landing->loads, 0.0, 1e-12);
    EXPECT_GT(landing->energy_released(), 0.0);
  }
  // With inertia the foot leaves the floor, and nothing brings it back.
  ASSERT_TRUE(jump.landings[2]);
  EXPECT_EQ(StateOf(jump.landings[2]->point, 0), ContactState::kOpen);
  EXPECT_FALSE(jump.robust);
}

TEST(JumpOfAnExample, SnapHook) { ExpectLandings("snap_hook", 10); }
TEST(JumpOfAnExample, RoughArch) { ExpectLandings("rough_arch", 10); }
TEST(JumpOfAnExample, RingOnRing) { ExpectLandings("ring_on_ring", 1); }

}  // namespace
}  // namespace contact_path::jump_test
