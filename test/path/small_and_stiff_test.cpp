// What is small beside what is stiff: slender parts that supports push, stiff parts under light loads, margins of
// friction that are zero, contacts without a reaction, coordinates far from the origin, symmetric parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

#include "contact_path/scene/read_scene.h"
#include "support/traced_path.h"

namespace contact_path::small_and_stiff_test {
namespace {

// Sums of texts and numbers.
template <typename... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  return out.str();
}

TracedPath Trace(const std::string& text) { return TraceIncrements(ReadTraceRequest(text, "test")); }

TracedPath TraceToItsEnd(const std::string& text) {
  const TracedPath path = TraceProved(ReadTraceRequest(text, "test"));
  return path;
}

// Clamped at both ends, one of which comes nearer by 0.1 of the length, with a small load across.
std::string PushedColumn(double EA) {
  return Text(
      "scene:\n  nodes:\n"
      "  - {name: a, fixed_x: true, fixed_y: true, fixed_rotation: true}\n"
      "  - {name: b, x: 1.0, fixed_x: true, fixed_y: true, fixed_rotation: true}\n"
      "  beams:\n  - {name: c, nodes: [a, b], EA: ",
      EA,
      ", EI: 1.0, segments: 20}\n"
      "  loads:\n  - {node: \"c/10\", fy: 0.001, constant: true}\n"
      "program:\n- {support_motions: [{node: b, dx: -0.1}]}\n"
      "options: {max_increments: 3000}\n");
}

// The end of a leaning beam is pressed onto a floor.
std::string PressedBristle(double EA) {
  return Text(
      "scene:\n  nodes:\n"
      "  - {name: a, y: 1.0, fixed_x: true, fixed_y: true, fixed_rotation: true}\n"
      "  - {name: b, x: 0.02}\n"
      "  beams:\n  - {name: c, nodes: [a, b], EA: ",
      EA,
      ", EI: 1.0, segments: 20}\n"
      "  obstacles:\n  - {name: floor, ny: 1.0, friction: 0.3}\n"
      "  contacts:\n  - {node: b, obstacle: floor}\n"
      "program:\n- {support_motions: [{node: a, dy: -0.1}]}\n"
      "options: {max_increments: 3000}\n");
}

TEST(SmallAndStiff, WhatIsPushedTakesStepsThatDoNotDependOnItsStiffness) {
  for (const auto& scene : {PushedColumn, PressedBristle}) {
    const std::size_t increments = TraceToItsEnd(scene(1e3)).increments.size();
    for (const double EA : {1e2, 1e4, 1e5, 1e6, 1e7}) {
      SCOPED_TRACE(EA);
      const TracedPath path = Trace(scene(EA));
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
      EXPECT_LE(path.increments.size(), 2 * increments);
    }
  }
}

// A half circle of blocks with narrower faces towards the next one, under its weight 1, and the same to the side by the
// load factor. E: over weight and radius. Units: of length and force.
std::string ArchOfBlocks(int blocks, double thickness, double E, double length = 1.0, double force = 1.0) {
  std::string nodes, solids, groups, contacts, surfaces, loads;
  const double half = 0.5 * thickness, pi = std::acos(-1.0);
  for (int k = 0; k < blocks; ++k) {
    const double area = 0.5 * std::sin(pi / blocks) * (std::pow(1.0 + half, 2) - std::pow(1.0 - half, 2));
    for (const int end : {0, 1})
      for (const int side : {0, 1}) {
        const double angle = pi * (k + end) / blocks, back = k > 0 && end == 0 ? 1e-3 * half : 0.0;
        const double r = side == 0 ? 1.0 - half + back : 1.0 + half - back;
        const std::string name = Text("n", k, "_", side, "_", end);
        nodes += Text("  - {name: ", name, ", x: ", length * r * std::cos(angle), ", y: ", length * r * std::sin(angle),
                      "}\n");
        const double weight = 0.25 * force * area;
        loads += Text("  - {node: ", name, ", fy: ", -weight, ", constant: true}\n  - {node: ", name, ", fx: ", weight,
                      "}\n");
      }
    solids += Text("  - {name: b", k, ", material: m, nodes: [n", k, "_0_0, n", k, "_1_0, n", k, "_1_1, n", k,
                   "_0_1], nodes_per_element: 4}\n");
    groups += Text("  - {name: g", k, ", nodes: [n", k, "_0_0, n", k, "_1_0]}\n");
    contacts += k == 0 ? std::string("  - {group: g0, obstacle: right}\n")
                       : Text("  - {group: g", k, ", surface: f", k - 1, ", friction: 0.8}\n");
    if (k + 1 < blocks) surfaces += Text("  - {name: f", k, ", nodes: [n", k, "_0_1, n", k, "_1_1]}\n");
  }
  const int last = blocks - 1;
  groups += Text("  - {name: left, nodes: [n", last, "_0_1, n", last, "_1_1]}\n");
  contacts += "  - {group: left, obstacle: left}\n";
  return Text("scene:\n  nodes:\n", nodes, "  materials:\n  - {name: m, model: neo_hookean, E: ", E * force / length,
              "}\n  solids:\n", solids,
              "  obstacles:\n  - {name: right, ny: 1.0, friction: 0.8}\n  - {name: left, ny: 1.0, friction: 0.8}\n"
              "  groups:\n",
              groups, "  contacts:\n", contacts, "  surfaces:\n", surfaces, "  loads:\n", loads,
              "options: {max_increments: 40}\n");
}

TEST(SmallAndStiff, LightLoadsHaveTheEventsOfHeavyOnesUpToTheLimit) {
  const auto limit_of = [](const TracedPath& path) {
    const auto& increments = path.increments;
    return std::find_if(increments.begin(), increments.end(), [](const Increment& increment) {
      return increment.kind == IncrementKind::kCornerLimit || increment.kind == IncrementKind::kSmoothLimit;
    });
  };
  for (const double thickness : {0.3, 0.36}) {
    const TracedPath rigid = Trace(ArchOfBlocks(4, thickness, 1e8));
    const auto last = limit_of(rigid);
    ASSERT_NE(last, rigid.increments.end()) << rigid.result.message;
    for (const double E : {1e4, 1e5, 1e6, 1e7, 1e8})
      for (const double unit : {1.0, 1e3}) {
        SCOPED_TRACE(Text(thickness, " E ", E, " unit ", unit));
        const TracedPath path = Trace(ArchOfBlocks(4, thickness, E, unit, 0.5 * unit));
        const auto limit = limit_of(path);
        ASSERT_NE(limit, path.increments.end()) << path.result.message;
        ASSERT_EQ(limit->index, last->index);
        // Soft blocks shorten, by their load over E.
        for (std::size_t i = 1; i <= static_cast<std::size_t>(last->index); ++i) {
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
      SCOPED_TRACE(Text(friction, " EA ", EA));
      std::string program;
      for (const double fx : {1.0, -1.0, 1.0, -1.0})
        program += Text("- {loads: [{node: D, fx: ", fx, "}], target: 2}\n");
      const std::string stiff = Text(", EA: ", EA, ", EI: ", 0.01 * EA, ", segments: 1}\n");
      const TracedPath path = TraceToItsEnd(Text(
          "scene:\n  nodes:\n  - {name: A}\n  - {name: M, x: 0.5}\n  - {name: B, x: 1.0}\n  - {name: D, x: 0.5, y: ",
          -0.5 / friction, "}\n  beams:\n  - {name: am, nodes: [A, M]", stiff, "  - {name: mb, nodes: [M, B]", stiff,
          "  - {name: arm, nodes: [M, D]", stiff,
          "  superelements:\n  - {nodes: [M], stiffness: [1, 0, 0, 0]}\n  - {nodes: [A], stiffness: [0, 0, 0, 0.001]}\n"
          "  - {nodes: [B], stiffness: [0, 0, 0, 0.001]}\n"
          "  obstacles:\n  - {name: floor, py: -0.001, ny: 1.0, friction: ",
          friction, "}\n  - {name: roof, py: 0.001, ny: -1.0, friction: ", friction,
          "}\n  contacts:\n  - {node: A, obstacle: floor}\n  - {node: A, obstacle: roof}\n"
          "  - {node: B, obstacle: floor}\n  - {node: B, obstacle: roof}\nprogram:\n",
          program));
      for (const Increment& increment : path.increments)
        EXPECT_NEAR(PositionX(path, increment, "M"), 0.5, 1e-5 + 100.0 / EA);
    }
}

// A block without friction in a round valley between two ramps of 45 degrees gets its weight 1: it rests, held by its
// reaction alone, and a pull p moves it to where the slope is p.
TEST(SmallAndStiff, WeightInAValleyRests) {
  for (const double radius : {0.01, 0.1, 1.0}) {
    SCOPED_TRACE(radius);
    const TracedPath path =
        TraceToItsEnd(Text("scene:\n  nodes:\n  - {name: block, y: ", radius * (std::sqrt(2.0) - 1.0),
                           "}\n  superelements:\n  - {nodes: [block], stiffness: [0, 0, 0, 1e-3]}\n"
                           "  loads:\n  - {node: block, fy: -1.0, constant: true}\n"
                           "  obstacles:\n  - {name: ground, shape: polyline, points: [-3, 3, 0, 0, 3, 3], fillet: ",
                           radius, "}\n  contacts:\n  - {node: block, obstacle: ground}\n",
                           "program:\n- {loads: [{node: block, fx: 1.0}], target: 0.5}\n"));
    EXPECT_NEAR(path.increments.front().contacts[0].rn, 1.0, 1e-12);
    EXPECT_NEAR(PositionX(path, path.increments.front(), "block"), 0.0, 1e-12);
    EXPECT_NEAR(PositionX(path, path.increments.back(), "block"), radius * 0.5 / std::sqrt(1.25), 1e-3 * radius);
  }
}

// Wherever the origin is.
TEST(SmallAndStiff, ArchFarFromTheOrigin) {
  const auto arch = [](double x, double y) {
    const std::string beam = ", EA: 100000.0, EI: 1.0, segments: 16, angle: -1.0471975511966}\n";
    return Text(
        "scene:\n  nodes:\n  - {name: left, x: ", x - std::sqrt(0.75), ", y: ", y, "}\n  - {name: crown, x: ", x,
        ", y: ", y + 0.5, ", fixed_x: true}\n  - {name: right, x: ", x + std::sqrt(0.75), ", y: ", y,
        "}\n  beams:\n  - {name: l, nodes: [left, crown]", beam, "  - {name: r, nodes: [crown, right]", beam,
        "  loads:\n  - {node: crown, fy: -1.0}\n  obstacles:\n  - {name: floor, ny: 1.0, friction: 1.4, px: ", x,
        ", py: ", y,
        "}\n  contacts:\n  - {node: left, obstacle: floor}\n  - {node: right, obstacle: floor}\n"
        "options: {max_increments: 900, stop: [{quantity: crown.y, when: \"<\", value: ",
        y - 0.2, "}]}\n");
  };
  const TracedPath here = TraceToItsEnd(arch(0.0, 0.0));
  for (const double away : {10.0, 100.0}) ExpectSameEvents(Trace(arch(away, -0.5 * away)), here, 1e-6);
}

// A column between its clamps, pressed against a beam on springs: all is symmetric, and stays so along the path but for
// bifurcations that are on record.
TEST(SmallAndStiff, SymmetricPartsStaySymmetric) {
  for (const double EA : {1e3, 1e4, 1e5, 1e6})
    for (const int segments : {8, 10, 20}) {
      SCOPED_TRACE(Text(EA, ", ", segments));
      std::string names;
      for (int i = 1; i < segments; ++i) names += Text(i > 1 ? ", " : "", "\"c/", i, "\"");
      const TracedPath path = TraceToItsEnd(
          Text("scene:\n  nodes:\n"
               "  - {name: a, fixed_x: true, fixed_y: true, fixed_rotation: true}\n"
               "  - {name: b, x: 1.0, fixed_x: true, fixed_y: true, fixed_rotation: true}\n"
               "  - {name: v, x: -0.1, y: 0.02, fixed_x: true, fixed_rotation: true}\n"
               "  - {name: w, x: 1.1, y: 0.02, fixed_x: true, fixed_rotation: true}\n"
               "  beams:\n  - {name: c, nodes: [a, b], EI: 1.0, EA: ",
               EA, ", segments: ", segments,
               "}\n  - {name: wall, nodes: [v, w], EA: 1e6, EI: 1e5, segments: 4}\n"
               "  superelements:\n  - {nodes: [v], stiffness: [0, 0, 0, 1000]}\n  - {nodes: [w], stiffness: [0, 0, 0, "
               "1000]}\n"
               "  surfaces:\n  - {name: under, nodes: [w, \"wall/3\", \"wall/2\", \"wall/1\", v]}\n"
               "  groups:\n  - {name: g, nodes: [",
               names, "]}\n  contacts:\n  - {group: g, surface: under}\n  loads:\n  - {node: \"c/", segments / 2,
               "\", fy: 0.001, constant: true}\nprogram:\n- {support_motions: [{node: a, dx: 0.5}, {node: b, dx: "
               "-0.5}], target: ",
               120.0 / EA, "}\noptions: {max_increments: 2000}\n"));
      bool crossed = false;
      for (const Increment& increment : path.increments) {
        double apart = 0.0;
        for (int i = 1; i < segments; ++i)
          apart = std::max(apart, std::abs(PositionY(path, increment, Text("c/", i)) -
                                           PositionY(path, increment, Text("c/", segments - i))));
        EXPECT_TRUE(crossed || apart < 1e-6) << increment.index << ": " << apart;
        crossed = crossed || increment.kind == IncrementKind::kBifurcation;
        if (!crossed && apart >= 1e-6) break;
      }
    }
}

}  // namespace
}  // namespace contact_path::small_and_stiff_test
