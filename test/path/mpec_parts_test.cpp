// Bodies, pins, friction that changes and eyes by Algorithm 3.2: against closed forms, and against method branch at
// equal values of one unknown.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/scaling.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::mpec_parts_test {
namespace {

constexpr double kGives = 1e-7;   // contacts of bodies give way by 1e-8 of their forces, scaled
constexpr double kCorner = 5e-4;  // what may be cut off at a corner, scaled
constexpr double kTinyForce = 1e-6;

TracedPath TraceByMpec(TraceRequest request) {
  request.options.method = Method::kMpec;
  request.options.at_limit = AtLimit::kFollow;
  TracedPath path = TraceVerified(request);
  EXPECT_FALSE(path.increments.empty()) << path.result.message;
  for (const Increment& increment : path.increments) EXPECT_LE(increment.residuals.Largest(), 1e-9);
  return path;
}

// Each increment is the point of the exact path with the same value of a quantity. cut: how far they may be apart
// behind a corner, scaled.
void ExpectPathOfBranch(const TracedPath& path, const std::string& quantity,
                        const std::function<double(const Increment&)>& value, double cut = kGives) {
  TraceRequest request = path.request;
  request.options.method = Method::kBranch;
  request.options.branch_rule = BranchRule::kForward;
  request.options.stop.clear();
  Samples samples;
  samples.quantity = quantity;
  for (std::size_t i = 1; i < path.increments.size(); ++i) samples.values.push_back(value(path.increments[i]));
  request.options.at = {samples};
  request.options.max_increments = 600;
  const TracedPath exact = TraceIncrements(request);
  const Scaling scaling = CharacteristicScales(Expand(request).request.scene);
  std::size_t compared = 0;
  double last = 0.0;  // value of the increment before
  for (const Increment& increment : path.increments) {
    const double at = value(increment);
    const auto found = std::find_if(exact.increments.begin(), exact.increments.end(), [&](const Increment& of) {
      return of.index > 0 && std::abs(value(of) - at) <= 1e-12 * (1.0 + std::abs(at));
    });
    if (increment.index == 0 || found == exact.increments.end()) continue;
    ++compared;
    for (std::size_t i = 0; i < increment.positions.size(); ++i)
      EXPECT_NEAR(increment.positions[i] / scaling.length, found->positions[i] / scaling.length, cut)
          << increment.index;
    for (std::size_t i = 0; i < increment.rotations.size(); ++i)
      EXPECT_NEAR(increment.rotations[i], found->rotations[i], cut) << increment.index;
    EXPECT_NEAR(increment.load_factor / scaling.load_factor, found->load_factor / scaling.load_factor, cut)
        << increment.index;
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      const ContactRecord &of = increment.contacts[i], &other = found->contacts[i];
      EXPECT_NEAR(of.rn / scaling.force, other.rn / scaling.force, 10.0 * cut) << increment.index << " contact " << i;
      EXPECT_NEAR(of.rt / scaling.force, other.rt / scaling.force, 10.0 * cut) << increment.index << " contact " << i;
      // The state is that of the way there, which may have had an event. At the edge of its cone a contact may slide by
      // what it gives way by, and be said to stick.
      if (found->kind == IncrementKind::kSample && at != last && other.rn > kTinyForce * scaling.force) {
        EXPECT_TRUE(of.state == other.state || Slips(of.state) != Slips(other.state))
            << increment.index << " contact " << i;
      }
    }
    last = at;
  }
  EXPECT_GE(compared + 4, path.increments.size());
}

double LoadOf(const Increment& increment) { return increment.load_factor; }

// A disc of the weight W in a right angle sticks up to M = mu sqrt(2) / (1 + mu^2) W R, and turns in place from there.
TEST(MpecBodies, ADiscTurnsInARightAngle) {
  for (const double radius : {1e-3, 200.0})
    for (const auto& [friction, weight] : {std::pair(0.1, 1e-6), {0.8, 1e6}}) {
      SCOPED_TRACE(testing::Message() << radius << ' ' << friction << ' ' << weight);
      const double limit = friction * std::sqrt(2.0) / (1.0 + friction * friction);
      TraceRequest request;
      request.scene = DiscInARightAngle(radius, friction, weight);
      request.options.stop = {{"disc.rotation", ">", 0.3}};
      request.options.step = 0.2;
      const TracedPath path = TraceByMpec(request);
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
      EXPECT_NEAR(LargestLoadFactor(path), limit, kGives);
      int turned = 0;
      for (const Increment& increment : path.increments) {
        if (!(increment.rotations.back() > 0.01)) continue;
        EXPECT_NEAR(increment.load_factor, limit, kGives);
        for (const ContactRecord& contact : increment.contacts) EXPECT_TRUE(Slips(contact.state));
        ++turned;
      }
      EXPECT_GE(turned, 2);
    }
}

// A box of the weight 1 slides at mu where that is below b / (2 z), and tips at b / (2 z) otherwise.
TEST(MpecBodies, ABoxSlidesOrTips) {
  for (const double size : {1e-3, 1e3})
    for (const auto& [friction, width] : {std::pair(0.2, 1.0), {0.8, 1.0}}) {
      SCOPED_TRACE(testing::Message() << "size " << size << ", mu " << friction << ", width " << width);
      TraceRequest request;
      request.scene = BoxOnFloor(width * size, size, friction);
      request.scene.loads = {LoadOnBody("box", 0.0, -1.0, true), LoadOnBody("box", 1.0, 0.0)};
      request.options.max_increments = 12;
      request.options.step = 0.2;
      EXPECT_NEAR(LargestLoadFactor(TraceByMpec(request)), std::min(friction, 0.5 * width), kCorner);
    }
}

// As far as the corner, which is cut, at the largest load.
void ExpectRisingPathOfBranch(TracedPath path) {
  path.increments.resize(LargestLoad(path));
  ExpectPathOfBranch(path, "load_factor", LoadOf);
}

TEST(MpecBodies, AHeldDiscAndALadderHaveThePathsOfBranch) {
  for (const auto& [scene, limit, length, force] :
       {std::tuple("held_disc", 0.4, 1e-3, 1e6), {"ladder", 0.8152173913, 1e3, 1e-6}}) {
    SCOPED_TRACE(testing::Message() << scene << ", unit of length " << length);
    TraceRequest request = ReadExample(scene);
    request.options.step = 0.05;
    request.options.max_increments = 40;
    const TracedPath path = TraceByMpec(ChangeUnits(request, length, force));
    EXPECT_NEAR(LargestLoadFactor(path), limit, kCorner * 2.0);
    ExpectRisingPathOfBranch(path);
  }
}

TEST(MpecBodies, ThreeDiscsRollApart) {
  TraceRequest request = ReadExample("three_discs");
  request.options.step = 0.5;
  request.options.max_increments = 40;
  const TracedPath path = TraceByMpec(request);
  EXPECT_NEAR(LargestLoadFactor(path), 0.4 / (std::tan(M_PI / 12.0) - 0.2) - 1.0, 3e-2);
  ExpectRisingPathOfBranch(path);
}

// Rods that are pinned to each other and to both ends, with springs at the pins between, carry a load in the middle.
TraceRequest PinnedChain(double size, double spring) {
  Scene scene;
  scene.name = "pinned_chain";
  constexpr int kRods = 3;
  for (int i = 0; i <= kRods; ++i) {
    const double x = size * i, y = i == 0 || i == kRods ? 0.0 : -0.2 * size;
    if (i > 0) scene.nodes.push_back(NodeOf("rod" + std::to_string(i), "e" + std::to_string(i), x, y));
    if (i < kRods) scene.nodes.push_back(NodeOf("rod" + std::to_string(i + 1), "s" + std::to_string(i), x, y));
  }
  scene.nodes.push_back({"left", 0.0, 0.0, true, true});
  scene.nodes.push_back({"right", kRods * size, 0.0, false, true});
  for (int i = 0; i < kRods; ++i)
    scene.bodies.push_back({"rod" + std::to_string(i + 1), size * (i + 0.5), i == 1 ? -0.2 * size : -0.1 * size});
  scene.pins = {{{"s0", "left"}}, {{"e1", "s1"}, spring}, {{"e2", "s2"}, spring}, {{"e3", "right"}}};
  const double holds = 3.0 * spring / (size * size);
  scene.superelements = {{{"right"}, {holds, 0.0, 0.0, holds}}};
  scene.loads = {LoadOnBody("rod1", 0.0, -spring / size), LoadOnBody("rod3", 0.0, -0.7 * spring / size)};
  return RequestWithin(30, scene);
}

TEST(MpecPins, AChainOnSpringsHasThePathOfBranch) {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const double spring : {1e-3, 1.0, 1e3}) {
      SCOPED_TRACE(testing::Message() << "size " << size << ", spring " << spring);
      const TracedPath path = TraceByMpec(PinnedChain(size, spring));
      EXPECT_EQ(path.increments.size(), 31U) << path.result.message;
      ExpectPathOfBranch(path, "load_factor", LoadOf, 1e-9);
    }
}

// Of a toggle clamp, pushed over its dead centre: the push is that of virtual work until its limit.
TEST(MpecPins, AToggleIsPushedToItsLimit) {
  TraceRequest request = ReadExample("toggle_clamp");
  request.program.resize(1);
  request.program[0].target = 1.2;
  const TracedPath path = TraceByMpec(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  for (const Increment& increment : path.increments) {
    const double a = std::asin(increment.positions[2]), d = std::max(0.0, 2.0 * std::cos(a) - 1.9);
    EXPECT_NEAR(increment.load_factor, (80.0 * d * std::sin(a) + 0.8 * (0.5 - a)) / std::cos(a), kGives);
  }
}

// A floor that moves by L takes a node along until k s = mu(s) N; then the node slides at the force mu(s) N.
TEST(MpecFrictionChanges, ANodeBearsWhatFrictionIs) {
  for (const auto& [length, force, load] : {std::tuple(1.0, 1.0, 1.0), {1e-3, 1e4, 1.0}, {250.0, 1e-5, 40.0}})
    for (const double rate : {0.3, -0.25}) {
      SCOPED_TRACE(testing::Message() << "length " << length << ", rate " << rate);
      constexpr double kPress = 2.0, kSpring = 3.0, kFriction = 0.4;
      const double k = kSpring * force / length;
      TraceRequest request;
      Scene& scene = request.scene;
      scene = NodeOnFloor("b", k, kFriction);
      scene.loads = {{"b", 0.0, -kPress * force, true}};
      scene.friction_changes = {{"floor", rate / load}};
      scene.obstacle_motions = {{"floor", length / load, 0.0}};
      request.options.step = 0.1;
      request.options.max_increments = 400;
      request.options.stop = {{"load_factor", ">", 3.0 * load}};
      const TracedPath path = TraceByMpec(request);
      const double grips = kFriction * kPress / (kSpring - rate * kPress);
      int slid = 0;
      for (const Increment& increment : path.increments) {
        const double s = increment.load_factor / load, mu = kFriction + rate * s;
        const double bears = s < grips ? kSpring * s : mu * kPress;
        EXPECT_NEAR(increment.contacts[0].rt / force, bears, Slips(increment.contacts[0].state) ? 1e-9 : 3.0 * kCorner);
        EXPECT_NEAR(increment.positions[0] / length, bears / kSpring, kCorner);
        slid += Slips(increment.contacts[0].state) ? 1 : 0;
      }
      EXPECT_GT(slid, 5);
      if (rate > 0.0) {
        EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
        continue;
      }
      EXPECT_EQ(path.result.reason, EndReason::kPathEnd) << path.result.message;
      EXPECT_NEAR(path.increments.back().load_factor / load, -kFriction / rate, 2e-6 * kFriction / -rate);
    }
}

// Legs that are pinned together slide apart on a floor that becomes slippery, and friction has to come back.
TEST(MpecFrictionChanges, AStepLadderSlidesApart) {
  const TracedPath path = TraceByMpec(ReadExample("step_ladder"));
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  EXPECT_NEAR(LargestLoadFactor(path), 0.8 - 0.66 / 0.76 / 3.0, 2.0 * kCorner);
  int slides = 0;
  for (const Increment& increment : path.increments) {
    if (!Slips(increment.contacts[1].state)) continue;
    ++slides;
    const double b = 0.5 * (increment.positions[4] - increment.positions[0]);
    EXPECT_NEAR(increment.load_factor, 0.8 - 0.66 / 0.76 * b / std::sqrt(2.5 - b * b), kGives) << increment.index;
  }
  EXPECT_GT(slides, 10);
}

// Drawn round an eye, the tensions differ by exp(mu turn); let go, the tendon sticks down to exp(-2 mu turn) of the
// force.
TEST(MpecEyes, TheTensionsDifferByTheCapstanFactor) {
  for (const auto& [turn, friction, EA] : {std::tuple(0.5 * M_PI, 0.3, 20.0), {3.0, 0.1, 1e3}, {0.5, 1.0, 20.0}}) {
    SCOPED_TRACE(testing::Message() << "turn " << turn << " friction " << friction << " EA " << EA);
    TraceRequest request = DrawnCord(turn, friction, EA);
    request.program.push_back(LoadingStage({{"drawn", -std::cos(turn), std::sin(turn)}}, 0.9));
    request.options.step = 0.05;
    const TracedPath path = TraceByMpec(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    const double factor = std::exp(friction * turn);
    int slides = 0, back = 0;
    for (const Increment& increment : path.increments) {
      const double before = increment.sections[0].N, behind = increment.sections[1].N;
      if (increment.contacts[0].state == ContactState::kSlipPlus) {
        EXPECT_NEAR(behind / factor, before, 2e-8);
        ++slides;
      } else if (increment.contacts[0].state == ContactState::kSlipMinus) {
        EXPECT_NEAR(behind, before / factor, 2e-8);
        EXPECT_LE(behind, 1.0 / (factor * factor) + 2.0 * kCorner);
        ++back;
      }
    }
    EXPECT_GT(slides, 2);
    EXPECT_GT(back, 0);
  }
}

}  // namespace
}  // namespace contact_path::mpec_parts_test
