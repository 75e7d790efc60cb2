// What is small beside what is stiff: slender parts that supports push, stiff parts under light loads, margins of
// friction that are zero, contacts without a reaction, coordinates far from the origin, symmetric parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "support/beams.h"
#include "support/curved_obstacles.h"
#include "support/parts.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::small_and_stiff_test {
namespace {

// A beam of 20 segments with EI = 1 from a clamped support, which moves.
TraceRequest PushedBeam(double EA, const Node& support, const Node& end, const SupportMotion& motion) {
  TraceRequest request;
  request.scene.nodes = {support, end};
  request.scene.beams = {Between("c", support.name, end.name, EA, 1.0, 20)};
  request.program = {MovingStage({motion})};
  request.options.max_increments = 3000;
  return request;
}

// Clamped at both ends, one of which comes nearer by 0.1 of the length, with a small load across.
TraceRequest PushedColumn(double EA) {
  TraceRequest request =
      PushedBeam(EA, {"a", 0.0, 0.0, true, true, true}, {"b", 1.0, 0.0, true, true, true}, {"b", -0.1, 0.0});
  request.scene.loads = {{"c/10", 0.0, 0.001, true}};
  return request;
}

// The end of a leaning beam is pressed onto a floor.
TraceRequest PressedBristle(double EA) {
  TraceRequest request = PushedBeam(EA, {"a", 0.0, 1.0, true, true, true}, {"b", 0.02, 0.0}, {"a", 0.0, -0.1});
  request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  request.scene.contacts = {{"b", "floor"}};
  return request;
}

TEST(SmallAndStiff, WhatIsPushedTakesStepsThatDoNotDependOnItsStiffness) {
  for (const auto& scene : {PushedColumn, PressedBristle}) {
    const std::size_t increments = TraceProved(scene(1e3)).increments.size();
    for (const double EA : {1e2, 1e4, 1e5, 1e6, 1e7}) {
      SCOPED_TRACE(EA);
      const TracedPath path = TraceIncrements(scene(EA));
      ExpectEnd(path, EndReason::kStopCriterion);
      EXPECT_LE(path.increments.size(), 2 * increments);
    }
  }
}

// A half circle of blocks with narrower faces towards the next one, under its weight 1, and the same to the side by the
// load factor. E: over weight and radius. Units: of length and force.
TraceRequest ArchOfBlocks(int blocks, double thickness, double E, double length = 1.0, double force = 1.0) {
  Scene scene;
  const double half = 0.5 * thickness, pi = std::acos(-1.0);
  const auto name = [](int block, int side, int end) {
    return "n" + std::to_string(block) + "_" + std::to_string(side) + "_" + std::to_string(end);
  };
  scene.materials = {ElasticMaterial("m", E * force / length, 0.0)};
  scene.obstacles = {{"right", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.8},
                     {"left", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.8}};
  for (int k = 0; k < blocks; ++k) {
    const double area = 0.5 * std::sin(pi / blocks) * (std::pow(1.0 + half, 2) - std::pow(1.0 - half, 2));
    for (const int end : {0, 1})
      for (const int side : {0, 1}) {
        const double angle = pi * (k + end) / blocks, back = k > 0 && end == 0 ? 1e-3 * half : 0.0;
        const double r = length * (side == 0 ? 1.0 - half + back : 1.0 + half - back);
        scene.nodes.push_back({name(k, side, end), r * std::cos(angle), r * std::sin(angle)});
        const double weight = 0.25 * force * area;
        scene.loads.push_back({name(k, side, end), 0.0, -weight, true});
        scene.loads.push_back({name(k, side, end), weight, 0.0});
      }
    const std::string place = std::to_string(k), before = std::to_string(k - 1);
    scene.solids.push_back(SolidOf("m"));
    scene.solids.back().nodes = {name(k, 0, 0), name(k, 1, 0), name(k, 1, 1), name(k, 0, 1)};
    scene.groups.push_back({"g" + place, {name(k, 0, 0), name(k, 1, 0)}});
    if (k == 0)
      scene.contacts.push_back({"", "right", "g0"});
    else
      scene.contacts.push_back({"", "", "g" + place, "f" + before, 0.8});
    if (k + 1 < blocks) scene.surfaces.push_back({"f" + place, {name(k, 0, 1), name(k, 1, 1)}});
  }
  scene.groups.push_back({"left", {name(blocks - 1, 0, 1), name(blocks - 1, 1, 1)}});
  scene.contacts.push_back({"", "left", "left"});
  return RequestWithin(40, scene);
}

TEST(SmallAndStiff, LightLoadsHaveTheEventsOfHeavyOnesUpToTheLimit) {
  const auto limit_of = [](const TracedPath& path) {
    return FirstThat(path,
                     [](const Increment& increment) {
                       return increment.kind == IncrementKind::kCornerLimit ||
                              increment.kind == IncrementKind::kSmoothLimit;
                     })
        .index;
  };
  for (const double thickness : {0.3, 0.36}) {
    const TracedPath rigid = TraceIncrements(ArchOfBlocks(4, thickness, 1e8));
    const int last = limit_of(rigid);
    for (const double E : {1e4, 1e5, 1e6, 1e7, 1e8})
      for (const double unit : {1.0, 1e3}) {
        SCOPED_TRACE(testing::Message() << thickness << " E " << E << " unit " << unit);
        const TracedPath path = TraceIncrements(ArchOfBlocks(4, thickness, E, unit, 0.5 * unit));
        ASSERT_EQ(limit_of(path), last);
        // Soft blocks shorten, by their load over E.
        for (std::size_t i = 1; i <= static_cast<std::size_t>(last); ++i) {
          EXPECT_EQ(path.increments[i].kind, rigid.increments[i].kind) << i;
          EXPECT_NEAR(path.increments[i].load_factor, rigid.increments[i].load_factor, 1e-6 + 20.0 / E) << i;
        }
      }
  }
}

// A slider of the length 1 in a guide, pushed at just the offset at which friction begins to hold it: forth and back,
// it moves no farther than it is deformed.
TEST(SmallAndStiff, SliderAtTheBindingRatioRests) {
  for (const double friction : {0.25, 0.5, 1.0})
    for (const double EA : {1e5, 1e6}) {
      SCOPED_TRACE(testing::Message() << friction << " EA " << EA);
      TraceRequest request;
      Scene& scene = request.scene;
      scene.nodes = {{"A", 0.0, 0.0}, {"M", 0.5, 0.0}, {"B", 1.0, 0.0}, {"D", 0.5, -0.5 / friction}};
      for (const auto& [from, to] : {std::pair("A", "M"), {"M", "B"}, {"M", "D"}})
        scene.beams.push_back(Between("", from, to, EA, 0.01 * EA, 1));
      scene.superelements = {
          {{"M"}, {1.0, 0.0, 0.0, 0.0}}, {{"A"}, {0.0, 0.0, 0.0, 0.001}}, {{"B"}, {0.0, 0.0, 0.0, 0.001}}};
      scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, -0.001, 0.0, 1.0, friction},
                         {"roof", ObstacleShape::kHalfPlane, 0.0, 0.001, 0.0, -1.0, friction}};
      scene.contacts = {{"A", "floor"}, {"A", "roof"}, {"B", "floor"}, {"B", "roof"}};
      for (const double fx : {1.0, -1.0, 1.0, -1.0}) request.program.push_back(LoadingStage({{"D", fx, 0.0}}, 2.0));
      const TracedPath path = TraceProved(request);
      for (const Increment& increment : path.increments)
        EXPECT_NEAR(PositionX(path, increment, "M"), 0.5, 1e-5 + 100.0 / EA);
    }
}

// A block without friction in a round valley between two ramps of 45 degrees gets its weight 1: it rests, held by its
// reaction alone, and a pull p moves it to where the slope is p.
TEST(SmallAndStiff, WeightInAValleyRests) {
  for (const double radius : {0.01, 0.1, 1.0}) {
    SCOPED_TRACE(radius);
    Scene scene;
    scene.nodes = {{"block", 0.0, radius * (std::sqrt(2.0) - 1.0)}};
    scene.superelements = {{{"block"}, {0.0, 0.0, 0.0, 1e-3}}};
    scene.loads = {{"block", 0.0, -1.0, true}};
    scene.obstacles = {CurveThrough(ObstacleShape::kPolyline, {-3.0, 3.0, 0.0, 0.0, 3.0, 3.0})};
    scene.obstacles[0].fillet = radius;
    scene.contacts = {{"block", "curve"}};
    const TracedPath path = TraceProved(RequestOf(scene, {LoadingStage({{"block", 1.0, 0.0}}, 0.5)}));
    EXPECT_NEAR(path.increments.front().contacts[0].rn, 1.0, 1e-12);
    EXPECT_NEAR(PositionX(path, path.increments.front(), "block"), 0.0, 1e-12);
    EXPECT_NEAR(PositionX(path, path.increments.back(), "block"), radius * 0.5 / std::sqrt(1.25), 1e-3 * radius);
  }
}

// Wherever the origin is.
TEST(SmallAndStiff, ArchFarFromTheOrigin) {
  const auto arch = [](double x, double y) {
    TraceRequest request = RestingArch(std::acos(-1.0) / 3.0, 1.4, 1e5, 16);
    for (Node& node : request.scene.nodes) {
      node.x += x;
      node.y += y;
    }
    request.scene.obstacles[0].px = x;
    request.scene.obstacles[0].py = y;
    request.options.max_increments = 900;
    request.options.stop = {{"crown.y", "<", y - 0.2}};
    return request;
  };
  const TracedPath here = TraceProved(arch(0.0, 0.0));
  for (const double away : {10.0, 100.0}) ExpectSameEvents(TraceIncrements(arch(away, -0.5 * away)), here, 1e-6);
}

// A column between its clamps, pressed against a beam on springs: all is symmetric, and stays so along the path but for
// bifurcations that are on record.
TEST(SmallAndStiff, SymmetricPartsStaySymmetric) {
  for (const double EA : {1e3, 1e4, 1e5, 1e6})
    for (const int segments : {8, 10, 20}) {
      SCOPED_TRACE(testing::Message() << EA << ", " << segments);
      const auto inner = [](int i) { return "c/" + std::to_string(i); };
      TraceRequest request;
      Scene& scene = request.scene;
      scene.nodes = {{"a", 0.0, 0.0, true, true, true},
                     {"b", 1.0, 0.0, true, true, true},
                     {"v", -0.1, 0.02, true, false, true},
                     {"w", 1.1, 0.02, true, false, true}};
      scene.beams = {Between("c", "a", "b", EA, 1.0, segments), Between("wall", "v", "w", 1e6, 1e5, 4)};
      scene.superelements = {{{"v"}, {0.0, 0.0, 0.0, 1000.0}}, {{"w"}, {0.0, 0.0, 0.0, 1000.0}}};
      scene.surfaces = {{"under", {"w", "wall/3", "wall/2", "wall/1", "v"}}};
      scene.groups = {{"g", {}}};
      for (int i = 1; i < segments; ++i) scene.groups[0].nodes.push_back(inner(i));
      scene.contacts = {{"", "", "g", "under"}};
      scene.loads = {{inner(segments / 2), 0.0, 0.001, true}};
      request.program = {MovingStage({{"a", 0.5, 0.0}, {"b", -0.5, 0.0}}, 120.0 / EA)};
      request.options.max_increments = 2000;
      const TracedPath path = TraceProved(request);
      bool crossed = false;
      for (const Increment& increment : path.increments) {
        double apart = 0.0;
        for (int i = 1; i < segments; ++i)
          apart = std::max(
              apart, std::abs(PositionY(path, increment, inner(i)) - PositionY(path, increment, inner(segments - i))));
        EXPECT_TRUE(crossed || apart < 1e-6) << increment.index << ": " << apart;
        crossed = crossed || increment.kind == IncrementKind::kBifurcation;
        if (!crossed && apart >= 1e-6) break;
      }
    }
}

}  // namespace
}  // namespace contact_path::small_and_stiff_test
