// Paths that jump where the machine can go no further.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "contact_path/path/end.h"
#include "support/parts.h"
#include "support/random_scene.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::jump_paths_test {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

TraceRequest Jumping(const std::string& name, double stiffness = 0.0) {
  TraceRequest request = ReadExample(name);
  request.options.at_limit = AtLimit::kJump;
  request.options.machine_stiffness = stiffness;
  return request;
}

std::vector<Increment> JumpsOf(const TracedPath& path) { return IncrementsOfKind(path, IncrementKind::kJump); }

// A von Mises truss with Green-Lagrange bars, half span 1, rise h = 1.2,
// EA = 1, c = EA / l0^3.
TraceRequest SnappingTruss() {
  Scene scene;
  scene.name = "snapping_truss";
  scene.nodes = {{"left", -1.0, 0.0, true, true}, {"apex", 0.0, 1.2, true, false}, {"right", 1.0, 0.0, true, true}};
  for (const char* foot : {"left", "right"})
    scene.bars.push_back({{foot, "apex"}, 1.0, 0.0, StrainMeasure::kGreenLagrange});
  scene.loads = {{"apex", 0.0, -1.0, false}};
  return RequestUntil({"apex.y", "<", -1.5}, scene);
}

TEST(JumpPaths, SnapThroughInClosedForm) {
  TraceRequest request = SnappingTruss();
  const double h = 1.2, c = 1.0 / std::pow(1.0 + h * h, 1.5);
  // The stiffest machine that the falling part needs is c h^2, at y = 0.
  request.options.at = {{"apex.y", {0.0}}};
  double stiffest = 0.0;
  const TracedPath followed = TraceProved(request);
  for (const Increment& increment : followed.increments)
    if (increment.stability.stability == Verdict::kUnstable)
      stiffest = std::max(stiffest, increment.stability.critical_stiffness);
  EXPECT_NEAR(stiffest, c * h * h, 1e-10);
  request.options.at_limit = AtLimit::kJump;
  request.options.landing_checks = true;
  const TracedPath path = TraceProved(request);
  ASSERT_EQ(JumpsOf(path).size(), 1U);
  const Increment jump = JumpsOf(path)[0];
  EXPECT_NEAR(jump.load_factor, 2.0 * c * h * h * h / (3.0 * std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(PositionY(path, jump, "apex"), -2.0 * h / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(jump.jump.energy_released, 0.75 * c * std::pow(h, 4), 1e-9);
  EXPECT_TRUE(jump.jump.landing_robust);
  EXPECT_EQ(jump.stability.stability, Verdict::kStable);
  // A machine that is stiff enough needs no jump.
  request.options.machine_stiffness = 1.01 * c * h * h;
  EXPECT_TRUE(JumpsOf(TraceProved(request)).empty());
  request.options.machine_stiffness = 0.5 * c * h * h;
  EXPECT_EQ(JumpsOf(TraceProved(request)).size(), 1U);
}

TEST(JumpPaths, SlipThatLetsTheLoadFall) {
  TraceRequest request = Jumping("two_dof_friction");
  EXPECT_FALSE(JumpsOf(TraceProved(request)).at(0).jump.landing_robust);  // nobody has asked
  request.options.landing_checks = true;
  const TracedPath path = TraceProved(request);
  ASSERT_EQ(JumpsOf(path).size(), 1U);
  const Increment jump = JumpsOf(path)[0];
  EXPECT_NEAR(jump.load_factor, 1.0, 1e-12);
  EXPECT_NEAR(PositionX(path, jump, "p"), 10.0 / 7.0, 1e-9);
  EXPECT_NEAR(PositionY(path, jump, "p"), 2.0 / 7.0, 1e-9);
  EXPECT_NEAR(jump.dissipation, 1.0 / 3.0, 1e-8);
  EXPECT_NEAR(jump.jump.energy_released + jump.dissipation, 4.0 / 7.0, 1e-10);
  EXPECT_TRUE(jump.jump.landing_robust);
  EXPECT_TRUE(JumpsOf(TraceProved(Jumping("two_dof_friction", kRigid))).empty());
  EXPECT_TRUE(JumpsOf(TraceProved(Jumping("two_dof_friction", 0.51))).empty());
  EXPECT_EQ(JumpsOf(TraceProved(Jumping("two_dof_friction", 0.49))).size(), 1U);
}

// Columns of a bar each, l0 = 1, EA = 10, that a spring of stiffness 2 at the top holds along x: each buckles where the
// load is 2 l, l = 1 - s / EA. All do at one place: a bifurcation of an odd number of them, with branches of each alone
// and of all together; the determinant of an even number keeps its sign, and directions are counted.
TEST(JumpPaths, SeveralPartsBuckleAtOnce) {
  constexpr double kEA = 10.0, kSpring = 2.0;
  for (const int copies : {1, 2, 3, 4, 7, 40}) {
    Scene scene;
    for (int i = 0; i < copies; ++i) {
      const std::string foot = "foot" + std::to_string(i), top = "top" + std::to_string(i);
      scene.nodes.push_back({foot, 2.0 * i, 0.0, true, true});
      scene.nodes.push_back({top, 2.0 * i, 1.0, false, false});
      scene.bars.push_back({{foot, top}, kEA});
      scene.superelements.push_back({{top}, {kSpring, 0.0, 0.0, 0.0}});
      scene.loads.push_back({top, 0.0, -1.0, false});
    }
    const TracedPath path = TraceUntil({"load_factor", ">", 3.0}, scene);
    const std::vector<Increment> onsets = IncrementsOfKind(path, IncrementKind::kBifurcation);
    ASSERT_EQ(onsets.size(), 1U) << copies;
    const std::size_t curves = copies == 1 ? 1 : static_cast<std::size_t>(copies) + 1;
    EXPECT_EQ(onsets[0].event.branches.size(), 1 + 2 * curves) << copies;
    EXPECT_EQ(onsets[0].event.complete, copies == 1) << copies;
    EXPECT_NEAR(onsets[0].load_factor, kEA * kSpring / (kEA + kSpring), 1e-10) << copies;
    for (const Increment& increment : path.increments) {
      const bool buckled = increment.index >= onsets[0].index;
      EXPECT_EQ(increment.stability.unstable_directions, buckled ? copies : 0) << copies << " " << increment.index;
      EXPECT_EQ(increment.stability.stability, buckled ? Verdict::kUnstable : Verdict::kStable) << copies;
    }
  }
}

// The same of two columns that differ by more than rounding: the onset is that of the softer one.
TEST(JumpPaths, NearlyEqualPartsBuckleOneBehindTheOther) {
  constexpr double kEA = 10.0;
  for (const double more : {1e-3, 1e-5, 1e-7}) {
    Scene scene;
    for (const double spring : {2.0, 2.0 * (1.0 + more)}) {
      const std::string of = spring == 2.0 ? "soft" : "stiff";
      const double x = spring == 2.0 ? 0.0 : 2.0;
      scene.nodes.push_back({"foot_" + of, x, 0.0, true, true});
      scene.nodes.push_back({"top_" + of, x, 1.0, false, false});
      scene.bars.push_back({{"foot_" + of, "top_" + of}, kEA});
      scene.superelements.push_back({{"top_" + of}, {spring, 0.0, 0.0, 0.0}});
      scene.loads.push_back({"top_" + of, 0.0, -1.0, false});
    }
    const TracedPath path = TraceUntil({"load_factor", ">", 3.0}, scene);
    const Increment& unstable =
        FirstThat(path, [](const Increment& increment) { return increment.stability.stability == Verdict::kUnstable; });
    EXPECT_NE(unstable.kind, IncrementKind::kRegular) << more;
    EXPECT_NEAR(unstable.load_factor, 2.0 * kEA / (2.0 + kEA), 1e-8) << more;
  }
}

TEST(JumpPaths, StopsWhereItIsAsked) {
  TraceRequest request = Jumping("von_mises");
  request.options.at_limit = AtLimit::kStop;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kAtLimit);
  EXPECT_EQ(path.increments.back().kind, IncrementKind::kSmoothLimit);
}

TEST(JumpPaths, ExampleScenesLand) {
  for (const char* name : {"snap_hook", "rough_arch", "stick_slip_chain", "bistable_arch", "deep_arch"}) {
    const TracedPath path = TraceProved(Jumping(name));
    const std::vector<Increment> jumps = JumpsOf(path);
    EXPECT_FALSE(jumps.empty()) << name;
    for (const Increment& jump : jumps) {
      EXPECT_GT(jump.jump.energy_released, 0.0) << name;
      EXPECT_EQ(jump.stability.stability, Verdict::kStable) << name;
    }
  }
}

TEST(JumpPaths, RandomScenes) {
  int jumps = 0;
  for (unsigned seed = 1; seed <= Seeds(100); ++seed) {
    TraceRequest request = RandomRequest(seed);
    request.options.at_limit = AtLimit::kJump;
    request.options.machine_stiffness = seed % 3 == 0 ? kRigid : seed % 3 == 1 ? 0.0 : 1.0;
    request.options.max_increments = 200;
    const TracedPath path = TraceVerified(request);
    if (path.increments.empty()) continue;  // its constant loads make it snap, or nothing holds it
    jumps += static_cast<int>(JumpsOf(path).size());
    // It lands, or ends by name; what the loads did is stored, taken by friction, or released.
    EXPECT_NE(path.result.reason, EndReason::kNumericalFailure) << seed << " " << path.result.message;
    double released = 0.0, exchanged = 1.0;
    for (const Increment& increment : path.increments) {
      released += increment.jump.energy_released;
      exchanged = std::max({exchanged, std::abs(increment.external_work), increment.strain_energy});
    }
    const Increment &first = path.increments.front(), &last = path.increments.back();
    const double stored = last.strain_energy - first.strain_energy;
    EXPECT_NEAR(last.external_work, stored + last.dissipation + released, 1e-10 * exchanged) << seed;
  }
  EXPECT_GT(jumps, AtLeast(20));
}

}  // namespace
}  // namespace contact_path::jump_paths_test
