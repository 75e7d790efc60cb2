#include "contact_path/contact/path_point.h"

#include <gtest/gtest.h>

namespace contact_path::path_point_test {
namespace {

TEST(PathPoint, DistanceTakesPositionsAndLoadFactorButNoReactions) {
  PathPoint a, b;
  a.u = Eigen::Vector2d(1.0, 1.0);
  b.u = Eigen::Vector2d(1.0, 3.0);
  a.s = -1.0;
  b.s = 0.5;
  a.rn = a.rt = Eigen::VectorXd::Zero(1);
  b.rn = b.rt = Eigen::VectorXd::Constant(1, 100.0);
  EXPECT_DOUBLE_EQ(Distance(a, b), 2.5);
  EXPECT_DOUBLE_EQ(Distance(b, a), 2.5);
  EXPECT_EQ(Distance(b, b), 0.0);
}

}  // namespace
}  // namespace contact_path::path_point_test
