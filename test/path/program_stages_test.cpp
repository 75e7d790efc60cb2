// Load programs: the scenes of their stages, what proves their paths, and their rules.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::program_stages_test {
namespace {

TEST(StageScene, HoldsWhatEarlierStagesBroughtOn) {
  const TraceRequest request = ReadExample("press_slide_lift");
  EXPECT_EQ(NumStages(request), 3u);
  const Scene third = StageScene(request, 2);
  const Configuration configuration = StageConfiguration(request, 2);
  EXPECT_DOUBLE_EQ(configuration.start[0], -1.0 + 0.3);
  EXPECT_DOUBLE_EQ(configuration.start[1], 1.0 - 0.1);
  EXPECT_EQ(configuration.reference, Configuration::Of(request.scene).reference);
  ASSERT_EQ(third.support_motions.size(), 2u);
  EXPECT_EQ(third.support_motions[0].dy, 1.0);
  TraceRequest loads = ReadExample("sliding_bar");
  loads.program = {{"one", {{"b", 2.0, 0.0, false}}, {}, {{"floor", 0.0, -1.0}}, -0.5},
                   {"two", {{"b", 0.0, 1.0, false}}, {}, {}, 0.0}};
  loads.scene.loads = {{"b", 0.0, -3.0, true}};
  const Scene second = StageScene(loads, 1);
  ASSERT_EQ(second.loads.size(), 3u);
  EXPECT_TRUE(second.loads[0].constant && second.loads[1].constant && !second.loads[2].constant);
  EXPECT_EQ(second.loads[1].fx, -1.0);
  EXPECT_EQ(second.obstacles[0].py, 0.5);
  EXPECT_TRUE(second.obstacle_motions.empty());
  EXPECT_EQ(StageScales(loads, 1).length, StageScales(loads, 0).length);
}

// Without bars: what a load per unit load factor is called must not matter, nor which stage comes first.
TEST(StageScales, FollowTheForcesAtTheTargets) {
  TraceRequest request;
  request.scene.nodes = {{"p", 0.0, 0.0, false, false}};
  request.scene.superelements = {{{"p"}, {2.0, 0.0, 0.0, 2.0}}};
  request.program = {{"little", {{"p", 1e-6, 0.0}}, {}, {}, 3.0}, {"much", {{"p", 0.0, -10.0}}, {}, {}, -2.0}};
  EXPECT_DOUBLE_EQ(StageScales(request, 0).force, 20.0);
  EXPECT_DOUBLE_EQ(StageScales(request, 0).length, 10.0);
  EXPECT_DOUBLE_EQ(StageScales(request, 0).load_factor, 2e7);
  EXPECT_DOUBLE_EQ(StageScales(request, 1).force, 20.0);
  EXPECT_DOUBLE_EQ(StageScales(request, 1).load_factor, 2.0);
  TraceRequest other = request;
  other.program[1].loads[0].fy = -1e-3;
  other.program[1].target = -2e4;
  EXPECT_DOUBLE_EQ(StageScales(other, 0).force, 20.0);
  EXPECT_DOUBLE_EQ(StageScales(other, 1).load_factor, 2e4);
}

TEST(StageScene, AfterUnloadingAllIsThatOfTheSceneToTheLastBit) {
  TraceRequest request = ReadExample("press_slide_lift");
  for (Stage& stage : request.program) stage.loads = {{"b", 0.1, 0.7, false}};
  request.program.push_back(UnloadingStage());
  request.program.push_back({"again", {{"b", 1.0, 0.0}}, {}, {}, 0.0});
  ASSERT_TRUE(Validate(request).empty());
  const Scene after = StageScene(request, 4);
  ASSERT_EQ(after.loads.size(), 1u);
  EXPECT_EQ(StageConfiguration(request, 4).start, Configuration::Of(request.scene).start);
  // One motion for each support, the sum of the three stages: down by 0.1, aside by 0.3, up by 0.2.
  const Stage traced = StageAsTraced(request, 3);
  ASSERT_EQ(traced.support_motions.size(), 2u);
  EXPECT_NEAR(traced.support_motions[0].dx, -0.3, 1e-15);
  EXPECT_NEAR(traced.support_motions[0].dy, -0.1, 1e-15);
  ASSERT_EQ(traced.loads.size(), 3u);
  EXPECT_DOUBLE_EQ(traced.loads[1].fx, -0.03);
}

// Half of what is left, and then half of what is left of that and of a load in between.
TEST(StageScene, PartsThatAreTakenBack) {
  TraceRequest request = ReadExample("sliding_bar");
  request.scene.loads.clear();
  request.options.stop.clear();
  const Stage half = UnloadingStage(0.5);
  request.program = {LoadingStage({{"b", 8.0, 0.0}}, 2.0), half, LoadingStage({{"b", 0.0, -4.0}}), half, half};
  ASSERT_TRUE(Validate(request).empty());
  const Scene last = StageScene(request, 4);
  ASSERT_EQ(last.loads.size(), 4u);
  EXPECT_EQ(last.loads[0].fx, 4.0);
  EXPECT_EQ(last.loads[1].fy, -2.0);
  EXPECT_TRUE(last.loads[0].constant && last.loads[1].constant);
  EXPECT_EQ(last.loads[2].fx, -4.0);
  EXPECT_EQ(last.loads[3].fy, 2.0);
  EXPECT_FALSE(last.loads[2].constant || last.loads[3].constant);
}

// ----- what a record of a program must not be able to hide -----

TEST(VerifyProgram, FindsWhatWasChanged) {
  const TraceRequest request = ReadExample("press_slide_lift");
  const TracedPath path = TraceIncrements(request);
  const auto first_of = [&](int stage) {
    const Increment& first = FirstThat(path, [&](const Increment& increment) { return increment.stage == stage; });
    return static_cast<std::size_t>(first.index);
  };
  ExpectNoFindings(path);
  const std::size_t second = first_of(2), third = first_of(3);
  using Increments = std::vector<Increment>;
  const std::function<void(Increments&)> changes[] = {
      [&](Increments& of) { of[second + 1].positions[0] += 1e-6; },  // a support
      [&](Increments& of) { of[second].dissipation += 1e-3; },
      [&](Increments& of) { of[second].contacts[0].rn *= 1.0 + 1e-6; },
      [&](Increments& of) {
        for (std::size_t i = second; i < third; ++i) of[i].stage = 3;
      },
      [&](Increments& of) {
        of.erase(of.begin() + static_cast<std::ptrdiff_t>(third) - 1);
        for (std::size_t i = 0; i < of.size(); ++i) of[i].index = static_cast<int>(i);
      },
      [&](Increments& of) {
        for (std::size_t i = second + 1; i < of.size(); ++i) of[i].external_work += 1e-2;
      }};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Increments increments = path.increments;
    changes[i](increments);
    EXPECT_FALSE(VerifyPath(request, increments).findings.empty()) << i;
  }
  // The scene's own motions, not those recorded.
  TraceRequest other = request;
  other.program[1].support_motions[0].dx = 1.1;
  EXPECT_FALSE(VerifyPath(other, path.increments).findings.empty());
}

// Right records that it once refused.
TEST(VerifyProgram, ShortRecordsOfMpecWithoutAllStatesAreProved) {
  TraceRequest request = ReadExample("press_slide_lift");
  request.options.method = Method::kMpec;
  request.options.full_state_every = 3;
  for (request.options.max_increments = 1; request.options.max_increments <= 8; ++request.options.max_increments) {
    SCOPED_TRACE(request.options.max_increments);
    TracedPath path = TraceIncrements(request);
    path.increments = Thinned(path, 3);
    ExpectNoFindings(path);
  }
}

TEST(VerifyProgram, LongMotionsAreProved) {
  TraceRequest request = ReadExample("stick_slip_cycle");
  request.program = {{"far", {}, {}, {{"belt", 1.0, 0.0}}, 1e6}};
  request.options.step = 1e5;
  TraceTo(Rotate(request, 0.3), EndReason::kStopCriterion, 1e-9);  // the belt not along an axis
}

// ----- rules -----

void ExpectViolation(const TraceRequest& request, const std::string& key, const std::string& rule) {
  const std::vector<Violation> violations = Validate(request);
  for (const Violation& violation : violations)
    if (violation.key == key && violation.rule.find(rule) != std::string::npos) return;
  ADD_FAILURE() << key << ": " << rule << "; but got " << (violations.empty() ? "nothing" : violations[0].ToLine());
}

TEST(ProgramRules, AreTold) {
  const TraceRequest sound = ReadExample("press_slide_lift");
  ASSERT_TRUE(Validate(sound).empty());
  TraceRequest request = sound;
  request.scene.loads = {{"b", 1.0, 0.0, false}};
  ExpectViolation(request, "scene.loads[0].constant", "must be true where there is a program");
  request = sound;
  request.program[1].loads = {{"b", 1.0, 0.0, true}};
  ExpectViolation(request, "program[1].loads[0].constant", "must be false");
  request = sound;
  request.program[0].support_motions.clear();
  ExpectViolation(request, "program[0]", "a load must act on a free component");
  request = sound;
  request.program[0].support_motions[0].node = "nobody";
  ExpectViolation(request, "program[0].support_motions[0].node", "must name a node");
  request = sound;
  request.program[0].support_motions[1].node = "a";
  ExpectViolation(request, "program[0].support_motions[1].node", "must not be repeated");
  request = sound;
  request.program[0].support_motions[0].node = "b";
  ExpectViolation(request, "program[0].support_motions[0].dy", "is not fixed in y");
  ExpectViolation(request, "program[0].support_motions[0].node", "must not be a contact candidate");
  request = sound;
  request.program[2].support_motions[0].dy = 0.0;
  ExpectViolation(request, "program[2].support_motions[0]", "must not be zero");
  request = sound;
  request.program[2].target = std::nan("");
  ExpectViolation(request, "program[2].target", "must be finite");
  request = sound;
  request.scene.support_motions = {{"a", 1.0, 0.0}};
  ExpectViolation(request, "scene.support_motions", "must be empty where there is a program");
  request = sound;
  request.scene.obstacle_motions = {{"floor", 1.0, 0.0}};
  ExpectViolation(request, "scene.obstacle_motions", "must be empty where there is a program");
  request = sound;
  request.program[0].obstacle_motions = {{"ceiling", 1.0, 0.0}};
  ExpectViolation(request, "program[0].obstacle_motions[0].obstacle", "must name an obstacle");
  request = sound;
  request.options.direction = -1.0;
  ExpectViolation(request, "options.direction", "must be 0 where there is a program");
  request = sound;
  request.options.stop = {{"load_factor", ">", 1.0}};
  ExpectViolation(request, "options.stop[0].quantity", "each stage has a target of its own");
  request = sound;
  request.scene.nodes[1].fixed_x = true;
  request.program[1].obstacle_motions = {{"floor", 1.0, 0.0}};
  ExpectViolation(request, "program[1].obstacle_motions[0].obstacle", "node b must be free to move that way");
  request = ReadExample("two_dof_friction");
  request.scene.superelements[0].rest_positions = {0.0};
  ExpectViolation(request, "scene.superelements[0].rest_positions", "must be empty or have");
}

}  // namespace
}  // namespace contact_path::program_stages_test
