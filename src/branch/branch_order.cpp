#include "contact_path/branch/branch_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Iterator = std::vector<Branch>::iterator;

// Two branches with the same rates are images of each other under a symmetry of the scene, and break it.
void MarkMirrorBranches(std::vector<Branch>* branches) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= tolerances::kRate; };
  for (Branch& a : *branches)
    for (const Branch& b : *branches)
      if (&a != &b && same(a.dissipation_rate, b.dissipation_rate) && same(a.load_rate, b.load_rate) &&
          same(std::cos(a.deviation), std::cos(b.deviation)))
        a.has_mirror = true;
}

// The state of arrival comes first.
int Rank(const Mode& mode, const Mode& arrival) { return mode.state == arrival.state ? -1 : mode.state; }

// Exact, and of any two branches with different states or directions.
bool Before(const Modes& arrival, const Branch& a, const Branch& b) {
  for (std::size_t i = 0; i < arrival.size(); ++i)
    if (a.modes[i].state != b.modes[i].state) return Rank(a.modes[i], arrival[i]) < Rank(b.modes[i], arrival[i]);
  if (a.begin.has_value() != b.begin.has_value()) return b.begin.has_value();
  return std::lexicographical_compare(b.direction.data(), b.direction.data() + b.direction.size(), a.direction.data(),
                                      a.direction.data() + a.direction.size());
}

// Sorts by `value`, ascending, and calls `each` for every group of values without a gap larger than `gap`.
void ForEachGroup(Iterator begin, Iterator end, double gap, const std::function<double(const Branch&)>& value,
                  const std::function<void(Iterator, Iterator)>& each) {
  std::sort(begin, end, [&](const Branch& a, const Branch& b) { return value(a) < value(b); });
  while (begin != end) {
    Iterator last = begin;
    while (std::next(last) != end && value(*std::next(last)) - value(*last) <= gap) ++last;
    each(begin, std::next(last));
    begin = std::next(last);
  }
}

}  // namespace

void SortBranches(const Modes& arrival, bool forward, std::vector<Branch>* branches) {
  MarkMirrorBranches(branches);
  const auto by_parameter = [&](Iterator from, Iterator to) {
    ForEachGroup(
        from, to, tolerances::kRate, [](const Branch& branch) { return -branch.parameter_rate; },
        [&](Iterator begin, Iterator end) {
          std::sort(begin, end, [&](const Branch& a, const Branch& b) { return Before(arrival, a, b); });
        });
  };
  const auto by_deviation = [&](Iterator from, Iterator to) {
    ForEachGroup(
        from, to, tolerances::kSameDirection, [](const Branch& branch) { return branch.deviation; }, by_parameter);
  };
  const auto by_dissipation = [&](Iterator from, Iterator to) {
    ForEachGroup(
        from, to, tolerances::kRate, [](const Branch& branch) { return -branch.dissipation_rate; },
        [&](Iterator begin, Iterator end) {
          const Iterator mirrors = std::partition(begin, end, [](const Branch& branch) { return !branch.has_mirror; });
          by_deviation(begin, mirrors);
          by_deviation(mirrors, end);
        });
  };
  if (!forward) return by_dissipation(branches->begin(), branches->end());
  ForEachGroup(
      branches->begin(), branches->end(), 0.0, [](const Branch& branch) { return -branch.sense; }, by_dissipation);
}

}  // namespace contact_path
