#include "contact_path/scene/text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace contact_path::nearest_name_test {
namespace {

std::string Nearest(const std::string& wanted, const std::vector<std::string>& names) {
  NearestName nearest(wanted);
  for (const std::string& name : names) nearest.Offer(name);
  return nearest.Get();
}

TEST(NearestNameTest, OneErrorInAShortName) {
  const std::vector<std::string> names = {"friction", "foot", "EA", "rest_length", "b"};
  EXPECT_EQ(Nearest("fot", names), "foot");    // left out
  EXPECT_EQ(Nearest("fooot", names), "foot");  // put in
  EXPECT_EQ(Nearest("fuot", names), "foot");   // wrong
  EXPECT_EQ(Nearest("ofot", names), "foot");   // exchanged
  EXPECT_EQ(Nearest("ea", names), "EA");       // the other case
  EXPECT_EQ(Nearest("B", names), "b");
  EXPECT_EQ(Nearest("restlenght", names), "rest_length");
}

TEST(NearestNameTest, WhatIsFarIsNotOffered) {
  EXPECT_EQ(Nearest("zz", {"a", "b", "ab"}), "");
  EXPECT_EQ(Nearest("z", {"a", "b"}), "");
  EXPECT_EQ(Nearest("wall", {"floor"}), "");
  EXPECT_EQ(Nearest("", {"a"}), "");
  EXPECT_EQ(Nearest("a", {""}), "");
  EXPECT_EQ(Nearest("anything", {}), "");
}

TEST(NearestNameTest, TheNearestWinsAndOfEqualsTheFirst) {
  EXPECT_EQ(Nearest("node12", {"node34", "node13", "node21"}), "node13");
  EXPECT_EQ(Nearest("node12", {"node15", "node13"}), "node15");
  EXPECT_EQ(Nearest("Floor", {"flour", "floor"}), "floor");
}

TEST(NearestNameTest, AsksOnlyWhereThereIsOne) {
  NearestName nearest("flor");
  EXPECT_EQ(nearest.Question(), "");
  nearest.Offer("floor");
  EXPECT_EQ(nearest.Question(), "; did you mean floor?");
}

// Names of a hostile request: as long and as many as it likes.
// Whoever asks for one has mistyped no name of a million letters: it is not compared.
TEST(NearestNameTest, VeryLongNamesAreNotCompared) {
  const std::string long_name(1 << 20, 'a');
  EXPECT_EQ(Nearest(long_name, {long_name + "b"}), "");
}

}  // namespace
}  // namespace contact_path::nearest_name_test
