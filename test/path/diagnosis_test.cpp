#include "contact_path/path/diagnosis.h"

#include <gtest/gtest.h>

namespace contact_path {
namespace {

Scene TwoBars() {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 2.0, 0.0, false, false}, {"c", 2.0, 1.0, false, false}};
  Bar first, second;
  first.nodes = {"a", "b"};
  second.nodes = {"b", "c"};
  first.EA = second.EA = 1.0;
  scene.bars = {first, second};
  return scene;
}

TEST(CollapsedBar, NamesTheOneThatHasShrunkMost) {
  EXPECT_EQ(CollapsedBar(TwoBars(), {0.0, 0.0, 0.015, 0.0, 0.015, 1e-3}),
            "bar 1 (b, c) has shrunk to 0.001 of its initial length");
  EXPECT_EQ(CollapsedBar(TwoBars(), {0.0, 0.0, 0.0, 1e-7, 0.0, 1e-3}),
            "bar 0 (a, b) has shrunk to 5e-08 of its initial length");
}

TEST(CollapsedBar, SaysNothingOfLongOnes) { EXPECT_EQ(CollapsedBar(TwoBars(), {0.0, 0.0, 0.1, 0.0, 0.1, 0.1}), ""); }

}  // namespace
}  // namespace contact_path
