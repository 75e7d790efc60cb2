// Pins in scenes: linkages, arches and springs in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact_path/path/earlier_trace.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/validate.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::pins_test {
namespace {

using Eigen::Vector2d;

constexpr double kExact = 1e-10;
constexpr double kGives = 2e-7;  // pins in loops give way by 1e-8 of their forces
constexpr double kSame = 1e-9;

RigidBody Ground(double x, double y) { return {"ground", x, y, true, true, true}; }

// A bob of the weight W on a rod of the length l hangs at the angle atan(F / W) under a push F.
TEST(Pins, APendulumHangsInTheDirectionOfItsForce) {
  for (const double length : {1e-3, 1.0, 1e3})
    for (const double weight : {1.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << "length " << length << ", weight " << weight);
      Scene scene;
      scene.bodies = {{"bob", 0.0, -length}};
      scene.nodes = {{"hook", 0.0, 0.0, true, true}, NodeOf("bob", "eye", 0.0, 0.0)};
      scene.pins = {{{"eye", "hook"}}};
      scene.loads = {LoadOnBody("bob", 0.0, -weight, true), LoadOnBody("bob", weight, 0.0)};
      const TracedPath path = TraceUntil({"load_factor", ">", 3.0}, scene);
      for (const Increment& increment : path.increments) {
        const double s = increment.load_factor;
        EXPECT_NEAR(increment.rotations.back(), std::atan(s), kExact);
        EXPECT_NEAR(increment.pins[0].rx / weight, -s, kExact);
        EXPECT_NEAR(increment.pins[0].ry / weight, 1.0, kExact);
        EXPECT_NEAR(increment.supports[0].rx / weight, -s, kExact);
        EXPECT_NEAR(increment.positions[2] / length, 0.0, kExact);
        EXPECT_EQ(increment.stability.stability, Verdict::kStable);
      }
    }
}

// Two rods of the lengths 1 and 0.8 with weights in the middle of the first and at the end of the second.
TraceRequest DoublePendulum() {
  Scene scene;
  scene.name = "double_pendulum";
  scene.bodies = {{"upper", 0.0, -0.5}, {"lower", 0.0, -1.8}};
  scene.nodes = {{"hook", 0.0, 0.0, true, true},
                 NodeOf("upper", "top", 0.0, 0.0),
                 NodeOf("upper", "above", 0.0, -1.0),
                 NodeOf("lower", "below", 0.0, -1.0)};
  scene.pins = {{{"top", "hook"}}, {{"above", "below"}}};
  scene.loads = {LoadOnBody("upper", 0.0, -1.0, true), LoadOnBody("lower", 0.0, -0.7, true),
                 LoadOnBody("lower", 1.0, 0.0)};
  return RequestUntil({"load_factor", ">", 2.0}, scene);
}

TEST(Pins, ADoublePendulum) {
  const TracedPath path = TraceTo(DoublePendulum());
  for (const Increment& increment : path.increments) {
    const double s = increment.load_factor;
    EXPECT_NEAR(increment.rotations[4], std::atan(s / 1.2), kExact);
    EXPECT_NEAR(increment.rotations[5], std::atan(s / 0.7), kExact);
    EXPECT_NEAR(increment.pins[0].rx, -s, kExact);
    EXPECT_NEAR(increment.pins[0].ry, 1.7, kExact);
    EXPECT_NEAR(increment.pins[1].rx, s, kExact);  // on the upper rod
    EXPECT_NEAR(increment.pins[1].ry, -0.7, kExact);
  }
}

TEST(Pins, APathEndsWhereAPinBears) {
  TraceRequest request = DoublePendulum();
  request.options.stop = {{"pin1.rx", "<", -1.5}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  EXPECT_NEAR(path.increments.back().load_factor, 1.5, kSame);
  request.options.stop[0].quantity = "pin1.rm";
  EXPECT_THROW(TraceIncrements(request), InvalidRequest);  // it has no spring
}

// By virtual work: s f . x' = k (phi - angle), with the coupler where it has to be for the turn phi of the crank.
TEST(Pins, AFourBarLinkageWithASpring) {
  for (const double angle : {0.0, 0.2}) {
    SCOPED_TRACE(angle);
    constexpr double kSpring = 0.7;
    const Vector2d crank(0.0, 1.0), rocker(2.0, 0.0), joint(2.0, 1.2), middle(1.0, 1.1), force(1.0, -0.3);
    Scene scene;
    scene.bodies = {{"crank", 0.0, 0.5}, {"coupler", middle.x(), middle.y()}, {"rocker", 2.0, 0.6}, Ground(1.0, 0.0)};
    scene.nodes = {NodeOf("ground", "o", 0.0, 0.0),   NodeOf("ground", "p", 2.0, 0.0),
                   NodeOf("crank", "c0", 0.0, 0.0),   NodeOf("crank", "c1", 0.0, 1.0),
                   NodeOf("coupler", "k0", 0.0, 1.0), NodeOf("coupler", "k1", 2.0, 1.2),
                   NodeOf("rocker", "r1", 2.0, 1.2),  NodeOf("rocker", "r0", 2.0, 0.0)};
    scene.pins = {{{"o", "c0"}, kSpring, angle, "drive"}, {{"c1", "k0"}}, {{"k1", "r1"}}, {{"r0", "p"}}};
    scene.loads = {LoadOnBody("coupler", force.x(), force.y())};
    const TracedPath path = TraceUntil({"crank.rotation", "<", -0.8}, scene);
    EXPECT_NEAR(path.increments.front().rotations[8], angle, kGives);
    const auto turned = [](double by, const Vector2d& v) {
      return Vector2d(std::cos(by) * v.x() - std::sin(by) * v.y(), std::sin(by) * v.x() + std::cos(by) * v.y());
    };
    const auto across = [](const Vector2d& v) { return Vector2d(-v.y(), v.x()); };
    for (const Increment& increment : path.increments) {
      const double phi = increment.rotations[8];
      const Vector2d c = turned(phi, crank);
      double psi = increment.rotations[9];  // of the coupler: Newton's method on the length of the rocker
      for (int i = 0; i < 20; ++i) {
        const Vector2d r = c + turned(psi, joint - crank) - rocker;
        psi -= 0.5 * (r.squaredNorm() - (joint - rocker).squaredNorm()) / r.dot(across(turned(psi, joint - crank)));
      }
      EXPECT_NEAR(increment.rotations[9], psi, kGives);
      const Vector2d r = c + turned(psi, joint - crank) - rocker;
      const double rate = -across(c).dot(r) / across(turned(psi, joint - crank)).dot(r);
      const Vector2d motion = across(c) + rate * across(turned(psi, middle - crank));
      EXPECT_NEAR(increment.load_factor * force.dot(motion), kSpring * (phi - angle), kGives);
      EXPECT_NEAR(increment.pins[0].rm, kSpring * (phi - angle), kExact);
      // The rocker bears along its axis alone.
      const Vector2d on_rocker(increment.pins[3].rx, increment.pins[3].ry);
      EXPECT_NEAR(on_rocker.dot(across(r)), 0.0, kGives);
    }
  }
}

// Two bodies from (-2, 0) and (2, 0) to a crown at (0, 1): a weight P = s on the left one at x = -1, a push H = s / 2
// on the right one at the height 0.5.
TEST(Pins, AnArchOfThreeHinges) {
  Scene scene;
  scene.bodies = {{"left", -1.0, 0.5}, {"right", 1.0, 0.5}};
  scene.nodes = {{"a", -2.0, 0.0, true, true},
                 {"b", 2.0, 0.0, true, true},
                 NodeOf("left", "left_foot", -2.0, 0.0),
                 NodeOf("left", "left_crown", 0.0, 1.0),
                 NodeOf("right", "right_crown", 0.0, 1.0),
                 NodeOf("right", "right_foot", 2.0, 0.0)};
  scene.pins = {{{"left_foot", "a"}}, {{"left_crown", "right_crown"}}, {{"right_foot", "b"}}};
  scene.loads = {LoadOnBody("left", 0.0, -1.0), LoadOnBody("right", 0.5, 0.0)};
  for (const bool swapped : {false, true}) {
    if (swapped)
      for (Pin& pin : scene.pins) std::swap(pin.nodes[0], pin.nodes[1]);
    const double sign = swapped ? -1.0 : 1.0;
    const TracedPath path = TraceTo(RequestUntil({"load_factor", ">", 1.0}, scene));
    for (const Increment& increment : path.increments) {
      const double P = increment.load_factor, H = 0.5 * P;
      const double right = (P + 0.5 * H) / 4.0, thrust = -2.0 * right - 0.5 * H;
      EXPECT_NEAR(sign * increment.pins[0].ry, P - right, kGives);
      EXPECT_NEAR(sign * increment.pins[0].rx, -thrust - H, kGives);
      EXPECT_NEAR(sign * increment.pins[1].ry, right, kGives);
      EXPECT_NEAR(sign * increment.pins[1].rx, thrust + H, kGives);
      EXPECT_NEAR(sign * increment.pins[2].ry, right, kGives);
      EXPECT_NEAR(sign * increment.pins[2].rx, thrust, kGives);
    }
  }
}

// Three equal links carry a platform: the least forces share its load equally, in any turn.
TEST(Pins, LeastForcesWhereEquilibriumDoesNotTellThem) {
  Scene scene;
  scene.bodies = {{"top", 1.0, 1.0}};
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::to_string(i);
    const double x = i;
    scene.bodies.push_back({"link" + name, x, 0.5});
    scene.nodes.push_back({"ground" + name, x, 0.0, true, true});
    scene.nodes.push_back(NodeOf("link" + name, "low" + name, x, 0.0));
    scene.nodes.push_back(NodeOf("link" + name, "high" + name, x, 1.0));
    scene.nodes.push_back(NodeOf("top", "top" + name, x, 1.0));
    scene.pins.push_back({{"low" + name, "ground" + name}});
    scene.pins.push_back({{"high" + name, "top" + name}});
  }
  scene.loads = {LoadOnBody("top", 0.0, 1.0, true), LoadOnBody("top", 1.0, 0.0)};
  const TracedPath path = TraceUntil({"load_factor", ">", 2.0}, scene);
  for (const Increment& increment : path.increments)
    for (std::size_t k = 0; k < 6; k += 2) {
      EXPECT_NEAR(increment.pins[k].rx, -increment.load_factor / 3.0, kGives);
      EXPECT_NEAR(increment.pins[k].ry, -1.0 / 3.0, kGives);
      EXPECT_NEAR(increment.pins[k + 1].rx, increment.load_factor / 3.0, kGives);
    }
}

// A shallow arch of two beams snaps through, its crown a hinge of a beam or a pin between two nodes.
TEST(Pins, JoinBeamsAsAHingeDoes) {
  TraceRequest hinged;
  Scene& scene = hinged.scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true, true}, {"b", 2.0, 0.0, true, true, true}, {"m", 1.0, 0.2}};
  scene.beams = {{"left", {"a", "m"}, 1e3, 1.0, 0.0, 8}, {"right", {"m", "b"}, 1e3, 1.0, 0.0, 8, 0.0, {true, false}}};
  scene.loads = {{"m", 0.3, -1.0}};
  hinged.options.stop = {{"m.y", "<", -0.3}};
  hinged.options.max_increments = 3000;
  TraceRequest pinned = hinged;
  pinned.scene.nodes.push_back({"n", 1.0, 0.2});
  pinned.scene.beams[1].nodes[0] = "n";
  pinned.scene.beams[1].hinged.clear();
  pinned.scene.pins = {{{"m", "n"}}};
  const TracedPath path = TraceIncrements(pinned), expected = TraceIncrements(hinged);
  ExpectNoFindings(path);
  ExpectSameEvents(path, expected, kSame);
  EXPECT_NEAR(path.increments.back().load_factor, expected.increments.back().load_factor, kSame);
  const Increment& last = path.increments.back();
  // The right support bears what the pin brings, less nothing: the right beam has no load.
  EXPECT_NEAR(last.pins[0].rx, last.supports[1].rx, kSame);
  EXPECT_NEAR(last.pins[0].ry, last.supports[1].ry, kSame);
}

// k (theta - angle) = M of a pawl, and a beam on a spring that M bends to a circle: M / k + M L / EI at its tip.
TEST(Pins, SpringsTurnByTheirMoments) {
  for (const double stiffness : {1e-3, 1.0, 1e4}) {
    SCOPED_TRACE(stiffness);
    Scene scene;
    scene.bodies = {Ground(0.0, 0.0), {"pawl", 1.0, 0.0}};
    scene.nodes = {NodeOf("pawl", "axle", 0.0, 0.0)};
    scene.pins = {{{"ground", "axle"}, stiffness, -0.3}};
    scene.loads = {LoadOnBody("pawl", 0.0, 0.0, false, stiffness)};
    const TracedPath path = TraceUntil({"pawl.rotation", ">", 3.0}, scene);
    for (const Increment& increment : path.increments) {
      EXPECT_NEAR(increment.rotations.back(), increment.load_factor - 0.3, kExact);
      EXPECT_NEAR(increment.pins[0].rm / stiffness, increment.load_factor, kExact);
      EXPECT_NEAR(increment.supports[0].rm / stiffness, -increment.load_factor, kExact);
    }
  }
  Scene scene;
  scene.bodies = {Ground(0.0, 0.0)};
  scene.nodes = {{"foot", 0.0, 0.0}, {"tip", 0.0, 2.0}};
  scene.beams = {{"rod", {"foot", "tip"}, 1e3, 0.5, 0.0, 8}};
  scene.pins = {{{"foot", "ground"}, 0.25}};
  scene.loads = {{"tip", 0.0, 0.0, false, 0.1}};
  const TracedPath path = TraceUntil({"load_factor", ">", 3.0}, scene);
  for (const Increment& increment : path.increments) {
    const double M = 0.1 * increment.load_factor;
    EXPECT_NEAR(increment.rotations[0], M / 0.25, kExact);
    EXPECT_NEAR(increment.rotations[1], M / 0.25 + M * 2.0 / 0.5, kExact);
    EXPECT_NEAR(increment.pins[0].rm, -M, kExact);
  }
}

// A rod that stands on a spring k falls over at P = k / l, and leans by k theta = P l sin(theta) - H l cos(theta) where
// it is pushed by H.
TEST(Pins, AStandingRodFallsOver) {
  for (const double length : {1e-2, 2.0, 1e2})
    for (const double push : {0.0, 0.01}) {
      SCOPED_TRACE(testing::Message() << "length " << length << ", push " << push);
      constexpr double kSpring = 3.0;
      const double critical = kSpring / length;
      Scene scene;
      scene.bodies = {Ground(0.0, 0.0), {"rod", 0.0, length}};
      scene.nodes = {NodeOf("rod", "foot", 0.0, 0.0)};
      scene.pins = {{{"ground", "foot"}, kSpring}};
      scene.loads = {LoadOnBody("rod", 0.0, -critical)};
      if (push > 0.0) scene.loads.push_back(LoadOnBody("rod", push * critical, 0.0, true));
      const TracedPath path = TraceUntil({"load_factor", ">", 1.4}, scene);
      for (const Increment& increment : path.increments) {
        const double theta = increment.rotations.back(), s = increment.load_factor;
        EXPECT_NEAR(theta, s * std::sin(theta) - push * std::cos(theta), kExact);
        if (push > 0.0 || std::abs(s - 1.0) > 1e-7) {
          EXPECT_EQ(increment.stability.stability, push > 0.0 || s < 1.0 ? Verdict::kStable : Verdict::kUnstable) << s;
        }
      }
      const std::vector<Increment> crossings = IncrementsOfKind(path, IncrementKind::kBifurcation);
      ASSERT_EQ(crossings.size(), push == 0.0 ? 1U : 0U);
      for (const Increment& crossing : crossings) EXPECT_NEAR(crossing.load_factor, 1.0, 1e-7);
    }
}

// A rigid link of the length l pushes a slider against a spring: P = K l (cos a - cos a0) tan a, K = EA / l0, and
// jumps.
TraceRequest Toggle() {
  Scene scene;
  scene.name = "toggle";
  const double x = std::cos(0.4), y = std::sin(0.4);
  scene.bodies = {{"link", -0.5 * x, 0.5 * y}};
  scene.nodes = {{"apex", 0.0, y, true, false},
                 {"slider", -x, 0.0, false, true},
                 {"wall", -x - 2.0, 0.0, true, true},
                 NodeOf("link", "high", 0.0, y),
                 NodeOf("link", "low", -x, 0.0)};
  scene.bars = {{{"slider", "wall"}, 2.0}};
  scene.pins = {{{"high", "apex"}}, {{"low", "slider"}}};
  scene.loads = {{"apex", 0.0, -0.1}};
  return RequestUntil({"load_factor", ">", 0.8}, scene);
}

TEST(Pins, ARigidToggleSnaps) {
  for (const AtLimit at_limit : {AtLimit::kFollow, AtLimit::kJump}) {
    TraceRequest request = Toggle();
    request.options.at_limit = at_limit;
    const TracedPath path = TraceTo(request);
    double largest = 0.0;
    for (double a = 0.0; a < 0.4; a += 1e-5) largest = std::max(largest, (std::cos(a) - std::cos(0.4)) * std::tan(a));
    for (const Increment& increment : path.increments) {
      const double a = std::asin(increment.positions[1]);
      EXPECT_NEAR(0.1 * increment.load_factor, (std::cos(a) - std::cos(0.4)) * std::tan(a), kGives);
    }
    EXPECT_NEAR(0.1 * IncrementsOfKind(path, IncrementKind::kSmoothLimit).at(0).load_factor, largest, kGives);
    EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kJump).size(), at_limit == AtLimit::kJump ? 1U : 0U);
  }
}

// A crank and a rod that push a slider, in stages, with springs.
TraceRequest SliderCrank() {
  Scene scene;
  scene.name = "slider_crank";
  scene.bodies = {{"crank", 0.0, 0.5}, {"rod", 0.8, 0.7}};
  scene.nodes = {{"o", 0.0, 0.0, true, true},     {"slider", 2.0, 0.0},
                 {"wall", 4.0, 0.0, true, true},  NodeOf("crank", "c0", 0.0, 0.0),
                 NodeOf("crank", "c1", 0.0, 1.0), NodeOf("rod", "k0", 0.0, 1.0),
                 NodeOf("rod", "k1", 2.0, 0.0),   {"above", 2.0, 3.0, true, true}};
  scene.bars = {{{"slider", "wall"}, 2.0}, {{"slider", "above"}, 4.0}};
  scene.pins = {{{"o", "c0"}}, {{"c1", "k0"}, 0.2, 0.1}, {{"k1", "slider"}, 0.0, 0.0, "wrist"}};
  scene.loads = {LoadOnBody("rod", 0.0, -0.01, true)};
  return RequestOf(scene, {LoadingStage({LoadOnBody("rod", 0.2, 0.0)}),
                           MovingStage({{"wall", -0.3, 0.0}, {"o", 0.0, 0.2}}), UnloadingStage()});
}

TEST(Pins, AreTheSameInOtherWords) {
  for (const TraceRequest& request : {SliderCrank(), DoublePendulum()}) {
    SCOPED_TRACE(request.scene.name);
    const TracedPath path = TraceTo(request);
    ExpectSameInOtherWords(request, path, kSame);
    ExpectSamePath(UndoRotation(TraceIncrements(Rotate(request, 0.7)), 0.7), path, kSame);
  }
}

TEST(Pins, GoOnFromAnIncrementAsIfNothingHadBeen) {
  for (const TraceRequest& request : {DoublePendulum(), Toggle(), SliderCrank()}) {
    SCOPED_TRACE(request.scene.name);
    const TracedPath path = TraceIncrements(request);
    for (const std::size_t after : {std::size_t{4}, path.increments.size() / 2, path.increments.size() - 3}) {
      const std::vector<Increment> all = ResumeAfter(after, path).increments;
      ASSERT_EQ(all.size(), path.increments.size());
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < all[i].pins.size(); ++k) {
          EXPECT_NEAR(all[i].pins[k].rx, path.increments[i].pins[k].rx, kSame) << i;
          EXPECT_NEAR(all[i].pins[k].ry, path.increments[i].pins[k].ry, kSame) << i;
        }
    }
  }
}

// Of a bag that has the state of every fourth increment alone.
TEST(Pins, StatesBetweenAreFoundAnew) {
  const TraceRequest request = Toggle();
  const TracedPath path = TraceIncrements(request);
  std::vector<Increment> thinned = Thinned(path, 4);
  ASSERT_EQ(RestoreStates(Expand(request).request, &thinned), thinned.size());
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    EXPECT_NEAR(thinned[i].positions[1], path.increments[i].positions[1], kSame) << i;
    EXPECT_NEAR(thinned[i].pins[0].ry, path.increments[i].pins[0].ry, kSame) << i;
  }
}

// A box on a rough floor is pulled by a rigid link that is pinned to it, with 0.01 W + s: it slides at mu W.
TEST(Pins, ABoxIsPulledByALink) {
  Scene scene;
  scene.bodies = {{"box", 0.0, 0.1}, {"link", 1.5, 0.1}};
  scene.nodes = {NodeOf("box", "a", -0.5, 0.0), NodeOf("box", "b", 0.5, 0.0), NodeOf("box", "eye", 0.5, 0.1),
                 NodeOf("link", "end", 0.5, 0.1)};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  scene.contacts = {{"a", "floor"}, {"b", "floor"}};
  scene.pins = {{{"eye", "end"}}};
  scene.loads = {LoadOnBody("box", 0.0, -1.0, true), LoadOnBody("link", 0.01, 0.0, true), LoadOnBody("link", 1.0, 0.0)};
  const TracedPath path = TraceVerified(RequestWithin(100, scene));
  EXPECT_NEAR(LargestLoadFactor(path), 0.29, kGives) << path.result.message;
  for (const Increment& increment : path.increments)
    EXPECT_NEAR(increment.pins[0].rx, 0.01 + increment.load_factor, kGives);
}

// Supports cannot move apart what a rigid body holds together.
TEST(Pins, DoNotGiveWayToSupports) {
  Scene scene;
  scene.bodies = {{"link", 0.5, 0.0}};
  scene.nodes = {{"f", 0.0, 0.0, true, true},
                 {"g", 1.0, 0.0, true, true},
                 NodeOf("link", "p", 0.0, 0.0),
                 NodeOf("link", "q", 1.0, 0.0)};
  scene.pins = {{{"p", "f"}}, {{"q", "g"}}};
  scene.support_motions = {{"g", 0.1, 0.0}};
  const TracedPath path = TraceTo(RequestUntil({"load_factor", ">", 1.0}, scene), EndReason::kNumericalFailure);
  EXPECT_FALSE(path.result.reached);
}

TEST(Pins, AreRefusedByNameWhereTheyCannotBe) {
  const auto line = [](const std::function<void(TraceRequest*)>& change) {
    TraceRequest request = DoublePendulum();
    change(&request);
    try {
      Trace(request, {});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(line([](TraceRequest* of) {
           of->scene.pins[0].nodes = {"top", "below"};
         }),
         "scene.pins[0].nodes = [top, below]: the two nodes must be at the same point at the start");
  expect(line([](TraceRequest* of) {
           of->scene.pins[0].nodes = {"top", "above"};
         }),
         "must not name two nodes of one body: upper");
  expect(line([](TraceRequest* of) { of->scene.pins[0].nodes = {"top"}; }), "must name two nodes");
  expect(line([](TraceRequest* of) { of->scene.pins[0].nodes = {"top", "top"}; }), "must name two different nodes");
  expect(line([](TraceRequest* of) { of->scene.pins[0].nodes = {"top", "hok"}; }), "did you mean hook?");
  expect(line([](TraceRequest* of) {
           of->scene.pins.push_back({{"below", "above"}});
         }),
         "scene.pins[2].nodes = [below, above]: must not be repeated");
  expect(line([](TraceRequest* of) { of->scene.pins[0].stiffness = 1.0; }),
         "scene.pins[0].nodes = hook: must be of a body, or a node that a beam turns");
  expect(line([](TraceRequest* of) { of->scene.pins[0].stiffness = -1.0; }), "scene.pins[0].stiffness = -1");
  expect(line([](TraceRequest* of) { of->scene.pins[1].name = "pin1"; }), "scene.pins[1].name = pin1: must be unique");
  expect(line([](TraceRequest* of) { of->scene.pins[1].name = "hook"; }),
         "scene.pins[1].name = hook: must not be the name of a node");
  expect(line([](TraceRequest* of) {
           of->scene.nodes.push_back({"nail", 0.0, 0.0, true, true});
           of->scene.pins.push_back({{"nail", "hook"}});
         }),
         "one of the two nodes must be free to move");
  // Written with few digits.
  EXPECT_EQ(line([](TraceRequest* of) { of->scene.nodes[1].x = 1e-10; }), "");
}

}  // namespace
}  // namespace contact_path::pins_test
