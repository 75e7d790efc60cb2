#include "contact_path/path/end.h"

#include <gtest/gtest.h>

#include "contact_path/path/sentences.h"

namespace contact_path {
namespace {

TEST(EndText, PutsNamesAndNumbersIn) {
  EXPECT_EQ(EndText({{sentences::kReactionSign, "p@floor", -1.2e-12, 5e-12}}),
            "the sign of the reaction of contact p@floor is not known: its value is -1.2e-12, its error 5e-12");
  EXPECT_EQ(
      EndText({{sentences::kCurveTurnsReaction, "p@table", 1e-9, 2.7123e-7}}),
      "contact p@table is pressed onto a curve of the radius 1e-09: rounding of the coordinates turns its reaction "
      "by 2.7e-07 rad");
  EXPECT_EQ(EndText({{sentences::kNoSuchBranch, "event 1", 7, 12345}}),
            "branch_choices wants branch 7 at event 1: the number of branches there is 12345");
  EXPECT_EQ(EndText({{sentences::kLimitPointOfLoads, "", 0.123456789}}),
            "a limit point at 0.123457 of their full size; only a dynamic jump leads further");
  EXPECT_EQ(EndText({{sentences::kCollapsedBar, "0 (<value>, b)", 0.5}}),
            "bar 0 (<value>, b) has shrunk to 0.5 of its initial length");
}

TEST(EndText, JoinsCauses) {
  EXPECT_EQ(EndText({}), "");
  EXPECT_EQ(EndText({{sentences::kConstantLoads}, {sentences::kNoIncrement}, {sentences::kNotSolved}}),
            "while the constant loads were brought on: no increment could be accepted, however short: the increment "
            "problem was not solved");
  EXPECT_EQ(EndText({{sentences::kNoBranch}, {sentences::kStandsAtEnd, "p@skin"}}),
            "no admissible branch: the quasi-static path ends here, only a dynamic jump leads further; contact p@skin "
            "stands at an end of its surface, over which a contact cannot slide");
}

}  // namespace
}  // namespace contact_path
