#include "contact_path/scene/nearest_name.h"

#include <algorithm>
#include <array>

namespace contact_path {
namespace {

// An error in a large scene, or in one with long names, must not take long.
constexpr std::size_t kLongestName = 48;
constexpr std::size_t kMostNames = 4000;

char LowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

double Substitution(char a, char b) {
  if (a == b) return 0.0;
  return LowerCase(a) == LowerCase(b) ? 0.5 : 1.0;
}

// The distance of Damerau and Levenshtein, where only neighbours are exchanged; some number from `most` on where it is
// not less than that.
double Distance(std::string_view a, std::string_view b, double most) {
  std::array<std::vector<double>, 3> rows;  // by letters of b: two letters of a before, one before, now
  for (auto& row : rows) row.resize(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) rows[1][j] = static_cast<double>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    double least = rows[2][0] = static_cast<double>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      double best = std::min(rows[1][j], rows[2][j - 1]) + 1.0;
      best = std::min(best, rows[1][j - 1] + Substitution(a[i - 1], b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) best = std::min(best, rows[0][j - 2] + 1.0);
      rows[2][j] = best;
      least = std::min(least, best);
    }
    if (least >= most + 1.0) return least;  // an exchange reaches two letters back, and costs an error
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1][b.size()];
}

}  // namespace

NearestName::NearestName(std::string_view wanted)
    : wanted_(wanted), distance_(static_cast<double>(std::max<std::size_t>(1, wanted.size() / 3)) + 0.5) {}

void NearestName::Offer(std::string_view name) {
  if (++offered_ > kMostNames) return;
  if (wanted_.empty() || name.empty() || wanted_.size() > kLongestName || name.size() > kLongestName) return;
  const auto longer = static_cast<double>(std::max(name.size(), wanted_.size()));
  const auto shorter = static_cast<double>(std::min(name.size(), wanted_.size()));
  if (longer - shorter >= distance_) return;
  const double distance = Distance(wanted_, name, distance_);
  // A name of which nothing is left is another name.
  if (distance >= distance_ || distance >= longer) return;
  distance_ = distance;
  nearest_ = name;
}

}  // namespace contact_path
