// Other branches than the best one: branch_choices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "branch/example_scenes.h"
#include "contact_path/verify/verify_path.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::branch_choices_test {
namespace {

constexpr double kExact = 2e-13;  // of loads, reactions and positions
constexpr double kDissipation = 1e-9;

// From any increment the bar may stick instead: then b rests, the load falls, r_n stays and r_t goes from -mu r_n to
// +mu r_n; from there b slips back, at s = -q (x + h mu), q = r_n / h.
TEST(BranchChoices, SlidingBarUnloaded) {
  namespace bar = sliding_bar;
  for (const int increment : {5, 15, 24, 40, 55, 65, 72}) {
    SCOPED_TRACE("from increment " + std::to_string(increment));
    TraceRequest request = ReadExample("sliding_bar");
    request.options.branch_choices = {{0, increment, 2}};
    request.options.stop = {{"b.x", "<", -4.9}, {"b.x", ">", 4.95}};
    request.options.max_increments = 3000;
    const TracedPath path = TraceIncrements(request);
    ExpectSoundIncrements(path, 1e-13);
    EXPECT_LE(EnergyImbalance(path), 1e-10);
    ASSERT_GT(path.increments.size(), static_cast<std::size_t>(increment) + 1);
    const Increment& turn = path.increments[static_cast<std::size_t>(increment)];
    const double x0 = PositionX(path, turn, "b"), rn = bar::NormalReaction(x0), q = rn / bar::kHeight;
    EXPECT_NEAR(turn.load_factor, bar::LoadFactor(x0), kExact);
    ASSERT_EQ(turn.event.branches.size(), 2U);
    EXPECT_EQ(turn.event.taken, 2);
    EXPECT_EQ(turn.event.branches[0].states[0], ContactState::kSlipPlus);
    EXPECT_NEAR(turn.event.branches[0].turn, 0.0, 1e-7);
    EXPECT_EQ(turn.event.branches[1].states[0], ContactState::kStick);
    EXPECT_NEAR(turn.event.branches[1].load_rate, -1.0, 1e-14);
    // The load rose before, or it was on the way down already.
    EXPECT_EQ(turn.kind, bar::LoadFactorSlope(x0) > 0.0 ? IncrementKind::kCornerLimit : IncrementKind::kContactEvent);

    const double reversal = -q * (x0 + bar::kHeight * bar::kFriction);
    double worst = 0.0, dissipated = 0.0;
    bool reversed = false;
    for (std::size_t i = static_cast<std::size_t>(increment) + 1; i < path.increments.size(); ++i) {
      const Increment& now = path.increments[i];
      const double x = PositionX(path, now, "b");
      const ContactRecord& contact = now.contacts[0];
      if (contact.state == ContactState::kStick) {
        EXPECT_FALSE(reversed);
        worst = std::max(
            {worst, std::abs(x - x0), std::abs(contact.rn - rn), std::abs(contact.rt + now.load_factor + q * x0)});
        dissipated = std::max(dissipated, std::abs(now.dissipation - bar::Dissipation(x0)));
        EXPECT_GE(now.load_factor, reversal - 1e-13);
      } else {
        ASSERT_EQ(contact.state, ContactState::kSlipMinus);
        if (!reversed) {
          EXPECT_NE(path.increments[i - 1].kind, IncrementKind::kRegular);
          EXPECT_NEAR(path.increments[i - 1].load_factor, reversal, 1e-13);
        }
        reversed = true;
        const double here = bar::NormalReaction(x);
        worst = std::max({worst, std::abs(now.load_factor + here / bar::kHeight * (x + bar::kHeight * bar::kFriction)),
                          std::abs(contact.rt - bar::kFriction * contact.rn), std::abs(contact.rn - here)});
        dissipated =
            std::max(dissipated, std::abs(now.dissipation - (2.0 * bar::Dissipation(x0) - bar::Dissipation(x))));
      }
    }
    EXPECT_TRUE(reversed);
    EXPECT_LE(worst, kExact);
    EXPECT_LE(dissipated, kDissipation);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
    EXPECT_LE(PositionX(path, path.increments.back(), "b"), -4.9);
  }
}

// Load up, down, up: a loop of which every cycle dissipates mu N times the slid distance, which is its area.
TEST(BranchChoices, HysteresisLoop) {
  constexpr double kSpring = 2.0, kLimit = 0.5;  // stiffness, mu N
  TraceRequest request;
  request.scene = SpringAndBlock();
  request.options.max_increments = 900;
  for (const int increment : {60, 200, 340, 480, 620, 760}) request.options.branch_choices.push_back({0, increment, 2});
  const TracedPath path = TraceIncrements(request);
  ExpectSoundIncrements(path, 1e-14);
  EXPECT_LE(EnergyImbalance(path), 1e-13);
  std::vector<const Increment*> turns;
  double slid = 0.0, worst = 0.0, area = 0.0;
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    const Increment &before = path.increments[i - 1], &now = path.increments[i];
    const double u = now.positions[0], du = u - before.positions[0];
    slid += std::abs(du);
    area += 0.5 * (before.load_factor + now.load_factor) * du;
    worst = std::max({worst, std::abs(now.dissipation - kLimit * slid), std::abs(now.external_work - area)});
    const ContactState state = now.contacts[0].state;
    if (state == ContactState::kSlipPlus) worst = std::max(worst, std::abs(now.load_factor - (kSpring * u + kLimit)));
    if (state == ContactState::kSlipMinus) worst = std::max(worst, std::abs(now.load_factor - (kSpring * u - kLimit)));
    if (state == ContactState::kStick) {
      EXPECT_EQ(du, 0.0);
      worst = std::max(worst, std::abs(now.contacts[0].rt - (kSpring * u - now.load_factor)));
    }
    if (now.kind == IncrementKind::kCornerLimit) turns.push_back(&now);
  }
  EXPECT_LE(worst, 1e-13);
  ASSERT_EQ(turns.size(), 6U);
  // From turn to turn: the load changes by 2 mu N before the block slips.
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double distance = std::abs(turns[i + 1]->positions[0] - turns[i]->positions[0]);
    EXPECT_NEAR(turns[i + 1]->dissipation - turns[i]->dissipation, kLimit * distance, 1e-13);
    EXPECT_NEAR(std::abs(turns[i + 1]->load_factor - turns[i]->load_factor), kSpring * distance + 2.0 * kLimit, 1e-13);
  }
}

// The foot of the rough truss slides and sticks again: it unloads, elastically, from where it is.
TEST(BranchChoices, ByIncrementAndByEvent) {
  const TracedPath plain = TraceIncrements(ReadExample("rough_truss"));
  const Increment corner = IncrementsOfKind(plain, IncrementKind::kCornerLimit).at(0);
  TraceRequest request = ReadExample("rough_truss");
  request.options.branch_choices = {{0, corner.index + 4, 2}};
  const TracedPath back = TraceIncrements(request);
  ExpectSoundIncrements(back, 1e-13);
  const Increment& turn = back.increments[static_cast<std::size_t>(corner.index) + 4];
  EXPECT_EQ(turn.event.taken, 2);
  EXPECT_EQ(turn.event.branches[1].states[0], ContactState::kStick);
  EXPECT_EQ(turn.kind, IncrementKind::kContactEvent);  // the load falls before and after
  const double foot = PositionX(back, turn, "foot"), middle = 0.5 * (foot - 1.0), half = 0.5 * (foot + 1.0);
  const double rest = std::hypot(1.0, rough_truss::kRise);
  double worst = 0.0;
  for (std::size_t i = static_cast<std::size_t>(turn.index) + 1; i < back.increments.size(); ++i) {
    const Increment& increment = back.increments[i];
    if (increment.contacts[0].state == ContactState::kOpen) break;
    EXPECT_EQ(increment.contacts[0].state, ContactState::kStick);
    const double y = PositionY(back, increment, "apex");
    worst = std::max({worst, std::abs(increment.load_factor - 2.0 * y * (1.0 / std::hypot(half, y) - 1.0 / rest)),
                      std::abs(PositionX(back, increment, "apex") - middle),
                      std::abs(PositionX(back, increment, "foot") - foot)});
    EXPECT_EQ(increment.dissipation, turn.dissipation);
  }
  EXPECT_LE(worst, kExact);

  // The best branch, asked for at the first event: the same path as without asking.
  request.options.branch_choices = {{1, 0, 1}};
  const TracedPath best = TraceIncrements(request);
  ASSERT_EQ(best.increments.size(), plain.increments.size());
  EXPECT_EQ(best.increments.back().positions, plain.increments.back().positions);
  // A branch that is not there ends the path, and says so.
  request.options.branch_choices = {{1, 0, 7}};
  const TracedPath none = TraceIncrements(request);
  EXPECT_EQ(none.result.reason, EndReason::kNoSuchBranch);
  EXPECT_NE(none.result.message.find("branch 7 at event 1"), std::string::npos) << none.result.message;
  EXPECT_EQ(none.increments.size(), static_cast<std::size_t>(corner.index) + 1);
  // A choice that the path never comes to is mentioned.
  request.options.branch_choices = {{9, 0, 2}, {0, 5000, 1}};
  const TracedPath unused = TraceIncrements(request);
  EXPECT_EQ(unused.increments.size(), plain.increments.size());
  EXPECT_NE(unused.result.message.find("never came to event 9, increment 5000"), std::string::npos)
      << unused.result.message;
}

// A choice that names an increment and takes the path itself leaves the path as it is, with its branches on record.
TEST(BranchChoices, ThePathItselfIsNoEvent) {
  for (const char* scene : {"sliding_bar", "von_mises"}) {
    SCOPED_TRACE(scene);
    const TracedPath plain = TraceIncrements(ReadExample(scene));
    const int limit = IncrementsOfKind(plain, IncrementKind::kSmoothLimit).at(0).index;
    for (const int increment : {5, limit}) {
      SCOPED_TRACE("increment " + std::to_string(increment));
      TraceRequest request = ReadExample(scene);
      request.options.branch_choices = {{0, increment, 1}};
      const TracedPath path = TraceIncrements(request);
      ASSERT_EQ(path.increments.size(), plain.increments.size());
      for (std::size_t i = 0; i < path.increments.size(); ++i) {
        EXPECT_EQ(path.increments[i].kind, plain.increments[i].kind) << i;
        EXPECT_EQ(path.increments[i].event.number, plain.increments[i].event.number) << i;
        EXPECT_NEAR(path.increments[i].load_factor, plain.increments[i].load_factor, kExact) << i;
      }
      EXPECT_EQ(path.increments[static_cast<std::size_t>(increment)].event.taken, 1);
      EXPECT_TRUE(VerifyPath(request, path.increments).findings.empty());
    }
  }
}

// All branches but the branch of arrival are on record: where sticking ends, sticking on is the branch of arrival.
TEST(BranchChoices, BranchesOnRecord) {
  const TracedPath path = TraceIncrements(ReadExample("two_dof_friction"));
  for (const Increment& increment : path.increments) {
    const bool event = increment.kind != IncrementKind::kRegular && increment.kind != IncrementKind::kSample;
    EXPECT_EQ(increment.event.branches.empty(), !event) << increment.index;
    EXPECT_EQ(increment.event.taken, event ? 1 : 0);
    EXPECT_TRUE(increment.event.complete);
    EXPECT_EQ(increment.event.complete_by.empty(), !event);
    EXPECT_EQ(increment.event.weakly_active, increment.kind == IncrementKind::kCornerLimit ? 1 : 0);
  }
  const std::vector<Increment> corners = IncrementsOfKind(path, IncrementKind::kCornerLimit);
  ASSERT_EQ(corners.size(), 2U);
  ASSERT_EQ(corners[0].event.branches.size(), 1U);
  EXPECT_EQ(corners[0].event.branches[0].states[0], ContactState::kSlipPlus);
  EXPECT_LT(corners[0].event.branches[0].load_rate, 0.0);
  EXPECT_GT(corners[0].event.branches[0].dissipation_rate, 0.0);
  EXPECT_EQ(corners[1].event.branches[0].states[0], ContactState::kOpen);
}

}  // namespace
}  // namespace contact_path::branch_choices_test
