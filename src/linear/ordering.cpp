#include "linear/ordering.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace contact_path {
namespace {

constexpr std::size_t kPlaces = 64;  // entries of a border
constexpr double kGoodPlaces = 0.5;  // of the largest entries of a row together
constexpr std::size_t kKept = 3;     // orderings of a structure

std::vector<int> Joined(std::vector<int> list, const std::vector<int>& further) {
  list.insert(list.end(), further.begin(), further.end());
  return list;
}

}  // namespace

std::vector<int> LargestPlaces(const Eigen::VectorXd& row) {
  std::vector<int> largest(static_cast<std::size_t>(row.size()));
  std::iota(largest.begin(), largest.end(), 0);
  const std::size_t count = std::min(kPlaces, largest.size());
  std::nth_element(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(count) - 1, largest.end(),
                   [&row](int a, int b) {
                     return std::abs(row[a]) != std::abs(row[b]) ? std::abs(row[a]) > std::abs(row[b]) : a < b;
                   });
  largest.resize(count);
  std::sort(largest.begin(), largest.end());
  return largest;
}

Eigen::VectorXd EntriesAt(const std::vector<int>& places, const Eigen::VectorXd& row) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(places.size()));
  std::transform(places.begin(), places.end(), values.data(), [&row](int place) { return row[place]; });
  return values;
}

bool AreGoodPlaces(const std::vector<int>& places, const Eigen::VectorXd& row) {
  return EntriesAt(places, row).lpNorm<1>() >= kGoodPlaces * EntriesAt(LargestPlaces(row), row).lpNorm<1>();
}

Ordering::Ordering(const Frame& frame, std::vector<int> places_of_border, const Eigen::VectorXd& row)
    : places(std::move(places_of_border)),
      border(EntriesAt(places, row)),
      analysis(Joined(frame.starts, {frame.starts.back() + static_cast<int>(places.size())}),
               Joined(frame.entries, places)) {}

bool Ordering::Suits(const Frame& frame) const {
  const std::vector<int>&starts = analysis.Starts(), &entries = analysis.Entries();
  return starts.size() == frame.starts.size() + 1 && entries.size() == frame.entries.size() + places.size() &&
         std::equal(frame.starts.begin(), frame.starts.end(), starts.begin()) &&
         std::equal(frame.entries.begin(), frame.entries.end(), entries.begin());
}

std::shared_ptr<const Ordering> Orderings::Find(const Frame& frame, const Eigen::VectorXd& row) const {
  std::shared_ptr<const Ordering> found;
  for (auto ordering = kept_.rbegin(); ordering != kept_.rend(); ++ordering) {
    if (!(*ordering)->Suits(frame)) continue;
    if (AreGoodPlaces((*ordering)->places, row)) return *ordering;
    if (found == nullptr) found = *ordering;
  }
  return found;
}

std::shared_ptr<const Ordering> Orderings::Add(const Frame& frame, const Eigen::VectorXd& row) {
  if (kept_.size() >= kKept) kept_.erase(kept_.begin());
  kept_.push_back(std::make_shared<const Ordering>(frame, LargestPlaces(row), row));
  return kept_.back();
}

}  // namespace contact_path
