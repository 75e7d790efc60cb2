// Paths of frames, by both methods, against closed forms and published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/scene/expand.h"
#include "support/beams.h"
#include "support/traced_path.h"

namespace contact_path::beam_paths_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Node At(const std::string& name, double x, double y) { return {name, x, y}; }

Node Clamped(Node node) {
  node.fixed_x = node.fixed_y = node.fixed_rotation = true;
  return node;
}

Node Pinned(Node node) {
  node.fixed_x = node.fixed_y = true;
  return node;
}

// From (0, 0), of length 1 along x, EI = 1.
TraceRequest Cantilever(int segments) {
  TraceRequest request;
  request.scene.nodes = {Clamped(At("a", 0.0, 0.0)), At("b", 1.0, 0.0)};
  request.scene.beams = {Between("leg", "a", "b", 1e6, 1.0, segments)};
  return request;
}

Load Force(const std::string& node, double fx, double fy) { return {node, fx, fy}; }

Load Moment(const std::string& node, double moment) {
  Load load;
  load.node = node;
  load.moment = moment;
  return load;
}

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
    Stage stage;
    stage.loads = {Force("b", 0.0, 1.0)};
    stage.target = tip.load - reached;
    reached = tip.load;
    request.program.push_back(stage);
  }
  request.options.method = method;
  request.options.max_increments = 3000;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectNoFindings(path);
  double error = 0.0;
  for (std::size_t i = 0; i + 1 < path.increments.size() + 1; ++i) {
    const Increment& increment = path.increments[i];
    const bool ends = i + 1 == path.increments.size() || path.increments[i + 1].stage != increment.stage;
    if (!ends) continue;
    const TipOfElastica& tip = kElastica[increment.stage - 1];
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
    const TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectNoFindings(path);
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
  const TracedPath path = TraceIncrements(request);
  // Rounding decides how far the path comes: what it has is proved, and an early end names the cause.
  ExpectNoFindings(path);
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
  request.scene.loads = {Moment("b", 4.0 * kPi)};
  request.options.max_increments = 3000;
  request.options.stop = {{"b.rotation", ">", 4.0 * kPi}};
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectNoFindings(path);
  for (const Increment& increment : path.increments) {
    // Each segment turns by M / EI times its length.
    const double turn = increment.load_factor * 4.0 * kPi / 20.0;
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
  request.scene.nodes[1] = Clamped(request.scene.nodes[1]);
  request.scene.nodes[1].fixed_x = false;
  SupportMotion motion;
  motion.node = "b";
  motion.rotation = 1e-3;
  request.scene.support_motions = {motion};
  request.options.stop = {{"load_factor", ">", 1.0}};
  for (const Method method : {Method::kBranch, Method::kMpec}) {
    request.options.method = method;
    const TracedPath path = TraceIncrements(request);
    ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectNoFindings(path);
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
  const std::vector<Increment> bifurcations = IncrementsOfKind(path, IncrementKind::kBifurcation);
  ASSERT_EQ(bifurcations.size(), 1u);
  EXPECT_NEAR(bifurcations[0].load_factor, kPi * kPi / 4.0, 2e-3);
  EXPECT_FALSE(bifurcations[0].event.null_vector.empty());
}

// The buckled column, taken by a small imperfection: P / P_cr at tip rotations of 20, 40, 60 and 100 degrees.
TEST(BeamPaths, BuckledColumn) {
  const struct {
    double degrees, share;
  } table[] = {{20.0, 1.015397}, {40.0, 1.063663}, {60.0, 1.151720}, {100.0, 1.518388}};
  TraceRequest request = Cantilever(40);
  request.scene.loads = {Force("b", -1.0, 1e-6)};
  request.options.max_increments = 3000;
  request.options.stop = {{"b.rotation", ">", 110.0 * kPi / 180.0}};
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  for (const auto& row : table) {
    const double wanted = row.degrees * kPi / 180.0;
    std::size_t i = 1;
    while (Rotation(path, path.increments[i], "b") < wanted) ++i;
    const Increment &before = path.increments[i - 1], &after = path.increments[i];
    const double from = Rotation(path, before, "b"), to = Rotation(path, after, "b");
    const double load = before.load_factor + (wanted - from) / (to - from) * (after.load_factor - before.load_factor);
    EXPECT_NEAR(load / (kPi * kPi / 4.0), row.share, 1e-3) << row.degrees;
  }
}

// Loads of the smooth limit points of an example scene.
std::vector<double> LimitLoads(TraceRequest request) {
  request.options.max_increments = 5000;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectNoFindings(path);
  std::vector<double> loads;
  for (const Increment& increment : IncrementsOfKind(path, IncrementKind::kSmoothLimit))
    loads.push_back(increment.load_factor);
  return loads;
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
  request.scene.nodes = {Pinned(At("a", -1.0, 0.0)), At("top", 0.0, 0.5), Pinned(At("b", 1.0, 0.0))};
  for (const char* const end : {"a", "b"}) {
    Beam beam = Between(std::string("to_") + end, end, "top", 1.0, 1.0, 1);
    beam.hinged = {true, true};
    request.scene.beams.push_back(beam);
  }
  request.scene.loads = {Force("top", 0.0, -1.0)};
  request.options.stop = {{"top.y", "<", 0.0}};
  const TracedPath path = TraceIncrements(request);
  const double l0 = std::sqrt(1.25), c = 1.0 / l0;
  const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_NEAR(limits[0].load_factor, 2.0 * std::pow(1.0 - std::pow(c, 2.0 / 3.0), 1.5), 1e-9);
}

// Dead load p per length on a cantilever: small displacements p L^4 / (8 EI).
TEST(BeamPaths, TractionOnABeam) {
  TraceRequest request = Cantilever(20);
  Load load;
  load.group = "leg";
  load.py = -1e-3;
  request.scene.loads = {load};
  request.options.stop = {{"load_factor", ">", 1.0}};
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectNoFindings(path);
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
      Node node = At(name(column, row), column, row);
      request.scene.nodes.push_back(row == 0 ? Clamped(node) : node);
      if (row == 0) continue;
      request.scene.beams.push_back(Between("", name(column, row - 1), name(column, row), 1e3, 1.0, 4));
      if (column == 0)
        request.scene.loads.push_back(Force(name(0, row), 1.0, 0.0));
      else
        request.scene.beams.push_back(Between("", name(column - 1, row), name(column, row), 1e3, 1.0, 4));
    }
  request.options.max_increments = 6;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements) << path.result.message;
  EXPECT_GT(path.increments.back().arc_length, 0.5);
  ExpectNoFindings(path);
}

// A circular arch of half angle a rests with both ends on a rough floor, loaded at its crown. For small loads the ends
// stick if mu > |H / V| of linear theory, and slip otherwise.
double RatioOfArch(double a) {
  const double s = std::sin(a), c = std::cos(a);
  return (s * s / 2.0 - a * s * c + c * (1.0 - c)) / (a / 2.0 + std::sin(2.0 * a) / 4.0 - 2.0 * s * c + a * c * c);
}

TraceRequest RestingArch(double a, double friction) {
  TraceRequest request;
  request.scene.nodes = {At("left", -std::sin(a), 0.0), At("crown", 0.0, 1.0 - std::cos(a)),
                         At("right", std::sin(a), 0.0)};
  request.scene.nodes[1].fixed_x = true;
  for (const auto& [name, first, second] :
       {std::array<const char*, 3>{"l", "left", "crown"}, std::array<const char*, 3>{"r", "crown", "right"}}) {
    Beam beam = Between(name, first, second, 1e6, 1.0, 16);
    beam.angle = -a;
    request.scene.beams.push_back(beam);
  }
  request.scene.loads = {Force("crown", 0.0, -1.0)};
  request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  request.scene.contacts = {{"left", "floor"}, {"right", "floor"}};
  request.options.max_increments = 3;
  return request;
}

TEST(BeamPaths, EndsOfAnArchStickOrSlip) {
  for (const double degrees : {30.0, 60.0, 90.0, 120.0, 135.0, 160.0, 170.0}) {
    const double a = degrees * kPi / 180.0, ratio = RatioOfArch(a);
    for (const double factor : {0.9, 1.1}) {
      SCOPED_TRACE(std::to_string(degrees) + " degrees, friction " + std::to_string(factor) + " H / V");
      const TracedPath path = TraceIncrements(RestingArch(a, factor * std::abs(ratio)));
      ASSERT_GE(path.increments.size(), 2u) << path.result.message;
      ExpectNoFindings(path);
      // Ends slip outwards below 141.549 degrees, and inwards above.
      const ContactState slip = ratio > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus;
      const ContactState expected = factor > 1.0 ? ContactState::kStick : slip;
      EXPECT_EQ(ToString(Contact(path, path.increments[1], "right@floor").state), ToString(expected));
    }
  }
}

// While both ends slip, nothing holds the arch sideways: it must not drift. It sags through its springing line.
TEST(BeamPaths, ArchThatNothingHoldsSideways) {
  TraceRequest request = RestingArch(kPi / 2.0, 0.4);
  request.scene.nodes[1].fixed_x = false;
  for (Beam& beam : request.scene.beams) beam.EA = 1e5;
  request.options.max_increments = 2000;
  request.options.stop = {{"crown.y", "<", -0.5}};
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectNoFindings(path);
  for (const Increment& increment : path.increments) {
    EXPECT_NEAR(PositionX(path, increment, "crown"), 0.0, 1e-6);
    EXPECT_NEAR(PositionX(path, increment, "left"), -PositionX(path, increment, "right"), 1e-6);
  }
}

}  // namespace
}  // namespace contact_path::beam_paths_test
