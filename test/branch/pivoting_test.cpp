#include "contact_path/branch/pivoting.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "contact_path/path/model.h"

namespace contact_path {
namespace {

using States = std::vector<ContactState>;

constexpr ContactState kOpen = ContactState::kOpen, kStick = ContactState::kStick;

class Pivoting : public testing::Test {
 protected:
  // Two rough contacts of one node.
  static Scene MakeScene() {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0, false, false}};
    scene.superelements = {{{"p"}, {2.0, 0.0, 0.0, 2.0}}};
    scene.loads = {{"p", 1.0, 0.0, false}};
    scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5},
                       {"wall", ObstacleShape::kHalfPlane, 0.0, 0.0, 1.0, 0.0, 0.0}};
    scene.contacts = {{"p", "floor"}, {"p", "wall"}};
    return scene;
  }

  const Model model_{MakeScene(), Scaling()};
};

TEST_F(Pivoting, StatesThatBreakNothingStay) {
  const auto none = [](const States&) { return std::vector<Constraint>{}; };
  EXPECT_EQ(Pivot(model_.contacts, {kStick, kOpen}, none), (States{kStick, kOpen}));
}

TEST_F(Pivoting, EachInequalityHasItsNextState) {
  const std::vector<std::pair<Inequality, ContactState>> expected = {{Inequality::kGap, kStick},
                                                                     {Inequality::kNormalReaction, kOpen},
                                                                     {Inequality::kConePlus, ContactState::kSlipPlus},
                                                                     {Inequality::kConeMinus, ContactState::kSlipMinus},
                                                                     {Inequality::kSlip, kStick}};
  for (const auto& [inequality, state] : expected) {
    int calls = 0;
    const auto once = [&, broken = inequality](const States&) {
      return ++calls == 1 ? std::vector<Constraint>{{0, broken}} : std::vector<Constraint>{};
    };
    EXPECT_EQ(Pivot(model_.contacts, {kOpen, kOpen}, once), (States{state, kOpen}));
  }
  int calls = 0;
  const auto wall = [&](const States&) {
    return ++calls == 1 ? std::vector<Constraint>{{1, Inequality::kGap}} : std::vector<Constraint>{};
  };
  EXPECT_EQ(Pivot(model_.contacts, {kOpen, kOpen}, wall),
            (States{kOpen, ContactState::kClosed}));  // it has no friction
}

// Both contacts are broken while they have the same state: changed together they come back to it for ever.
TEST_F(Pivoting, OneByOneWhereAllAtOnceGoesRoundInCircles) {
  const auto alike = [](const States& states) {
    std::vector<Constraint> broken;
    if ((states[0] == kOpen) == (states[1] == kOpen))
      for (const int i : {0, 1})
        broken.push_back(
            {i, states[static_cast<std::size_t>(i)] == kOpen ? Inequality::kGap : Inequality::kNormalReaction});
    return broken;
  };
  const std::optional<States> states = Pivot(model_.contacts, {kOpen, kOpen}, alike);
  ASSERT_TRUE(states);
  EXPECT_TRUE(alike(*states).empty());
}

TEST_F(Pivoting, GivesUp) {
  const auto always = [](const States& states) {
    return std::vector<Constraint>{{0, states[0] == kOpen ? Inequality::kGap : Inequality::kNormalReaction}};
  };
  EXPECT_FALSE(Pivot(model_.contacts, {kOpen, kOpen}, always));
  const auto nothing = [](const States&) { return std::optional<std::vector<Constraint>>(); };
  EXPECT_FALSE(Pivot(model_.contacts, {kOpen, kOpen}, nothing));
}

}  // namespace
}  // namespace contact_path
