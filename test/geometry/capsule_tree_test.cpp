#include "contact_path/geometry/capsule_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/random.h"

namespace contact_path::capsule_tree_test {
namespace {

using Eigen::Vector2d;

class CapsuleTreeTest : public testing::TestWithParam<int> {
 protected:
  // Points of a curve that winds.
  CapsuleTreeTest() {
    for (int i = 0; i < GetParam(); ++i) {
      const double t = 0.1 * i;
      const Vector2d point(t + 3.0 * std::sin(t), 2.0 * std::cos(1.7 * t));
      points_.push_back({point, point, 0.0});
    }
  }

  std::vector<Capsule> points_;
};

TEST_P(CapsuleTreeTest, FindsTheNearestPoint) {
  const CapsuleTree tree(points_);
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Vector2d x(random.Number(-5.0, 105.0), random.Number(-5.0, 5.0));
    double least = std::numeric_limits<double>::infinity(), found = least;
    for (const Capsule& point : points_) least = std::min(least, (x - point.begin).norm());
    tree.Search(x, &found, [&](std::size_t leaf) { found = std::min(found, (x - points_[leaf].begin).norm()); });
    EXPECT_EQ(found, least);
  }
}

TEST_P(CapsuleTreeTest, VisitsEachLeafWithinReachOnce) {
  const CapsuleTree tree(points_);
  const double reach = 1.3;
  const Vector2d x(2.0, 0.5);
  std::vector<std::size_t> visited, expected;
  tree.Search(x, &reach, [&](std::size_t leaf) { visited.push_back(leaf); });
  for (std::size_t i = 0; i < points_.size(); ++i)
    if ((x - points_[i].begin).norm() <= reach) expected.push_back(i);
  std::sort(visited.begin(), visited.end());
  EXPECT_EQ(visited, expected);
}

TEST_P(CapsuleTreeTest, BeginsWithTheLeafThatIsWanted) {
  const CapsuleTree tree(points_);
  const double reach = 1.3;
  const Vector2d x(2.0, 0.5);
  for (std::size_t first = 0; first < points_.size(); first += 1 + points_.size() / 10) {
    std::vector<std::size_t> visited, expected;
    tree.SearchFrom(first, x, &reach, [&](std::size_t leaf) { visited.push_back(leaf); });
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (i == first || (x - points_[i].begin).norm() <= reach) expected.push_back(i);
    EXPECT_EQ(visited.front(), first);
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CapsuleTreeTest, testing::Values(1, 2, 3, 7, 64, 1000));

// Of a wave that is far away few pieces are looked at.
TEST(CapsuleTree, LooksAtFewLeaves) {
  const auto place = [](std::size_t i) {
    const double along = 0.01 * static_cast<double>(i);
    return Vector2d(along, std::sin(along));
  };
  constexpr std::size_t kPieces = 4096;
  std::vector<Capsule> wave;
  for (std::size_t i = 0; i < kPieces; ++i) wave.push_back({place(i), place(i + 1), 1e-4});
  const CapsuleTree tree(wave);
  for (const double height : {1.3, 20.0, -300.0}) {
    double most = std::numeric_limits<double>::infinity();
    int visits = 0;
    const Vector2d x(12.34, height);
    tree.Search(x, &most, [&](std::size_t leaf) {
      ++visits;
      most = std::min({most, (x - place(leaf)).norm(), (x - place(leaf + 1)).norm()});
    });
    EXPECT_LE(visits, 20);
  }
}

}  // namespace
}  // namespace contact_path::capsule_tree_test
