#include "contact_path/structure/dof_map.h"

#include <gtest/gtest.h>

namespace contact_path::dof_map_test {
namespace {

// Two nodes: the first held along y, with a rotation; the second without one.
class TwoNodes : public testing::Test {
 protected:
  TwoNodes() {
    EXPECT_EQ(dofs_.Add(0, Field::kPosition, 0, false), 0);
    EXPECT_EQ(dofs_.Add(0, Field::kPosition, 1, true), -1);
    EXPECT_EQ(dofs_.Add(0, Field::kRotation, 0, false), 1);
    EXPECT_EQ(dofs_.Add(1, Field::kPosition, 0, false), 2);
    EXPECT_EQ(dofs_.Add(1, Field::kPosition, 1, false), 3);
  }

  DofMap dofs_{2};
};

TEST_F(TwoNodes, UnknownsAreNumberedInOrder) {
  EXPECT_EQ(dofs_.NumDofs(), 4);
  EXPECT_EQ(dofs_.Dof(0, Field::kPosition, 0), 0);
  EXPECT_EQ(dofs_.Dof(0, Field::kPosition, 1), -1);
  EXPECT_EQ(dofs_.Dof(0, Field::kRotation, 0), 1);
  EXPECT_EQ(dofs_.Dof(1, Field::kPosition, 1), 3);
  EXPECT_EQ(dofs_.Dof(1, Field::kRotation, 0), -1);
}

TEST_F(TwoNodes, HeldValuesAreComponentsToo) {
  ASSERT_EQ(dofs_.Components().size(), 5u);
  EXPECT_EQ(dofs_.Index(0, Field::kPosition, 1), 1);
  EXPECT_EQ(dofs_.Components()[1].dof, -1);
  EXPECT_EQ(dofs_.Index(1, Field::kRotation, 0), -1);
  EXPECT_EQ(dofs_.Components()[2].field, Field::kRotation);
}

TEST_F(TwoNodes, PositionsAreLengthsAndRotationsAreNot) {
  const Eigen::VectorXd unit = dofs_.Unit(7.0);
  EXPECT_EQ(unit, Eigen::Vector4d(7.0, 1.0, 7.0, 7.0));
}

}  // namespace
}  // namespace contact_path::dof_map_test
