// Scenes that once went wrong, with what is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/verify/verify_path.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::hard_scenes_test {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

// By method branch. max_increments: 0: as the file has it.
TraceRequest ReadHard(const std::string& name, int max_increments = 0) {
  TraceRequest request = ReadData(name);
  if (max_increments > 0) request.options.max_increments = max_increments;
  request.options.method = Method::kBranch;
  return request;
}

TracedPath TraceHard(const std::string& name, Accuracy accuracy, int max_increments = 0) {
  TraceRequest request = ReadHard(name, max_increments);
  request.options.accuracy = accuracy;
  return TraceIncrements(request);
}

std::vector<double> LimitLoads(const TracedPath& path) {
  std::vector<double> loads;
  for (const Increment& increment : path.increments)
    if (increment.kind == IncrementKind::kSmoothLimit || increment.kind == IncrementKind::kCornerLimit)
      loads.push_back(increment.load_factor);
  return loads;
}

TEST(HardScenes, ReactionThatTouchesItsConeWhereSlipOnceTurned) {
  std::vector<double> first;
  for (const Accuracy accuracy : kPresets) {
    const TracedPath path = TraceHard("reversal_revisited", accuracy);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectSoundIncrements(path, 1e-9);
    const std::vector<double> loads = LimitLoads(path);
    ASSERT_EQ(loads.size(), 4U);
    if (first.empty()) first = loads;
    for (std::size_t i = 0; i < loads.size(); ++i) EXPECT_NEAR(loads[i], first[i], 1e-10);
  }
}

TEST(HardScenes, BarWithoutLengthThatMeetsAWall) {
  for (const Accuracy accuracy : kPresets) {
    const TracedPath path = TraceHard("zero_length_at_wall", accuracy);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectSoundIncrements(path, 1e-9);
    EXPECT_NEAR(LargestLoadFactor(path), 0.5, 0.1);
    ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), {1.0 / (3.0 * std::sqrt(3.0))}, 1e-12);
    for (const Increment& increment : path.increments) {
      const double length = PositionX(path, increment, "b") - 1.0;
      const double reaction = increment.load_factor - 0.5 * length * (1.0 - length * length);
      EXPECT_GE(length, -1e-15);
      EXPECT_NEAR(increment.contacts[0].rn, reaction, 1e-12);
      EXPECT_NEAR(length * reaction, 0.0, 1e-12);
    }
  }
}

TEST(HardScenes, BranchNextToStraightBack) {
  constexpr double kFriction = 0.00018, kCoupling = 0.0009;
  for (const Accuracy accuracy : kPresets) {
    const TracedPath path = TraceHard("almost_straight_back", accuracy);
    ExpectSoundIncrements(path, 1e-9);
    ASSERT_EQ(LimitLoads(path), std::vector<double>{LargestLoadFactor(path)});
    EXPECT_NEAR(LargestLoadFactor(path), kFriction / kCoupling, 1e-12);
    for (std::size_t i = LargestLoad(path) + 1; i < path.increments.size(); ++i) {
      const Increment& increment = path.increments[i];
      const double moved = (kFriction - kCoupling * increment.load_factor) / (1.0 + kCoupling * kCoupling);
      EXPECT_EQ(increment.contacts[0].state, ContactState::kSlipPlus);
      EXPECT_NEAR(PositionX(path, increment, "p"), moved, 1e-13);
      EXPECT_NEAR(increment.dissipation, kFriction * moved, 1e-15);
    }
    EXPECT_LT(path.increments.back().load_factor, 0.195);
  }
}

// The increments of the method would step over the limit point; the start does not depend on them.
TEST(HardScenes, ConstantLoadNextToTheLimitLoad) {
  // At the limit load the cosine of the bars' slope is the cube root of what it is at the start.
  const double limit_height = std::sqrt(std::pow(2.0, 1.0 / 3.0) - 1.0);
  for (const Method method : kMethods)
    for (const Accuracy accuracy : kPresets) {
      TraceRequest request = ReadData("preload_near_limit");
      request.options.method = method;
      request.options.accuracy = accuracy;
      const TracedPath path = TraceIncrements(request);
      ASSERT_FALSE(path.increments.empty()) << path.result.message;
      // On the side of the limit point from which the load was put on.
      const double y = PositionY(path, path.increments[0], "a");
      EXPECT_NEAR(von_mises::BiotLoad(1.0, 1.0, y), -path.request.scene.loads[1].fy, 1e-12);
      EXPECT_GT(y, limit_height);
    }
}

TEST(HardScenes, ConstantLoadBeyondTheLimitLoad) {
  TraceRequest request = ReadData("preload_near_limit");
  request.scene.loads[1].fy *= 1.01 / 0.999;
  for (const Method method : kMethods) {
    request.options.method = method;
    const TracedPath path = TraceIncrements(request);
    EXPECT_TRUE(path.increments.empty());
    ExpectEnd(path, EndReason::kPathEnd, "limit point at 0.990099");
  }
}

// The branch that dissipates most turns the loads back before they have their full size, and another one goes on with
// them: the path that a stage of a program takes where branch_choices wants that one.
TEST(HardScenes, ConstantLoadGoesOnWhereItCan) {
  const TracedPath path = TraceHard("preload_corner", Accuracy::kBalanced);
  ASSERT_FALSE(path.increments.empty()) << path.result.message;
  TraceRequest request = path.request;
  Stage stage;
  for (Load& load : request.scene.loads)
    if (load.constant) {
      load.constant = false;
      stage.loads.push_back(load);
    }
  request.scene.loads.clear();
  request.program = {stage};
  request.options.max_increments = 500;
  request.options.branch_rule = BranchRule::kDissipation;
  const TracedPath turning = TraceIncrements(request);
  const auto turns = [](const Increment& increment) {
    return increment.event.branches.size() > 1 && increment.event.branches[0].load_rate < 0.0;
  };
  const auto event = std::find_if(turning.increments.begin() + 1, turning.increments.end(), turns);
  ASSERT_NE(event, turning.increments.end());
  EXPECT_NEAR(event->load_factor, 1.0 / 1.02, 1e-9);
  int rising = 1;
  while (event->event.branches.at(static_cast<std::size_t>(rising)).load_rate < 0.0) ++rising;
  request.options.branch_choices = {{event->event.number, 0, rising + 1}};
  const TracedPath chosen = TraceIncrements(request);
  ASSERT_EQ(chosen.result.reason, EndReason::kStopCriterion) << chosen.result.message;
  const Increment &start = path.increments[0], &end = chosen.increments.back();
  for (std::size_t i = 0; i < end.positions.size(); ++i) EXPECT_NEAR(start.positions[i], end.positions[i], 1e-9);
  for (std::size_t i = 0; i < end.contacts.size(); ++i) {
    EXPECT_NEAR(start.contacts[i].rn, end.contacts[i].rn, 1e-9);
    EXPECT_NEAR(start.contacts[i].rt, end.contacts[i].rt, 1e-9);
    EXPECT_EQ(start.contacts[i].state, end.contacts[i].state);
  }
}

// Forces of 1e-8 of the characteristic one, which a stiff bar that carries nothing sets: regularised increments do not
// see them. The block sticks until the load is 1, then slides with r_n = 1 - 1.5 x, and the load is 1 - 0.5 x.
TEST(HardScenes, ForcesFarBelowTheCharacteristicOne) {
  TraceRequest request = ReadData("stiff_neighbour");
  request.options.method = Method::kMpec;
  request.options.max_increments = 40;
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kMaxIncrements);
  std::size_t sliding = 0;
  for (const Increment& increment : path.increments) {
    const double x = PositionX(path, increment, "p");
    EXPECT_NEAR(increment.contacts[0].rn, 1.0 - 1.5 * x, 1e-12);
    if (increment.contacts[0].state == ContactState::kStick) {
      EXPECT_NEAR(x, 0.0, 1e-12);
      EXPECT_NEAR(increment.contacts[0].rt, -increment.load_factor, 1e-12);
    } else {
      EXPECT_EQ(increment.contacts[0].state, ContactState::kSlipPlus);
      EXPECT_NEAR(increment.load_factor, 1.0 - 0.5 * x, 1e-12);
      ++sliding;
    }
  }
  EXPECT_GE(sliding, 30u);
  // The exact method is not in the way of its bar.
  const TracedPath exact = TraceHard("stiff_neighbour", Accuracy::kBalanced);
  ExpectEnd(exact, EndReason::kStopCriterion);
  ExpectNear(LimitLoads(exact), {1.0, 2.0 / 3.0}, 1e-9);
  EXPECT_NEAR(exact.increments.back().dissipation, 1.0 / 3.0, 1e-7);
}

// The load of an unloaded part that swings through its shape is a cubic of the arc length: its rate touches zero, and
// the load goes on.
TEST(HardScenes, ALoadThatIsACubicDoesNotTurn) {
  for (const Accuracy accuracy : kPresets) {
    SCOPED_TRACE(ToString(accuracy));
    const TracedPath path = TraceHard("load_is_a_cubic", accuracy, 60);
    ExpectNoFindings(path);
    const std::vector<Increment> corners = IncrementsOfKind(path, IncrementKind::kCornerLimit);
    ASSERT_FALSE(corners.empty());
    double load = corners[0].load_factor;
    for (std::size_t i = static_cast<std::size_t>(corners[0].index) + 1; load > -1e-7; ++i) {
      ASSERT_LT(i, path.increments.size());
      EXPECT_LT(path.increments[i].load_factor, load) << i;
      EXPECT_NE(path.increments[i].kind, IncrementKind::kSmoothLimit) << i;
      load = path.increments[i].load_factor;
    }
  }
}

// The load turns just after the end of an increment, at the same load for each preset.
TEST(HardScenes, ALimitPointAmongStiffPartsIsFound) {
  for (const Accuracy accuracy : kPresets) {
    SCOPED_TRACE(ToString(accuracy));
    const TracedPath path = TraceHard("limit_point_among_stiff_parts", accuracy, 60);
    ExpectNoFindings(path);
    EXPECT_NEAR(LimitLoads(path).at(0), -2.654765434e-8, 1e-17);
  }
}

TEST(HardScenes, ALimitPointWhereAStepSetsOutIsFoundOnce) {
  for (const Accuracy accuracy : kPresets) {
    SCOPED_TRACE(ToString(accuracy));
    const TracedPath path = TraceHard("limit_next_to_a_start", accuracy, 15);
    ExpectNoFindings(path);
    ExpectNear(LimitLoads(path), {9.4518259e-7}, 1e-14);
  }
}

TEST(HardScenes, ALoadThatIsLevelAtAnEventTurnsThere) {
  ForEachAccuracy(ReadHard("load_leaves_level", 60), EndReason::kMaxIncrements, kNoBound, [&](const TracedPath& path) {
    ExpectNear(LoadsOfKind(path, IncrementKind::kCornerLimit), {-0.2}, 1e-12);
    EXPECT_GT(path.increments.back().load_factor, -0.2 + 1e-6);
  });
}

// Where a frame that bears no load begins to move freely, the located point is off by rounding: what that leaves of the
// derivatives of the load is no turn of it.
TEST(HardScenes, ALoadThatEndsAtAMechanismDoesNotTurnThere) {
  TraceRequest request = ReadHard("free_motion_at_no_load");
  request.options.accuracy = Accuracy::kFast;
  const TracedPath path = TraceTo(request, EndReason::kMaxIncrements);
  ExpectNear(LoadsOfKind(path, IncrementKind::kCornerLimit), {-0.093445944556607874}, 1e-12);
  ExpectNear(LoadsOfKind(path, IncrementKind::kContactEvent), {0.0}, 1e-8);
}

// The limit points of a truss are those of the truss without the loose chain, and the path goes on beyond them.
TEST(HardScenes, ALooseChainDoesNotStopAPathAtALimitPoint) {
  TraceRequest request = ReadData("loose_chain_beside_a_limit_point");
  Scene& scene = request.scene;
  for (Node& node : scene.nodes)
    if (node.name == "e" || node.name == "f") node.fixed_x = node.fixed_y = true;
  scene.bars = {scene.bars[1], scene.bars[2], scene.bars[3]};
  const std::vector<double> without = LimitLoads(TraceIncrements(request));
  ASSERT_EQ(without.size(), 2U);
  ForEachAccuracy(ReadHard("loose_chain_beside_a_limit_point"), EndReason::kStopCriterion, kNoBound,
                  [&](const TracedPath& path) { ExpectNear(LimitLoads(path), without, 1e-12); });
}

// Two paths cross where a step begins, and the second derivatives there are rounding: they do not count for its length.
TEST(HardScenes, ArcLengthFromWherePathsCross) {
  const TracedPath slack = TraceHard("bar_goes_slack_in_a_guide", Accuracy::kBalanced);
  ExpectNoFindings(slack);
  EXPECT_EQ(FirstThat(slack, [](const Increment& increment) { return increment.event.number == 2; }).event.taken, 2);
  // Once the tie is taut all moves along one line.
  const TracedPath path = TraceHard("slack_tie", Accuracy::kFast);
  const Increment& crossing = FirstThat(path, [](const Increment& increment) { return increment.event.number == 2; });
  const Increment& last = path.increments.back();
  ASSERT_GT(last.index, crossing.index + 1);
  const double slope = (last.arc_length - crossing.arc_length) / (last.load_factor - crossing.load_factor);
  for (std::size_t i = static_cast<std::size_t>(crossing.index); i < path.increments.size(); ++i) {
    const double load = path.increments[i].load_factor - crossing.load_factor;
    EXPECT_NEAR(path.increments[i].arc_length - crossing.arc_length, slope * load, 1e-9) << i;
  }
}

// The floor takes the force over as the node slides back, and not at once; the shelf leaves it then.
TEST(HardScenes, TotalLawBetweenTwoObstacles) {
  ForEachAccuracy(ReadHard("total_law_between_two"), EndReason::kStopCriterion, kNoBound, [&](const TracedPath& path) {
    const std::vector<double> loads = LimitLoads(path);
    ASSERT_EQ(loads.size(), 2U);
    EXPECT_GT(loads[0], loads[1]);
    const ContactRecord &floor = path.increments.back().contacts[0], &shelf = path.increments.back().contacts[1];
    EXPECT_EQ(shelf.state, ContactState::kOpen);
    EXPECT_EQ(floor.state, ContactState::kSlipPlus);
    EXPECT_GT(floor.rn, 0.0);
    EXPECT_NEAR(floor.rt, -1.2 * floor.rn, 1e-12);
    for (std::size_t i = 1; i < path.increments.size(); ++i) {
      const Increment &before = path.increments[i - 1], &now = path.increments[i];
      const double change = now.arc_length == before.arc_length ? now.contacts[0].rn - before.contacts[0].rn : 0.0;
      EXPECT_NEAR(change, 0.0, 1e-12) << i;
    }
  });
}

// The path is once round where it comes to the limit point at which it had left for another branch.
TEST(HardScenes, APathThatClosesAtALimitPoint) {
  const TracedPath path = TraceTo(ReadData("closed_at_a_limit_point"), EndReason::kClosedPath);
  ASSERT_GT(path.increments.size(), 4U);
  const Increment &first = path.increments[3], &last = path.increments.back();
  EXPECT_EQ(first.event.taken, 2);
  EXPECT_EQ(last.kind, IncrementKind::kSmoothLimit);
  EXPECT_NEAR(last.load_factor, first.load_factor, 1e-12);
}

// No friction acts across an open gap, however rough the wall.
TEST(HardScenes, AnOpenContactHasNoFriction) {
  const TracedPath path = TraceTo(ReadData("rough_wall_apart"), EndReason::kMaxIncrements);
  ASSERT_EQ(path.increments.size(), 3U);
  for (const Increment& increment : path.increments)
    for (const ContactRecord& contact : increment.contacts) {
      EXPECT_GT(contact.gap, 1e-3);
      EXPECT_NEAR(std::hypot(contact.rn, contact.rt), 0.0, 1e-12);
    }
}

// The wall stands where a step ends: rounding decides whether that step or one without a length meets it. The node
// rests by the wall, which rounding alone could tell from open, and goes back by the floor: no reaction jumps.
TEST(HardScenes, StepThatEndsAtAWall) {
  const TracedPath path = TraceHard("step_ends_at_a_wall", Accuracy::kBalanced);
  ExpectNoFindings(path);
  const Increment& meets = FirstThat(path, [](const Increment& at) { return at.kind == IncrementKind::kContactEvent; });
  ASSERT_LT(meets.index, 23);
  const Increment& sticks = path.increments[static_cast<std::size_t>(meets.index) + 1];
  EXPECT_NEAR(meets.load_factor, 0.81000865245232312, 1e-13);
  ASSERT_EQ(meets.event.branches.size(), 2U);
  EXPECT_EQ(meets.event.branches[0].states, (std::vector<ContactState>{ContactState::kStick, ContactState::kOpen}));
  EXPECT_EQ(meets.event.branches[1].states,
            (std::vector<ContactState>{ContactState::kSlipPlus, ContactState::kClosed}));
  EXPECT_NEAR(sticks.contacts[0].rn, meets.contacts[0].rn, 0.06);
  EXPECT_NEAR(sticks.contacts[0].rt, meets.contacts[0].rt, 0.06);
  EXPECT_EQ(sticks.contacts[1].rn, 0.0);
}

// Increments that are hard to prove are proved, or the path ends by name before them. Where no end is given, rounding
// decides how far it comes: what it has is proved.
TEST(HardScenes, IncrementsThatAreHardToProve) {
  struct Case {
    const char* name;
    std::optional<EndReason> end;
    std::size_t increments;  // at least
  };
  const Case cases[] = {{"slip_turns_in_rounding", EndReason::kStopCriterion, 4},
                        {"presses_in_between", EndReason::kMaxIncrements, 12},
                        {"slack_bars_in_line", EndReason::kMaxIncrements, 11},
                        {"friction_left_open", EndReason::kMaxIncrements, 3},
                        {"far_from_its_curve", EndReason::kMaxIncrements, 2},
                        {"begins_with_other_reactions", EndReason::kMaxIncrements, 8},
                        {"taut_after_slack", std::nullopt, 4},
                        {"loads_go_forth_and_back", EndReason::kMaxIncrements, 13},
                        {"presses_from_the_start", EndReason::kMaxIncrements, 16},
                        {"friction_gives_back", EndReason::kMaxIncrements, 11},
                        {"preload_that_nearly_cancels", EndReason::kStopCriterion, 13},
                        {"preload_that_leaves_a_pull", EndReason::kStopCriterion, 13},
                        {"slip_turns_where_a_chain_gets_taut", std::nullopt, 2},
                        {"guide_that_moves", EndReason::kStopCriterion, 5},
                        {"moves_off_at_rounding", std::nullopt, 5},
                        {"stiff_support_moves", std::nullopt, 10},
                        {"winds_from_the_start", std::nullopt, 1},
                        {"rounding_beside_the_curve", std::nullopt, 8}};
  for (const Case& of : cases) {
    SCOPED_TRACE(of.name);
    const TracedPath path = TraceVerified(ReadData(of.name));
    if (of.end) {
      EXPECT_EQ(path.result.reason, *of.end) << path.result.message;
    }
    EXPECT_GE(path.increments.size(), of.increments);
  }
}

// The interpolation of a coarse step shows a zero of a gap that the curve does not have: no event, by no accuracy.
TEST(HardScenes, AGapThatIsZeroOnACoarseStepOnlyIsNoEvent) {
  ForEachAccuracy(ReadHard("gap_of_a_coarse_step"), EndReason::kStopCriterion, kNoBound, [&](const TracedPath& path) {
    ExpectNear(LoadsOfKind(path, IncrementKind::kContactEvent), {0.2491609551}, 1e-9);
  });
}

TEST(HardScenes, ALoadThatHasLeftItsTargetForGoodEndsThePath) {
  TraceRequest request = ReadData("load_leaves_its_target");
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced}) {
    request.options.accuracy = accuracy;
    const TracedPath path = TraceTo(request, EndReason::kPathEnd);
    EXPECT_EQ(path.result.message.rfind("every contact is open, and the load factor has gone beyond minus", 0), 0U)
        << path.result.message;
    EXPECT_LT(path.increments.back().load_factor, -1.0);
    EXPECT_GT(path.increments.back().load_factor, -1.2);
    EXPECT_EQ(EndContradicted(request, path.increments, "path_end"), "");
  }
  // Who waits for something else may go on.
  request.options.accuracy = Accuracy::kFast;
  request.options.stop = {{"c.x", ">", 10.0}};
  request.options.max_increments = 800;
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kMaxIncrements);
  EXPECT_LT(path.increments.back().load_factor, -2.0);
}

TEST(HardScenes, ABeamThatHasComeFreeEndsThePath) {
  ForEachAccuracy(ReadHard("drifts_off"), EndReason::kPathEnd, kNoBound, [&](const TracedPath& path) {
    EXPECT_EQ(path.result.message.rfind("every contact is open, and the structure as a whole drifts away", 0), 0U)
        << path.result.message;
    ExpectEnd(path, EndReason::kPathEnd, "move freely");
    const Increment& last = path.increments.back();
    EXPECT_NEAR(last.load_factor, 0.0, 1e-12);
    EXPECT_LT(std::abs(PositionY(path, last, "mid")), 1.0);
    EXPECT_EQ(EndContradicted(path.request, path.increments, "path_end"), "");
  });
}

// A contact whose friction coefficient is 1e6 has lost its normal reaction to rounding before its friction force: it
// slides until the force is zero, and no force vanishes at once.
TEST(HardScenes, AVeryRoughContactSlidesBeforeItOpens) {
  std::vector<double> dissipation;
  ForEachAccuracy(
      ReadHard("very_rough_contact_opens", 100), EndReason::kStopCriterion, kNoBound, [&](const TracedPath& path) {
        int opened = 0;
        for (std::size_t i = 1; i < path.increments.size(); ++i)
          for (std::size_t k = 0; k < 2; ++k) {
            const ContactRecord &before = path.increments[i - 1].contacts[k], &now = path.increments[i].contacts[k];
            if (path.increments[i - 1].kind == IncrementKind::kStart || now.state != ContactState::kOpen ||
                before.state == ContactState::kOpen)
              continue;
            ++opened;
            EXPECT_EQ(before.state, ContactState::kSlipMinus);
            EXPECT_LE(std::hypot(before.rn, before.rt), 1e-13);
          }
        EXPECT_EQ(opened, 1);
        dissipation.push_back(path.increments.back().dissipation);
      });
  for (const double dissipated : dissipation) EXPECT_NEAR(dissipated, dissipation[0], 1e-8 * dissipation[0]);
}

// A step of the length that was asked for would be off by 4 % of the energy that it exchanges.
TEST(HardScenes, StepsAreShortEnoughForTheEnergies) {
  TraceRequest request = ReadHard("soft_part");
  request.options.accuracy = Accuracy::kFast;
  const TracedPath path = TraceTo(request, EndReason::kMaxIncrements);
  double exchanged = 0.0;
  int rejected = 0;
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    const Increment &from = path.increments[i - 1], &to = path.increments[i];
    const double work = to.external_work - from.external_work, stored = to.strain_energy - from.strain_energy;
    const double dissipated = to.dissipation - from.dissipation;
    EXPECT_LE(std::abs(work - stored - dissipated), 2e-3 * (std::abs(work) + std::abs(stored) + dissipated)) << i;
    exchanged += std::abs(work);
    rejected += to.solve.rejected;
  }
  EXPECT_GT(exchanged, 1e5);
  EXPECT_GT(rejected, 0);
}

}  // namespace
}  // namespace contact_path::hard_scenes_test
