// Contacts whose fixed-mode equations become singular: parts that rest at a limit point of their own, guides without
// clearance. Each is held against a closed form, or against itself for other steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/decisions.h"
#include "support/parts.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::singular_scenes_test {
namespace {

constexpr double kResidual = 1e-9;

// Load factors of the first events.
std::vector<double> EventLoads(const TracedPath& path, std::size_t most) {
  std::vector<double> loads;
  for (const Increment& increment : path.increments)
    if (increment.event.number > 0 && loads.size() < most) loads.push_back(increment.load_factor);
  return loads;
}

// Two rough walls at right angles hold a node until the force on it leaves the hull of both friction cones.
TEST(SingularScenes, WedgeHoldsANodeAsFarAsBothConesReach) {
  const double slides = 1.3 / 0.7;
  ForEachAccuracy(ReadLongData("wedge"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    for (const Increment& increment : path.increments) {
      EXPECT_EQ(increment.solve.nullity, 0) << increment.index;
      if (increment.load_factor > slides + 1e-13) continue;
      EXPECT_NEAR(PositionX(path, increment, "b"), 0.0, 1e-15);
    }
    const std::vector<double> events = EventLoads(path, 9);
    ASSERT_FALSE(events.empty());
    EXPECT_NEAR(events.back(), slides, 1e-13);
    EXPECT_EQ(path.increments.back().contacts[1].state, ContactState::kSlipPlus);
  });
}

// With the load P at c: P = (x - 1) + (x - l) / l, with the length l of the chain.
TEST(SingularScenes, SlackBarsBecomeTautUnderConstantLoads) {
  const double chain = 2.0 * std::hypot(0.5, 0.05);
  ForEachAccuracy(ReadLongData("slack_chain"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    for (const Increment& increment : path.increments) {
      const double load = 0.1 * (1.0 + increment.load_factor);
      EXPECT_NEAR(PositionX(path, increment, "c"), (load + 2.0) / (1.0 + 1.0 / chain), 1e-14);
      EXPECT_NEAR(PositionX(path, increment, "m"), 0.5 * PositionX(path, increment, "c"), 1e-14);
    }
  });
}

TEST(SingularScenes, AReactionThatBeginsWithTheThirdPower) {
  ForEachAccuracy(ReadLongData("third_power"), EndReason::kStopCriterion, kResidual,
                  [&](const TracedPath& path) { EXPECT_EQ(path.increments.back().event.number, 0); });
}

// With the apex of the truss at x its load is P(x), the dragged end is at x - 1 + P(x) / 0.3, and s = P + 0.1 while
// that end slides forth, P - 0.1 while it slides back. It turns where P' = sqrt(2) - 2 / l^3 = -0.3: nothing moves
// there until friction has turned.
TEST(SingularScenes, SnapBackWithFriction) {
  const double turn = std::sqrt(std::pow(2.0 / (std::sqrt(2.0) + 0.3), 2.0 / 3.0) - 1.0);
  const auto load = [](double x) {
    const double l = std::hypot(2.0 - x, 1.0);
    return 2.0 * (1.0 - l / std::sqrt(2.0)) * (2.0 - x) / l;
  };
  const auto end = [&](double x) { return x - 1.0 + load(x) / 0.3; };
  const double first = 2.0 - turn, second = 2.0 + turn;
  ForEachAccuracy(ReadLongData("drag_snapback"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    std::vector<ContactState> states;
    for (const Increment& increment : path.increments) {
      if (increment.index == 0) continue;
      const ContactState state = increment.contacts[0].state;
      if (states.empty() || states.back() != state) states.push_back(state);
      const double x = PositionX(path, increment, "c"), p = load(x);
      if (states.size() > 1) {
        EXPECT_NEAR(PositionX(path, increment, "b"), end(x), 1e-9);
      }
      switch (states.size()) {
        case 2: EXPECT_NEAR(increment.load_factor, p + 0.1, 1e-9); break;
        case 3: EXPECT_NEAR(x, first, 1e-9); break;
        case 4: EXPECT_NEAR(increment.load_factor, p - 0.1, 1e-9); break;
        case 5: EXPECT_NEAR(x, second, 1e-9); break;
        case 6: EXPECT_NEAR(increment.load_factor, p + 0.1, 1e-9); break;
        default: EXPECT_NEAR(PositionX(path, increment, "b"), 0.0, 1e-12);
      }
    }
    const std::vector<ContactState> wanted = {ContactState::kStick, ContactState::kSlipPlus,
                                              ContactState::kStick, ContactState::kSlipMinus,
                                              ContactState::kStick, ContactState::kSlipPlus};
    EXPECT_EQ(states, wanted);
    const std::vector<double> events = {0.1, load(first) + 0.1, load(first) - 0.1, load(second) - 0.1,
                                        load(second) + 0.1};
    ExpectNear(EventLoads(path, 9), events, 1e-10);
    const double slid =
        end(first) + (end(first) - end(second)) + (end(PositionX(path, path.increments.back(), "c")) - end(second));
    EXPECT_NEAR(path.increments.back().dissipation, 0.1 * slid, 1e-7);
  });
}

// The tie of two bars becomes straight without stress, where the end that slides would turn if the tie folded to the
// other side. It goes on with the tie taut: s = 0.1 + (force of the bar) + (force of the tie).
TEST(SingularScenes, SlackTieBecomesTaut) {
  const double tie = 2.0 * std::hypot(0.5, 0.2);
  for (const double step : {0.0, 0.003, 0.01, 0.05}) {
    TraceRequest request = ReadData("slack_tie");
    request.options.step = step;
    request.options.max_increments = 3000;
    const TracedPath path = TraceTo(request, EndReason::kStopCriterion, kResidual);
    for (const Increment& increment : path.increments) {
      const double b = PositionX(path, increment, "b");
      const double taut = std::max(0.0, (1.0 - b) / tie - 1.0);
      if (increment.contacts[0].state == ContactState::kSlipMinus) {
        EXPECT_NEAR(increment.load_factor, 0.1 - 0.5 * b + taut, 1e-9);
      }
    }
    EXPECT_LT(PositionX(path, path.increments.back(), "b"), 1.0 - tie);
    EXPECT_NEAR(path.increments.back().dissipation, -0.1 * PositionX(path, path.increments.back(), "b"), 1e-9);
  }
}

// The rest of the structure is at a limit point while n5 sticks, and the load acts on n5: friction turns at rest.
TEST(SingularScenes, LoadOnTheNodeThatStopsSliding) {
  ForEachAccuracy(ReadLongData("wrong_path_end"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    int at_rest = 0;
    for (std::size_t i = 1; i < path.increments.size(); ++i) {
      const Increment &before = path.increments[i - 1], &increment = path.increments[i];
      if (increment.contacts[0].state != ContactState::kStick) continue;
      ++at_rest;
      for (std::size_t k = 0; k < increment.positions.size(); ++k)
        EXPECT_NEAR(increment.positions[k], before.positions[k], 1e-12);
    }
    EXPECT_GE(at_rest, 2);
    ExpectNear(EventLoads(path, 5), {0.007807830041, 0.3662055768, 0.118735902, 0.03472924716, 0.0491156351}, 1e-9);
  });
}

// Both once ended where a contact stops sliding next to a smooth limit point.
TEST(SingularScenes, PartsAtRestWhileOthersMove) {
  for (const char* name : {"stall_333", "stall_354"}) {
    TraceRequest request = ReadLongData(name);
    std::vector<double> first;
    for (const Accuracy accuracy : kPresets) {
      request.options.accuracy = accuracy;
      const TracedPath path = TraceVerified(request, kResidual);
      EXPECT_TRUE(path.result.reason == EndReason::kStopCriterion || path.result.reason == EndReason::kClosedPath)
          << path.result.message;
      const std::vector<double> loads = EventLoads(path, 6);
      if (first.empty()) first = loads;
      ExpectNear(loads, first, 1e-9);
      EXPECT_EQ(loads.size(), 6U);
    }
  }
}

// b = (0, y): s = (1 - y) + (force of the bar to c along y). The smooth wall takes the rest along x.
TEST(SingularScenes, GuideWithoutClearance) {
  ForEachAccuracy(ReadLongData("slot"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    for (const Increment& increment : path.increments) {
      const double y = PositionY(path, increment, "b"), l = std::hypot(1.0, y);
      const double force = l / std::sqrt(2.0) - 1.0;
      EXPECT_NEAR(PositionX(path, increment, "b"), 0.0, 1e-14);
      EXPECT_NEAR(increment.load_factor, (1.0 - y) - force * y / l, 1e-12);
      EXPECT_NEAR(Contact(path, increment, "b@smooth").rn, increment.load_factor - force / l, 1e-12);
      EXPECT_EQ(Contact(path, increment, "b@rough").rn, 0.0);
      EXPECT_EQ(Contact(path, increment, "b@rough").rt, 0.0);
    }
  });
}

TEST(SingularScenes, GuideWithoutClearanceForAnyStep) {
  std::vector<double> first;
  for (const double step : {0.02, 0.01, 0.05}) {
    TraceRequest request = ReadData("slot_step_dependent");
    request.options.step = step;
    request.options.max_increments = 600;
    const TracedPath path = TraceTo(request, EndReason::kMaxIncrements, kResidual);
    const std::vector<double> loads = EventLoads(path, 4);
    ASSERT_EQ(loads.size(), 4U);
    if (first.empty()) first = loads;
    ExpectNear(loads, first, 1e-9);
    // One wall of the two carries.
    for (const Increment& increment : path.increments)
      EXPECT_LE(std::min(Contact(path, increment, "n1@o1").rn, Contact(path, increment, "n1@o2").rn), 1e-12);
  }
}

// The second node is 7e-11 above the floor where the first one stands, and so stands as well. The force that closes its
// gap takes the reaction out of the cone by as much.
TEST(SingularScenes, GapBelowTheToleranceUnderALoadOnTheEdgeOfTheCone) {
  ForEachAccuracy(ReadLongData("load_on_the_edge_of_the_cone"), EndReason::kStopCriterion, kResidual,
                  [&](const TracedPath& path) {
                    for (const Increment& increment : path.increments) {
                      const double pressed = std::max(increment.load_factor - 0.1, 0.0);
                      for (const char* name : {"n0@floor", "n1@floor"}) {
                        const ContactRecord& contact = Contact(path, increment, name);
                        EXPECT_NEAR(contact.rn, pressed, 1e-10);
                        EXPECT_NEAR(contact.rt, -0.3 * pressed, 1e-10);
                        EXPECT_NEAR(contact.gap, std::max(0.1 - increment.load_factor, 0.0), 1e-10);
                      }
                    }
                    EXPECT_EQ(path.increments.back().contacts[1].state, ContactState::kStick);
                  });
}

// A chain of soft bars on a rough floor, dragged at either end, that pushes a von Mises truss, equal bars or not:
// stick, slip and snap-back in any order.
TraceRequest RandomDrag(unsigned seed) {
  Decisions decide{SplitMix64(seed)};
  Scene scene;
  scene.name = "drag_" + std::to_string(seed);
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0,
                      decide.OneOf(std::vector<double>{0.05, 0.1, 0.2, 0.5, 1.0})}};
  const std::size_t links = 1 + decide.Index(3);
  const auto name = [](std::size_t i) { return "n" + std::to_string(i); };
  for (std::size_t i = 0; i <= links; ++i) {
    const bool rides = i > 0 && (i == links || decide.Chance(0.7));  // off the floor, guided
    scene.nodes.push_back({name(i), static_cast<double>(i), 0.0, false, rides});
    if (rides) continue;
    scene.contacts.push_back({name(i), "floor"});
    scene.loads.push_back({name(i), 0.0, -decide.OneOf(std::vector<double>{0.2, 0.5, 1.0}), true});
  }
  for (std::size_t i = 0; i < links; ++i)
    scene.bars.push_back({{name(i), name(i + 1)}, decide.OneOf(std::vector<double>{0.1, 0.2, 0.3, 0.5, 1.0, 2.0})});
  const double width = decide.OneOf(std::vector<double>{0.5, 1.0, 1.5}), rise = decide.Number(0.5, 1.0);
  const double end = static_cast<double>(links) + width;
  scene.nodes.push_back({"above", end, rise, true, true});
  scene.nodes.push_back({"below", end, -rise, true, true});
  scene.bars.push_back({{name(links), "above"}, 1.0});
  scene.bars.push_back({{name(links), "below"}, decide.OneOf(std::vector<double>{1.0, 0.8})});
  scene.loads.push_back(
      {decide.Chance(0.7) ? name(0) : name(links), decide.OneOf(std::vector<double>{1.0, -1.0}), 0.0});
  return RequestWithin(300, scene);
}

// They end early only where a bar has shrunk to a point, where a Biot bar has no direction.
TEST(SingularScenes, RandomDragsEndOnlyWithABarWithoutLength) {
  int rests = 0;
  for (unsigned seed = 1; seed <= Seeds(120); ++seed) {
    const TracedPath path = TraceVerified(RandomDrag(seed), kResidual);
    if (path.result.reason == EndReason::kStepTooSmall) {
      EXPECT_NE(path.result.message.find("has shrunk to"), std::string::npos) << seed << ": " << path.result.message;
    } else if (path.result.reason != EndReason::kClosedPath) {
      EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements) << seed << ": " << path.result.message;
    }
    for (std::size_t i = 2; i < path.increments.size(); ++i)
      if (path.increments[i - 1].event.number > 1 && path.increments[i].positions == path.increments[i - 1].positions)
        ++rests;
  }
  EXPECT_GE(rests, AtLeast(10));
}

}  // namespace
}  // namespace contact_path::singular_scenes_test
