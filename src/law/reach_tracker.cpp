#include "contact_path/law/reach_tracker.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact_path/tolerances.h"

namespace contact_path {

std::vector<std::size_t> ReachTracker::InReach(const Eigen::Ref<const Eigen::VectorXd>& u, double s, double reach) {
  if (u_.size() == u.size()) moved_ += std::hypot((u - u_).norm(), s - s_);
  if (u_.size() != u.size() || looks_.size() != laws_.size()) {
    looks_.clear();
    for (std::size_t i = 0; i < laws_.size(); ++i) looks_.emplace_back(moved_, i);  // a heap: all are equal
  }
  u_ = u;
  s_ = s;
  // Rounding of the sum and of the distances.
  const double slack = tolerances::kTouching * (moved_ + reach);
  const auto later = std::greater<>();
  std::vector<std::size_t> in_reach;
  auto end = looks_.end();  // of the heap; behind it what was looked at in this call
  while (end != looks_.begin() && !(looks_.front().first > moved_ + reach + slack)) {
    std::pop_heap(looks_.begin(), end, later);
    Look& look = *--end;
    const Law& law = laws_[look.second];
    const double away = law.Reach(u_, s_), rate = law.LargestReachRate();
    if (std::isinf(rate) || away <= reach * rate) in_reach.push_back(look.second);
    const double distance = (1.0 - tolerances::kTouching) * away / rate;
    look.first = std::isfinite(distance) ? moved_ + distance : moved_;
  }
  while (end != looks_.end()) std::push_heap(looks_.begin(), ++end, later);
  std::sort(in_reach.begin(), in_reach.end());
  return in_reach;
}

}  // namespace contact_path
