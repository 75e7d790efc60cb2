#include "contact_path/scene/number_text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "support/random.h"

namespace contact_path::number_text_test {
namespace {

TEST(NumberText, IsAsAPersonWroteIt) {
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(-3.0), "-3");
  EXPECT_EQ(NumberText(1e-100), "1e-100");
  EXPECT_EQ(NumberText(0.0), "0");
}

TEST(NumberText, ReadsBack) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double number = random.Number(-1.0, 1.0);
    EXPECT_EQ(std::strtod(NumberText(number).c_str(), nullptr), number);
  }
}

TEST(NumberText, IsInYamlsSpellingWhereItIsNotFinite) {
  EXPECT_EQ(NumberText(std::numeric_limits<double>::quiet_NaN()), ".nan");
  EXPECT_EQ(NumberText(std::numeric_limits<double>::infinity()), ".inf");
  EXPECT_EQ(NumberText(-std::numeric_limits<double>::infinity()), "-.inf");
}

}  // namespace
}  // namespace contact_path::number_text_test
