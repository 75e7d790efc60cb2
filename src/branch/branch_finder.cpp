#include "branch/branch_finder.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "contact_path/equations/measured.h"
#include "contact_path/equations/transitions.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostPivots = 200;

// Of two unit vectors [rad].
double AngleTo(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

Measured Rate(double value) { return {value, tolerances::kRate}; }

bool SameReactions(const Branch& branch, const Branch& other) {
  return std::abs(branch.reaction_rate - other.reaction_rate) <=
         tolerances::kRate * (1.0 + std::abs(other.reaction_rate));
}

}  // namespace

double ReactionNorm(const ContactPairs& contacts, const PathPoint& point) {
  double sum = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    sum += (point.rn[k] * point.rn[k] + point.rt[k] * point.rt[k]) / std::pow(contacts[i]->ForceUnit(), 2);
  }
  return std::sqrt(sum);
}

ContactModes ModesWith(const std::vector<ContactState>& states, const std::vector<ContactModes>& options,
                       const PathPoint& point) {
  ContactModes modes;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto found = std::find_if(options[i].begin(), options[i].end(),
                                    [&](const ContactMode& option) { return option.state == states[i]; });
    modes.push_back(found != options[i].end() ? *found : ContactMode{states[i], point.Patch(i)});
  }
  return modes;
}

BranchFinder::BranchFinder(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
                           const Options& options, const Arrival& arrival, const ActiveSetTolerance& tolerance,
                           const std::function<bool()>& cancelled)
    : contacts_(contacts),
      point_(point),
      options_(options),
      arrival_(arrival),
      tolerance_(tolerance),
      cancelled_(cancelled),
      redundant_(contacts, point, tolerance.gap),
      system_(structure, contacts),
      reference_(SlipReferences(contacts, point)) {}

bool BranchFinder::Cancelled() {
  was_cancelled_ = was_cancelled_ || (cancelled_ && cancelled_());
  return was_cancelled_;
}

bool BranchFinder::Try(const ContactModes& modes, std::vector<Branch>* branches, double load_sense) {
  if (redundant_.Among(StatesOf(modes))) return false;
  Eigen::VectorXd x;
  const Tangents tangents = TangentsOf(modes, &x);
  bool settled = false;
  for (std::size_t k = 0; k < tangents.first.size(); ++k)
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd first = sign * tangents.first[k];
      const bool leads_on = Admissible(tangents, k, x, first);
      if (leads_on) Add(tangents, first, tangents.second[k], branches);
      const bool in_sense = first[NumMotion() - 1] * load_sense > 0.0;
      const bool goes_back = arrival_.is_start ? arrival_.parameter.Sense(first, NumMotion()) < 0 : IsReversed(first);
      settled = settled || (in_sense && (leads_on || goes_back));
    }
  return settled;
}

bool BranchFinder::TryStates(const States& states, std::vector<Branch>* branches, double load_sense) {
  std::set<ContactModes> tried;
  bool settled = false;
  for (const double sign : {1.0, -1.0})
    if (const ContactModes modes = OntoPatches(states, sign); !Cancelled() && tried.insert(modes).second)
      settled = Try(modes, branches, load_sense) || settled;
  return settled;
}

bool BranchFinder::TrySolution(const States& states, bool degenerate, double load_sense,
                               std::vector<Branch>* branches) {
  if (TryStates(states, branches, load_sense)) return true;
  if (!degenerate) return false;
  const std::optional<States> others = PivotFrom(states, load_sense, nullptr);
  return others && *others != states && TryStates(*others, branches, load_sense);
}

std::optional<BranchFinder::States> BranchFinder::PivotFrom(States states, double load_sense,
                                                            const RateProblem* condensed) {
  std::set<States> seen;
  bool together = true;
  for (int pivot = 0; pivot < kMostPivots && !Cancelled(); ++pivot) {
    std::optional<std::vector<Constraint>> broken = BrokenOf(states, load_sense, condensed);
    if (!broken) return std::nullopt;
    // At the end of a patch another patch is wanted, and no other state.
    broken->erase(std::remove_if(broken->begin(), broken->end(),
                                 [](const Constraint& constraint) { return KeepsPatch(constraint.inequality); }),
                  broken->end());
    if (broken->empty()) return states;
    together = together && seen.insert(states).second;
    if (!together) broken->resize(1);
    for (const Constraint& constraint : *broken) {
      const auto i = static_cast<std::size_t>(constraint.contact);
      states[i] = NextMode(*contacts_[i], constraint.inequality, {states[i], 0}).state;
      // By the total law of friction a contact that closes may have slipped, and cannot stick.
      const ContactModes& modes = options_[i];
      const auto touches = [](const ContactMode& mode) { return mode.state != ContactState::kOpen; };
      if (states[i] == ContactState::kStick && !HasState(modes, ContactState::kStick))
        states[i] = std::find_if(modes.begin(), modes.end(), touches)->state;
    }
  }
  return std::nullopt;
}

bool BranchFinder::Excluded(const States& states, const RateProblem& condensed) const {
  if (redundant_.Among(states)) return true;
  const std::optional<CondensedRates> rates = condensed.Rates(states);
  if (!rates) return false;
  if (arrival_.is_start && arrival_.parameter.IsLoadFactor() && std::abs(rates->load) <= tolerances::kUnitComponent)
    return true;
  return condensed.Broken(states, *rates, 1.0, tolerance_, tolerances::kSameTangent, nullptr) &&
         condensed.Broken(states, *rates, -1.0, tolerance_, tolerances::kSameTangent, nullptr);
}

void BranchFinder::TryOtherStatesAtNodes(std::vector<Branch>* branches) {
  for (std::size_t b = 0; b < branches->size(); ++b)
    for (const std::vector<std::size_t>& node : redundant_.AtEachNode()) {
      ContactModes modes = ModesWith((*branches)[b].states, options_, point_);
      const std::vector<int>& patches = (*branches)[b].patches;
      for (std::size_t i = 0; i < patches.size(); ++i) modes[i].patch = patches[i];
      const std::function<void(std::size_t)> vary = [&](std::size_t k) {
        if (k == node.size()) {
          Try(modes, branches);
          return;
        }
        for (const ContactMode& mode : options_[node[k]]) {
          modes[node[k]] = mode;
          vary(k + 1);
        }
      };
      if (!Cancelled()) vary(0);
    }
}

Tangents BranchFinder::TangentsOf(const ContactModes& modes, Eigen::VectorXd* x) {
  system_.SetStates(StatesOf(modes), reference_, PatchesOf(modes));
  *x = system_.Pack(point_);
  Tangents tangents = FindTangents(*x, arrival_.direction, arrival_.singular, &system_, &solvers_);
  rigid_modes_ = std::max(rigid_modes_, tangents.rigid_modes);
  return tangents;
}

ContactModes BranchFinder::OntoPatches(const States& states, double sign) {
  ContactModes modes = ModesWith(states, options_, point_);
  bool choice = false;
  for (std::size_t i = 0; i < modes.size() && !choice; ++i)
    choice = std::any_of(options_[i].begin(), options_[i].end(), [&](const ContactMode& other) {
      return other.state == modes[i].state && other.patch != modes[i].patch;
    });
  if (!choice) return modes;
  std::set<ContactModes> seen;
  while (!Cancelled() && seen.insert(modes).second) {
    Eigen::VectorXd x;
    const Tangents tangents = TangentsOf(modes, &x);
    if (tangents.first.empty()) break;
    const double along = tangents.first[0].head(NumMotion()).dot(arrival_.direction);
    const Eigen::VectorXd first = (along < 0.0 ? -sign : sign) * tangents.first[0];
    for (const Constraint& constraint : system_.Inequalities()) {
      if (!KeepsPatch(constraint.inequality) || !IsWeaklyActive(system_, constraint, x, tolerance_)) continue;
      const Jet value = system_.ValueAlong(constraint, x, first, tangents.second[0]);
      if (LeadingSign({Rate(value.first), Rate(value.second)}) >= 0) continue;
      const auto i = static_cast<std::size_t>(constraint.contact);
      const ContactMode next = NextMode(*contacts_[i], constraint.inequality, modes[i]);
      if (std::find(options_[i].begin(), options_[i].end(), next) != options_[i].end()) modes[i] = next;
    }
  }
  return modes;
}

std::optional<std::vector<Constraint>> BranchFinder::BrokenOf(const States& states, double load_sense,
                                                              const RateProblem* condensed) {
  if (condensed != nullptr) {
    const std::optional<CondensedRates> rates = condensed->Rates(states);
    if (!rates) return std::nullopt;
    std::vector<Constraint> broken;
    condensed->Broken(states, *rates, rates->load < 0.0 ? -load_sense : load_sense, tolerance_, tolerances::kRate,
                      &broken);
    return broken;
  }
  Eigen::VectorXd x;
  const Tangents tangents = TangentsOf(ModesWith(states, options_, point_), &x);
  if (tangents.first.empty()) return std::nullopt;
  const double sign = tangents.first[0][NumMotion() - 1] < 0.0 ? -load_sense : load_sense;
  return Broken(x, sign * tangents.first[0], tangents.second[0], contacts_.size());
}

bool BranchFinder::Admissible(const Tangents& tangents, std::size_t k, const Eigen::VectorXd& x,
                              const Eigen::VectorXd& first) {
  const Eigen::VectorXd& second = tangents.second[k];
  // Under a dead load nothing tells which way a part moves that nothing resists; a machine takes it along.
  const bool loose = tangents.rigid && arrival_.parameter.IsLoadFactor();
  if (arrival_.is_start && (loose || !SetsOut(x, first, second, tangents.load_error[k]))) return false;
  if (!arrival_.is_start && IsReversed(first)) return false;
  return Broken(x, first, second, 1).empty();
}

std::vector<Constraint> BranchFinder::Broken(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                             const Eigen::VectorXd& second, std::size_t most) {
  std::vector<Constraint> broken, level;
  for (const Constraint& constraint : system_.Inequalities()) {
    if (broken.size() == most) return broken;
    if (!IsWeaklyActive(system_, constraint, x, tolerance_)) continue;
    const Jet along = system_.ValueAlong(constraint, x, first, second);
    const double unit = system_.UnitOf(constraint);
    Measured rate = Rate(along.first / unit);
    const Measured bend = Rate(along.second / unit);
    // A graze is located to the root of rounding only: a value that is past its minimum before it counts as negative.
    if (constraint.inequality != Inequality::kSlip)
      rate.error = std::max(rate.error, std::sqrt(2.0 * std::max(bend.value, 0.0) * tolerances::kNoMove));
    if (rate.value < 0.0 && arrival_.failed == constraint && system_.states() == point_.states) rate.error = 0.0;
    const int sign = LeadingSign({rate, bend});
    if (sign < 0) broken.push_back(constraint);
    if (sign == 0) level.push_back(constraint);
  }
  if (!broken.empty() || level.empty()) return broken;
  const std::optional<Ahead> ahead = LookAhead(x, first, second);
  if (!ahead) return broken;
  for (const Constraint& constraint : level)
    if (Rate(system_.Rate(constraint, ahead->x, ahead->first) / system_.UnitOf(constraint)).Sign() < 0)
      broken.push_back(constraint);
  return broken;
}

bool BranchFinder::SetsOut(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                           double error) {
  const PathParameter& parameter = arrival_.parameter;
  int sense = parameter.Sense(first, second, NumMotion(), error);
  if (sense == 0)
    if (const std::optional<Ahead> ahead = LookAhead(x, first, second))
      sense = parameter.Sense(ahead->first, NumMotion());
  return sense > 0;
}

std::optional<BranchFinder::Ahead> BranchFinder::LookAhead(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                                           const Eigen::VectorXd& second) {
  const Eigen::Index n = NumMotion();
  const double length = tolerances::kNextToStart;
  Ahead ahead{x + length * first + 0.5 * length * length * second, {}};
  Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
  row.head(n) = first.head(n);
  BorderedSolver solver;
  if (!solver.FactorizeRegular(system_.TransposedJacobian(ahead.x), row, tolerances::kRegularPivot, system_.InFrame()))
    return std::nullopt;
  ahead.first = solver.Solve(Eigen::VectorXd::Zero(system_.NumEquations()), 1.0);
  ahead.first /= ahead.first.head(n).norm();
  return ahead;
}

bool BranchFinder::IsReversed(const Eigen::VectorXd& first) const {
  return (first.head(NumMotion()) + arrival_.direction).norm() < tolerances::kSameTangent && !SetsSliding(first);
}

bool BranchFinder::SetsSliding(const Eigen::VectorXd& first) const {
  const Eigen::VectorXd apart = first.head(NumMotion()) + arrival_.direction;
  const std::vector<std::size_t>& touching = system_.Touching();
  return std::any_of(touching.begin(), touching.end(), [&](std::size_t i) {
    return contacts_[i]->Curved() && Slips(system_.states()[i]) && point_.states[i] == ContactState::kStick &&
           Rate(contacts_[i]->SlipRate(point_.u, point_.s, point_.Patch(i), apart, apart[NumMotion() - 1])).Sign() != 0;
  });
}

int BranchFinder::IdleSlips(const Branch& branch) const {
  int idle = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (Slips(branch.states[i]) &&
        Rate(contacts_[i]->SlipRate(point_.u, point_.s, point_.Patch(i), branch.direction, branch.load_rate)).Sign() ==
            0)
      ++idle;
  return idle;
}

bool BranchFinder::IsPlainer(const Branch& branch, const Branch& other) const {
  const int idle = IdleSlips(branch), others = IdleSlips(other);
  if (idle != others) return idle < others;
  return branch.reaction_rate < other.reaction_rate && !SameReactions(branch, other);
}

void BranchFinder::Add(const Tangents& tangents, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                       std::vector<Branch>* branches) const {
  Branch branch;
  branch.states = system_.states();
  if (!point_.patches.empty()) branch.patches = system_.patches();
  branch.mechanism = tangents.mechanism;
  branch.singular = tangents.rests;
  branch.rests = tangents.rests || first.head(NumMotion() - 1).norm() <= tolerances::kRate;
  branch.direction = first.head(NumMotion());
  branch.first = first;
  branch.second = second - first.head(NumMotion()).dot(second.head(NumMotion())) * first;
  branch.load_rate = first[NumMotion() - 1];
  branch.parameter_rate = arrival_.parameter.Rate(first, NumMotion());
  branch.sense = arrival_.parameter.Sense(first, NumMotion());
  branch.dissipation_rate = DissipationRate(contacts_, branch.states, point_, branch.direction);
  branch.turn = AngleTo(arrival_.direction, branch.direction);
  branch.reaction_rate = ReactionNorm(contacts_, system_.Unpack(first));
  branch.deviation = arrival_.before ? std::min(branch.turn, AngleTo(*arrival_.before, branch.direction)) : branch.turn;
  for (Branch& other : *branches) {
    if ((other.direction - branch.direction).norm() >= tolerances::kSameDirection) continue;
    const bool others = other.other_reactions || !SameReactions(branch, other);
    if (IsPlainer(branch, other)) other = std::move(branch);
    other.other_reactions = others;
    return;
  }
  branches->push_back(std::move(branch));
}

}  // namespace contact_path
