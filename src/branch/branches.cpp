#include "contact_path/branch/branches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "branch/branch_finder.h"
#include "branch/rates_by_forces.h"
#include "contact_path/branch/branch_order.h"
#include "contact_path/branch/force_redistribution.h"
#include "contact_path/branch/rate_complementarity.h"
#include "contact_path/branch/rate_problem.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kFewCombinations = 8.0;          // not worth condensing the rate problem of a small structure for
constexpr double kMostCondensed = 5e7;            // numbers that may be held for that
constexpr std::size_t kMostCondensedLaws = 1024;  // of more, the sparse equations of all take their place
// Shares of the springs of a rate problem: those that nearly stand for the contacts, then ever softer ones.
constexpr double kMostShare = 1e6, kLeastShare = 1e-8, kNextShare = 0.1;
constexpr double kMostCombinations = 4096.0;  // 4^6

using Options = BranchFinder::Options;

// Every combination of the options: an odometer, the last law turning fastest.
// excluded(modes): whether they need not be tried.
void TryAll(const Options& options, const std::function<bool(const Modes&)>& excluded, BranchFinder* finder,
            BranchSet* result) {
  Modes modes;
  for (const Modes& option : options) modes.push_back(option.front());
  std::vector<std::size_t> digits(options.size(), 0);
  bool turned = true;
  while (turned && !finder->Cancelled()) {
    if (!excluded(modes)) finder->Try(modes, &result->branches);
    ++result->combinations;
    turned = false;
    for (std::size_t i = options.size(); i-- > 0 && !turned;) {
      digits[i] = (digits[i] + 1) % options[i].size();
      modes[i] = options[i][digits[i]];
      turned = digits[i] != 0;
    }
  }
}

// What there is to find the rates as solutions of complementarity problems.
struct RateSolvers {
  const RateComplementarity* condensed = nullptr;
  const RatesByForces* by_forces = nullptr;
};

// The solutions of the complementarity problems of the rates, for both senses of the load. Whether they settle both: a
// direction leads on, or is the branch of arrival; at a start the sense that is not wanted settles itself.
bool TrySolutions(const RateSolvers& solvers, const Arrival& arrival, BranchFinder* finder, BranchSet* result) {
  bool both = true;
  for (const double sense : {1.0, -1.0}) {
    if (finder->Cancelled()) return true;
    const bool unwanted = arrival.is_start && arrival.parameter.IsLoadFactor() &&
                          sense * arrival.direction[arrival.direction.size() - 1] < 0.0;
    if (unwanted) continue;
    bool settled = false;
    const auto try_out = [&](const States& solution) {
      bool leads_on = finder->TryStates(solution, &result->branches, sense);
      // Rates of zero hide some of the states: the leading signs lead to them.
      const std::optional<States> others = leads_on ? std::nullopt : finder->PivotFrom(solution, sense, nullptr);
      if (others && *others != solution) leads_on = finder->TryStates(*others, &result->branches, sense);
      settled = settled || leads_on;
      ++result->combinations;
    };
    if (solvers.condensed != nullptr)
      for (const States& solution : solvers.condensed->Solve(sense)) try_out(solution);
    ComplementaritySolution near;
    for (double share = kMostShare;
         share >= kLeastShare && !settled && solvers.by_forces != nullptr && !finder->Cancelled();
         share *= kNextShare) {
      const std::optional<States> solution = solvers.by_forces->Solve(sense, share, &near);
      if (solution && share <= 1.0) try_out(*solution);
    }
    both = both && settled;
  }
  return both;
}

// Where there are too many combinations: principal pivoting from the states of now, from as many idle laws as may be,
// and from as many laws as may be in each of the states. Each result is tried like any other combination.
void TryLikely(const Laws& laws, const Options& options, const RateProblem* condensed, BranchFinder* finder,
               BranchSet* result) {
  std::set<States> tried;
  const auto pivot_from = [&](const auto& is_preferred) {
    States guess;
    for (std::size_t i = 0; i < options.size(); ++i) {
      const auto preferred = std::find_if(options[i].begin(), options[i].end(),
                                          [&](const Mode& mode) { return is_preferred(laws[i], mode.state); });
      guess.push_back((preferred != options[i].end() ? *preferred : options[i].front()).state);
    }
    for (const double sense : {1.0, -1.0}) {
      const std::optional<States> states = finder->PivotFrom(guess, sense, condensed);
      if (!states || finder->Cancelled() || !tried.insert(*states).second) continue;
      if (condensed == nullptr || !finder->Excluded(*states, *condensed)) finder->TryStates(*states, &result->branches);
      ++result->combinations;
    }
  };
  int states = 0;
  for (std::size_t i = 0; i < laws.size(); ++i) states = std::max(states, laws[i].NumStates());
  pivot_from([](const Law&, int) { return false; });
  pivot_from([](const Law& law, int state) { return law.In(state).idle; });
  for (int preferred = 0; preferred < states; ++preferred)
    pivot_from([&](const Law&, int state) { return state == preferred; });
}

// With the forces of the point. In no order, and mirror branches are not told.
BranchSet BranchesWithForces(const Structure& structure, const Laws& laws, const PathPoint& point,
                             const Arrival& arrival, const ActiveSetTolerance& tolerance,
                             const std::function<bool()>& cancelled) {
  BranchSet result;
  Options options;
  Modes natural;
  std::vector<int> weakly_active;
  double combinations = 1.0;
  bool between_pieces = false;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    options.push_back(laws.ModesAt(point, i, tolerance));
    natural.push_back({options[i].front().state, point.modes[i].piece});
    const int piece = laws[i].Known(point.u, point.s, point.modes[i]).piece;
    for (const Mode& option : options[i]) between_pieces = between_pieces || option.piece != piece;
    combinations *= static_cast<double>(options[i].size());
    if (options[i].size() > 1) weakly_active.push_back(static_cast<int>(i));
  }
  result.weakly_active = static_cast<int>(weakly_active.size());
  BranchFinder finder(structure, laws, point, options, arrival, tolerance, cancelled);
  // Where another path crosses, rates are not unique, and every combination is looked at as a whole. Where pieces meet,
  // whose curvatures differ, there is a problem for each combination of pieces.
  std::optional<RateProblem> problem;
  const double entries = static_cast<double>(point.u.size()) * static_cast<double>(2 * weakly_active.size() + 1);
  const double few = point.u.size() < kLargeSystem ? kFewCombinations : 1.0;
  const bool solves = combinations > few && !arrival.singular;
  std::optional<RatePairs> pairs;
  if (solves && !between_pieces) pairs.emplace(laws, options, weakly_active);
  const bool few_enough = combinations <= kMostCombinations;
  const bool condenses = solves && weakly_active.size() <= kMostCondensedLaws && entries <= kMostCondensed;
  if (condenses && !between_pieces) problem.emplace(structure, laws, point, natural, weakly_active, arrival.direction);
  const RateProblem* condensed = problem && problem->regular() ? &*problem : nullptr;
  std::map<std::vector<int>, const RateProblem> on_pieces;
  const auto excluded = [&](const Modes& modes) {
    if (!between_pieces) return condensed != nullptr && finder.Excluded(StatesOf(modes), *condensed);
    if (!condenses) return false;
    Modes there = natural;
    std::vector<int> pieces;
    for (std::size_t i = 0; i < modes.size(); ++i) pieces.push_back(there[i].piece = modes[i].piece);
    const RateProblem& rates =
        on_pieces.try_emplace(pieces, structure, laws, point, there, weakly_active, arrival.direction).first->second;
    return rates.regular() && finder.Excluded(StatesOf(modes), rates);
  };
  bool solved = false;
  if (pairs && pairs->exist()) {
    std::optional<RateComplementarity> complementarity;
    if (condensed != nullptr) complementarity.emplace(*pairs, *condensed);
    const bool exists = complementarity && complementarity->exists(), unique = exists && complementarity->unique();
    std::optional<RatesByForces> by_forces;
    if (!unique && !few_enough) by_forces.emplace(structure, laws, point, natural, weakly_active, *pairs);
    if (unique || by_forces) {
      const RateSolvers solvers{exists ? &*complementarity : nullptr, by_forces ? &*by_forces : nullptr};
      solved = TrySolutions(solvers, arrival, &finder, &result) && !result.branches.empty();
      result.complete_by = unique ? Completeness::kOnlySolution : Completeness::kNone;
    }
  }
  if (!solved) {
    result.complete_by = few_enough ? Completeness::kAllCombinations : Completeness::kNone;
    if (few_enough)
      TryAll(options, excluded, &finder, &result);
    else
      TryLikely(laws, options, condensed, &finder, &result);
  }
  result.rigid_modes = finder.rigid_modes();
  result.cancelled = finder.Cancelled();
  return result;
}

bool GoesOn(const Branch& branch) { return std::cos(branch.deviation) > tolerances::kRate; }

// A branch that needs no change of forces comes before one in the same direction that does. Of several changes, the
// least forces are kept: a choice that neither the order nor the tangents of the laws decide.
void AddOthers(const Laws& laws, BranchSet&& others, const PathPoint& begin, BranchSet* result) {
  for (Branch& branch : others.branches) {
    branch.begin = begin;
    branch.other_reactions = true;
    const auto known = std::find_if(result->branches.begin(), result->branches.end(), [&](const Branch& other) {
      return (other.direction - branch.direction).norm() < tolerances::kSameDirection;
    });
    if (known == result->branches.end())
      result->branches.push_back(std::move(branch));
    else if (known->begin && ForceNorm(laws, begin) < (1.0 - tolerances::kRate) * ForceNorm(laws, *known->begin))
      *known = std::move(branch);
  }
  result->weakly_active = std::max(result->weakly_active, others.weakly_active);
  result->complete_by = std::min(result->complete_by, others.complete_by);
  result->cancelled = result->cancelled || others.cancelled;
  result->combinations += others.combinations;
  result->rigid_modes = std::max(result->rigid_modes, others.rigid_modes);
}

}  // namespace

std::string_view ToString(Completeness completeness) {
  switch (completeness) {
    case Completeness::kNone: return "";
    case Completeness::kOnlySolution: return "only_solution";
    case Completeness::kAllCombinations: return "all_combinations";
  }
  return "unknown";
}

BranchSet FindBranches(const Structure& structure, const Laws& laws, const PathPoint& point, const Arrival& arrival,
                       const ActiveSetTolerance& tolerance, const std::function<bool()>& cancelled) {
  BranchSet result = BranchesWithForces(structure, laws, point, arrival, tolerance, cancelled);
  const auto none = [&](const auto& test) {
    return std::none_of(result.branches.begin(), result.branches.end(), test);
  };
  const bool turns = none(GoesOn) || (arrival.forward && none([](const Branch& branch) { return branch.sense > 0; }));
  if (!result.cancelled && turns) {
    const ForceRedistributions others = FindForceRedistributions(laws, point, tolerance);
    if (!others.complete) result.complete_by = Completeness::kNone;
    for (const PathPoint& begin : others.points) {
      if (result.cancelled) break;
      AddOthers(laws, BranchesWithForces(structure, laws, begin, arrival, tolerance, cancelled), begin, &result);
    }
  }
  SortBranches(point.modes, arrival.forward, &result.branches);
  return result;
}

}  // namespace contact_path
