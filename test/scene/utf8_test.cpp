#include "contact_path/scene/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace contact_path::utf8_test {
namespace {

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
}  // namespace contact_path::utf8_test
