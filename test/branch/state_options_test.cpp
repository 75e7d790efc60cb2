#include "contact_path/branch/state_options.h"

#include <gtest/gtest.h>

#include <vector>

#include "branch/example_scenes.h"
#include "contact_path/path/model.h"

namespace contact_path::state_options_test {
namespace {

using States = std::vector<ContactState>;

constexpr ContactState kOpen = ContactState::kOpen, kClosed = ContactState::kClosed, kStick = ContactState::kStick;
constexpr ContactState kSlipPlus = ContactState::kSlipPlus, kSlipMinus = ContactState::kSlipMinus;

// A node on a floor with this friction, at the height `gap`, with these reactions and this state.
States OptionsOf(double friction, double gap, double rn, double rt, ContactState state) {
  Scene scene = SpringAndBlock();
  scene.obstacles[0].friction = friction;
  const Model model(scene, Scaling());
  PathPoint point = model.InitialPoint();
  point.u[1] = gap;
  point.rn[0] = rn;
  point.rt[0] = rt;
  point.states = {state};
  return StatesOf(StateOptions(*model.contacts[0], point, 0, ActiveSetTolerance()));
}

TEST(StateOptions, OneWhereNothingIsActive) {
  EXPECT_EQ(OptionsOf(0.5, 0.1, 0.0, 0.0, kOpen), States{kOpen});
  EXPECT_EQ(OptionsOf(0.5, 0.0, 1.0, 0.2, kStick), States{kStick});
  EXPECT_EQ(OptionsOf(0.0, 0.0, 1.0, 0.0, kClosed), States{kClosed});
}

TEST(StateOptions, StickOrSlideOnTheEdgeOfTheCone) {
  EXPECT_EQ(OptionsOf(0.5, 0.0, 1.0, -0.5, kStick), (States{kStick, kSlipPlus}));
  EXPECT_EQ(OptionsOf(0.5, 0.0, 1.0, 0.5, kStick), (States{kStick, kSlipMinus}));
}

TEST(StateOptions, AllWithoutAReaction) {
  EXPECT_EQ(OptionsOf(0.5, 0.0, 0.0, 0.0, kStick), (States{kStick, kSlipPlus, kSlipMinus, kOpen}));
  EXPECT_EQ(OptionsOf(0.0, 0.0, 0.0, 0.0, kClosed), (States{kClosed, kOpen}));
}

TEST(StateOptions, TheStateAsItWasComesFirst) {
  EXPECT_EQ(OptionsOf(0.5, 0.0, 1.0, -0.5, kSlipPlus), (States{kSlipPlus, kStick}));
  EXPECT_EQ(OptionsOf(0.5, 0.0, 0.0, 0.0, kOpen).front(), kOpen);
}

}  // namespace
}  // namespace contact_path::state_options_test
