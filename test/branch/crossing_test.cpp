#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "branch/example_scenes.h"
#include "contact_path/verify/verify_path.h"
#include "support/traced_path.h"

namespace contact_path::crossing_test {
namespace {

// A von Mises truss, half span 1 and rise 3: under a load -s at its apex it sways to one side before it snaps.
constexpr double kRise = 3.0;

TraceRequest HighTruss(double sideways = 0.0) {
  TraceRequest request;
  request.scene = tall_truss::MakeScene(kRise);
  request.scene.loads = {{"apex", sideways, -1.0}};
  request.options.max_increments = 120;
  return request;
}

// Horizontal equilibrium of the apex over EA: N / l of a Biot bar is EA (1/l_0 - 1/l).
double Horizontal(double x, double y) {
  const double rest = std::hypot(1.0, kRise), left = std::hypot(1.0 + x, y), right = std::hypot(1.0 - x, y);
  return (1.0 + x) * (1.0 / rest - 1.0 / left) - (1.0 - x) * (1.0 / rest - 1.0 / right);
}
double Load(double x, double y) {
  const double rest = std::hypot(1.0, kRise), left = std::hypot(1.0 + x, y), right = std::hypot(1.0 - x, y);
  return -y * (2.0 / rest - 1.0 / left - 1.0 / right);
}

TracedPath Swaying(int branch) {
  TraceRequest request = HighTruss();
  request.options.branch_choices = {{1, 0, branch}};
  return TraceIncrements(request);
}

// The increment at the first bifurcation: a limit point where the path leaves for the sway.
const Increment& First(const TracedPath& path) {
  for (const Increment& increment : path.increments)
    if (increment.event.number == 1) return increment;
  ADD_FAILURE() << "no event";
  return path.increments[0];
}

TEST(Crossing, IsOnRecordInBothDirections) {
  const TracedPath path = TraceIncrements(HighTruss());
  const std::vector<Increment> crossings = IncrementsOfKind(path, IncrementKind::kBifurcation);
  ASSERT_FALSE(crossings.empty());
  const EventRecord& event = crossings[0].event;
  EXPECT_EQ(event.number, 1);
  EXPECT_EQ(event.taken, 1);
  ASSERT_EQ(event.branches.size(), 3U);
  EXPECT_EQ(event.branches[0].turn, 0.0);
  EXPECT_GT(event.branches[0].load_rate, 0.0);
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_NEAR(event.branches[k].load_rate, 0.0, 1e-13);
    EXPECT_NEAR(event.branches[k].turn, std::acos(0.0), 1e-13);
    EXPECT_EQ(event.branches[k].dissipation_rate, 0.0);
  }
  // The path itself stays straight.
  for (const Increment& increment : path.increments) EXPECT_NEAR(PositionX(path, increment, "apex"), 0.0, 1e-11);
}

TEST(Crossing, IsTheSwayOfAHighTruss) {
  for (const int branch : {2, 3}) {
    const TracedPath path = Swaying(branch);
    const Increment crossing = First(path);
    EXPECT_EQ(crossing.event.taken, branch);
    EXPECT_EQ(crossing.kind, IncrementKind::kCornerLimit);
    double worst = 0.0, farthest = 0.0;
    for (std::size_t i = static_cast<std::size_t>(crossing.index) + 1; i < path.increments.size(); ++i) {
      const Increment& increment = path.increments[i];
      const double x = PositionX(path, increment, "apex"), y = PositionY(path, increment, "apex");
      EXPECT_GT(branch == 2 ? x : -x, 0.0) << i;
      worst = std::max({worst, std::abs(Horizontal(x, y)), std::abs(increment.load_factor - Load(x, y))});
      farthest = std::max(farthest, std::abs(x));
    }
    EXPECT_LE(worst, 1e-12);
    EXPECT_GT(farthest, 0.3);
    EXPECT_LE(EnergyImbalance(path), 1e-9);
    for (const Finding& finding : VerifyPath(path.request, path.increments).findings)
      ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
  }
}

TEST(Crossing, BothDirectionsAreMirrorImages) {
  const TracedPath right = Swaying(2), left = Swaying(3);
  ASSERT_EQ(right.increments.size(), left.increments.size());
  for (std::size_t i = 0; i < right.increments.size(); ++i) {
    const Increment &a = right.increments[i], &b = left.increments[i];
    EXPECT_NEAR(PositionX(right, a, "apex"), -PositionX(left, b, "apex"), 1e-12);
    EXPECT_NEAR(PositionY(right, a, "apex"), PositionY(left, b, "apex"), 1e-12);
    EXPECT_NEAR(a.load_factor, b.load_factor, 1e-12);
  }
}

// A load that is a little oblique follows the crossing path at a distance of its order.
TEST(Crossing, IsWhereASmallImperfectionLeads) {
  for (const double sideways : {1e-3, 1e-4}) {
    const TracedPath path = TraceIncrements(HighTruss(sideways));
    double worst = 0.0;
    int seen = 0;
    for (const Increment& increment : path.increments) {
      const double x = PositionX(path, increment, "apex"), y = PositionY(path, increment, "apex");
      if (x < 0.2 || x > 0.6) continue;
      worst = std::max(worst, std::abs(increment.load_factor - Load(x, y)));
      EXPECT_NEAR(Horizontal(x, y), sideways * increment.load_factor, 1e-9);
      ++seen;
    }
    EXPECT_GT(seen, 5) << path.result.message;
    EXPECT_LE(worst, 1e-12);
  }
}

TEST(Crossing, OfABranchThatIsNotThereEndsTheTrace) {
  const TracedPath path = Swaying(4);
  EXPECT_EQ(path.result.reason, EndReason::kNoSuchBranch);
  EXPECT_NE(path.result.message.find("branch_choices wants branch 4 at event 1: the number of branches there is 3"),
            std::string::npos)
      << path.result.message;
}

// Three bars that stand on end, each held along x by a spring at its top: the first, or all of them, fall over.
TEST(Crossing, OfEqualPartsIsOfEachAloneAndOfAllTogether) {
  TraceRequest request;
  for (int i = 0; i < 3; ++i) {
    const std::string foot = "foot" + std::to_string(i), top = "top" + std::to_string(i);
    request.scene.nodes.push_back({foot, 2.0 * i, 0.0, true, true});
    request.scene.nodes.push_back({top, 2.0 * i, 1.0});
    request.scene.bars.push_back({{foot, top}, 10.0});
    request.scene.superelements.push_back({{top}, {2.0, 0.0, 0.0, 0.0}});
    request.scene.loads.push_back({top, 0.0, -1.0});
  }
  request.scene.name = "columns";
  request.options.max_increments = 100;
  for (const int branch : {2, 8}) {
    request.options.branch_choices = {{1, 0, branch}};
    const TracedPath path = TraceIncrements(request);
    const Increment crossing = First(path), last = path.increments.back();
    EXPECT_EQ(crossing.event.branches.size(), 9U);
    EXPECT_FALSE(crossing.event.complete);
    EXPECT_GT(last.index, crossing.index + 5) << path.result.message;
    std::vector<double> moved;
    for (const int i : {0, 1, 2}) moved.push_back(PositionX(path, last, "top" + std::to_string(i)) - 2.0 * i);
    std::sort(moved.begin(), moved.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    EXPECT_GT(std::abs(moved[2]), 0.1);
    for (const int k : {0, 1}) EXPECT_NEAR(moved[static_cast<std::size_t>(k)], branch == 8 ? moved[2] : 0.0, 1e-9);
    for (const Finding& finding : VerifyPath(path.request, path.increments).findings)
      ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
  }
}

}  // namespace
}  // namespace contact_path::crossing_test
