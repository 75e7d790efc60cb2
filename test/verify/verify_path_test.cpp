#include "contact_path/verify/verify_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/scene/program.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/validate.h"
#include "support/traced_path.h"

namespace contact_path::verify_path_test {
namespace {

TracedPath Traced(const std::string& scene, Method method) {
  TraceRequest request = ReadExample(scene);
  request.options.method = method;
  if (method == Method::kMpec) request.options.step = 0.05;
  return TraceIncrements(request);
}

std::string Listed(const Verification& verification) {
  std::string text;
  for (const Finding& finding : verification.findings)
    text += "increment " + std::to_string(finding.increment) + ": " + finding.what + '\n';
  return text;
}

TEST(VerifyPath, ProvesWhatBothMethodsTrace) {
  for (const char* scene : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop", "arch19"})
    for (const Method method : {Method::kBranch, Method::kMpec}) {
      SCOPED_TRACE(scene);
      const TracedPath path = Traced(scene, method);
      const Verification verification = VerifyPath(path.request, path.increments);
      EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
      EXPECT_EQ(verification.increments, static_cast<int>(path.increments.size()));
      EXPECT_EQ(verification.full_increments, verification.increments);
      EXPECT_EQ(verification.exact_increments, verification.increments);
      EXPECT_LE(verification.exact.equilibrium, 1e-12);
      EXPECT_LE(verification.exact.Contact(), 1e-11);
      EXPECT_GT(verification.work, 0.0);
    }
}

// Where a node cannot move along an obstacle, there is no friction, whatever its coefficient.
TEST(VerifyPath, ProvesContactsThatCannotSlide) {
  TraceRequest request = ReadExample("rigid_stop");
  for (Obstacle& obstacle : request.scene.obstacles) obstacle.friction = 0.3;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.increments.back().contacts[0].state, ContactState::kClosed);
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

// A path with slip both ways, corners and contact events.
const TracedPath& Genuine() {
  static const TracedPath path = Traced("two_dof_friction", Method::kBranch);
  return path;
}

struct Tampering {
  const char* name;
  std::function<void(std::vector<Increment>&)> change;
  const char* found;  // in one of the findings
};

std::size_t First(const std::vector<Increment>& increments, const std::function<bool(const Increment&)>& is) {
  for (std::size_t i = 1; i + 2 < increments.size(); ++i)
    if (is(increments[i])) return i;
  ADD_FAILURE() << "no such increment";
  return 1;
}

std::size_t FirstSlipping(const std::vector<Increment>& increments) {
  return First(increments, [](const Increment& increment) {
    return increment.kind == IncrementKind::kRegular && increment.contacts[0].state == ContactState::kSlipPlus;
  });
}

std::size_t FirstRegular(const std::vector<Increment>& increments) {
  return First(increments, [](const Increment& increment) { return increment.kind == IncrementKind::kRegular; });
}

std::size_t FirstCorner(const std::vector<Increment>& increments) {
  return First(increments, [](const Increment& increment) { return increment.kind == IncrementKind::kCornerLimit; });
}

const Tampering kTamperings[] = {
    {"Position", [](auto& increments) { increments[5].positions[0] += 1e-7; }, "equilibrium residual"},
    {"LoadFactor", [](auto& increments) { increments[5].load_factor *= 1.0 + 1e-6; }, "equilibrium residual"},
    {"NormalReaction", [](auto& increments) { increments[5].contacts[0].rn += 1e-7; }, "equilibrium residual"},
    {"Gap", [](auto& increments) { increments[5].contacts[0].gap += 1e-9; }, "recorded gap"},
    {"Residual", [](auto& increments) { increments[5].residuals.friction_law = 1e-3; },
     "friction law residual is recorded as"},
    {"StrainEnergy", [](auto& increments) { increments[5].strain_energy += 1e-8; }, "strain energy is recorded as"},
    {"Dissipation",
     [](auto& increments) {
       for (auto& increment : increments) increment.dissipation *= 1.2;
     },
     "dissipation, over F L, is off by"},
    {"DissipationAndWork",
     [](auto& increments) {
       for (auto& increment : increments) {
         increment.external_work += increment.dissipation;
         increment.dissipation *= 2.0;
       }
     },
     "dissipation, over F L, is off by"},
    {"WorkAndEnergyShifted",
     [](auto& increments) {
       for (std::size_t i = 9; i < increments.size(); ++i) increments[i].external_work += 1e-3;
     },
     "work of the loads, over F L, is off by"},
    {"StatesRemoved",
     [](auto& increments) {
       increments[5].positions.clear();
       increments[5].contacts.clear();
     },
     "has no state"},
    {"BranchesRemoved", [](auto& increments) { increments[FirstCorner(increments)].event.branches.clear(); },
     "an event without branches"},
    {"NoBranchTaken", [](auto& increments) { increments[FirstCorner(increments)].event.taken = 0; },
     "no branch is taken"},
    {"EventInvented",
     [](auto& increments) { increments[FirstRegular(increments)].kind = IncrementKind::kContactEvent; },
     "an event without branches"},
    {"BifurcationInvented",
     [](auto& increments) { increments[FirstRegular(increments)].kind = IncrementKind::kBifurcation; },
     "a bifurcation without the direction"},
    {"SaidToBeRegularised", [](auto& increments) { increments[5].solve.exact = false; }, "not exact"},
    {"DissipationFalls", [](auto& increments) { increments[FirstSlipping(increments)].dissipation = -1e-3; },
     "dissipation falls"},
    {"ExternalWork", [](auto& increments) { increments.back().external_work += 0.1; }, "energy balance"},
    {"Stick", [](auto& increments) { increments[FirstSlipping(increments)].contacts[0].state = ContactState::kStick; },
     "as sticking"},
    {"SlipTheOtherWay",
     [](auto& increments) { increments[FirstSlipping(increments)].contacts[0].state = ContactState::kSlipMinus; },
     "as slipping backwards"},
    {"Open", [](auto& increments) { increments[FirstSlipping(increments)].contacts[0].state = ContactState::kOpen; },
     "as open"},
    {"RowLeftOut", [](auto& increments) { increments.erase(increments.begin() + 5); }, "increments are missing"},
    {"RowsExchanged", [](auto& increments) { std::swap(increments[5], increments[6]); }, "out of order"},
    {"LimitPointHidden", [](auto& increments) { increments[FirstCorner(increments)].kind = IncrementKind::kRegular; },
     "turns without a limit point"},
    {"LimitPointInvented",
     [](auto& increments) { increments[FirstRegular(increments)].kind = IncrementKind::kSmoothLimit; },
     "does not turn at the limit point"},
    {"EventHidden", [](auto& increments) { increments[FirstCorner(increments)].kind = IncrementKind::kSmoothLimit; },
     "change without an event"},
    {"OtherBranch", [](auto& increments) { increments[FirstCorner(increments)].event.taken = 7; }, "is none of its"},
    {"OtherStates",
     [](auto& increments) {
       EventRecord& event = increments[FirstCorner(increments)].event;
       event.branches[static_cast<std::size_t>(event.taken) - 1].states[0] = ContactState::kOpen;
     },
     "not those of the branch taken"},
    {"ArcLengthFalls", [](auto& increments) { increments[6].arc_length = increments[4].arc_length; },
     "arc length falls"},
    {"ArcLengthTooLong",
     [](auto& increments) {
       for (std::size_t i = 5; i < increments.size(); ++i) increments[i].arc_length += 1.0;
     },
     "arc length is off by"},
    {"ArcLengthTooShort",
     [](auto& increments) {
       for (auto& increment : increments) increment.arc_length *= 0.9;
     },
     "less than the chord"},
    {"NotFinite", [](auto& increments) { increments[5].load_factor = std::numeric_limits<double>::quiet_NaN(); },
     "not finite"},
    {"OtherScene", [](auto& increments) { increments[5].positions.pop_back(); }, "not those of the scene"},
    {"ForcesRemoved", [](auto& increments) { increments[5].boundaries.clear(); }, "not those of the scene"},
    {"MomentOfAnObstacle", [](auto& increments) { increments.back().boundaries[0].rm += 1e-6; },
     "rm of boundary 1 is recorded as"},
    {"ForceIsNoNumber",
     [](auto& increments) { increments[5].boundaries[0].rx = std::numeric_limits<double>::infinity(); }, "not finite"},
    {"Pull",
     [](auto& increments) {
       for (auto& increment : increments)
         for (ContactRecord* contact : {&increment.contacts[0]}) contact->rn = contact->rt = 0.0;
       increments[5].contacts[0].rn = -1e-12;
     },
     "pulls with"},
    {"Start", [](auto& increments) { increments[0].load_factor = 0.1; }, "is no start"},
    {"KindOfStart", [](auto& increments) { increments[0].kind = IncrementKind::kRegular; }, "is of the kind regular"},
    {"Nothing", [](auto& increments) { increments.clear(); }, "no increments"},
};

class Tampered : public testing::TestWithParam<Tampering> {};

TEST_P(Tampered, IsFound) {
  std::vector<Increment> increments = Genuine().increments;
  GetParam().change(increments);
  const Verification verification = VerifyPath(Genuine().request, increments);
  EXPECT_NE(Listed(verification).find(GetParam().found), std::string::npos) << Listed(verification);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, Tampered, testing::ValuesIn(kTamperings),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(VerifyPath, ForceOfASupportIsProved) {
  const TracedPath path = Traced("rough_truss", Method::kBranch);
  std::vector<Increment> increments = path.increments;
  ASSERT_FALSE(increments[5].supports.empty());
  increments[5].supports[0].ry += 1e-6;
  const Verification verification = VerifyPath(path.request, increments);
  EXPECT_NE(Listed(verification).find("ry of support 1 is recorded as"), std::string::npos) << Listed(verification);
}

TEST(VerifyPath, LongIncrementsThatCutCornersAreProved) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  request.options.step = 0.2;
  const TracedPath path = TraceIncrements(request);
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

TEST(VerifyPath, FarFromTheOriginIsRounding) {
  for (const char* scene : {"sliding_bar", "von_mises"}) {
    TraceRequest request = ReadExample(scene);
    for (Node& node : request.scene.nodes) node.x += 1e5;
    for (Obstacle& obstacle : request.scene.obstacles) obstacle.px += 1e5;
    request.options.stop.clear();
    request.options.max_increments = 60;
    const TracedPath path = TraceIncrements(request);
    ASSERT_EQ(path.increments.size(), 61U);
    const Verification verification = VerifyPath(path.request, path.increments);
    EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  }
}

// ----- jumps -----

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

// 117 components.
TEST(VerifyPath, FindsVerdictsOfFramesAnew) {
  TracedPath path = TraceIncrements(ReadExample("lee_frame"));
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_GT(verification.proved_verdicts, 100);
  const auto recorded = std::count_if(path.increments.begin(), path.increments.end(), [](const Increment& increment) {
    return increment.stability.stability != Verdict::kNotProved;
  });
  EXPECT_EQ(verification.proved_verdicts + verification.open_verdicts, recorded);
  for (Increment& increment : path.increments) {
    Verdict& verdict = increment.stability.stability;
    verdict = verdict == Verdict::kStable ? Verdict::kUnstable : Verdict::kStable;
  }
  const Verification tampered = VerifyPath(path.request, path.increments);
  EXPECT_NE(Listed(tampered).find("is recorded as"), std::string::npos);
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

void ShiftWork(JumpedPath* path, double by) {
  for (std::size_t i = path->landing; i < path->increments.size(); ++i) path->increments[i].external_work += by;
}

const JumpTampering kJumpTamperings[] = {
    {"EnergyReleased", [](auto* path) { LandingOf(path).jump.energy_released += 1e-7; }, "energy released is not what"},
    {"EnergyBalance", [](auto* path) { ShiftWork(path, 1e-7); }, "energy released is not what"},
    {"WorkOfLoads",
     [](auto* path) {
       ShiftWork(path, 1e-7);
       LandingOf(path).jump.energy_released += 1e-7;
     },
     "work of the loads over a jump is off"},
    {"Negative",
     [](auto* path) {
       const double by = 2.0 * LandingOf(path).jump.energy_released;
       ShiftWork(path, -by);
       LandingOf(path).jump.energy_released -= by;
     },
     "energy released is negative"},
    {"Dissipation",
     [](auto* path) {
       for (std::size_t i = path->landing; i < path->increments.size(); ++i) path->increments[i].dissipation -= 1e-3;
       LandingOf(path).jump.energy_released += 1e-3;
     },
     "dissipation falls"},
    {"NotAskedFor", [](auto* path) { path->request.options.at_limit = AtLimit::kFollow; }, "though at_limit is follow"},
    {"OtherMachine", [](auto* path) { path->request.options.machine_stiffness *= 1.01; },
     "the setting is not that of the machine"},
    {"DeadLoads", [](auto* path) { path->request.options.machine_stiffness = 0.0; },
     "though no machine loads the structure"},
    {"Landing", [](auto* path) { LandingOf(path).positions[3] += 1e-7; }, "equilibrium residual"},
    {"ArcLength",
     [](auto* path) {
       for (std::size_t i = path->landing; i < path->increments.size(); ++i) path->increments[i].arc_length += 1e-3;
     },
     "arc length of the jump"},
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

// ----- verdicts -----

// On the rising and on the falling part of a path without contact.
TEST(VerifyPath, FindsVerdictsThatWereChanged) {
  const TracedPath path = Traced("von_mises", Method::kBranch);
  const std::size_t rising = FirstRegular(path.increments);
  const std::size_t falling = First(path.increments, [](const Increment& increment) {
    return increment.kind == IncrementKind::kRegular && increment.stability.stability == Verdict::kUnstable;
  });
  const auto found = [&](std::size_t increment, const std::function<void(StabilityRecord*)>& change) {
    std::vector<Increment> increments = path.increments;
    change(&increments[increment].stability);
    return Listed(VerifyPath(path.request, increments));
  };
  EXPECT_EQ(found(falling, [](auto*) {}), "");
  const auto expect = [&](std::size_t increment, const char* what,
                          const std::function<void(StabilityRecord*)>& change) {
    EXPECT_NE(found(increment, change).find(what), std::string::npos) << found(increment, change);
  };
  expect(rising, "is recorded as unstable, but is stable", [](auto* of) { of->stability = Verdict::kUnstable; });
  expect(falling, "is recorded as stable, but is unstable", [](auto* of) { of->stability = Verdict::kStable; });
  expect(falling, "unstable directions are recorded as 2, but are 1", [](auto* of) { of->unstable_directions = 2; });
  expect(falling, "under the machine it is recorded as unstable",
         [](auto* of) { of->stability_controlled = Verdict::kUnstable; });
  expect(falling, "the critical stiffness is recorded as", [](auto* of) { of->critical_stiffness *= 1.001; });
  expect(falling, "does not fall along the unstable direction", [](auto* of) {
    // To the side, which the bars hold.
    of->unstable_direction.assign(of->unstable_direction.size(), 0.0);
    of->unstable_direction[2] = 1.0;
  });
}

// Paths that are right, whatever rounding or long increments make of single figures.
class RightPathIsProved : public ::testing::TestWithParam<const char*> {};

TEST_P(RightPathIsProved, FromFile) {
  const TracedPath path =
      TraceIncrements(ReadTraceRequestFile(std::string(CONTACT_PATH_TEST_DATA) + "/" + GetParam() + ".yaml"));
  ASSERT_TRUE(path.result.reason == EndReason::kMaxIncrements || path.result.reason == EndReason::kStopCriterion)
      << path.result.message;
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, RightPathIsProved,
                         ::testing::Values("held_on_stiff_solid", "over_the_end_of_a_thick_surface",
                                           "touching_but_for_rounding", "drag_in_one_increment", "slot_on_stiff_bars",
                                           "strained_to_second_order", "slip_between_two_zeros",
                                           "largest_friction_within", "large_stored_energy", "soft_motion_in_place",
                                           "load_turns_on_soft_parts", "load_turns_in_rounding", "load_is_a_cubic",
                                           "very_rough_contact_opens", "presses_to_second_order",
                                           "very_rough_contact_leaves", "begins_to_press", "presses_and_lets_go",
                                           "over_a_bulge", "slips_forth_and_back"),
                         [](const auto& instance) { return std::string(instance.param); });

// A solid that rounding of its places stresses by more than the bars beside bear: the path ends by name, or is right.
TEST(VerifyPath, StiffSolidAmongSoftBarsIsProvedAsFarAsItGoes) {
  const TracedPath path =
      TraceIncrements(ReadTraceRequestFile(std::string(CONTACT_PATH_TEST_DATA) + "/stiff_solid_among_soft_bars.yaml"));
  EXPECT_TRUE(path.result.reason == EndReason::kMaxIncrements || path.result.reason == EndReason::kStepTooSmall ||
              path.result.reason == EndReason::kNotDetermined)
      << path.result.message;
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

// Work and dissipation are changed alike, so that the energies still balance: their trapezoids tell. The bars beside
// the contact are 100 times as stiff as F over L.
TEST(VerifyPath, DissipationThatIsBalancedByWorkIsFound) {
  for (const double factor : {0.0, 0.5, 1.5, 3.0})
    for (const double step : {0.0, 0.05, 0.1}) {
      SCOPED_TRACE(std::to_string(factor) + " of the dissipation, step " + std::to_string(step));
      TraceRequest request =
          ReadTraceRequestFile(std::string(CONTACT_PATH_TEST_DATA) + "/driven_through_a_stiff_bar.yaml");
      request.options.step = step;
      TracedPath path = TraceIncrements(request);
      ExpectNoFindings(path);
      ASSERT_GT(path.increments.back().dissipation, 0.0);
      for (Increment& increment : path.increments) {
        increment.external_work += (factor - 1.0) * increment.dissipation;
        increment.dissipation *= factor;
      }
      EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
    }
}

TracedPath WithInnerStates(TraceRequest request, int increments) {
  request.options.record.emplace_back("inner");
  request.options.max_increments = increments;
  return TraceIncrements(request);
}

bool HasInner(const Increment& increment) { return !increment.inner.positions.empty(); }

// Scenes whose integrals are those of loads, of friction on arcs of beams, of a solid with a surface, and of an
// obstacle that moves.
struct AccurateScene {
  const char* name;
  Accuracy accuracy;  // so that a millionth of the whole path is more than what an increment leaves open
};

class InnerStates : public ::testing::TestWithParam<AccurateScene> {
 protected:
  void SetUp() override {
    TraceRequest request = ReadExample(GetParam().name);
    request.options.accuracy = GetParam().accuracy;
    path_ = WithInnerStates(request, 150);
    for (std::size_t i = 1; i < path_.increments.size(); ++i)
      if (path_.increments[i].kind == IncrementKind::kRegular && HasInner(path_.increments[i])) regular_.push_back(i);
    ASSERT_GT(regular_.size(), 10U);
  }

  // The findings where a sum is larger by this share of its total from an increment on.
  std::string FindingsWith(double Increment::*sum, std::size_t from) const {
    std::vector<Increment> increments = path_.increments;
    double total = 0.0;
    for (std::size_t i = 1; i < increments.size(); ++i) total += std::abs(increments[i].*sum - increments[i - 1].*sum);
    for (std::size_t i = from; i < increments.size(); ++i) increments[i].*sum += 1e-6 * total;
    return Listed(VerifyPath(path_.request, increments));
  }

  TracedPath path_;
  std::vector<std::size_t> regular_;
};

TEST_P(InnerStates, ProveEachIncrementThatMoves) {
  const Verification verification = VerifyPath(path_.request, path_.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_EQ(verification.open_integrals, 0);
  EXPECT_GE(verification.proved_integrals, static_cast<int>(regular_.size()));
}

TEST_P(InnerStates, ShowAMillionthOfEachSum) {
  for (std::size_t k = 0; k < regular_.size(); k += regular_.size() / 6) {
    SCOPED_TRACE(regular_[k]);
    // Before other increments longer steps were tried, and their arc length is known to less.
    if (path_.increments[regular_[k]].solve.rejected == 0) {
      EXPECT_NE(FindingsWith(&Increment::arc_length, regular_[k]).find("arc length is off by"), std::string::npos);
    }
    EXPECT_NE(FindingsWith(&Increment::external_work, regular_[k]).find("work of the loads"), std::string::npos);
    if (path_.increments.back().dissipation > 0.0) {
      EXPECT_NE(FindingsWith(&Increment::dissipation, regular_[k]).find("dissipation, over"), std::string::npos);
    }
  }
}

TEST_P(InnerStates, ThatWereChangedAreFound) {
  const std::size_t at = regular_[regular_.size() / 2];
  const auto findings_with = [&](const std::function<void(InnerState&)>& change) {
    std::vector<Increment> increments = path_.increments;
    change(increments[at].inner);
    return Listed(VerifyPath(path_.request, increments));
  };
  EXPECT_NE(findings_with([](InnerState& inner) { inner.load_factor += 1e-4; }), "");
  // The coordinate that moves most on the path.
  const std::vector<double>&first = path_.increments.front().positions, &last = path_.increments.back().positions;
  std::size_t most = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (std::abs(last[i] - first[i]) > std::abs(last[most] - first[most])) most = i;
  EXPECT_NE(findings_with([&](InnerState& inner) { inner.positions[most] += 1e-5; }).find("equilibrium residual"),
            std::string::npos);
  EXPECT_NE(findings_with([](InnerState& inner) { inner.contacts.back().gap += 1e-3; }).find("recorded gap"),
            std::string::npos);
  EXPECT_NE(findings_with([](InnerState& inner) { inner.positions.pop_back(); }).find("not those of the scene"),
            std::string::npos);
  // A state of the path, but not of this increment.
  EXPECT_NE(findings_with([&](InnerState& inner) {
              inner = path_.increments[at + 1].inner;
            }).find("not inside of the increment"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, InnerStates,
                         ::testing::Values(AccurateScene{"sliding_bar", Accuracy::kAccurate},
                                           AccurateScene{"rough_arch", Accuracy::kBalanced},
                                           AccurateScene{"two_blocks", Accuracy::kBalanced},
                                           AccurateScene{"snap_hook", Accuracy::kBalanced}),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Steps do not depend on whether inner states are recorded.
TEST(VerifyPath, InnerStatesLeaveThePathAsItIs) {
  for (const Method method : {Method::kBranch, Method::kMpec}) {
    TraceRequest request = ReadExample("fin_ray");
    request.options.method = method;
    TracedPath with = WithInnerStates(request, 80);
    with.request.options.record.clear();
    const TracedPath without = TraceIncrements(with.request);
    ASSERT_EQ(with.increments.size(), without.increments.size());
    for (std::size_t i = 0; i < with.increments.size(); ++i) {
      EXPECT_EQ(with.increments[i].positions, without.increments[i].positions);
      EXPECT_FALSE(HasInner(without.increments[i]));
    }
  }
}

TEST(VerifyPath, IncrementsByIpoptHaveNoInnerStates) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  request.options.record = {"inner"};
  request.options.max_increments = 10;
  const TracedPath path = TraceIncrements(request);
  for (const Increment& increment : path.increments) EXPECT_FALSE(HasInner(increment));
  ExpectNoFindings(path);
}

// The trapezoids are recorded themselves: a change that is balanced is found, too.
TEST(VerifyPath, WorkOfIncrementsByIpoptIsComparedWithTrapezoids) {
  TracedPath path = Traced("two_dof_friction", Method::kMpec);
  for (Increment& increment : path.increments) {
    increment.external_work += 1e-6 * increment.dissipation;
    increment.dissipation *= 1.0 + 1e-6;
  }
  EXPECT_NE(Listed(VerifyPath(path.request, path.increments)).find("dissipation, over"), std::string::npos);
}

TEST(VerifyPath, AllScenesAreProvedWithAndWithoutInnerStates) {
  int inner = 0, proved = 0;
  for (const char* const directory : {CONTACT_PATH_SCENES, CONTACT_PATH_TEST_DATA})
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
      if (entry.path().extension() != ".yaml") continue;
      SCOPED_TRACE(entry.path().filename().string());
      const TraceRequest request = ReadTraceRequestFile(entry.path().string());
      if (!request.options.LocatesEvents()) continue;
      TracedPath path = WithInnerStates(request, 50);
      if (path.increments.empty()) continue;
      for (const Increment& increment : path.increments) inner += HasInner(increment) ? 1 : 0;
      const Verification verification = VerifyPath(path.request, path.increments);
      EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
      proved += verification.proved_integrals;
      for (Increment& increment : path.increments) increment.inner = InnerState();
      ExpectNoFindings(path);
    }
  EXPECT_GT(inner, 3000);
  EXPECT_GE(proved, inner);
}

TEST(VerifyPath, FixedNodesRest) {
  const TracedPath path = Traced("sliding_bar", Method::kBranch);
  ASSERT_TRUE(path.request.scene.nodes[0].fixed_x);
  std::vector<Increment> increments = path.increments;
  increments[5].positions[0] += 1e-6;
  const Verification verification = VerifyPath(path.request, increments);
  const std::string wanted = "increment 5: support " + path.request.scene.nodes[0].name + " is not where it has to be";
  EXPECT_NE(Listed(verification).find(wanted), std::string::npos) << Listed(verification);
}

TEST(VerifyPath, AnotherSceneIsNotProved) {
  TraceRequest request = Genuine().request;
  request.scene.obstacles[0].friction *= 1.01;
  EXPECT_FALSE(VerifyPath(request, Genuine().increments).findings.empty());
}

TEST(VerifyPath, RowsWithoutStateAreCounted) {
  std::vector<Increment> increments = Genuine().increments;
  int left = 0;
  for (Increment& increment : increments)
    if (increment.kind == IncrementKind::kRegular && increment.index % 4 != 0) {
      increment.positions.clear();
      increment.contacts.clear();
      ++left;
    }
  ASSERT_GT(left, 10);
  TraceRequest request = Genuine().request;
  EXPECT_NE(Listed(VerifyPath(request, increments)).find("has no state"), std::string::npos);
  request.options.full_state_every = 4;
  const Verification verification = VerifyPath(request, increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_EQ(verification.full_increments, verification.increments - left);
}

TEST(VerifyPath, EndsWhereTheCallerWantsNoMore) {
  int asked = 0;
  const auto interrupt = [&asked] {
    if (++asked == 5) throw std::runtime_error("enough");
  };
  EXPECT_THROW(VerifyPath(Genuine().request, Genuine().increments, interrupt), std::runtime_error);
  EXPECT_EQ(asked, 5);
}

TEST(VerifyPath, FindingsHaveAnEnd) {
  std::vector<Increment> increments = Genuine().increments;
  for (Increment& increment : increments) increment.load_factor += 1.0;
  EXPECT_EQ(VerifyPath(Genuine().request, increments).findings.size(), kMostLines);
}

// Pressed with 5e-12 of F and lifted: residuals over F see nothing of the reaction.
class SoftContact : public testing::Test {
 protected:
  void SetUp() override {
    path_ =
        TraceIncrements(ReadTraceRequestFile(std::string(CONTACT_PATH_TEST_DATA) + "/soft_across_stiff_along.yaml"));
    ASSERT_EQ(path_.result.reason, EndReason::kStopCriterion) << path_.result.message;
    pressed_ = path_.increments.size();
    for (const Increment& increment : path_.increments)
      if (increment.stage == 2 && increment.contacts[0].rn > 1e-12)
        pressed_ = static_cast<std::size_t>(increment.index);
    ASSERT_LT(pressed_, path_.increments.size());
  }

  std::string FindingsWith(double rn) {
    path_.increments[pressed_].contacts[0].rn = rn;
    return Listed(VerifyPath(path_.request, path_.increments));
  }

  TracedPath path_;
  std::size_t pressed_ = 0;
};

TEST_F(SoftContact, IsProved) {
  const Verification verification = VerifyPath(path_.request, path_.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

TEST_F(SoftContact, MustNotPull) {
  EXPECT_NE(FindingsWith(-1e-12).find("pulls"), std::string::npos) << FindingsWith(-1e-12);
}

TEST_F(SoftContact, MustBeInEquilibrium) {
  const double rn = path_.increments[pressed_].contacts[0].rn;
  EXPECT_NE(FindingsWith(1.1 * rn).find("equilibrium residual across"), std::string::npos) << FindingsWith(1.1 * rn);
}

}  // namespace
}  // namespace contact_path::verify_path_test
