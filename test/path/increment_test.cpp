#include "contact_path/path/increment.h"

#include <gtest/gtest.h>

namespace contact_path::increment_test {
namespace {

TEST(IncrementKind, WordsAreThoseOfTheOutput) {
  EXPECT_EQ(ToString(IncrementKind::kStart), "start");
  EXPECT_EQ(ToString(IncrementKind::kRegular), "regular");
  EXPECT_EQ(ToString(IncrementKind::kSmoothLimit), "smooth_limit");
  EXPECT_EQ(ToString(IncrementKind::kCornerLimit), "corner_limit");
  EXPECT_EQ(ToString(IncrementKind::kContactEvent), "contact_event");
  EXPECT_EQ(ToString(IncrementKind::kBifurcation), "bifurcation");
}

}  // namespace
}  // namespace contact_path::increment_test
