#include "contact_path/scene/scene.h"

#include <array>

namespace contact_path {
namespace {

template <typename Enum>
struct Word {
  std::string_view text;
  Enum value;
};

// The first of each table is the default.
constexpr std::array<Word<StrainMeasure>, 3> kStrainMeasures{{{"biot", StrainMeasure::kBiot},
                                                              {"green_lagrange", StrainMeasure::kGreenLagrange},
                                                              {"logarithmic", StrainMeasure::kLogarithmic}}};
constexpr std::array<Word<ObstacleShape>, 1> kObstacleShapes{{{"half_plane", ObstacleShape::kHalfPlane}}};
constexpr std::array<Word<Method>, 2> kMethods{{{"branch", Method::kBranch}, {"mpec", Method::kMpec}}};
constexpr std::array<Word<Accuracy>, 3> kAccuracies{
    {{"balanced", Accuracy::kBalanced}, {"fast", Accuracy::kFast}, {"accurate", Accuracy::kAccurate}}};

template <typename Enum, std::size_t size>
std::optional<Enum> Parse(const std::array<Word<Enum>, size>& words, std::string_view text) {
  if (text.empty()) return words[0].value;
  for (const Word<Enum>& word : words) {
    if (word.text == text) return word.value;
  }
  return std::nullopt;
}

template <typename Enum, std::size_t size>
std::string_view TextOf(const std::array<Word<Enum>, size>& words, Enum value) {
  for (const Word<Enum>& word : words) {
    if (word.value == value) return word.text;
  }
  return "unknown";  // not an enumerator
}

}  // namespace

std::optional<StrainMeasure> ParseStrainMeasure(std::string_view word) { return Parse(kStrainMeasures, word); }
std::optional<ObstacleShape> ParseObstacleShape(std::string_view word) { return Parse(kObstacleShapes, word); }
std::optional<Method> ParseMethod(std::string_view word) { return Parse(kMethods, word); }
std::optional<Accuracy> ParseAccuracy(std::string_view word) { return Parse(kAccuracies, word); }

std::string_view ToString(StrainMeasure strain) { return TextOf(kStrainMeasures, strain); }
std::string_view ToString(ObstacleShape shape) { return TextOf(kObstacleShapes, shape); }
std::string_view ToString(Method method) { return TextOf(kMethods, method); }
std::string_view ToString(Accuracy accuracy) { return TextOf(kAccuracies, accuracy); }

}  // namespace contact_path
