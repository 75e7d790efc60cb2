#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "verify/verified.h"

namespace contact_path::verify_jumps_test {
namespace {

// A truss that snaps, and from the limit point on the increment with the same load factor behind it, as if it had
// jumped there. With a machine: to the first increment with less load, and the machine that leads there.
struct JumpedPath {
  TraceRequest request;
  std::vector<Increment> increments;
  std::size_t landing = 0;
};

JumpedPath Jumped(bool machine) {
  JumpedPath jumped;
  jumped.request = ReadExample("von_mises");
  jumped.request.options.stop = {{"apex.y", "<", -1.4}};
  TracedPath path = TraceIncrements(jumped.request);
  std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
  EXPECT_EQ(limits.size(), 2U);
  if (!machine) {
    jumped.request.options.at = {{"load_factor", {limits[0].load_factor}}};
    path = TraceIncrements(jumped.request);
    limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
  }
  const std::vector<Increment>& all = path.increments;
  std::size_t to = static_cast<std::size_t>(limits[1].index) + 1;
  while (machine ? all[to].kind != IncrementKind::kRegular : all[to].kind != IncrementKind::kSample) ++to;
  const Increment& from = limits[0];
  jumped.landing = static_cast<std::size_t>(from.index) + 1;
  jumped.increments = {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(jumped.landing)};
  jumped.increments.insert(jumped.increments.end(), all.begin() + static_cast<std::ptrdiff_t>(to), all.end());
  Increment& landing = jumped.increments[jumped.landing];
  const Scaling scaling = ProgramScales(jumped.request);
  const double down = PositionY(path, from, "apex") - PositionY(path, landing, "apex");
  const double change = landing.load_factor - from.load_factor;
  const double chord = std::hypot(down / scaling.length, change / scaling.load_factor);
  const double work = 0.5 * (from.load_factor + landing.load_factor) * down;
  const double arc_before = landing.arc_length, work_before = landing.external_work;
  for (std::size_t i = jumped.landing; i < jumped.increments.size(); ++i) {
    Increment& increment = jumped.increments[i];
    increment.index = static_cast<int>(i);
    increment.arc_length += from.arc_length + chord - arc_before;
    increment.external_work += from.external_work + work - work_before;
  }
  const double stiffness = machine ? -change / down : 0.0;
  const double top = PositionY(path, all.front(), "apex");
  for (Increment& increment : jumped.increments)
    if (machine) increment.setting = top - PositionY(path, increment, "apex") + increment.load_factor / stiffness;
  landing.kind = IncrementKind::kJump;
  landing.jump = {work - (landing.strain_energy - from.strain_energy), true};
  EXPECT_GT(landing.jump.energy_released, 0.0);
  jumped.request.options.at_limit = AtLimit::kJump;
  jumped.request.options.machine_stiffness = stiffness;
  return jumped;
}

TEST(VerifyPath, ProvesJumps) {
  for (const bool machine : {false, true}) {
    const JumpedPath path = Jumped(machine);
    const Verification verification = VerifyPath(path.request, path.increments);
    EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
    EXPECT_GT(verification.proved_verdicts, 5);
  }
}

// Under dead loads, a machine, and with friction on the way.
TEST(VerifyPath, ProvesJumpsThatWereTraced) {
  for (const char* const scene : {"von_mises", "two_dof_friction", "rough_truss", "snap_hook", "williams_toggle"})
    for (const double stiffness : {0.0, 0.1}) {
      SCOPED_TRACE(std::string(scene) + ", machine of stiffness " + std::to_string(stiffness));
      TraceRequest request = ReadExample(scene);
      request.options.at_limit = AtLimit::kJump;
      request.options.machine_stiffness = stiffness;
      request.options.max_increments = 100;
      const TracedPath path = TraceIncrements(request);
      EXPECT_FALSE(IncrementsOfKind(path, IncrementKind::kJump).empty() && stiffness == 0.0);
      ExpectNoFindings(path);
      EXPECT_EQ(EndContradicted(path.request, path.increments, ToString(path.result.reason)), "");
    }
}

struct JumpTampering {
  const char* name;
  std::function<void(JumpedPath*)> change;
  const char* found;
};

Increment& LandingOf(JumpedPath* path) { return path->increments[path->landing]; }

// A sum, from the landing on.
void Shift(double Increment::*sum, double by, JumpedPath* path) {
  for (std::size_t i = path->landing; i < path->increments.size(); ++i) path->increments[i].*sum += by;
}

const JumpTampering kJumpTamperings[] = {
    {"EnergyReleased", [](auto* path) { LandingOf(path).jump.energy_released += 1e-7; }, "energy released is not what"},
    {"EnergyBalance", [](auto* path) { Shift(&Increment::external_work, 1e-7, path); }, "energy released is not what"},
    {"WorkOfLoads",
     [](auto* path) {
       Shift(&Increment::external_work, 1e-7, path);
       LandingOf(path).jump.energy_released += 1e-7;
     },
     "work of the loads over a jump is off"},
    {"Negative",
     [](auto* path) {
       const double by = 2.0 * LandingOf(path).jump.energy_released;
       Shift(&Increment::external_work, -by, path);
       LandingOf(path).jump.energy_released -= by;
     },
     "energy released is negative"},
    {"Dissipation",
     [](auto* path) {
       Shift(&Increment::dissipation, -1e-3, path);
       LandingOf(path).jump.energy_released += 1e-3;
     },
     "dissipation falls"},
    {"NotAskedFor", [](auto* path) { path->request.options.at_limit = AtLimit::kFollow; }, "though at_limit is follow"},
    {"OtherMachine", [](auto* path) { path->request.options.machine_stiffness *= 1.01; },
     "the setting is not that of the machine"},
    {"DeadLoads", [](auto* path) { path->request.options.machine_stiffness = 0.0; },
     "though no machine loads the structure"},
    {"Landing", [](auto* path) { LandingOf(path).positions[3] += 1e-7; }, "equilibrium residual"},
    {"ArcLength", [](auto* path) { Shift(&Increment::arc_length, 1e-3, path); }, "arc length of the jump"},
    {"NoJump", [](auto* path) { path->increments[2].jump.energy_released = 1e-3; }, "but there is no jump"},
    {"KindHidden", [](auto* path) { LandingOf(path).kind = IncrementKind::kRegular; }, "but there is no jump"},
};

class TamperedJump : public testing::TestWithParam<JumpTampering> {};

TEST_P(TamperedJump, IsFound) {
  JumpedPath path = Jumped(true);
  GetParam().change(&path);
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_NE(Listed(verification).find(GetParam().found), std::string::npos) << Listed(verification);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, TamperedJump, testing::ValuesIn(kJumpTamperings),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace contact_path::verify_jumps_test
