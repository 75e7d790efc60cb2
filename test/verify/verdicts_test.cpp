// Verdicts of stability that are found anew: against closed forms, and those that were changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/verify/verify_path.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "verify/disturbance.h"
#include "verify/verified.h"

namespace contact_path::verdicts_test {
namespace {

bool Inside(const Increment& increment) {
  return increment.kind == IncrementKind::kRegular && increment.event.branches.empty();
}

bool Decided(const Increment& increment) {
  return increment.stability.stability == Verdict::kStable || increment.stability.stability == Verdict::kUnstable;
}

// The path is proved, with all verdicts inside its arcs but for `open`; and each of them that is changed is found.
void ExpectVerdictsFound(const TracedPath& path, int open = 0) {
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  const auto inside = std::count_if(path.increments.begin(), path.increments.end(),
                                    [](const Increment& of) { return Inside(of) && Decided(of); });
  EXPECT_GE(verification.proved_verdicts, inside - open);
  EXPECT_GT(verification.proved_verdicts, 0);
  // Of up to 8, since only some findings are listed.
  std::vector<Increment> increments = path.increments;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < increments.size(); i += 1 + increments.size() / 8) {
    if (!Inside(increments[i]) || !Decided(increments[i])) continue;
    Verdict& verdict = increments[i].stability.stability;
    verdict = verdict == Verdict::kStable ? Verdict::kUnstable : Verdict::kStable;
    ++changed;
  }
  EXPECT_GT(changed, 0U);
  const Verification tampered = VerifyPath(path.request, increments);
  std::size_t found = 0;
  for (const Finding& finding : tampered.findings)
    if (finding.what.find("able, but is ") != std::string::npos) ++found;
  EXPECT_GE(found + static_cast<std::size_t>(open), changed) << Listed(tampered);
}

// A body with a round foot of the radius r stands on a drum of the radius R, or a floor, its weight W at the height h
// above the foot. Turned by theta it has rolled round by phi = theta r / (r + R), and needs the moment
//   M = W ((r - h) sin theta - r sin phi),  dM/dtheta = W ((r - h) cos theta - r^2 / (r + R) cos phi)
// so that it rests at 0 if 1 / h > 1 / r + 1 / R.
TEST(Verdicts, ARoundFootRocks) {
  for (const double unit : {1e-3, 1.0, 1e3})
    for (const double drum : {0.0, 0.7, 2.0})
      for (const double share : {0.5, 0.95, 1.05, 1.4}) {
        SCOPED_TRACE(testing::Message() << "unit " << unit << ", drum " << drum << ", share " << share);
        const double r = unit, R = drum * unit;
        const double height = share * (drum > 0.0 ? r * R / (r + R) : r);
        TraceRequest request;
        Scene& scene = request.scene;
        scene.name = "rocks";
        scene.bodies = {{"rocker", 0.0, R + height}};
        Obstacle rim{"rim", ObstacleShape::kCircle, 0.0, R + r, 0.0, 0.0, 2.0, r};
        rim.body = "rocker";
        scene.obstacles = {rim, drum > 0.0 ? Obstacle{"ground", ObstacleShape::kCircle, 0.0, 0.0, 0.0, 0.0, 2.0, R}
                                           : Obstacle{"ground", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 2.0}};
        ContactCandidate rolls;
        rolls.obstacles = {"rim", "ground"};
        scene.contacts = {rolls};
        scene.loads = {LoadOnBody("rocker", 0.0, -1.0, true), LoadOnBody("rocker", 0.0, 0.0, false, unit)};
        request.options.max_increments = 25;
        request.options.step = 0.05;
        const TracedPath path = TraceIncrements(request);
        ASSERT_GT(path.increments.size(), 5U) << path.result.message;
        int stable = 0, unstable = 0;
        for (const Increment& increment : path.increments) {
          if (increment.contacts[0].state != ContactState::kStick || !Inside(increment)) continue;
          const double theta = increment.rotations.front(), phi = drum > 0.0 ? theta * r / (r + R) : 0.0;
          EXPECT_NEAR(increment.load_factor, ((r - height) * std::sin(theta) - r * std::sin(phi)) / unit, 1e-7);
          const double stiffness =
              ((r - height) * std::cos(theta) - (drum > 0.0 ? r * r / (r + R) * std::cos(phi) : 0.0)) / unit;
          if (std::abs(stiffness) < 1e-6) continue;
          EXPECT_EQ(increment.stability.stability, stiffness > 0.0 ? Verdict::kStable : Verdict::kUnstable) << theta;
          ++(stiffness > 0.0 ? stable : unstable);
        }
        EXPECT_GT(share < 1.0 ? stable : unstable, 3);
        ExpectVerdictsFound(path);
      }
}

// A rod of the length l under P stands on a pin with the spring k: up to P = k / l.
TEST(Verdicts, ARodStandsOnASpring) {
  for (const double length : {1e-2, 2.0, 1e2})
    for (const double spring : {1e-3, 3.0, 1e3}) {
      SCOPED_TRACE(testing::Message() << "length " << length << ", spring " << spring);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.name = "rod";
      scene.bodies = {{"ground", 0.0, 0.0, true, true, true}, {"rod", 0.0, length}};
      scene.nodes = {{"foot", 0.0, 0.0}};
      scene.nodes[0].body = "rod";
      scene.pins = {{{"ground", "foot"}, spring}};
      scene.loads = {LoadOnBody("rod", 0.0, -spring / length)};
      request.options.stop = {{"load_factor", ">", 1.8}};
      const TracedPath path = TraceIncrements(request);
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
      for (const Increment& increment : path.increments)
        if (Inside(increment)) {
          EXPECT_EQ(increment.stability.stability, increment.load_factor < 1.0 ? Verdict::kStable : Verdict::kUnstable);
        }
      ExpectVerdictsFound(path, 1);
    }
}

// Bodies on contacts and pins that hold them more often than needed, rollers, eyes that stick and slide.
class OfScenes : public testing::TestWithParam<const char*> {};

TEST_P(OfScenes, AreFound) { ExpectVerdictsFound(TraceIncrements(ReadExample(GetParam())), 3); }

INSTANTIATE_TEST_SUITE_P(Verdicts, OfScenes,
                         testing::Values("ladder", "held_disc", "three_discs", "toggle_clamp", "tendon_finger",
                                         "tackle", "ratchet", "step_ladder"),
                         [](const auto& tested) { return std::string(tested.param); });

// A body in a sling: eyes that it carries slide, and its motion changes the largest friction force.
TEST(Verdicts, EyesOfABodySlide) {
  for (const double friction : {0.2, 0.2677}) {
    TraceRequest request;
    Scene& scene = request.scene;
    scene.name = "sling";
    scene.bodies = {{"load", 0.05, 3.0}};
    scene.nodes = {{"one", -0.6, 3.6},
                   {"two", 0.5, 3.5},
                   {"foot", 0.1, 2.2},
                   {"left", -0.65, 5.0, true, true},
                   {"right", 1.05, 5.2, true, true},
                   {"hook", 0.0, 5.5, true, true}};
    for (std::size_t i = 0; i < 3; ++i) scene.nodes[i].body = "load";
    scene.tendons = {{"", {"left", "one", "hook", "two", "right"}, 103.0, 0.0, friction}};
    scene.superelements = {{{"foot"}, {0.235, 0.0, 0.0, 0.33}}};
    scene.loads = {LoadOnBody("load", 0.0, -1.0, true), LoadOnBody("load", 0.18, -0.98, false, 0.126)};
    request.options.stop = {{"load_factor", ">", 1.0}};
    const TracedPath path = TraceIncrements(request);
    EXPECT_TRUE(std::any_of(path.increments.begin(), path.increments.end(), [](const Increment& increment) {
      return Decided(increment) && Inside(increment) &&
             std::count_if(increment.contacts.begin(), increment.contacts.end(),
                           [](const ContactRecord& of) { return Slips(of.state); }) > 1;
    }));
    ExpectVerdictsFound(path);
  }
}

// ----- dense matrices -----

Eigen::MatrixXd Matrix(Eigen::Index columns, std::vector<double> entries) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      entries.data(), static_cast<Eigen::Index>(entries.size()) / columns, columns);
}

TEST(Disturbance, IsPositiveOnTheCone) {
  EXPECT_TRUE(PositiveOnCone(Matrix(2, {1.0, 3.0, 3.0, 1.0})));  // not positive definite
  EXPECT_FALSE(PositiveOnCone(Matrix(2, {1.0, -3.0, -3.0, 1.0})));
  EXPECT_FALSE(PositiveOnCone(Matrix(2, {-1.0, 3.0, 3.0, 1.0})));
  EXPECT_TRUE(PositiveOnCone(Matrix(2, {1.0, -0.9, -0.9, 1.0})));
  // Horn's matrix is on the boundary, and so is what is a little more or less.
  const Eigen::MatrixXd horn =
      Matrix(5, {1, -1, 1, 1, -1, -1, 1, -1, 1, 1, 1, -1, 1, -1, 1, 1, 1, -1, 1, -1, -1, 1, 1, -1, 1});
  const Eigen::MatrixXd one = 1e-3 * Eigen::MatrixXd::Identity(5, 5);
  EXPECT_TRUE(PositiveOnCone(horn + one));
  EXPECT_FALSE(PositiveOnCone(horn - one));
}

// A motion whose energy falls, and what holds it: rigid, twice, by a spring, by one that is too soft.
TEST(Disturbance, IsHeld) {
  Disturbed of;
  of.stiffness = Matrix(2, {-1.0, 0.2, 0.2, 2.0});
  of.change = Eigen::MatrixXd::Zero(2, 2);
  of.held.resize(2, 0);
  EXPECT_EQ(FreeMotions(of).Falling(), 1);
  EXPECT_EQ(VerdictOf(of, FreeMotions(of)), Verdict::kUnstable);
  of.held = Matrix(1, {1.0, 0.0});
  for (const double give : {0.0, 1e-8, 0.5, 2.0}) {
    of.give = Eigen::VectorXd::Constant(1, give);
    EXPECT_EQ(VerdictOf(of, FreeMotions(of)), give < 0.9 ? Verdict::kStable : Verdict::kUnstable) << give;
  }
  of.held = Matrix(3, {1.0, -1.0, 1.0, 0.0, 0.0, 1e-9});
  of.give = Eigen::Vector3d(1e-8, 1e-8, 0.0);
  EXPECT_EQ(VerdictOf(of, FreeMotions(of)), Verdict::kStable);
  of.held = Matrix(2, {1.0, 0.0, 0.0, 1.0});
  of.give = Eigen::Vector2d(1e-8, 0.0);
  EXPECT_EQ(VerdictOf(of, FreeMotions(of)), Verdict::kStable);
}

// A node on a floor, which slides along x: H = k11 - mu k12 with its sense, and k22 is held.
TEST(Disturbance, Slides) {
  for (const double sense : {1.0, -1.0})
    for (const double coupling : {-2.0, -0.5, 0.5, 2.0}) {
      Disturbed of;
      of.stiffness = Matrix(2, {1.0, coupling, coupling, 5.0});
      of.change = Eigen::MatrixXd::Zero(2, 2);
      of.held = Matrix(2, {0.0, 1.0, 1.0, 0.0});
      of.give = Eigen::Vector2d::Zero();
      of.sliding = {{1, 0, sense, 0.8, {}, {}}};
      const double H = 1.0 + 0.8 * sense * coupling;
      EXPECT_EQ(VerdictOf(of, FreeMotions(of)), H > 0.0 ? Verdict::kStable : Verdict::kUnstable);
    }
}

}  // namespace
}  // namespace contact_path::verdicts_test
