#include "contact_path/branch/rate_pairs.h"

#include <algorithm>

namespace contact_path {

RatePairs::RatePairs(const Laws& laws, const std::vector<Modes>& options, const std::vector<int>& weakly_active)
    : options_(options), weakly_active_(weakly_active) {
  exist_ = Find(laws);
}

bool RatePairs::Find(const Laws& laws) {
  Eigen::Index first = 0;
  for (const int i : weakly_active_) first += static_cast<Eigen::Index>(laws[static_cast<std::size_t>(i)].NumPorts());
  turn_.assign(static_cast<std::size_t>(first), kFree);
  compliance_ = Eigen::VectorXd::Zero(first);
  first = 0;
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const auto i = static_cast<std::size_t>(weakly_active_[k]);
    const Law& law = laws[i];
    const Modes& modes = options_[i];
    if (law.Holonomic()) return false;
    const auto acts = [&](const Mode& mode) { return !law.In(mode).idle; };
    const int base = law.In(*std::find_if(modes.begin(), modes.end(), acts)).held;
    base_.push_back(base);
    const bool idle = !std::all_of(modes.begin(), modes.end(), acts);
    for (std::size_t p = 0; p < law.NumPorts(); ++p)
      if (const PortRule& port = law.In(base).ports[p]; port.Holds()) {
        turn_[static_cast<std::size_t>(first) + p] = kHeld;
        compliance_[first + static_cast<Eigen::Index>(p)] = port.compliance;
      }
    const std::size_t pairs_before = pairs_.size();
    for (const LimitRule& limit : law.In(base).limits)
      // A law that may become idle has no force: all its limits are at zero.
      if (limit.OfForces() && (idle || HasState(modes, limit.next)) && !Add(law, k, first, limit)) return false;
    // None where pieces meet, and two the same way in which the law acts where a cone is as narrow as rounding.
    if (pairs_.size() == pairs_before || (!idle && pairs_.size() > pairs_before + 1)) return false;
    first += static_cast<Eigen::Index>(law.NumPorts());
  }
  return true;
}

bool RatePairs::Add(const Law& law, std::size_t k, Eigen::Index first, const LimitRule& limit) {
  Pair pair{k, -1, 1.0};
  pair.next = limit.next;
  for (const LimitRule& back : law.In(limit.next).limits)
    if (back.next == base_[k] && !back.OfForces() && !back.OfPiece()) {
      if (limit.weights[back.port] != back.sign) return false;  // z and w are measured alike
      pair.port = first + static_cast<Eigen::Index>(back.port);
      pair.sign = back.sign;
      for (std::size_t p = 0; p < law.NumPorts(); ++p) {
        if (p == back.port || limit.weights[p] == 0.0) continue;
        if (pair.other >= 0) return false;  // a pair is of two ports at most
        pair.other = first + static_cast<Eigen::Index>(p);
        pair.weight = limit.weights[p];
      }
    }
  // Nothing leads back from the state beyond: the rates are no complementarity problem.
  if (pair.port < 0) return false;
  turn_[static_cast<std::size_t>(pair.port)] = pair.other < 0 ? kAlone : kWithOther;
  if (!pairs_.empty() && pairs_.back().port == pair.port) pairs_.back().first_of_two = true;
  pairs_.push_back(pair);
  return true;
}

bool RatePairs::BothWays() const {
  return std::any_of(pairs_.begin(), pairs_.end(), [](const Pair& pair) { return pair.first_of_two; });
}

States RatePairs::StatesBeyond(const std::vector<bool>& beyond) const {
  States states;
  for (const Modes& option : options_) states.push_back(option.front().state);
  for (std::size_t k = 0; k < base_.size(); ++k) states[static_cast<std::size_t>(weakly_active_[k])] = base_[k];
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    if (int& state = states[static_cast<std::size_t>(weakly_active_[pairs_[p].law])];
        beyond[p] && state == base_[pairs_[p].law])
      state = pairs_[p].next;
  return states;
}

}  // namespace contact_path
