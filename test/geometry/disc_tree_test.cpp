#include "contact_path/geometry/disc_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/random.h"

namespace contact_path {
namespace {

using Eigen::Vector2d;

class DiscTreeTest : public testing::TestWithParam<int> {
 protected:
  // Points of a curve that winds.
  DiscTreeTest() {
    for (int i = 0; i < GetParam(); ++i) {
      const double t = 0.1 * i;
      discs_.push_back({{t + 3.0 * std::sin(t), 2.0 * std::cos(1.7 * t)}, 0.0});
    }
  }

  std::vector<Disc> discs_;
};

TEST_P(DiscTreeTest, FindsTheNearestPoint) {
  const DiscTree tree(discs_);
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Vector2d x(random.Number(-5.0, 105.0), random.Number(-5.0, 5.0));
    double least = std::numeric_limits<double>::infinity(), found = least;
    for (const Disc& disc : discs_) least = std::min(least, (x - disc.centre).norm());
    tree.Search(x, &found, [&](std::size_t leaf) { found = std::min(found, (x - discs_[leaf].centre).norm()); });
    EXPECT_EQ(found, least);
  }
}

TEST_P(DiscTreeTest, VisitsEachLeafWithinReachOnce) {
  const DiscTree tree(discs_);
  const double reach = 1.3;
  const Vector2d x(2.0, 0.5);
  std::vector<std::size_t> visited, expected;
  tree.Search(x, &reach, [&](std::size_t leaf) { visited.push_back(leaf); });
  for (std::size_t i = 0; i < discs_.size(); ++i)
    if ((x - discs_[i].centre).norm() <= reach) expected.push_back(i);
  std::sort(visited.begin(), visited.end());
  EXPECT_EQ(visited, expected);
}

INSTANTIATE_TEST_SUITE_P(Sizes, DiscTreeTest, testing::Values(1, 2, 3, 7, 64, 1000));

// Where a bound is given, few of many leaves are looked at.
TEST(DiscTree, LooksAtFewLeaves) {
  std::vector<Disc> discs;
  for (int i = 0; i < 4096; ++i) discs.push_back({{1.0 * i, 0.0}, 0.5});
  const DiscTree tree(discs);
  double most = std::numeric_limits<double>::infinity();
  int visits = 0;
  tree.Search({1234.4, 0.3}, &most, [&](std::size_t leaf) {
    ++visits;
    most = std::min(most, std::hypot(1234.4 - 1.0 * static_cast<double>(leaf), 0.3));
  });
  EXPECT_LE(visits, 4);
}

}  // namespace
}  // namespace contact_path
