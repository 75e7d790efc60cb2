#include "contact_path/geometry/nodal_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace contact_path::admissible_patches_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::vector<Eigen::Vector2d> Line(int count) {
  std::vector<Eigen::Vector2d> nodes;
  for (int i = 0; i < count; ++i) nodes.emplace_back(i, 0.0);
  return nodes;
}

std::vector<Eigen::Vector2d> Circle(int count) {
  std::vector<Eigen::Vector2d> nodes;
  for (int i = 0; i < count; ++i) nodes.emplace_back(std::cos(2.0 * kPi * i / count), std::sin(2.0 * kPi * i / count));
  return nodes;
}

// Of the numbers from 0 to `count` - 1.
std::vector<int> PatchesOf(const AdmissiblePatches& patches, int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i)
    if (patches.Has(i)) numbers.push_back(i);
  return numbers;
}

TEST(AdmissiblePatches, AreAllPatchesOfAPointBeside) {
  const AdmissiblePatches open(NodalSpline(4, false)), closed(NodalSpline(4, true));
  EXPECT_EQ(PatchesOf(open, 4), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_FALSE(open.Has(-1) || open.Has(4) || open.None());
  EXPECT_TRUE(closed.Has(-7) && closed.Has(9));
}

TEST(AdmissiblePatches, OfAnOwnNodeLeaveOutThePatchesThatShareControlNodes) {
  const AdmissiblePatches inner(Line(10), false, 0.0, 4), first(Line(10), false, 0.0, 0);
  EXPECT_EQ(PatchesOf(inner, 10), (std::vector<int>{0, 1, 7, 8, 9}));
  EXPECT_EQ(PatchesOf(first, 10), (std::vector<int>{3, 4, 5, 6, 7, 8, 9}));
  EXPECT_FALSE(inner.Has(-1) || inner.Has(10));
  for (const int patch : {-1, 0, 1, 2, 6, 7, 8, 9, 10})  // also where they are prolonged
    for (const int node : inner.Patch(patch).nodes) EXPECT_NE(node, 4);
}

// Patches begin in the middles of edges: 0.5, 1.5, 2.5, ... edges from the node.
TEST(AdmissiblePatches, OfAnOwnNodeLeaveOutWhatBeginsWithinPiTimesTheRadius) {
  EXPECT_EQ(PatchesOf(AdmissiblePatches(Line(20), false, 3.4 / kPi, 10), 20),
            (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 14, 15, 16, 17, 18, 19}));
  // To rounding at the begin of a patch, whatever the unit.
  for (const double unit : {1.0, 0.1, 1.0 / 3.0, 1e-5}) {
    std::vector<Eigen::Vector2d> nodes = Line(20);
    for (Eigen::Vector2d& node : nodes) node *= unit;
    EXPECT_EQ(PatchesOf(AdmissiblePatches(nodes, false, 3.5 * unit / kPi, 10), 20),
              (std::vector<int>{0, 1, 2, 3, 4, 5, 15, 16, 17, 18, 19}));
  }
}

TEST(AdmissiblePatches, OfAClosedCurveAreOneStretchInEveryRound) {
  const double edge = 2.0 * std::sin(kPi / 40.0);
  const AdmissiblePatches patches(Circle(40), true, 3.6 * edge / kPi, 1);
  for (int i = -80; i < 80; ++i) {
    const int apart = std::abs(((i - 1) % 40 + 60) % 40 - 20);
    EXPECT_EQ(patches.Has(i), apart > 4) << i;
  }
  EXPECT_FALSE(patches.None());
}

TEST(AdmissiblePatches, AreProlongedWhereTheyEnd) {
  const AdmissiblePatches patches(Circle(12), true, 0.0, 0);
  EXPECT_EQ(patches.Patch(2).knot, 2.5);
  EXPECT_EQ(patches.Patch(10).knot, 8.5);
  EXPECT_EQ(patches.Patch(-2).knot, -3.5);
  EXPECT_EQ(patches.Patch(5).knot, 4.5);
  // There a foot is past the end.
  EXPECT_TRUE(std::isinf(patches.Patch(2).begin) && patches.Patch(2).end == 0.0);
  EXPECT_TRUE(patches.Patch(10).begin == 1.0 && std::isinf(patches.Patch(10).end));
  EXPECT_TRUE(patches.Patch(5).begin == 0.0 && patches.Patch(5).end == 1.0);
}

TEST(AdmissiblePatches, AreNoneOfAShortCurve) {
  EXPECT_TRUE(AdmissiblePatches(Line(3), false, 0.0, 0).None());
  EXPECT_TRUE(AdmissiblePatches(Line(5), false, 0.0, 2).None());
  EXPECT_FALSE(AdmissiblePatches(Line(5), false, 0.0, 1).None());
  EXPECT_TRUE(AdmissiblePatches(Line(20), false, 7.0, 9).None());
  EXPECT_TRUE(AdmissiblePatches(Circle(5), true, 0.0, 3).None());
  EXPECT_FALSE(AdmissiblePatches(Circle(6), true, 0.0, 3).None());
  EXPECT_TRUE(AdmissiblePatches(Circle(20), true, 1.0, 3).None());
}

}  // namespace
}  // namespace contact_path::admissible_patches_test
