#include "contact_path/path/increment.h"

#include <gtest/gtest.h>

namespace contact_path {
namespace {

TEST(RowKind, WordsAreThoseOfTheOutput) {
  EXPECT_EQ(ToString(RowKind::kStart), "start");
  EXPECT_EQ(ToString(RowKind::kRegular), "regular");
  EXPECT_EQ(ToString(RowKind::kSmoothLimit), "smooth_limit");
  EXPECT_EQ(ToString(RowKind::kCornerLimit), "corner_limit");
  EXPECT_EQ(ToString(RowKind::kContactEvent), "contact_event");
  EXPECT_EQ(ToString(RowKind::kBifurcation), "bifurcation");
}

}  // namespace
}  // namespace contact_path
