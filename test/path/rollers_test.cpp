// Tendons round rollers of a radius and wound on drums, in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "contact_path/scene/validate.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::rollers_test {
namespace {

constexpr double kExact = 1e-9;
constexpr double kSoft = 1e-7;  // of pieces with friction: what keeps the strains of slack ones even

Tendon TendonThrough(const std::vector<std::string>& nodes, const std::vector<double>& radii,
                     const std::vector<double>& turns, double EA, double friction = 0.0, double rest_length = 0.0) {
  return {"rope", nodes, EA, rest_length, friction, radii, turns};
}

// From a hand that goes down on the left over a roller about (0, 1) to a node on a spring of the stiffness 1 on the
// right, both below its sides; `more` whole turns round it.
TraceRequest OverARoller(double radius, double EA, double friction, int more) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "over_a_roller";
  scene.nodes = {{"hand", -radius, 0.0, true, true},
                 {"axle", 0.0, 1.0, true, true},
                 {"load", radius, 0.0, true, false},
                 {"ground", radius, -1.0, true, true}};
  scene.bars = {{{"load", "ground"}, 1.0}};
  scene.tendons = {TendonThrough({"hand", "axle", "load"}, {0.0, radius, 0.0}, {0.0, -1.0 - more, 0.0}, EA, friction)};
  scene.support_motions = {{"hand", 0.0, -0.5}};
  request.options.stop = {{"load_factor", ">", 1.0}};
  request.options.record = {"sections"};
  return request;
}

TEST(Rollers, FixedOnesHoldByTheAngleThatIsWrapped) {
  for (const double radius : {0.01, 0.2, 2.0})
    for (const double friction : {0.05, 0.3})
      for (const int more : {0, 1, 3})
        for (const double EA : {20.0, 1e6}) {
          SCOPED_TRACE(::testing::Message() << radius << ' ' << friction << ' ' << more << ' ' << EA);
          const TracedPath path = TraceTo(OverARoller(radius, EA, friction, more));
          const Increment& last = path.increments.back();
          const double factor = std::exp(friction * M_PI * (1 + 2 * more));
          EXPECT_EQ(last.contacts[0].state, ContactState::kSlipMinus);
          const double soft = 2e-8 * (1.0 + last.sections[1].N);
          EXPECT_NEAR(last.sections[2].N, last.sections[0].N, soft);  // the spring's
          EXPECT_NEAR(last.sections[1].N / factor, last.sections[2].N, soft);
          EXPECT_EQ(last.stability.stability, Verdict::kStable);
        }
}

TEST(Rollers, WithoutFrictionOrFreeTheTensionIsTheSame) {
  for (const Pulley pulley : {Pulley::kFixed, Pulley::kFree})
    for (const double radius : {0.01, 0.2, 2.0})
      for (const double EA : {20.0, 1e6}) {
        SCOPED_TRACE(::testing::Message() << radius << ' ' << EA);
        TraceRequest request = OverARoller(radius, EA, 0.0, 1);
        request.scene.tendons[0].pulley = pulley;
        const TracedPath path = TraceTo(request);
        const double length = 2.0 + 3.0 * M_PI * radius;
        // EA ((length + 0.5 - y) / length - 1) = y
        EXPECT_NEAR(path.increments.back().sections[1].N, 0.5 * EA / (length + EA), kExact);
      }
}

// A belt that crosses between two rollers: its way by the angles of the tangents, when one roller moves off sideways.
TEST(Rollers, ATendonCrossesBetweenThem) {
  const double r = 0.3, R = 0.5;
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"end", -3.0, r, true, true},
                 {"left", 0.0, 0.0, true, true},
                 {"right", 2.0, -1.5, false, true},
                 {"ground", 6.0, -1.5, true, true},
                 {"other", 5.0, -1.5 - R, true, true}};
  scene.bars = {{{"right", "ground"}, 1.0}};
  scene.tendons = {TendonThrough({"end", "left", "right", "other"}, {0.0, r, R, 0.0}, {0.0, -1.0, 1.0, 0.0}, 50.0)};
  scene.support_motions = {{"end", -0.2, 0.0}};
  request.options.stop = {{"load_factor", ">", 1.0}};
  request.options.record = {"sections"};
  const TracedPath path = TraceTo(request);
  // Clockwise round the left one, counterclockwise round the right one: the piece between them is an inner tangent, and
  // those outside are level. Both arcs are the angle by which it goes down.
  const auto length = [&](double end, double x) {
    const double dx = x, dy = -1.5, apart = std::hypot(dx, dy);
    const double down = -(std::atan2(dy, dx) - std::asin((r + R) / apart));
    return (0.0 - end) + std::sqrt(apart * apart - (r + R) * (r + R)) + (r + R) * down + (5.0 - x);
  };
  const Increment& last = path.increments.back();
  const double x = last.positions[4], tension = 50.0 * (length(-3.2, x) / length(-3.0, 2.0) - 1.0);
  EXPECT_GT(tension, 0.2);
  EXPECT_NEAR(last.sections[1].N, tension, kExact);
  const double apart = std::hypot(x, 1.5), down = -(std::atan2(-1.5, x) - std::asin((r + R) / apart));
  EXPECT_NEAR(tension * (1.0 - std::cos(down)), 0.25 * (x - 2.0), kExact);  // what the string pulls on the right roller
}

// A drum that is turned winds the rope that is fixed to it; the moment that turns it is the tension times its radius.
TEST(Rollers, ADrumWindsATendon) {
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(side);
    const double r = 0.2;
    TraceRequest request;
    Scene& scene = request.scene;
    scene.bodies = {{"drum", 0.0, 1.0, true, true}};
    scene.nodes = {
        {"load", side * r, 0.0, true, false}, {"ground", side * r, -1.0, true, true}, NodeOf("drum", "axle", 0.0, 1.0)};
    scene.bars = {{{"load", "ground"}, 1.0}};
    scene.tendons = {TendonThrough({"load", "axle"}, {0.0, r}, {0.0, side * 2.0}, 40.0)};
    scene.loads = {{"drum", 0.0, 0.0, false, side}};
    request.options.stop = {{"load_factor", ">", 0.1}};
    request.options.record = {"sections"};
    const TracedPath path = TraceTo(request);
    const double tension = 0.1 / r, length = 1.0 + 4.0 * M_PI * r;
    const Increment& last = path.increments.back();
    EXPECT_NEAR(last.sections[1].N, tension, kExact);
    EXPECT_NEAR(last.positions[1], tension, kExact);
    // Turned by t: EA ((length - tension + r t) / length - 1) = tension.
    EXPECT_NEAR(side * last.rotations.back(), (tension + length * tension / 40.0) / r, kExact);

    // Unwound to nothing, the rope has come to its end.
    request.scene.loads.clear();
    request.scene.bodies[0].fixed_rotation = true;
    request.scene.support_motions = {{"", 0.0, 0.0, -side, "", "drum"}};
    request.scene.bars[0].rest_length = 0.2;
    request.options.stop.clear();
    request.options.max_increments = 1000;
    const TracedPath unwound = TraceTo(request, EndReason::kPathEnd);
    EXPECT_NE(unwound.result.message.find("tendon rope at axle comes off its roller"), std::string::npos)
        << unwound.result.message;
    EXPECT_NEAR(unwound.increments.back().load_factor, 4.0 * M_PI, 1e-8);
  }
}

// A capstan drags a slack tail: the tensions come to differ by exp(mu angle), and the path ends where the arc behind
// its middle has been hauled off.
TEST(Rollers, ADrivenOneDragsTheTendonAlong) {
  const double r = 0.2, friction = 0.15, wrapped = 3.0 * M_PI;
  TraceRequest request;
  Scene& scene = request.scene;
  scene.bodies = {{"drum", 0.0, 1.0, true, true, true}};
  scene.nodes = {{"tail", -r, 0.0, true, false},
                 {"left", -r, -1.0, true, true},
                 {"load", r, 0.0, true, false},
                 {"right", r, -1.0, true, true},
                 NodeOf("drum", "axle", 0.0, 1.0)};
  scene.bars = {{{"tail", "left"}, 1.0}, {{"load", "right"}, 1.0}};
  scene.tendons = {TendonThrough({"tail", "axle", "load"}, {0.0, r, 0.0}, {0.0, -2.0, 0.0}, 100.0, friction,
                                 2.0 + wrapped * r - 0.6)};
  scene.support_motions = {{"", 0.0, 0.0, 1.0, "", "drum"}};
  request.options.record = {"sections"};
  request.options.max_increments = 1000;
  const TracedPath path = TraceTo(request, EndReason::kPathEnd, "has been hauled by the arc on one side of its roller");
  EXPECT_NEAR(path.increments.back().load_factor, 0.5 * wrapped, 1e-8);
  bool slips = false;
  for (const Increment& increment : path.increments) {
    if (increment.contacts[0].state != ContactState::kSlipPlus) continue;
    slips = true;
    EXPECT_NEAR(increment.sections[3].N / std::exp(friction * wrapped), increment.sections[2].N, kSoft);
    // The moment that turns it.
    double moment = 0.0;
    for (const Resultant& support : increment.supports) moment += support.rm;
    EXPECT_NEAR(moment, r * (increment.sections[3].N - increment.sections[2].N), kSoft);
  }
  EXPECT_TRUE(slips);
}

// Lifted, a rope leaves the roller where it is straight, whether it bears something there or nothing.
TEST(Rollers, ATendonComesOffWhereItIsStraight) {
  for (const double friction : {0.0, 0.05, 0.2, 0.5})
    for (const double EA : {1.0, 10.0, 1e6})
      for (const double rest_length : {0.9, 1.0}) {
        SCOPED_TRACE(testing::Message() << friction << " " << EA << " " << rest_length);
        Scene scene;
        scene.nodes = {{"a", -0.5, 0.8, true, true}, {"axle", 0.0, 1.0, true, true}, {"b", 0.5, 0.8, true, true}};
        scene.tendons = {
            TendonThrough({"a", "axle", "b"}, {0.0, 0.2, 0.0}, {0.0, -1.0, 0.0}, EA, friction, rest_length)};
        scene.nodes.push_back({"free", 2.0, 0.0});
        scene.superelements = {{{"free"}, {1.0, 0.0, 0.0, 1.0}}};
        scene.support_motions = {{"a", 0.0, 0.4}, {"b", 0.0, 0.4}};
        const TracedPath path = TraceTo(RequestWithin(1000, scene), EndReason::kPathEnd, "comes off its roller");
        EXPECT_NEAR(path.increments.back().load_factor, 1.0, 1e-8);  // at y = 1.2, the top of the roller
      }
}

TEST(Rollers, AreTheSameInOtherWords) {
  TraceRequest request = OverARoller(0.2, 30.0, 0.2, 0);
  request.scene.nodes[2].fixed_x = false;
  request.scene.superelements = {{{"load"}, {0.5, 0.0, 0.0, 0.0}}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  ExpectSamePath(UndoUnits(TraceIncrements(ChangeUnits(request, 1e-3, 1e6)), 1e-3, 1e6), path, kSoft);
  const TracedPath mirrored = TraceIncrements(Mirror(request));
  ASSERT_EQ(mirrored.increments.size(), path.increments.size());
  for (std::size_t i = 0; i < path.increments.size(); ++i) {
    EXPECT_NEAR(mirrored.increments[i].positions[4], -path.increments[i].positions[4], kSoft);
    EXPECT_NEAR(mirrored.increments[i].positions[5], path.increments[i].positions[5], kSoft);
  }
}

TEST(Rollers, RefuseWhatNoTendonCanGoRound) {
  const auto expect_refused = [](const std::vector<double>& radii, const std::vector<double>& turns,
                                 const std::string& why) {
    TraceRequest request = OverARoller(0.2, 30.0, 0.2, 0);
    request.scene.tendons[0].radii = radii;
    request.scene.tendons[0].turns = turns;
    const std::vector<Violation> violations = Validate(request);
    ASSERT_EQ(violations.size(), 1U) << why;
    EXPECT_NE(violations[0].ToLine().find(why), std::string::npos) << violations[0].ToLine();
  };
  expect_refused({0.2}, {-1.0}, "radii");
  expect_refused({0.0, 0.2, 0.0}, {0.0, 1.5, 0.0}, "whole number");
  expect_refused({0.0, 0.2, 0.0}, {0.0, 0.0, 0.0}, "must be 0 where the radius is");
  expect_refused({0.0, 3.0, 0.0}, {0.0, 1.0, 0.0}, "must leave room");
}

}  // namespace
}  // namespace contact_path::rollers_test
