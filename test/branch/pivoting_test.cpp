#include "contact_path/branch/pivoting.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

namespace contact_path::pivoting_test {
namespace {

using States = std::vector<ContactState>;

constexpr ContactState kOpen = ContactState::kOpen, kStick = ContactState::kStick;

// Of two contacts, the second one without friction.
States Touching() { return {kStick, ContactState::kClosed}; }

TEST(Pivoting, StatesThatBreakNothingStay) {
  const auto none = [](const States&) { return std::vector<Constraint>{}; };
  EXPECT_EQ(Pivot(Touching(), {kStick, kOpen}, none), (States{kStick, kOpen}));
}

TEST(Pivoting, EachInequalityHasItsNextState) {
  const std::vector<std::pair<Inequality, ContactState>> expected = {{Inequality::kGap, kStick},
                                                                     {Inequality::kNormalReaction, kOpen},
                                                                     {Inequality::kConePlus, ContactState::kSlipPlus},
                                                                     {Inequality::kConeMinus, ContactState::kSlipMinus},
                                                                     {Inequality::kSlip, kStick},
                                                                     {Inequality::kTotalSlip, kStick}};
  for (const auto& [inequality, state] : expected) {
    int calls = 0;
    const auto once = [&, broken = inequality](const States&) {
      return ++calls == 1 ? std::vector<Constraint>{{0, broken}} : std::vector<Constraint>{};
    };
    EXPECT_EQ(Pivot(Touching(), {kOpen, kOpen}, once), (States{state, kOpen}));
  }
  int calls = 0;
  const auto wall = [&](const States&) {
    return ++calls == 1 ? std::vector<Constraint>{{1, Inequality::kGap}} : std::vector<Constraint>{};
  };
  EXPECT_EQ(Pivot(Touching(), {kOpen, kOpen}, wall), (States{kOpen, ContactState::kClosed}));  // it has no friction
}

// Both contacts are broken while they have the same state: changed together they come back to it for ever.
TEST(Pivoting, OneByOneWhereAllAtOnceGoesRoundInCircles) {
  const auto alike = [](const States& states) {
    std::vector<Constraint> broken;
    if ((states[0] == kOpen) == (states[1] == kOpen))
      for (const int i : {0, 1})
        broken.push_back(
            {i, states[static_cast<std::size_t>(i)] == kOpen ? Inequality::kGap : Inequality::kNormalReaction});
    return broken;
  };
  const std::optional<States> states = Pivot(Touching(), {kOpen, kOpen}, alike);
  ASSERT_TRUE(states);
  EXPECT_TRUE(alike(*states).empty());
}

TEST(Pivoting, GivesUp) {
  const auto always = [](const States& states) {
    return std::vector<Constraint>{{0, states[0] == kOpen ? Inequality::kGap : Inequality::kNormalReaction}};
  };
  EXPECT_FALSE(Pivot(Touching(), {kOpen, kOpen}, always));
  const auto nothing = [](const States&) { return std::optional<std::vector<Constraint>>(); };
  EXPECT_FALSE(Pivot(Touching(), {kOpen, kOpen}, nothing));
}

}  // namespace
}  // namespace contact_path::pivoting_test
