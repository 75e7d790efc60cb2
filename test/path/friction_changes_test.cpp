// Friction that changes with the load factor, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/scene/validate.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::friction_changes_test {
namespace {

constexpr double kExact = 1e-9;
constexpr double kGives = 2e-7;   // contacts of bodies give way by 1e-8 of their forces
constexpr double kLeft = 1.1e-6;  // of the friction, where the path ends

Obstacle HalfPlane(const std::string& name, double nx, double ny, double friction) {
  return {name, ObstacleShape::kHalfPlane, 0.0, 0.0, nx, ny, friction};
}

// Units of length and force, and of the load factor.
struct Units {
  double length = 1.0, force = 1.0, load_factor = 1.0;
};
const Units kUnits[] = {{}, {1e-3, 1e4, 1.0}, {250.0, 1e-5, 40.0}, {1.0, 1.0, 1e-3}};

// A node on a floor, pressed onto it by N = 2 F and held by a spring of 3 F / L along it.
constexpr double kPress = 2.0, kSpring = 3.0;

TraceRequest Slider(const Units& units, double friction, double rate) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene = NodeOnFloor("b", kSpring * units.force / units.length, friction);
  scene.loads = {{"b", 0.0, -kPress * units.force, true}};
  scene.friction_changes = {{"floor", rate / units.load_factor}};
  return request;
}

// The floor moves by L per load factor and takes the node along until k s = mu(s) N; then the node slides, with the
// force mu(s) N, and the dissipation is the integral of mu N (1 - r N / k) ds.
TEST(FrictionChanges, ASlidingNodeBearsWhatFrictionIs) {
  for (const Units& units : kUnits)
    for (const double rate : {0.3, -0.25})
      for (const bool mirrored : {false, true})
        for (const FrictionLaw law : {FrictionLaw::kIncremental, FrictionLaw::kTotal}) {
          constexpr double kFriction = 0.4;
          SCOPED_TRACE(testing::Message()
                       << "length " << units.length << ", load factor " << units.load_factor << ", rate " << rate
                       << (mirrored ? ", mirrored" : "") << (law == FrictionLaw::kTotal ? ", total" : ""));
          TraceRequest request = Slider(units, kFriction, rate);
          request.scene.obstacle_motions = {{"floor", units.length / units.load_factor, 0.0}};
          request.options.friction_law = law;
          request.options.stop = {{"load_factor", ">", 1.2 * units.load_factor}};
          const TracedPath path = TraceProved(mirrored ? Mirror(request) : request);
          const double grips = kFriction * kPress / (kSpring - rate * kPress);  // until there
          const double slides = kPress * (1.0 - rate * kPress / kSpring);
          bool slid = false, grip = false;
          for (const Increment& increment : path.increments) {
            const double s = increment.load_factor / units.load_factor, mu = kFriction + rate * s;
            const double u = (mirrored ? -1.0 : 1.0) * increment.positions[0] / units.length;
            const double rt = (mirrored ? -1.0 : 1.0) * increment.contacts[0].rt / units.force;
            if (s < grips - kExact) {
              EXPECT_NEAR(u, s, kExact);
              EXPECT_NEAR(rt, kSpring * s, 10.0 * kExact);
              continue;
            }
            grip = grip || std::abs(s - grips) < kExact;
            slid = true;
            EXPECT_NEAR(rt, mu * kPress, 10.0 * kExact);
            EXPECT_NEAR(u, mu * kPress / kSpring, kExact);
            EXPECT_NEAR(increment.dissipation / (units.force * units.length),
                        slides * (kFriction * (s - grips) + 0.5 * rate * (s * s - grips * grips)), 10.0 * kExact);
          }
          EXPECT_TRUE(slid && grip);
        }
}

// Where nothing slides, the path ends where mu is 0, and the same where the node slides there.
TEST(FrictionChanges, ThePathEndsWhereFrictionIsGone) {
  for (const Units& units : kUnits)
    for (const double floor_moves : {0.0, 1.0})
      for (const double side : {1.0, -1.0}) {
        SCOPED_TRACE(testing::Message() << "length " << units.length << ", load factor " << units.load_factor
                                        << ", moves " << floor_moves << ", side " << side);
        TraceRequest request = Slider(units, 0.4, -0.5 * side);
        request.options.direction = side;
        if (floor_moves > 0.0) request.scene.obstacle_motions = {{"floor", units.length / units.load_factor, 0.0}};
        const TracedPath path =
            TraceTo(request, EndReason::kPathEnd, "the friction of obstacle floor falls to 0 at load factor ");
        EXPECT_FALSE(path.result.reached);
        const Increment& last = path.increments.back();
        EXPECT_NEAR(last.load_factor * side / units.load_factor, 0.8, kLeft);
        EXPECT_NEAR(last.contacts[0].rt / units.force, 0.0, 3.0 * kLeft);
        EXPECT_NEAR(last.positions[0] / units.length, 0.0, 3.0 * kLeft);
      }
}

// A stop criterion for the friction force is met where it has this value, not where the force over what is left of
// friction has it.
TEST(FrictionChanges, TheForceOnRecordIsTheOneWatched) {
  TraceRequest request = Slider({}, 0.4, 0.3);
  request.scene.obstacle_motions = {{"floor", 1.0, 0.0}};
  request.options.stop = {{"b@floor.rt", ">", 1.1}};
  const TracedPath path = TraceProved(request);
  EXPECT_NEAR(path.increments.back().contacts[0].rt, 1.1, kExact);
  EXPECT_NEAR(path.increments.back().load_factor, (1.1 / kPress - 0.4) / 0.3, kExact);
}

// Pushed by P in a first stage, a node slides in the second one as soon as mu N < P: k u = P - mu N. A third stage goes
// on from where the second one left mu; the last one takes all back.
TEST(FrictionChanges, StagesGoOnFromEachOther) {
  for (const Units& units : kUnits)
    for (const bool own : {false, true}) {
      SCOPED_TRACE(testing::Message() << "length " << units.length << (own ? ", of the contact" : ""));
      constexpr double kFriction = 0.5, kPush = 0.8;
      TraceRequest request = Slider(units, own ? 0.9 : kFriction, 0.0);
      request.scene.friction_changes.clear();
      if (own) request.scene.contacts[0].friction = kFriction;
      request.program.resize(4);
      request.program[0].loads = {{"b", kPush * units.force, 0.0, false}};
      request.program[1].friction_changes = {{"floor", -0.3 / units.load_factor}};
      request.program[1].target = units.load_factor;
      request.program[2].friction_changes = {{"floor", -0.1}};
      request.program[3].unload = true;
      const TracedPath path = TraceProved(request);
      for (const Increment& increment : path.increments) {
        const double s = increment.load_factor / (increment.stage == 2 ? units.load_factor : 1.0);
        const double mu = increment.stage == 1   ? kFriction
                          : increment.stage == 2 ? kFriction - 0.3 * s
                          : increment.stage == 3 ? kFriction - 0.3 - 0.1 * s
                                                 : kFriction - 0.4 * (1.0 - s);
        const double push = increment.stage == 1 ? s * kPush : increment.stage == 4 ? (1.0 - s) * kPush : kPush;
        const double u = increment.positions[0] / units.length, most = (kPush - 0.1 * kPress) / kSpring;
        if (increment.stage < 4)
          EXPECT_NEAR(u, std::max(0.0, push - mu * kPress) / kSpring, kExact);
        else  // friction holds it as long as its spring pulls with less
          EXPECT_NEAR(u, std::min(most, (push + mu * kPress) / kSpring), kExact);
        EXPECT_NEAR(increment.contacts[0].rt / units.force, kSpring * u - push, 10.0 * kExact);
      }
    }
}

// A stage whose friction ends before its target.
TEST(FrictionChanges, AStageDoesNotGoBeyondItsFriction) {
  TraceRequest request = Slider({}, 0.5, 0.0);
  request.scene.friction_changes.clear();
  request.program.resize(2);
  request.program[0].friction_changes = {{"floor", -0.4}};
  request.program[1].friction_changes = {{"floor", -0.2}};
  const TracedPath path = TraceTo(request, EndReason::kPathEnd);
  EXPECT_EQ(path.increments.back().stage, 2);
  EXPECT_NEAR(path.increments.back().load_factor, 0.5, kLeft);
}

// Resumed from any of its increments, the path is the same.
TEST(FrictionChanges, APathIsResumed) {
  TraceRequest request = Slider({}, 0.4, 0.3);
  request.scene.obstacle_motions = {{"floor", 1.0, 0.0}};
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceProved(request);
  for (const std::size_t kept : {std::size_t{3}, path.increments.size() - 2}) {
    const TracedPath resumed = ResumeAfter(kept, path);
    ExpectSameEvents(resumed, path, kExact);
    EXPECT_NEAR(resumed.increments.back().dissipation, path.increments.back().dissipation, kExact);
    EXPECT_NEAR(resumed.increments.back().contacts[0].rt, path.increments.back().contacts[0].rt, kExact);
  }
}

// A box under its weight slides down a slope where mu = tan(slope).
TEST(FrictionChanges, ABoxSlidesWhereFrictionIsTheSlope) {
  for (const Units& units : kUnits)
    for (const double degrees : {5.0, 20.0, 35.0})
      for (const bool mirrored : {false, true}) {
        SCOPED_TRACE(testing::Message() << "length " << units.length << ", degrees " << degrees
                                        << (mirrored ? ", mirrored" : ""));
        const double slope = degrees * M_PI / 180.0, c = std::cos(slope), s = std::sin(slope);
        const auto at = [&](double along, double above) {
          return std::pair(units.length * (c * along - s * above), units.length * (s * along + c * above));
        };
        Scene scene;
        const auto [x, y] = at(0.0, 0.1);
        scene.bodies = {{"box", x, y}};
        for (const auto& [name, along] : {std::pair("back", -1.0), std::pair("front", 1.0)}) {
          const auto [px, py] = at(along, 0.0);
          scene.nodes.push_back(NodeOf("box", name, px, py));
          scene.contacts.push_back({name, "slope"});
        }
        scene.obstacles = {HalfPlane("slope", -s, c, 1.0)};
        scene.loads = {LoadOnBody("box", 0.0, -units.force, true)};
        scene.friction_changes = {{"slope", -0.5 / units.load_factor}};
        const TracedPath path =
            TraceTo(mirrored ? Mirror(RequestUpToALimit(scene)) : RequestUpToALimit(scene), EndReason::kAtLimit);
        EXPECT_NEAR(LargestLoadFactor(path) / units.load_factor, (1.0 - std::tan(slope)) / 0.5, kGives);
      }
}

// A ladder against a wall, its weight in the middle, holds as long as tan(angle) >= (1 - mu_f mu_w) / (2 mu_f).
TEST(FrictionChanges, ALadderSlipsWhereTheFloorNoLongerHoldsIt) {
  for (const double length : {1e-2, 1.0, 300.0})
    for (const double degrees : {50.0, 65.0})
      for (const double of_wall : {0.05, 0.3}) {
        SCOPED_TRACE(testing::Message() << "length " << length << ", degrees " << degrees << ", wall " << of_wall);
        const double angle = degrees * M_PI / 180.0, x = length * std::cos(angle), y = length * std::sin(angle);
        TraceRequest request;
        Scene& scene = request.scene;
        scene.bodies = {{"ladder", 0.5 * x, 0.5 * y}};
        scene.nodes = {NodeOf("ladder", "foot", x, 0.0), NodeOf("ladder", "head", 0.0, y)};
        scene.obstacles = {HalfPlane("floor", 0.0, 1.0, 1.0), HalfPlane("wall", 1.0, 0.0, of_wall)};
        scene.contacts = {{"foot", "floor"}, {"head", "wall"}};
        scene.loads = {LoadOnBody("ladder", 0.0, -1.0, true)};
        scene.friction_changes = {{"floor", -1.0}};
        request.options.at_limit = AtLimit::kStop;
        request.options.record = {"inner"};
        const TracedPath path = TraceTo(request, EndReason::kAtLimit);
        const double critical = 1.0 / (2.0 * std::tan(angle) + of_wall);
        EXPECT_NEAR(1.0 - LargestLoadFactor(path), critical, kGives);
      }
}

// A disc of the weight W between two fingers that press with N slips at mu = W / (2 N).
TEST(FrictionChanges, ADiscSlipsOutOfAGrip) {
  for (const Units& units : kUnits)
    for (const double weight : {0.3, 1.1}) {
      SCOPED_TRACE(testing::Message() << "length " << units.length << ", weight " << weight);
      Scene scene;
      scene.bodies = {{"disc", 0.0, 0.0}};
      scene.obstacles = {Circle("rim", 0.0, 0.0, units.length, 0.9, "disc")};
      const double k = 4.0 * units.force / units.length;
      for (const auto& [name, side] : {std::pair("left", -1.0), std::pair("right", 1.0)}) {
        scene.nodes.push_back({name, side * units.length, 0.0, false, true});
        scene.superelements.push_back({{name}, {k, 0.0, 0.0, k}});
        scene.contacts.push_back({name, "rim"});
        scene.loads.push_back({name, -side * units.force, 0.0, true});
      }
      scene.loads.push_back(LoadOnBody("disc", 0.0, -weight * units.force, true));
      scene.friction_changes = {{"rim", -0.4 / units.load_factor}};
      const TracedPath path = TraceTo(RequestUpToALimit(scene), EndReason::kAtLimit);
      EXPECT_NEAR(LargestLoadFactor(path) / units.load_factor, (0.9 - 0.5 * weight) / 0.4, kGives);
    }
}

// A disc on a floor under a moment M, held by a spring at its hub, slips where mu W = M / r, and spins there.
TEST(FrictionChanges, ARollingDiscSlips) {
  for (const double radius : {1e-3, 1.0, 1e3}) {
    SCOPED_TRACE(radius);
    Scene scene;
    scene.bodies = {{"disc", 0.0, radius}};
    scene.nodes = {NodeOf("disc", "hub", 0.0, radius)};
    scene.superelements = {{{"hub"}, {2.0 / radius, 0.0, 0.0, 0.0}}};
    scene.obstacles = {Circle("rim", 0.0, radius, radius, 0.0, "disc"), HalfPlane("floor", 0.0, 1.0, 0.5)};
    scene.contacts = {Rolls("rim", "floor")};
    scene.loads = {LoadOnBody("disc", 0.0, -1.0, true, -0.2 * radius)};
    scene.friction_changes = {{"floor", -0.25}};
    const TracedPath path = TraceVerified(RequestWithin(60, scene));
    EXPECT_NEAR(LargestLoadFactor(path), 1.2, kGives) << path.result.message;
  }
}

// A node that a bar pulls up in a bowl whose friction changes: energies balance, and what is on record is proved.
TEST(FrictionChanges, OnCurves) {
  for (const double rate : {-0.2, 0.3})
    for (const double turn : {0.0, 0.1}) {
      SCOPED_TRACE(testing::Message() << "rate " << rate << ", turn " << turn);
      Scene scene;
      scene.nodes = {{"b", 0.0, -2.0}, {"pull", 1.5, -2.0, true, true}};
      scene.bars = {{{"b", "pull"}, 2.0}};
      scene.obstacles = {{"bowl", ObstacleShape::kCircle, 0.0, 0.0, 0.0, 0.0, 0.3, 2.0}};
      scene.obstacles[0].inside = true;
      scene.contacts = {{"b", "bowl"}};
      scene.loads = {{"b", 0.0, -1.0, true}};
      scene.support_motions = {{"pull", 1.0, 0.2}};
      if (turn != 0.0) scene.obstacle_motions = {{"bowl", 0.0, 0.0, turn}};
      scene.friction_changes = {{"bowl", rate}};
      const TracedPath path = TraceUntil({"load_factor", ">", 1.2}, scene);
      int slides = 0;
      for (const Increment& increment : path.increments) {
        const ContactRecord& contact = increment.contacts[0];
        if (!Slips(contact.state)) continue;
        ++slides;
        EXPECT_NEAR(std::abs(contact.rt), (0.3 + rate * increment.load_factor) * contact.rn, kExact);
      }
      EXPECT_GT(slides, 5);
      EXPECT_LT(EnergyImbalance(path), 1e-7);
    }
}

// Each change of a sound request breaks one rule.
TEST(FrictionChanges, WhatIsNotSoundIsRefusedByName) {
  using Change = void (*)(TraceRequest*);
  const std::pair<Change, const char*> kBroken[] = {
      {[](TraceRequest* r) { r->scene.friction_changes[0].obstacle = "ceiling"; },
       "scene.friction_changes[0].obstacle = ceiling: "},
      {[](TraceRequest* r) {
         r->scene.friction_changes.push_back({"floor", 0.2});
       },
       "scene.friction_changes[1].obstacle = floor: must not be repeated"},
      {[](TraceRequest* r) { r->scene.friction_changes[0].rate = 0.0; },
       "scene.friction_changes[0].rate = 0: must not be 0"},
      {[](TraceRequest* r) { r->scene.friction_changes[0].rate = INFINITY; },
       "scene.friction_changes[0].rate = .inf: must be finite"},
      {[](TraceRequest* r) { r->scene.obstacles[0].friction = 0.0; },
       "scene.friction_changes[0].obstacle = floor: must have friction > 0 at load factor 0, or its contact b@floor "
       "must"},
      {[](TraceRequest* r) {
         r->scene.obstacles.push_back(HalfPlane("wall", 1.0, 0.0, 0.2));
         r->scene.friction_changes[0].obstacle = "wall";
       },
       "scene.friction_changes[0].obstacle = wall: must be the obstacle of a contact"},
      {[](TraceRequest* r) { r->scene.loads.clear(); },
       "scene.loads = []: must have a load that presses a contact where friction alone changes"},
      {[](TraceRequest* r) {
         r->scene.loads.push_back({"b", 1.0, 0.0, false});
         r->options.machine_stiffness = 1.0;
       },
       "scene.friction_changes: must be empty where a machine loads the structure"},
      {[](TraceRequest* r) {
         r->program.resize(1);
         r->program[0].friction_changes = r->scene.friction_changes;
       },
       "scene.friction_changes: must be empty where there is a program"},
      {[](TraceRequest* r) {
         r->program.resize(2);
         std::swap(r->program[0].friction_changes, r->scene.friction_changes);
         r->program[1].unload = true;
         r->program[1].friction_changes = r->program[0].friction_changes;
       },
       "program[1].friction_changes: must be empty where the stage unloads"},
      {[](TraceRequest* r) { r->scene.friction_changes.clear(); },
       "scene.loads = no net force: a load that is not constant must act on a free component, a support or an obstacle "
       "must move, or friction must change"},
  };
  EXPECT_TRUE(Validate(Slider({}, 0.5, -0.1)).empty());
  for (const auto& [change, line] : kBroken) {
    TraceRequest request = Slider({}, 0.5, -0.1);
    change(&request);
    const std::vector<Violation> violations = Validate(request);
    ASSERT_EQ(violations.size(), 1U) << line;
    EXPECT_EQ(violations[0].ToLine().substr(0, std::string(line).size()), line);
  }
}

}  // namespace
}  // namespace contact_path::friction_changes_test
