// Paths of frames, by both methods, against closed forms and published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/beams.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::beam_paths_test {
namespace {

// From (0, 0), of length 1 along x, EI = 1.
TraceRequest Cantilever(int segments) {
  TraceRequest request;
  request.scene.nodes = {{"a", 0.0, 0.0, true, true, true}, {"b", 1.0, 0.0}};
  request.scene.beams = {Between("leg", "a", "b", 1e6, 1.0, segments)};
  return request;
}

Load Force(const std::string& node, double fx, double fy) { return {node, fx, fy}; }

double Rotation(const TracedPath& path, const Increment& increment, const std::string& node) {
  return increment.rotations[NodeNumber(path.request.scene, node)];
}

// Values of the elastica: P L^2 / EI, (L - x)/L, y/L of the tip.
struct TipOfElastica {
  double load, u, w;
};
constexpr TipOfElastica kElastica[] = {
    {1.0, 0.056433, 0.301721}, {2.0, 0.160642, 0.493457}, {5.0, 0.387628, 0.713792}, {10.0, 0.554996, 0.810609}};

// Largest error of the tip at the loads of the table.
double ErrorOfElastica(int segments, Method method) {
  TraceRequest request = Cantilever(segments);
  double reached = 0.0;
  for (const TipOfElastica& tip : kElastica) {
    request.program.push_back(LoadingStage({Force("b", 0.0, 1.0)}, tip.load - reached));
    reached = tip.load;
  }
  request.options.method = method;
  request.options.max_increments = 3000;
  const TracedPath path = TraceTo(request);
  double error = 0.0;
  for (int stage = 1; stage <= static_cast<int>(std::size(kElastica)); ++stage) {
    const Increment& increment = LastOfStage(path, stage);
    const TipOfElastica& tip = kElastica[stage - 1];
    error = std::max({error, std::abs(1.0 - PositionX(path, increment, "b") - tip.u),
                      std::abs(PositionY(path, increment, "b") - tip.w)});
  }
  return error;
}

TEST(BeamPaths, ElasticaOfTheSecondOrder) {
  const double coarse = ErrorOfElastica(10, Method::kBranch), fine = ErrorOfElastica(20, Method::kBranch);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

// Neither axial stiffness nor the number of segments makes increments shorter.
TEST(BeamPaths, IncrementsAreAsLongForFineAndForSlenderBeams) {
  const auto increments = [](int segments, double EA) {
    TraceRequest request = Cantilever(segments);
    request.scene.beams[0].EA = EA;
    request.scene.loads = {Force("b", 0.0, 1.0)};
    request.options.stop = {{"load_factor", ">", 10.0}};
    const TracedPath path = TraceTo(request);
    return static_cast<double>(path.increments.size());
  };
  const double usual = increments(20, 1e6);
  EXPECT_LT(usual, 250.0);
  EXPECT_LT(increments(80, 1e6), usual);
  EXPECT_NEAR(increments(20, 1e4), usual, 0.02 * usual);
  EXPECT_NEAR(increments(20, 1e8), usual, 0.02 * usual);
}

TEST(BeamPaths, TooSlenderABeamIsNamed) {
  TraceRequest request = Cantilever(20);
  request.scene.beams[0].EA = 1e12;
  request.scene.loads = {Force("b", 0.0, 1.0)};
  const TracedPath path = TraceVerified(request);
  // Rounding decides how far the path comes: what it has is proved, and an early end names the cause.
  const bool early = path.result.reason != EndReason::kMaxIncrements;
  EXPECT_EQ(path.result.message.find("EA L^2 / EI of beam leg is 1e+12") != std::string::npos, early)
      << path.result.message;
}

TEST(BeamPaths, ElasticaByMpec) { EXPECT_LT(ErrorOfElastica(10, Method::kMpec), 6e-3); }

// An end moment 4 pi EI / L rolls the beam up to two turns: the nodes are on a circle, of which the segments are
// chords.
TEST(BeamPaths, RollsUpTwice) {
  TraceRequest request = Cantilever(20);
  request.scene.beams[0].EA = 1e4;
  request.scene.loads = {{"b", 0.0, 0.0, false, 4.0 * M_PI}};
  request.options.max_increments = 3000;
  request.options.stop = {{"b.rotation", ">", 4.0 * M_PI}};
  const TracedPath path = TraceTo(request);
  for (const Increment& increment : path.increments) {
    // Each segment turns by M / EI times its length.
    const double turn = increment.load_factor * 4.0 * M_PI / 20.0;
    EXPECT_NEAR(Rotation(path, increment, "b"), 20.0 * turn, 1e-8);
    double x = 0.0, y = 0.0;
    for (int i = 0; i < 20; ++i) {
      x += std::cos((i + 0.5) * turn) / 20.0;
      y += std::sin((i + 0.5) * turn) / 20.0;
    }
    EXPECT_NEAR(PositionX(path, increment, "b"), x, 1e-8);
    EXPECT_NEAR(PositionY(path, increment, "b"), y, 1e-8);
  }
}

TEST(BeamPaths, RotationOfASupport) {
  // One end turned by 1, the other clamped: M = 4 EI / L and 2 EI / L for small rotations.
  TraceRequest request = Cantilever(20);
  request.scene.nodes[1] = {"b", 1.0, 0.0, false, true, true};
  request.scene.support_motions = {{"b", 0.0, 0.0, 1e-3}};
  request.options.stop = {{"load_factor", ">", 1.0}};
  for (const Method method : kMethods) {
    request.options.method = method;
    const TracedPath path = TraceTo(request);
    const double turn = Rotation(path, path.increments.back(), "b");
    EXPECT_NEAR(turn, 1e-3 * path.increments.back().load_factor, 1e-14);
    EXPECT_NEAR(path.increments.back().strain_energy / (2.0 * turn * turn), 1.0, 1e-4);
  }
}

TEST(BeamPaths, ColumnBucklesAtEulersLoad) {
  TraceRequest request = Cantilever(20);
  request.scene.loads = {Force("b", -1.0, 0.0)};
  request.options.stop = {{"load_factor", ">", 3.0}};
  const TracedPath path = TraceIncrements(request);
  const Increment bifurcation = IncrementsOfKind(path, IncrementKind::kBifurcation).at(0);
  ExpectNear(LoadsOfKind(path, IncrementKind::kBifurcation), {M_PI * M_PI / 4.0}, 2e-3);
  EXPECT_FALSE(bifurcation.event.null_vector.empty());
}

// The buckled column, taken by a small imperfection: P / P_cr at tip rotations of 20, 40, 60 and 100 degrees.
TEST(BeamPaths, BuckledColumn) {
  const struct {
    double degrees, share;
  } table[] = {{20.0, 1.015397}, {40.0, 1.063663}, {60.0, 1.151720}, {100.0, 1.518388}};
  TraceRequest request = Cantilever(40);
  request.scene.loads = {Force("b", -1.0, 1e-6)};
  request.options.max_increments = 3000;
  request.options.stop = {{"b.rotation", ">", 110.0 * M_PI / 180.0}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  for (const auto& row : table) {
    const double wanted = row.degrees * M_PI / 180.0;
    std::size_t i = 1;
    while (Rotation(path, path.increments[i], "b") < wanted) ++i;
    const Increment &before = path.increments[i - 1], &after = path.increments[i];
    const double from = Rotation(path, before, "b"), to = Rotation(path, after, "b");
    const double load = before.load_factor + (wanted - from) / (to - from) * (after.load_factor - before.load_factor);
    EXPECT_NEAR(load / (M_PI * M_PI / 4.0), row.share, 1e-3) << row.degrees;
  }
}

// Loads of the smooth limit points of an example scene.
std::vector<double> LimitLoads(TraceRequest request) {
  request.options.max_increments = 5000;
  const TracedPath path = TraceTo(request);
  return LoadsOfKind(path, IncrementKind::kSmoothLimit);
}

TEST(BeamPaths, LeeFrame) {
  const std::vector<double> loads = LimitLoads(ReadExample("lee_frame"));
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_NEAR(loads[0], 1.8557, 4e-3);
  EXPECT_NEAR(loads[1], -0.942, 6e-3);
}

TEST(BeamPaths, WilliamsToggle) {
  const std::vector<double> loads = LimitLoads(ReadExample("williams_toggle"));
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_NEAR(loads[0], 33.86, 0.1);
  EXPECT_NEAR(loads[1], 31.26, 0.1);
}

TEST(BeamPaths, HingesActAsJoints) {
  // A beam that is hinged at both ends is a bar: an arch of two of them is a von Mises truss.
  TraceRequest request;
  request.scene.nodes = {{"a", -1.0, 0.0, true, true}, {"top", 0.0, 0.5}, {"b", 1.0, 0.0, true, true}};
  for (const char* const end : {"a", "b"}) {
    Beam beam = Between(std::string("to_") + end, end, "top", 1.0, 1.0, 1);
    beam.hinged = {true, true};
    request.scene.beams.push_back(beam);
  }
  request.scene.loads = {Force("top", 0.0, -1.0)};
  request.options.stop = {{"top.y", "<", 0.0}};
  const TracedPath path = TraceIncrements(request);
  const double l0 = std::sqrt(1.25), c = 1.0 / l0;
  ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), {2.0 * std::pow(1.0 - std::pow(c, 2.0 / 3.0), 1.5)}, 1e-9);
}

// Dead load p per length on a cantilever: small displacements p L^4 / (8 EI).
TEST(BeamPaths, TractionOnABeam) {
  TraceRequest request = Cantilever(20);
  request.scene.loads = {LoadOnGroup("leg", 0.0, -1e-3)};
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceTo(request);
  const Increment& last = path.increments.back();
  EXPECT_NEAR(-8.0 * PositionY(path, last, "b") / (1e-3 * last.load_factor), 1.0, 2e-3);
}

TEST(BeamPaths, UnitsDoNotMatter) {
  TraceRequest metres = Cantilever(10);
  metres.scene.loads = {Force("b", -0.5, 1.0)};
  metres.options.max_increments = 40;
  TraceRequest millimetres = metres;
  for (Node& node : millimetres.scene.nodes) node.x *= 1000.0;
  millimetres.scene.beams[0].EI *= 1e6;
  const TracedPath a = TraceIncrements(metres), b = TraceIncrements(millimetres);
  ASSERT_EQ(a.increments.size(), b.increments.size());
  for (std::size_t i = 0; i < a.increments.size(); ++i) {
    EXPECT_NEAR(a.increments[i].load_factor, b.increments[i].load_factor, 1e-7 * (1.0 + a.increments[i].load_factor));
    EXPECT_NEAR(1000.0 * PositionY(a, a.increments[i], "b"), PositionY(b, b.increments[i], "b"), 1e-5);
    EXPECT_NEAR(Rotation(a, a.increments[i], "b"), Rotation(b, b.increments[i], "b"), 1e-7);
  }
}

// A frame far larger than its bays: rounding of its coordinates must not end the path.
TEST(BeamPaths, FrameOfManyBays) {
  constexpr int kBays = 15;
  TraceRequest request;
  const auto name = [](int column, int row) { return "n" + std::to_string(column) + "_" + std::to_string(row); };
  for (int row = 0; row <= kBays; ++row)
    for (int column = 0; column <= kBays; ++column) {
      const bool clamped = row == 0;
      request.scene.nodes.push_back({name(column, row), 1.0 * column, 1.0 * row, clamped, clamped, clamped});
      if (row == 0) continue;
      request.scene.beams.push_back(Between("", name(column, row - 1), name(column, row), 1e3, 1.0, 4));
      if (column == 0)
        request.scene.loads.push_back(Force(name(0, row), 1.0, 0.0));
      else
        request.scene.beams.push_back(Between("", name(column - 1, row), name(column, row), 1e3, 1.0, 4));
    }
  request.options.max_increments = 6;
  const TracedPath path = TraceTo(request, EndReason::kMaxIncrements);
  EXPECT_GT(path.increments.back().arc_length, 0.5);
}

// For small loads the ends of the arch stick if mu > |H / V| of linear theory, and slip otherwise.
TEST(BeamPaths, EndsOfAnArchStickOrSlip) {
  for (const double degrees : {30.0, 60.0, 90.0, 120.0, 135.0, 160.0, 170.0}) {
    const double a = degrees * M_PI / 180.0, ratio = ThrustOfArch(a);
    for (const double factor : {0.9, 1.1}) {
      SCOPED_TRACE(std::to_string(degrees) + " degrees, friction " + std::to_string(factor) + " H / V");
      const TracedPath path = TraceVerified(RestingArch(a, factor * std::abs(ratio), 1e6, 16));
      ASSERT_GE(path.increments.size(), 2u) << path.result.message;
      // Ends slip outwards below 141.549 degrees, and inwards above.
      const ContactState slip = ratio > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus;
      const ContactState expected = factor > 1.0 ? ContactState::kStick : slip;
      EXPECT_EQ(ToString(Contact(path, path.increments[1], "right@floor").state), ToString(expected));
    }
  }
}

// While both ends slip, nothing holds the arch sideways: it must not drift. It sags through its springing line.
TEST(BeamPaths, ArchThatNothingHoldsSideways) {
  TraceRequest request = RestingArch(M_PI / 2.0, 0.4, 1e5, 16);
  request.scene.nodes[1].fixed_x = false;
  request.options.max_increments = 2000;
  request.options.stop = {{"crown.y", "<", -0.5}};
  const TracedPath path = TraceTo(request);
  for (const Increment& increment : path.increments) {
    EXPECT_NEAR(PositionX(path, increment, "crown"), 0.0, 1e-6);
    EXPECT_NEAR(PositionX(path, increment, "left"), -PositionX(path, increment, "right"), 1e-6);
  }
}

}  // namespace
}  // namespace contact_path::beam_paths_test
