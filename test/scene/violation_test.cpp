#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "contact_path/scene/validate.h"

namespace contact_path::violation_test {
namespace {

Violation MakeViolation(const std::string& file, int line, const std::string& key, const std::string& value) {
  Violation violation;
  violation.key = key;
  violation.value = value;
  violation.rule = "must be > 0";
  violation.file = file;
  violation.line = line;
  return violation;
}

TEST(ViolationTest, LineLeavesOutWhatIsNotKnown) {
  EXPECT_EQ(MakeViolation("a.yaml", 3, "scene.bars[0].EA", "-1").ToLine(),
            "a.yaml:3: scene.bars[0].EA = -1: must be > 0");
  EXPECT_EQ(MakeViolation("a.yaml", 0, "scene.bars[0].EA", "-1").ToLine(),
            "a.yaml: scene.bars[0].EA = -1: must be > 0");
  EXPECT_EQ(MakeViolation("", 3, "EA", "-1").ToLine(), "line 3: EA = -1: must be > 0");
  EXPECT_EQ(MakeViolation("", 0, "EA", "-1").ToLine(), "EA = -1: must be > 0");
  EXPECT_EQ(MakeViolation("", 0, "EA", "").ToLine(), "EA: must be > 0");
  EXPECT_EQ(MakeViolation("a.yaml", 3, "", "").ToLine(), "a.yaml:3: must be > 0");
  EXPECT_EQ(MakeViolation("", 0, "", "").ToLine(), "must be > 0");
}

TEST(ViolationTest, LineIsOneLineWhateverTheText) {
  EXPECT_EQ(MakeViolation("a\nb", 1, "k\x7f", "\x01\r\xc3\xa9").ToLine(),
            "a\\x0ab:1: k\\x7f = \\x01\\x0d\xc3\xa9: must be > 0");
  const std::string line = MakeViolation("", 0, "EA", std::string(159, '1') + "\xc3\xa9" + "2345").ToLine();
  EXPECT_EQ(line, "EA = " + std::string(159, '1') + "\xc3\xa9...: must be > 0");
}

TEST(InvalidRequestTest, WhatIsALineForEachViolation) {
  const InvalidRequest error({MakeViolation("a.yaml", 3, "EA", "-1"), MakeViolation("a.yaml", 4, "x", "9")});
  EXPECT_STREQ(error.what(), "a.yaml:3: EA = -1: must be > 0\na.yaml:4: x = 9: must be > 0");
  ASSERT_EQ(error.violations().size(), 2U);
  EXPECT_EQ(error.violations()[1].line, 4);
  EXPECT_NO_THROW(InvalidRequest({}));
  const std::string of_many = InvalidRequest(std::vector<Violation>(25, MakeViolation("", 0, "x", "9"))).what();
  EXPECT_EQ(std::count(of_many.begin(), of_many.end(), '\n'), 19);
  EXPECT_EQ(of_many.substr(of_many.rfind('\n')), "\n... and 6 more");
}

}  // namespace
}  // namespace contact_path::violation_test
