#include "contact_path/scene/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contact_path::scene_test {
namespace {

// Every enumerator has the word of the scene format, both ways; "" is the first; nothing else is a word.
template <typename Enum>
void ExpectWords(const std::vector<std::pair<std::string, Enum>>& words) {
  const auto parse = [](const std::string& word) { return ParseWord<Enum>(word); };
  for (const auto& [word, value] : words) {
    EXPECT_EQ(parse(word), value) << word;
    EXPECT_EQ(ToString(value), word);
    EXPECT_EQ(parse(word + " "), std::nullopt);
    EXPECT_EQ(parse(word.substr(1)), std::nullopt);
  }
  EXPECT_EQ(parse(""), words.front().second);
  EXPECT_EQ(parse("Biot"), std::nullopt);
  EXPECT_EQ(parse("unknown"), std::nullopt);
}

TEST(SceneTest, WordsOfStrainMeasures) {
  ExpectWords<StrainMeasure>({{"biot", StrainMeasure::kBiot},
                              {"green_lagrange", StrainMeasure::kGreenLagrange},
                              {"logarithmic", StrainMeasure::kLogarithmic}});
}

TEST(SceneTest, WordsOfAccuracies) {
  ExpectWords<Accuracy>(
      {{"balanced", Accuracy::kBalanced}, {"fast", Accuracy::kFast}, {"accurate", Accuracy::kAccurate}});
}

TEST(SceneTest, ZeroOptionsStandForTheirDefaults) {
  TraceOptions options;
  EXPECT_EQ(options.MaxIncrements(0), 1000U);
  EXPECT_EQ(options.MaxIncrements(3), 3000U);
  EXPECT_EQ(options.Direction(), 1.0);
  options.max_increments = 7;
  options.direction = -0.5;
  EXPECT_EQ(options.MaxIncrements(3), 7U);
  EXPECT_EQ(options.Direction(), -1.0);
  options.direction = 3.0;
  EXPECT_EQ(options.Direction(), 1.0);
}

TEST(SceneTest, ContactsAreNamedByNodeAndObstacle) {
  ContactCandidate contact;
  contact.node = "b";
  contact.obstacle = "floor";
  EXPECT_EQ(contact.Name(), "b@floor");
}

}  // namespace
}  // namespace contact_path::scene_test
