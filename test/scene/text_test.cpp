#include "contact_path/scene/text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>

#include "support/random.h"

namespace contact_path::text_test {
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

TEST(Utf8Test, CharactersHaveOneToFourBytes) {
  const std::string first_and_last[][2] = {{std::string(1, '\0'), "\x7f"},
                                           {"\xc2\x80", "\xdf\xbf"},
                                           {"\xe0\xa0\x80", "\xef\xbf\xbf"},
                                           {"\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}};
  for (std::size_t size = 1; size <= 4; ++size)
    for (const std::string& character : first_and_last[size - 1]) {
      ASSERT_EQ(character.size(), size);
      EXPECT_EQ(Utf8Size(character), size);
      EXPECT_EQ(Utf8Size(character + "\x80"), size);
    }
}

TEST(Utf8Test, OtherBytesAreNone) {
  for (const char* const text :
       {"", "\x80", "\xbf", "\xff", "\xfe", "\xc3", "\xc3z", "\xe2\x82", "\xf0\x9f\x98",  // cut off
        "\xc0\xaf", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf",                       // too long
        "\xed\xa0\x80", "\xed\xbf\xbf", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80"})
    EXPECT_EQ(Utf8Size(text), 0U) << text;
}

TEST(Utf8Test, TheFirstByteOfNoCharacterIsFound) {
  EXPECT_EQ(FindNoUtf8(""), std::string::npos);
  EXPECT_EQ(FindNoUtf8("m\xc3\xbchle"), std::string::npos);
  EXPECT_EQ(FindNoUtf8("m\xfchle"), 1U);
  EXPECT_EQ(FindNoUtf8("\xe2\x82\xac\xe2\x82"), 3U);
}

}  // namespace
}  // namespace contact_path::text_test
