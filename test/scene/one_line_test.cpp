#include "contact_path/scene/one_line.h"

#include <gtest/gtest.h>

#include <string>

namespace contact_path::one_line_test {
namespace {

TEST(OneLineTest, KeepsPrintableCharacters) {
  for (const char* const text : {"", "sliding bar", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x98\x80", "\xef\xbf\xbd"})
    EXPECT_EQ(OneLine(text), text);
}

TEST(OneLineTest, ShowsControlCharactersAndLineSeparators) {
  EXPECT_EQ(OneLine(std::string("a\0b\n\r\t\x1b\x7f", 8)), "a\\x00b\\x0a\\x0d\\x09\\x1b\\x7f");
  EXPECT_EQ(OneLine("\xc2\x85"), "\\xc2\\x85");           // U+0085, next line
  EXPECT_EQ(OneLine("\xc2\x9b"), "\\xc2\\x9b");           // U+009B, as escape and [
  EXPECT_EQ(OneLine("\xe2\x80\xa8"), "\\xe2\\x80\\xa8");  // U+2028, line separator
  EXPECT_EQ(OneLine("\xe2\x80\xa9"), "\\xe2\\x80\\xa9");  // U+2029, paragraph separator
}

TEST(OneLineTest, ShowsWhatIsNoUtf8) {
  EXPECT_EQ(OneLine("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(OneLine("\x80"), "\\x80");
  EXPECT_EQ(OneLine("\xc3"), "\\xc3");                             // cut off
  EXPECT_EQ(OneLine("\xe2\x82z"), "\\xe2\\x82z");                  // cut off
  EXPECT_EQ(OneLine("\xc0\xaf"), "\\xc0\\xaf");                    // "/" in two bytes
  EXPECT_EQ(OneLine("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");           // and in three
  EXPECT_EQ(OneLine("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
  EXPECT_EQ(OneLine("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
}

TEST(OneLineTest, IsNeverMuchLongerThanALine) {
  const std::string line = std::string(159, '1') + "\xc3\xa9";
  EXPECT_EQ(OneLine(line), line);
  EXPECT_EQ(OneLine(line + "23"), line + "...");
  for (const char c : {'\n', '\x80', '\xe2', 'x'}) EXPECT_LT(OneLine(std::string(100000, c)).size(), 170U) << c;
}

}  // namespace
}  // namespace contact_path::one_line_test
