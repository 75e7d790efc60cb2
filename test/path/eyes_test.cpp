// Tendons that slide through eyes with friction, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/beams.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::eyes_test {
namespace {

// What keeps the strains of a slack tendon even, of the difference of the tensions.
constexpr double kSoft = 2e-8;
constexpr double kSame = 1e-7;

TraceRequest DrawnAndReleased(double turn, double friction, double EA) {
  TraceRequest request = DrawnCord(turn, friction, EA);
  request.program.push_back(UnloadingStage());
  return request;
}

// Drawn, the tensions differ by exp(mu turn); let go, the tendon sticks down to exp(-2 mu turn) of the force, and
// slides back to nothing.
TEST(Eyes, TheTensionsDifferByTheCapstanFactor) {
  for (const double turn : {0.2, 0.5 * M_PI, 3.0})
    for (const double friction : {0.1, 0.3, 1.0})
      for (const double EA : {20.0, 1e3, 1e6}) {
        SCOPED_TRACE(::testing::Message() << "turn " << turn << " friction " << friction << " EA " << EA);
        const TracedPath path = TraceTo(DrawnAndReleased(turn, friction, EA));
        const double factor = std::exp(friction * turn);
        double sticks = 0.0, leaves = 0.0;
        for (const Increment& increment : path.increments) {
          const double before = increment.sections[0].N, behind = increment.sections[1].N;
          const ContactState state = increment.contacts[0].state;
          // At the end, without tension, none need be proved.
          if (increment.contacts[0].rn > 1e-6) {
            EXPECT_EQ(increment.stability.stability, Verdict::kStable);
          }
          EXPECT_NEAR(increment.contacts[0].rn, before + behind, 1e-9);
          if (state == ContactState::kSlipPlus) {
            EXPECT_NEAR(behind / factor, before, kSoft);
            sticks = std::max(sticks, behind);
          } else if (state == ContactState::kSlipMinus) {
            EXPECT_NEAR(behind, before / factor, kSoft);
          } else if (increment.stage == 2 && increment.kind == IncrementKind::kContactEvent) {
            leaves = behind;
          }
        }
        EXPECT_NEAR(sticks, 1.0, kSoft);
        EXPECT_NEAR(leaves, 1.0 / (factor * factor), kSoft);
        EXPECT_NEAR(path.increments.back().sections[0].N, 0.0, kSoft);
      }
}

// What friction takes while a rigid cord is drawn by d: the difference of the tensions times what has slid. Here the
// end gives way by its spring k: T1 = k w, T2 = T1 exp(mu turn), and the work of friction (exp(mu turn) - 1) k w^2 / 2.
TEST(Eyes, FrictionTakesTheDifferenceOfTheTensionsTimesWhatSlides) {
  for (const double friction : {0.1, 0.5}) {
    SCOPED_TRACE(friction);
    Scene scene;
    scene.nodes = {{"end", -1.0, 0.0, false, true}, {"eye", 0.0, 0.0, true, true}, {"hand", 0.0, -1.0, true, true}};
    scene.superelements = {{{"end"}, {2.0, 0.0, 0.0, 1.0}}};
    scene.tendons = {{"", {"end", "eye", "hand"}, 1e7, 0.0, friction}};
    scene.support_motions = {{"hand", 0.0, -1.0}};
    const TracedPath path = TraceUntil({"load_factor", ">", 0.5}, scene);
    const double factor = std::exp(0.5 * M_PI * friction), slid = 0.5;
    const Increment& last = path.increments.back();
    EXPECT_NEAR(last.supports.back().ry, -2.0 * slid * factor, 2e-6);
    EXPECT_NEAR(last.dissipation, (factor - 1.0) * slid * slid, 1e-6);
    EXPECT_NEAR(last.strain_energy, slid * slid, 1e-6);
  }
}

// A tackle of n parts: the hauling part comes off the fixed block, and the load is the pull times the sum over k from 1
// to n of exp(-mu pi k) (each sheave turns the rope by pi).
TEST(Eyes, ATackleLosesAtEachSheave) {
  for (const int parts : {1, 2, 3, 4})
    for (const double friction : {0.05, 0.2}) {
      SCOPED_TRACE(::testing::Message() << parts << " parts, friction " << friction);
      Scene scene;
      scene.nodes = {{"roof", 0.0, 0.0, true, true}, {"load", 0.0, -5.0, true, false}, {"hand", 0.0, -7.0, true, true}};
      std::vector<std::string> nodes;
      for (int i = 0; i <= parts; ++i) nodes.emplace_back((parts - i) % 2 == 0 ? "roof" : "load");
      nodes.emplace_back("hand");
      scene.tendons = {{"rope", nodes, 1e3, 0.0, friction}};
      scene.loads = {{"load", 0.0, -1.0, true}};
      scene.support_motions = {{"hand", 0.0, -1.0}};
      const TracedPath path = TraceUntil({"load_factor", ">", 0.5}, scene);
      double advantage = 0.0;
      for (int k = 1; k <= parts; ++k) advantage += std::exp(-M_PI * friction * k);
      EXPECT_NEAR(-path.increments.back().supports.back().ry, 1.0 / advantage, kSoft);
      for (const ContactRecord& eye : path.increments.back().contacts) EXPECT_EQ(eye.state, ContactState::kSlipPlus);
    }
}

// A tendon goes slack as a whole, and becomes taut where it is as long as its way.
TEST(Eyes, GoesSlackAsAWhole) {
  TraceRequest request = DrawnAndReleased(0.5 * M_PI, 0.3, 100.0);
  request.scene.superelements.clear();
  request.scene.nodes[2].fixed_x = request.scene.nodes[2].fixed_y = true;
  request.scene.tendons[0].rest_length = 2.1;
  request.program = {MovingStage({{"drawn", 0.0, -0.2}}), MovingStage({{"drawn", 0.0, 0.2}})};
  const TracedPath path = TraceTo(request);
  for (const int stage : {1, 2}) {
    const Increment& changes = FirstThat(path, [&](const Increment& of) {
      return of.stage == stage && of.kind == IncrementKind::kContactEvent && of.contacts[0].rn < kSoft;
    });
    EXPECT_NEAR(changes.load_factor, 0.5, kSoft);
  }
  for (const Increment& increment : path.increments) {
    const bool taut = increment.bars[0] == BarState::kTaut;
    EXPECT_EQ(increment.bars[1] == BarState::kTaut, taut);
    EXPECT_EQ(increment.contacts[0].state != ContactState::kOpen, taut);
  }
  EXPECT_NEAR(path.increments.back().contacts[0].gap, 0.1, 1e-12);
}

// A finger of two beams and a rib, whose cord passes three eyes: units, order and mirror change nothing.
TraceRequest Finger() {
  Scene scene;
  scene.name = "finger";
  scene.nodes = {{"root", 0.0, 0.0, true, true, true},
                 {"joint", 0.0, 1.0},
                 {"tip", 0.0, 2.0},
                 {"rib", 0.3, 1.0},
                 {"nail", 0.3, 2.0},
                 {"base", 0.4, 0.0, true, true},
                 {"hand", 0.8, -0.5, true, true}};
  scene.beams = {Between("lower", "root", "joint", 1e3, 1.0, 3), Between("upper", "joint", "tip", 1e3, 1.0, 3),
                 Between("arm", "joint", "rib", 1e3, 100.0, 1), Between("end", "tip", "nail", 1e3, 100.0, 3)};
  scene.tendons = {{"cord", {"hand", "base", "rib", "nail"}, 500.0, 0.0, 0.2}};
  scene.support_motions = {{"hand", 0.1, -0.5}};
  return RequestUntil({"load_factor", ">", 0.3}, scene);
}

TEST(Eyes, OfAFingerAreTheSameInOtherWords) {
  const TraceRequest request = Finger();
  const TracedPath path = TraceTo(request);
  ExpectSamePath(UndoUnits(TraceIncrements(ChangeUnits(request, 1e-3, 1e6)), 1e-3, 1e6), path, kSame);
  // What slides through an eye has no side.
  const TracedPath mirrored = TraceIncrements(Mirror(request));
  ASSERT_EQ(mirrored.increments.size(), path.increments.size());
  for (std::size_t i = 0; i < path.increments.size(); ++i) {
    const Increment &a = path.increments[i], &b = mirrored.increments[i];
    EXPECT_NEAR(a.load_factor, b.load_factor, kSame);
    for (std::size_t node = 0; node < request.scene.nodes.size(); ++node) {
      EXPECT_NEAR(a.positions[2 * node], -b.positions[2 * node], kSame);
      EXPECT_NEAR(a.positions[2 * node + 1], b.positions[2 * node + 1], kSame);
    }
    for (std::size_t k = 0; k < a.contacts.size(); ++k) {
      EXPECT_EQ(a.contacts[k].state, b.contacts[k].state);
      EXPECT_NEAR(a.contacts[k].rt, b.contacts[k].rt, kSame);
    }
  }
}

}  // namespace
}  // namespace contact_path::eyes_test
