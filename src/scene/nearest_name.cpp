#include "contact_path/scene/nearest_name.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace contact_path {
namespace {

// An error in a large scene, or in one with long names, must not take long.
constexpr std::size_t kLongestName = 48;
constexpr std::size_t kMostNames = 4000;

char LowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// In halves of an error.
std::size_t Substitution(char a, char b) {
  if (a == b) return 0;
  return LowerCase(a) == LowerCase(b) ? 1 : 2;
}

// The distance of Damerau and Levenshtein, where only neighbours are exchanged, in halves of an error; some number from
// `most` on where it is not less than that.
std::size_t Distance(std::string_view a, std::string_view b, std::size_t most) {
  constexpr std::size_t kError = 2;
  std::array<std::vector<std::size_t>, 3> rows;  // by letters of b: two letters of a before, one before, now
  for (auto& row : rows) row.resize(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) rows[1][j] = kError * j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t least = rows[2][0] = kError * i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t best = std::min(rows[1][j], rows[2][j - 1]) + kError;
      best = std::min(best, rows[1][j - 1] + Substitution(a[i - 1], b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = std::min(best, rows[0][j - 2] + kError);
      rows[2][j] = best;
      least = std::min(least, best);
    }
    if (least >= most + kError) return least;  // an exchange reaches two letters back, and costs an error
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1][b.size()];
}

}  // namespace

NearestName::NearestName(std::string_view wanted)
    : wanted_(wanted), distance_(2 * std::max<std::size_t>(1, wanted.size() / 3) + 1) {}

void NearestName::Offer(std::string_view name) {
  if (++offered_ > kMostNames) return;
  if (wanted_.empty() || name.empty() || wanted_.size() > kLongestName || name.size() > kLongestName) return;
  const std::size_t longer = std::max(name.size(), wanted_.size()), shorter = std::min(name.size(), wanted_.size());
  if (2 * (longer - shorter) >= distance_) return;
  const std::size_t distance = Distance(wanted_, name, distance_);
  // A name of which nothing is left is another name.
  if (distance >= distance_ || distance >= 2 * longer) return;
  distance_ = distance;
  nearest_ = name;
}

}  // namespace contact_path
