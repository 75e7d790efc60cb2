// Load programs: moved supports and obstacles, friction history from stage to stage, by both methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/verify/verify_path.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::program_test {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kSound = 1e-9;  // largest residual

// Complete, sound, and proved.
TracedPath TraceProgram(TraceRequest request, Method method = Method::kBranch) {
  request.options.method = method;
  TracedPath path = TraceTo(request, EndReason::kStopCriterion, kSound);
  EXPECT_EQ(path.result.message.rfind("the program was traced to its end", 0), 0u);  // remarks may follow
  return path;
}

class EachMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Programs, EachMethod, testing::Values(Method::kBranch, Method::kMpec),
                         [](const auto& method) { return std::string(ToString(method.param)); });

// The block sticks while the belt goes 2 mu N / k, then slips: k = 1, mu N = 0.3.
TEST_P(EachMethod, StickSlipCycleIsTheHysteresisLoopOfCoulomb) {
  const TracedPath path = TraceProgram(ReadExample("stick_slip_cycle"), GetParam());
  const bool exact = GetParam() == Method::kBranch;
  const double tolerance = exact ? kRounding : 1e-6;  // of the work of an increment that cuts a corner
  const double dissipated[] = {0.06, 0.18, 0.30};
  for (int stage = 1; stage <= 3; ++stage) {
    const Increment& end = LastOfStage(path, stage);
    const double sign = stage == 2 ? -1.0 : 1.0;
    EXPECT_NEAR(PositionX(path, end, "b"), 1.0 + 0.3 * sign, kRounding);
    EXPECT_NEAR(Contact(path, end, "b@belt").rt, 0.3 * sign, kRounding);
    EXPECT_EQ(Contact(path, end, "b@belt").state, stage == 2 ? ContactState::kSlipPlus : ContactState::kSlipMinus);
    EXPECT_NEAR(end.dissipation, dissipated[stage - 1], tolerance);
    EXPECT_NEAR(end.strain_energy, 0.045, kRounding);
    EXPECT_NEAR(end.external_work, dissipated[stage - 1] + 0.045, tolerance);
  }
  // In between, at each increment: the friction force against the displacement of the belt.
  for (const Increment& increment : path.increments) {
    const double sign = increment.stage == 2 ? -1.0 : 1.0;
    const double stuck = increment.stage == 1 ? 0.3 : 0.6, gone = std::abs(increment.load_factor);
    const double force = (increment.stage == 1 ? 0.0 : -0.3 * sign) + sign * std::min(gone, stuck);
    EXPECT_NEAR(Contact(path, increment, "b@belt").rt, force, exact ? kRounding : 1e-7)
        << "increment " << increment.index;
  }
  if (!exact) return;
  // Slip sets in where the theory says.
  for (int stage = 1; stage <= 3; ++stage) {
    const Increment& begins = FirstThat(path, [&](const Increment& increment) {
      return increment.stage == stage && increment.kind == IncrementKind::kContactEvent;
    });
    EXPECT_NEAR(begins.load_factor, stage == 1 ? 0.3 : 0.6, kRounding);
  }
}

TEST_P(EachMethod, FootIsPressedDraggedAndLifted) {
  const TracedPath path = TraceProgram(ReadExample("press_slide_lift"), GetParam());
  const Increment& pressed = LastOfStage(path, 1);
  const double l = std::hypot(1.0, 0.9), l0 = std::hypot(1.0, 0.98);
  EXPECT_EQ(pressed.load_factor, 0.1);
  EXPECT_NEAR(PositionY(path, pressed, "a"), 0.9, kRounding);
  EXPECT_NEAR(Contact(path, pressed, "b@floor").rn, 2.0 * 10.0 * (1.0 - l / l0) * 0.9 / l, 1e-11);
  EXPECT_EQ(Contact(path, pressed, "b@floor").state, ContactState::kStick);
  const Increment& dragged = LastOfStage(path, 2);
  EXPECT_EQ(Contact(path, dragged, "b@floor").state, ContactState::kSlipPlus);
  // With b slipping, its place between the supports does not depend on how far it was dragged: equilibrium along x and
  // the cone give the same shape for a foot that was dragged twice as far.
  TraceRequest farther = ReadExample("press_slide_lift");
  farther.program.resize(2);
  farther.program[1].target = 0.6;
  const TracedPath far = TraceProgram(farther, GetParam());
  const Increment& twice = LastOfStage(far, 2);
  EXPECT_NEAR(PositionX(far, twice, "b") - PositionX(far, twice, "a"),
              PositionX(path, dragged, "b") - PositionX(path, dragged, "a"), 1e-10);
  const Increment& lifted = LastOfStage(path, 3);
  EXPECT_EQ(Contact(path, lifted, "b@floor").state, ContactState::kOpen);
  EXPECT_NEAR(PositionX(path, lifted, "b"), 0.3, 1e-9);
  EXPECT_NEAR(PositionY(path, lifted, "b"), 0.12, 1e-9);
  EXPECT_NEAR(lifted.strain_energy, 0.0, 1e-15);
  EXPECT_NEAR(lifted.external_work, lifted.dissipation, GetParam() == Method::kBranch ? kRounding : 5e-5);
}

TEST(Program, GripperIsSymmetricAndSlipsAtItsPullOutForce) {
  const TracedPath path = TraceProgram(ReadExample("gripper"));
  double pull_out = -1.0;
  for (const Increment& increment : path.increments) {
    const ContactRecord &left = Contact(path, increment, "l@left_face"),
                        &right = Contact(path, increment, "r@right_face");
    EXPECT_NEAR(left.rn, right.rn, 1e-11);
    EXPECT_NEAR(left.rt, -right.rt, 1e-11);  // the tangents of the faces are opposed
    EXPECT_NEAR(PositionX(path, increment, "l"), -PositionX(path, increment, "r"), 1e-12);
    pull_out = std::max(pull_out, left.rt - right.rt);
  }
  const Increment& end = path.increments.back();
  EXPECT_NEAR(std::abs(Contact(path, end, "l@left_face").rt), 0.5 * Contact(path, end, "l@left_face").rn, 1e-11);
  EXPECT_NEAR(pull_out, 2.0 * Contact(path, end, "l@left_face").rt, 1e-11);
  EXPECT_NEAR(pull_out, 1.74, 0.005);  // as its file says
  EXPECT_GT(end.dissipation, 0.0);
}

// A stage of the scene's own load is the path without a program, as far as its target.
TEST_P(EachMethod, OneStageIsThePathUpToItsTarget) {
  TraceRequest plain = ReadExample("sliding_bar");
  plain.options.method = GetParam();
  plain.options.stop = {{"load_factor", ">", 0.5}};
  TraceRequest program = plain;
  program.options.stop.clear();
  program.program = {{"all", program.scene.loads, {}, {}, 0.5}};
  program.scene.loads.clear();
  const TracedPath whole = TraceIncrements(plain), staged = TraceProgram(program, GetParam());
  ASSERT_LE(staged.increments.size(), whole.increments.size());
  for (std::size_t i = 0; i + 1 < staged.increments.size(); ++i) {
    EXPECT_EQ(staged.increments[i].positions, whole.increments[i].positions);
    EXPECT_EQ(staged.increments[i].load_factor, whole.increments[i].load_factor);
    EXPECT_EQ(staged.increments[i].stage, 1);
  }
  EXPECT_EQ(staged.increments.back().load_factor, 0.5);
}

TEST(Program, AStageInTwoHalvesEndsAtTheSamePoint) {
  const TraceRequest whole = ReadExample("press_slide_lift");
  TraceRequest halves = whole;
  halves.program.clear();
  for (Stage stage : whole.program) {
    stage.target *= 0.5;
    halves.program.insert(halves.program.end(), {stage, stage});
  }
  const TracedPath a = TraceProgram(whole), b = TraceProgram(halves);
  for (int stage = 1; stage <= 3; ++stage) {
    const Increment &one = LastOfStage(a, stage), &other = LastOfStage(b, 2 * stage);
    for (std::size_t i = 0; i < one.positions.size(); ++i) EXPECT_NEAR(one.positions[i], other.positions[i], 1e-11);
    EXPECT_NEAR(one.dissipation, other.dissipation, 1e-9);
    EXPECT_NEAR(one.external_work, other.external_work, 1e-9);
  }
}

// Superelements keep the place where they are free of force when their supports move.
TEST(Program, SuperelementsAreStretchedByTheirSupports) {
  TraceRequest request;
  request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, true}};
  request.scene.superelements = {{{"a", "b"}, {2, 0, -2, 0, 0, 0, 0, 0, -2, 0, 2, 0, 0, 0, 0, 0}, {}}};
  request.scene.obstacles = {{"wall", ObstacleShape::kHalfPlane, 1.5, 0.0, -1.0, 0.0, 0.0}};
  request.scene.contacts = {{"b", "wall"}};
  request.program = {{"push", {}, {{"a", 1.0, 0.0}}, {}, 0.75}, {"push on", {}, {{"a", 1.0, 0.0}}, {}, 0.25}};
  const TracedPath path = TraceProgram(request);
  EXPECT_NEAR(Contact(path, LastOfStage(path, 1), "b@wall").rn, 2.0 * 0.25, kRounding);
  EXPECT_NEAR(Contact(path, LastOfStage(path, 2), "b@wall").rn, 2.0 * 0.5, kRounding);
  EXPECT_NEAR(path.increments.back().external_work, 0.5 * 2.0 * 0.25, kRounding);
}

// Without bars, the forces of the first stage are the measure for all.
TEST_P(EachMethod, StagesOfVeryDifferentLoads) {
  TraceRequest request = ReadExample("two_dof_friction");
  const std::vector<Load> loads = request.scene.loads;
  request.options = {};
  request.scene.loads.clear();
  std::vector<Load> tiny;
  for (const Load& load : loads) {
    if (load.constant)
      request.scene.loads.push_back(load);
    else
      tiny.push_back({load.node, 1e-8 * load.fx, 1e-8 * load.fy, false});
  }
  request.program = {{"much", {}, {}, {}, 0.1}, {"hardly", tiny, {}, {}, 0.0}, {"back", {}, {}, {}, -0.1}};
  for (const Load& load : loads)
    if (!load.constant)
      for (Stage* stage : {&request.program[0], &request.program[2]}) stage->loads.push_back(load);
  TraceProgram(request, GetParam());
}

// Supports can move without a program, too: displacement control, through the snap of a shallow arch.
TEST_P(EachMethod, SupportMotionOfTheSceneItself) {
  TraceRequest request;
  request.scene.nodes = {{"a", -1.0, 0.0, true, true},
                         {"b", 0.0, 0.3, false, false},
                         {"c", 1.0, 0.0, true, true},
                         {"d", 0.0, 1.0, true, true}};
  request.scene.bars = {{{"a", "b"}, 1.0}, {{"b", "c"}, 1.0}, {{"b", "d"}, 100.0}};
  request.scene.support_motions = {{"d", 0.0, -1.0}};
  request.options.method = GetParam();
  request.options.stop = {{"d.y", "<", 0.3}};
  const TracedPath path = TraceTo(request);
  ExpectNoFindings(path);
  for (const Increment& increment : path.increments) {
    EXPECT_NEAR(PositionY(path, increment, "d"), 1.0 - increment.load_factor, kRounding);
    EXPECT_LE(increment.residuals.support, kRounding);
    // The bar from above carries what the arch resists.
    const double y = PositionY(path, increment, "b"), l = std::hypot(1.0, y), l0 = std::hypot(1.0, 0.3);
    const double arch = 2.0 * (l / l0 - 1.0) * y / l, push = 100.0 * ((1.0 - increment.load_factor - y) / 0.7 - 1.0);
    EXPECT_NEAR(arch, push, 1e-11);
  }
  EXPECT_LE(EnergyImbalance(path), GetParam() == Method::kBranch ? 1e-9 : 1e-6);
  EXPECT_LT(PositionY(path, path.increments.back(), "b"), 0.0);  // through
}

TEST(Program, UnitsDoNotMatter) {
  const TraceRequest request = ReadExample("press_slide_lift");
  const TracedPath a = TraceProgram(request);
  const TracedPath b = UndoUnits(TraceProgram(ChangeUnits(request, 1e-3, 1e6)), 1e-3, 1e6);
  ASSERT_EQ(a.increments.size(), b.increments.size());
  for (std::size_t i = 0; i < a.increments.size(); ++i)
    for (std::size_t k = 0; k < a.increments[i].positions.size(); ++k)
      EXPECT_NEAR(a.increments[i].positions[k], b.increments[i].positions[k], 1e-10);
}

// The block slips at 0.3: whatever the distance of the target from there, the stage ends at it.
TEST(Program, TargetsNextToAnEventAreHit) {
  for (const double step : {0.02, 0.2, 2.0})
    for (const double off : {-1e-3, -1e-5, -1e-6, -1e-7, -1e-9, -1e-11, -1e-13, 0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5}) {
      TraceRequest request = ReadExample("stick_slip_cycle");
      request.options.step = step;
      request.program.resize(2);
      request.program[0].target = 0.3 + off;
      const TracedPath path = TraceProgram(request);
      EXPECT_NEAR(LastOfStage(path, 1).load_factor, 0.3 + off, 1e-12) << off;
      EXPECT_NEAR(Contact(path, path.increments.back(), "b@belt").rt, -0.3, kRounding) << off;
    }
}

TEST(Program, NumberOfIncrementsIsKeptAlsoWhereAStageEnds) {
  TraceRequest request = ReadExample("press_slide_lift");
  for (int most = 1; most < 40; ++most) {
    request.options.max_increments = most;
    EXPECT_LE(TraceIncrements(request).increments.size(), static_cast<std::size_t>(most) + 1);
  }
}

TEST(Program, ByDefaultEachStageHasAThousandIncrements) {
  TraceRequest request = ReadExample("stick_slip_cycle");
  request.options.step = 2e-3;
  const TracedPath whole = TraceProgram(request);
  std::vector<int> of_stage(request.program.size(), 0);
  for (const Increment& increment : whole.increments) ++of_stage[static_cast<std::size_t>(increment.stage) - 1];
  EXPECT_LE(*std::max_element(of_stage.begin(), of_stage.end()), 1001);
  EXPECT_GT(whole.increments.size(), 1001U);
  request.options.step = 1e-3;
  const TracedPath cut = TraceIncrements(request);
  EXPECT_EQ(cut.result.reason, EndReason::kMaxIncrements);
  EXPECT_EQ(cut.increments.back().stage, 2);
  EXPECT_EQ(cut.increments.back().index, LastOfStage(cut, 1).index + 1001);
  EXPECT_EQ(EndContradicted(request, cut.increments, "max_increments"), "");
  request.options.max_increments = 1200;
  EXPECT_EQ(TraceIncrements(request).increments.size(), 1201U);
}

TEST(Program, EventsAndIncrementsAreNumberedThroughAllStages) {
  const TracedPath path = TraceProgram(ReadExample("stick_slip_cycle"));
  int events = 0, starts = 0;
  for (std::size_t i = 0; i < path.increments.size(); ++i) {
    EXPECT_EQ(path.increments[i].index, static_cast<int>(i));
    if (path.increments[i].event.number > 0) {
      EXPECT_EQ(path.increments[i].event.number, ++events);
    }
    starts += path.increments[i].kind == IncrementKind::kStart ? 1 : 0;
  }
  EXPECT_EQ(events, 3);
  EXPECT_EQ(starts, 3);
}

TEST(Program, StopCriterionEndsAllOfIt) {
  TraceRequest request = ReadExample("press_slide_lift");
  request.options.stop = {{"b.x", ">", 0.1}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  EXPECT_EQ(path.increments.back().stage, 2);
  request.options.stop.clear();
  request.options.max_increments = 3;
  EXPECT_EQ(TraceIncrements(request).increments.size(), 4u);
}

// The load factor turns twice before it comes to its target.
TEST_P(EachMethod, AStageGoesThroughLimitPoints) {
  TraceRequest request = ReadExample("von_mises");
  request.options = {};
  request.program = {{"snap", request.scene.loads, {}, {}, 0.0}};
  request.scene.loads.clear();
  const TracedPath path = TraceProgram(request, GetParam());
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSmoothLimit).size(), 2u);
  EXPECT_EQ(path.increments.back().load_factor, 1.0);
}

// On this side of the limit point, not where the load factor comes by again after the snap.
TEST_P(EachMethod, TargetsJustBelowALimitPointAreHit) {
  TraceRequest request = ReadExample("von_mises");
  const TracedPath snap = TraceIncrements(request);
  const Increment limit = IncrementsOfKind(snap, IncrementKind::kSmoothLimit).front();
  request.options = {};
  const std::vector<Load> loads = request.scene.loads;
  request.scene.loads.clear();
  for (const double below : {1e-2, 1e-3, 1e-4, 1e-6}) {
    request.program = {{"up", loads, {}, {}, (1.0 - below) * limit.load_factor}};
    const TracedPath path = TraceProgram(request, GetParam());
    EXPECT_GT(PositionY(path, path.increments.back(), "apex"), PositionY(snap, limit, "apex")) << below;
  }
}

TEST(Program, TargetsNextToAnEventAreHitByMpec) {
  for (const double off : {-1e-3, -1e-7, -1e-9, -1e-10, 1e-10, 1e-9, 1e-7}) {
    TraceRequest request = ReadExample("stick_slip_cycle");
    request.program.resize(1);
    request.program[0].target = 0.3 + off;
    const TracedPath path = TraceProgram(request, Method::kMpec);
    EXPECT_NEAR(path.increments.back().load_factor, 0.3 + off, 1e-12) << off;
  }
}

// ----- stages that unload -----

// The belt of the cycle comes back: it goes 0.5, less than the 0.6 that would make the block slip the other way, so the
// block goes back with it from 1.3 to 0.8.
TEST_P(EachMethod, UnloadingTakesTheBeltBack) {
  TraceRequest request = ReadExample("stick_slip_cycle");
  request.program.resize(2);
  request.program[1] = UnloadingStage();
  const TracedPath path = TraceProgram(request, GetParam());
  const Increment &forth = LastOfStage(path, 1), &back = LastOfStage(path, 2);
  EXPECT_EQ(back.load_factor, 1.0);
  EXPECT_NEAR(PositionX(path, back, "b"), 0.8, kRounding);
  EXPECT_NEAR(Contact(path, back, "b@belt").rt, -0.2, kRounding);
  EXPECT_EQ(Contact(path, back, "b@belt").state, ContactState::kStick);
  EXPECT_EQ(back.dissipation, forth.dissipation);
  EXPECT_NEAR(back.strain_energy, 0.02, kRounding);
}

// A block on a spring of stiffness 2 with mu N = 0.5 is pulled with P = 1.5: it slips to u = (P - 0.5) / 2 = 0.5. While
// P falls to 0 it sticks until P = 2 u - 0.5 = 0.5, then slips back to u = 0.25, in one stage or in several.
TEST_P(EachMethod, UnloadingLeavesAResidualDisplacement) {
  TraceRequest request;
  request.scene = NodeOnFloor("p", 2.0, 0.5);
  request.scene.loads = {{"p", 0.0, -1.0, true}};
  request.program = {{"pull", {{"p", 1.0, 0.0}}, {}, {}, 1.5}};
  const double tolerance = GetParam() == Method::kBranch ? kRounding : 1e-6;
  for (const std::vector<double>& parts : std::vector<std::vector<double>>{{0.0}, {1.0}, {0.5, 0.25, 1.0}}) {
    request.program.resize(1);
    for (const double part : parts) request.program.push_back(UnloadingStage(part));
    const TracedPath path = TraceProgram(request, GetParam());
    EXPECT_NEAR(PositionX(path, LastOfStage(path, 1), "p"), 0.5, kRounding);
    const Increment& end = path.increments.back();
    EXPECT_NEAR(PositionX(path, end, "p"), 0.25, kRounding);
    EXPECT_NEAR(Contact(path, end, "p@floor").rt, 0.5, kRounding);
    EXPECT_EQ(Contact(path, end, "p@floor").state, ContactState::kSlipMinus);
    EXPECT_NEAR(end.dissipation, 0.5 * 0.75, tolerance);
  }
}

}  // namespace
}  // namespace contact_path::program_test
