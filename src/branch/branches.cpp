#include "contact_path/branch/branches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "branch/branch_finder.h"
#include "contact_path/branch/branch_order.h"
#include "contact_path/branch/rate_complementarity.h"
#include "contact_path/branch/rate_problem.h"
#include "contact_path/branch/reaction_redistribution.h"
#include "contact_path/branch/state_options.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kFewCombinations = 8.0;             // not worth condensing the rate problem of a small structure for
constexpr double kMostCondensed = 5e7;               // numbers that may be held for that
constexpr std::size_t kMostCondensedContacts = 512;  // of more, dense equations take longer than the sparse ones of all
constexpr double kMostCombinations = 4096.0;         // 4^6
constexpr double kMostIfNone = 65536.0;              // 4^8: tried before the path is said to end

using States = BranchFinder::States;
using Options = BranchFinder::Options;

// Every combination of the options: an odometer, the last contact turning fastest.
// excluded(modes): whether they need not be tried.
void TryAll(const Options& options, const std::function<bool(const ContactModes&)>& excluded, BranchFinder* finder,
            BranchSet* result) {
  ContactModes modes;
  for (const ContactModes& option : options) modes.push_back(option.front());
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

// The solutions of the complementarity problem of the rates, for both senses of the load. Whether they settle both: a
// direction leads on, or is the branch of arrival; at a start the sense that is not wanted settles itself. Where the
// solution is not known to exist, a sense for which none is found counts as settled, too.
bool TrySolutions(const RateComplementarity& problem, const Arrival& arrival, BranchFinder* finder, BranchSet* result) {
  bool both = true;
  for (const double sense : {1.0, -1.0}) {
    if (finder->Cancelled()) return true;
    const bool unwanted = arrival.is_start && arrival.parameter.IsLoadFactor() &&
                          sense * arrival.direction[arrival.direction.size() - 1] < 0.0;
    if (unwanted) continue;
    const std::vector<RateSolution> solutions = problem.Solve(sense);
    bool settled = solutions.empty() && !problem.unique();
    for (const RateSolution& solution : solutions) {
      settled = finder->TrySolution(solution.states, solution.degenerate, sense, &result->branches) || settled;
      ++result->combinations;
    }
    both = both && settled;
  }
  return both;
}

// Where there are too many combinations: principal pivoting from the states of now, and from as many contacts as may be
// in each of the states. Each result is tried like any other combination.
void TryLikely(const Options& options, const RateProblem* condensed, BranchFinder* finder, BranchSet* result) {
  std::set<States> tried;
  const auto pivot_from = [&](const std::optional<ContactState>& preferred) {
    States guess;
    for (const ContactModes& option : options) {
      guess.push_back(preferred && HasState(option, *preferred) ? *preferred : option.front().state);
    }
    for (const double sense : {1.0, -1.0}) {
      const std::optional<States> states = finder->PivotFrom(guess, sense, condensed);
      if (!states || finder->Cancelled() || !tried.insert(*states).second) continue;
      if (condensed == nullptr || !finder->Excluded(*states, *condensed)) finder->TryStates(*states, &result->branches);
      ++result->combinations;
    }
  };
  pivot_from(std::nullopt);
  for (const ContactState preferred : {ContactState::kOpen, ContactState::kStick, ContactState::kSlipPlus,
                                       ContactState::kSlipMinus, ContactState::kClosed})
    pivot_from(preferred);
}

// With the reactions of the point. In no order, and mirror branches are not told.
BranchSet BranchesWithReactions(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
                                const Arrival& arrival, const ActiveSetTolerance& tolerance,
                                const std::function<bool()>& cancelled) {
  BranchSet result;
  Options options;
  States natural;
  std::vector<int> weakly_active;
  double combinations = 1.0;
  bool between_patches = false, between_rigid = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    options.push_back(StateOptions(*contacts[i], point, i, tolerance));
    natural.push_back(options[i].front().state);
    const int patch = contacts[i]->KnownPatch(point.u, point.s, point.Patch(i));
    for (const ContactMode& option : options[i]) {
      if (option.patch == patch) continue;
      between_patches = true;
      between_rigid = between_rigid || !contacts[i]->Deformable();
    }
    combinations *= static_cast<double>(options[i].size());
    if (options[i].size() > 1) weakly_active.push_back(static_cast<int>(i));
  }
  result.weakly_active = static_cast<int>(weakly_active.size());
  BranchFinder finder(structure, contacts, point, options, arrival, tolerance, cancelled);
  if (finder.AllRedundant()) return result;
  // Where another path crosses, rates are not unique, and every combination is looked at as a whole; so it is where
  // patches of a rigid surface meet, whose curvatures differ. Nodes pass from patch to patch of a deformable surface
  // all the time: then there is a problem for each combination of patches.
  std::optional<RateProblem> problem;
  const double entries = static_cast<double>(point.u.size()) * static_cast<double>(2 * weakly_active.size() + 1);
  const double few = point.u.size() < kLargeSystem ? kFewCombinations : 1.0;
  const bool condenses = combinations > few && weakly_active.size() <= kMostCondensedContacts && !arrival.singular &&
                         entries <= kMostCondensed;
  const bool few_enough = combinations <= kMostCombinations;
  // Where there are too many of them, rates on the patches of now lead to the states; their branches lie on the next
  // patches, which have the same tangents on a surface that deforms.
  if (condenses && (!between_patches || (!few_enough && !between_rigid)))
    problem.emplace(structure, contacts, point, natural, weakly_active, arrival.direction);
  const RateProblem* condensed = problem && problem->regular() ? &*problem : nullptr;
  // Curvatures of patches differ.
  std::map<std::vector<int>, const RateProblem> on_patches;
  const auto excluded = [&](const ContactModes& modes) {
    if (!between_patches) return condensed != nullptr && finder.Excluded(StatesOf(modes), *condensed);
    if (!condenses || between_rigid) return false;
    PathPoint there = point;
    there.patches = PatchesOf(modes);
    const RateProblem& rates =
        on_patches.try_emplace(there.patches, structure, contacts, there, natural, weakly_active, arrival.direction)
            .first->second;
    return rates.regular() && finder.Excluded(StatesOf(modes), rates);
  };
  bool solved = false;
  if (condensed != nullptr) {
    const RateComplementarity complementarity(contacts, *condensed, options, weakly_active);
    const bool unique = complementarity.unique() && !between_patches;
    if (complementarity.exists() && (unique || !few_enough)) {
      solved = TrySolutions(complementarity, arrival, &finder, &result) && !result.branches.empty();
      finder.TryOtherStatesAtNodes(&result.branches);
      result.complete_by = unique ? Completeness::kOnlySolution : Completeness::kNone;
    }
  }
  if (!solved) {
    result.complete_by = few_enough ? Completeness::kAllCombinations : Completeness::kNone;
    if (few_enough)
      TryAll(options, excluded, &finder, &result);
    else
      TryLikely(options, between_patches ? nullptr : condensed, &finder, &result);
  }
  if (result.branches.empty() && result.complete_by == Completeness::kNone && combinations <= kMostIfNone) {
    TryAll(options, excluded, &finder, &result);
    result.complete_by = Completeness::kAllCombinations;
  }
  if (result.branches.empty() && condensed != nullptr)
    finder.Try(ModesWith(natural, options, point), &result.branches);  // for its rigid modes
  result.rigid_modes = finder.rigid_modes();
  result.cancelled = finder.Cancelled();
  return result;
}

bool GoesOn(const Branch& branch) { return std::cos(branch.deviation) > tolerances::kRate; }

// A branch that needs no change of reactions comes before one in the same direction that does. Of several changes, the
// least reactions are kept: a choice that neither the order nor the tangents of the contacts decide.
void AddOthers(const ContactPairs& contacts, BranchSet&& others, const PathPoint& begin, BranchSet* result) {
  for (Branch& branch : others.branches) {
    branch.begin = begin;
    branch.other_reactions = true;
    const auto known = std::find_if(result->branches.begin(), result->branches.end(), [&](const Branch& other) {
      return (other.direction - branch.direction).norm() < tolerances::kSameDirection;
    });
    if (known == result->branches.end())
      result->branches.push_back(std::move(branch));
    else if (known->begin &&
             ReactionNorm(contacts, begin) < (1.0 - tolerances::kRate) * ReactionNorm(contacts, *known->begin))
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

double DissipationRate(const ContactPairs& contacts, const std::vector<ContactState>& states, const PathPoint& point,
                       const Eigen::VectorXd& direction) {
  double rate = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (Slips(states[i]) && !contacts[i]->HasTotalLaw())
      rate -= point.rt[static_cast<Eigen::Index>(i)] *
              contacts[i]->SlipRate(point.u, point.s, point.Patch(i), direction, direction[direction.size() - 1]);
  return std::max(rate, 0.0);  // rounding may leave less
}

BranchSet FindBranches(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
                       const Arrival& arrival, const ActiveSetTolerance& tolerance,
                       const std::function<bool()>& cancelled) {
  BranchSet result = BranchesWithReactions(structure, contacts, point, arrival, tolerance, cancelled);
  const auto none = [&](const auto& test) {
    return std::none_of(result.branches.begin(), result.branches.end(), test);
  };
  const bool turns = none(GoesOn) || (arrival.forward && none([](const Branch& branch) { return branch.sense > 0; }));
  if (!result.cancelled && turns) {
    const ReactionRedistributions others = FindReactionRedistributions(contacts, point, tolerance);
    if (!others.complete) result.complete_by = Completeness::kNone;
    for (const PathPoint& begin : others.points) {
      if (result.cancelled) break;
      AddOthers(contacts, BranchesWithReactions(structure, contacts, begin, arrival, tolerance, cancelled), begin,
                &result);
    }
  }
  SortBranches(point.states, arrival.forward, &result.branches);
  return result;
}

}  // namespace contact_path
