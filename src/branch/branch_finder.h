// What the search for branches tries one after the other.
#ifndef CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_
#define CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/pivoting.h"
#include "contact_path/branch/rate_problem.h"
#include "contact_path/branch/redundant_contacts.h"
#include "contact_path/branch/tangents.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// The modes with these states: the first options of each candidate that have them.
inline ContactModes ModesWith(const std::vector<ContactState>& states, const std::vector<ContactModes>& options,
                              const PathPoint& point) {
  ContactModes modes;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto found = std::find_if(options[i].begin(), options[i].end(),
                                    [&](const ContactMode& option) { return option.state == states[i]; });
    modes.push_back(found != options[i].end() ? *found : ContactMode{states[i], point.Patch(i)});
  }
  return modes;
}

// The state that a contact takes on where its gap closes: by the total law of friction it may have slipped already.
inline ContactState TouchingState(const ContactPair& contact, const ContactModes& options) {
  if (!contact.Frictional()) return ContactState::kClosed;
  if (!contact.HasTotalLaw()) return ContactState::kStick;
  const auto has = [&](ContactState state) {
    return std::any_of(options.begin(), options.end(), [&](const ContactMode& mode) { return mode.state == state; });
  };
  if (has(ContactState::kStick)) return ContactState::kStick;
  return has(ContactState::kSlipMinus) ? ContactState::kSlipMinus : ContactState::kSlipPlus;
}

// Of two unit vectors [rad].
inline double AngleTo(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

// Tries combinations of the states that contacts may take on from a point, and keeps the branches that lead on.
class BranchFinder {
 public:
  using States = std::vector<ContactState>;
  using Options = std::vector<ContactModes>;  // of each candidate

  BranchFinder(const Structure& structure, const ContactPairs& contacts, const PathPoint& point, const Options& options,
               const Arrival& arrival, const ActiveSetTolerance& tolerance, const std::function<bool()>& cancelled)
      : contacts_(contacts),
        point_(point),
        options_(options),
        arrival_(arrival),
        tolerance_(tolerance),
        cancelled_(cancelled),
        redundant_(contacts, point, tolerance.gap),
        system_(structure, contacts),
        reference_(SlipReferences(contacts, point)) {
    for (std::size_t i = 0; i < contacts.size(); ++i) touching_.push_back(TouchingState(*contacts[i], options[i]));
  }

  // Adds the branches with these modes.
  void Try(const ContactModes& modes, std::vector<Branch>* branches) {
    if (redundant_.Among(StatesOf(modes))) return;
    Eigen::VectorXd x;
    const Tangents tangents = TangentsOf(modes, &x);
    for (std::size_t k = 0; k < tangents.first.size(); ++k)
      for (const double sign : {1.0, -1.0}) {
        const Eigen::VectorXd first = sign * tangents.first[k];
        if (Admissible(tangents, k, x, first)) Add(tangents, first, tangents.second[k], branches);
      }
  }

  // Adds the branches with these states, each on the patches onto which it leads.
  void TryStates(const States& states, std::vector<Branch>* branches) {
    std::set<ContactModes> tried;
    for (const double sign : {1.0, -1.0})
      if (const ContactModes modes = OntoPatches(states, sign); !Cancelled() && tried.insert(modes).second)
        Try(modes, branches);
  }

  // From these states to admissible ones. sign: of the tangent, relative to the direction of arrival. condensed: null,
  // or the rate problem condensed.
  std::optional<States> PivotFrom(States states, double sign, const RateProblem* condensed) {
    return Pivot(touching_, std::move(states), [&](const States& now) {
      return condensed != nullptr ? BrokenCondensed(now, sign, *condensed) : Broken(now, sign);
    });
  }

  // Whether contacts are redundant with these states, or their rates are broken in both directions by far more than
  // rounding, or the structure starts as a mechanism with them.
  bool Excluded(const States& states, const RateProblem& condensed) const {
    if (redundant_.Among(states)) return true;
    const std::optional<CondensedRates> rates = condensed.Rates(states);
    if (!rates) return false;
    if (arrival_.is_start && std::abs(rates->load) <= tolerances::kUnitComponent) return true;
    return condensed.Broken(states, *rates, 1.0, tolerance_, tolerances::kSameTangent, nullptr) &&
           condensed.Broken(states, *rates, -1.0, tolerance_, tolerances::kSameTangent, nullptr);
  }

  // Where several contacts hold a node, others of their states may hold it with less: tries them, node by node.
  void TryOtherStatesAtNodes(std::vector<Branch>* branches) {
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

  // Whether each combination of the options has contacts that are redundant.
  bool AllRedundant() const { return redundant_.AmongAll(options_); }

  int rigid_modes() const { return rigid_modes_; }

  // Once true, stays so.
  bool Cancelled() {
    was_cancelled_ = was_cancelled_ || (cancelled_ && cancelled_());
    return was_cancelled_;
  }

 private:
  Eigen::Index NumMotion() const { return system_.NumDofs() + 1; }

  // The system takes on these modes; *x: the point.
  Tangents TangentsOf(const ContactModes& modes, Eigen::VectorXd* x) {
    system_.SetStates(StatesOf(modes), reference_, PatchesOf(modes));
    *x = system_.Pack(point_);
    Tangents tangents = FindTangents(*x, arrival_.direction, arrival_.singular, &system_, &solvers_);
    rigid_modes_ = std::max(rigid_modes_, tangents.rigid_modes);
    return tangents;
  }

  // The modes with these states, each on the patch onto which the first tangent leads. sign: of the tangent, relative
  // to the direction of arrival. On other patches the tangent may be another one: until modes come back.
  ContactModes OntoPatches(const States& states, double sign) {
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
        const double unit = system_.UnitOf(constraint), rate = value.first / unit, bend = value.second / unit;
        if (rate > tolerances::kRate || (rate >= -tolerances::kRate && bend >= -tolerances::kRate)) continue;
        const auto i = static_cast<std::size_t>(constraint.contact);
        const int next = modes[i].patch + (constraint.inequality == Inequality::kPatchEnd ? 1 : -1);
        const ContactModes& of_contact = options_[i];
        const ContactMode wanted{modes[i].state, next};
        if (std::find(of_contact.begin(), of_contact.end(), wanted) != of_contact.end()) modes[i] = wanted;
      }
    }
    return modes;
  }

  // By the rates of these states, times sign relative to the direction of arrival.
  std::optional<std::vector<Constraint>> Broken(const States& states, double sign) {
    if (Cancelled()) return std::nullopt;
    Eigen::VectorXd x;
    const Tangents tangents = TangentsOf(ModesWith(states, options_, point_), &x);
    if (tangents.first.empty()) return std::nullopt;
    const double along = tangents.first[0].head(NumMotion()).dot(arrival_.direction);
    const Eigen::VectorXd first = (along < 0.0 ? -sign : sign) * tangents.first[0];
    std::vector<Constraint> broken;
    for (const Constraint& constraint : system_.Inequalities())
      if (IsWeaklyActive(system_, constraint, x, tolerance_) &&
          system_.Rate(constraint, x, first) < -tolerances::kRate * system_.UnitOf(constraint))
        broken.push_back(constraint);
    return broken;
  }

  std::optional<std::vector<Constraint>> BrokenCondensed(const States& states, double sign,
                                                         const RateProblem& condensed) const {
    const std::optional<CondensedRates> rates = condensed.UniqueRates(states);
    if (!rates) return std::nullopt;
    std::vector<Constraint> broken;
    condensed.Broken(states, *rates, rates->along < 0.0 ? -sign : sign, tolerance_, tolerances::kRate, &broken);
    return broken;
  }

  // first: the tangent k, or its opposite.
  bool Admissible(const Tangents& tangents, std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& first) {
    const Eigen::VectorXd& second = tangents.second[k];
    if (arrival_.is_start && (tangents.rigid || !SetsOut(x, first, second, tangents.load_error[k]))) return false;
    if (!arrival_.is_start && IsReversed(first)) return false;
    std::vector<Constraint> level;
    for (const Constraint& constraint : system_.Inequalities()) {
      if (!IsWeaklyActive(system_, constraint, x, tolerance_)) continue;
      const Jet along = system_.ValueAlong(constraint, x, first, second);
      const double unit = system_.UnitOf(constraint), rate = along.first / unit, curvature = along.second / unit;
      // A graze, located to the root of rounding only: the value is past its minimum before it counts as negative.
      const bool grazes = constraint.inequality != Inequality::kSlip && rate < 0.0 && curvature > tolerances::kRate &&
                          rate * rate <= 2.0 * curvature * tolerances::kNoMove;
      if (rate < -tolerances::kRate && !grazes) return false;
      if (rate < 0.0 && arrival_.failed == constraint && system_.states() == point_.states) return false;
      if (rate <= tolerances::kRate && curvature < -tolerances::kRate) return false;
      if (std::abs(rate) <= tolerances::kRate && std::abs(curvature) <= tolerances::kRate) level.push_back(constraint);
    }
    return level.empty() || HoldsAhead(level, x, first, second);
  }

  // Whether inequalities that neither rate nor curvature tells of hold a little farther along the curve.
  bool HoldsAhead(const std::vector<Constraint>& limits, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                  const Eigen::VectorXd& second) {
    const std::optional<Ahead> ahead = LookAhead(x, first, second);
    if (!ahead) return true;
    return std::none_of(limits.begin(), limits.end(), [&](const Constraint& constraint) {
      return system_.Rate(constraint, ahead->x, ahead->first) < -tolerances::kRate * system_.UnitOf(constraint);
    });
  }

  // Whether the load starts to change in the wanted sense, by more than the error of its rate: a motion without load is
  // a mechanism. At a smooth limit point the load rests, and its curvature tells; where that is zero as well, as of a
  // load across straight bars, the rate a little farther along the curve does.
  bool SetsOut(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second, double error) {
    const Eigen::Index s = NumMotion() - 1;
    const double sense = arrival_.direction[s];
    if (std::abs(first[s]) > error) return first[s] * sense > 0.0;
    if (std::abs(second[s]) > tolerances::kRate) return second[s] * sense > 0.0;
    const std::optional<Ahead> ahead = LookAhead(x, first, second);
    return ahead && ahead->first[s] * sense > tolerances::kRate;
  }

  // The tangent of the curve a little farther along; nothing where there is none. The error of the Taylor polynomial is
  // of a higher order than the change of a rate.
  struct Ahead {
    Eigen::VectorXd x, first;
  };
  std::optional<Ahead> LookAhead(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                 const Eigen::VectorXd& second) {
    const Eigen::Index n = NumMotion();
    const double length = tolerances::kNextToStart;
    Ahead ahead{x + length * first + 0.5 * length * length * second, {}};
    Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
    row.head(n) = first.head(n);
    BorderedSolver solver;
    if (!solver.FactorizeRegular(system_.TransposedJacobian(ahead.x), row, tolerances::kRegularPivot,
                                 system_.InFrame()))
      return std::nullopt;
    ahead.first = solver.Solve(Eigen::VectorXd::Zero(system_.NumEquations()), 1.0);
    ahead.first /= ahead.first.head(n).norm();
    return ahead;
  }

  bool IsReversed(const Eigen::VectorXd& first) const {
    return (first.head(NumMotion()) + arrival_.direction).norm() < tolerances::kSameTangent && !SetsSliding(first);
  }

  // Whether a contact that stuck slides on a curve, however little, other than back: over a sharp one the load changes
  // far more than the node moves.
  bool SetsSliding(const Eigen::VectorXd& first) const {
    const Eigen::VectorXd apart = first.head(NumMotion()) + arrival_.direction;
    for (const std::size_t i : system_.Touching())
      if (contacts_[i]->Curved() && Slips(system_.states()[i]) && point_.states[i] == ContactState::kStick &&
          std::abs(contacts_[i]->SlipRate(point_.u, point_.s, point_.Patch(i), apart, apart[NumMotion() - 1])) >
              tolerances::kRate)
        return true;
    return false;
  }

  // Contacts that slip by name but do not move.
  int IdleSlips(const Branch& branch) const {
    int idle = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (Slips(branch.states[i]) &&
          std::abs(contacts_[i]->SlipRate(point_.u, point_.s, point_.Patch(i), branch.direction, branch.load_rate)) <=
              tolerances::kRate)
        ++idle;
    return idle;
  }

  double ReactionRate(const Eigen::VectorXd& first) const {
    const PathPoint rates = system_.Unpack(first);
    double sum = 0.0;
    for (const std::size_t i : system_.Touching()) {
      const auto k = static_cast<Eigen::Index>(i);
      sum += (rates.rn[k] * rates.rn[k] + rates.rt[k] * rates.rt[k]) / std::pow(contacts_[i]->ForceUnit(), 2);
    }
    return std::sqrt(sum);
  }

  // Of two branches with one direction of motion: whether the first is to be kept. Walls that hold a node have several
  // states that do; those with the least reactions are kept, whatever the order of the contacts, and whichever way the
  // tangents of the walls point.
  bool IsPlainer(const Branch& branch, const Branch& other) const {
    const int idle = IdleSlips(branch), others = IdleSlips(other);
    if (idle != others) return idle < others;
    return branch.reaction_rate < other.reaction_rate && !SameReactions(branch, other);
  }

  static bool SameReactions(const Branch& branch, const Branch& other) {
    return std::abs(branch.reaction_rate - other.reaction_rate) <=
           tolerances::kRate * (1.0 + std::abs(other.reaction_rate));
  }

  void Add(const Tangents& tangents, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
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
    branch.dissipation_rate = DissipationRate(contacts_, branch.states, point_, branch.direction);
    branch.turn = AngleTo(arrival_.direction, branch.direction);
    branch.reaction_rate = ReactionRate(first);
    branch.deviation =
        arrival_.before ? std::min(branch.turn, AngleTo(*arrival_.before, branch.direction)) : branch.turn;
    for (Branch& other : *branches) {
      if ((other.direction - branch.direction).norm() >= tolerances::kSameDirection) continue;
      const bool others = other.other_reactions || !SameReactions(branch, other);
      if (IsPlainer(branch, other)) other = std::move(branch);
      other.other_reactions = others;
      return;
    }
    branches->push_back(std::move(branch));
  }

  const ContactPairs& contacts_;
  const PathPoint& point_;
  const Options& options_;
  const Arrival& arrival_;
  ActiveSetTolerance tolerance_;
  const std::function<bool()>& cancelled_;
  bool was_cancelled_ = false;
  RedundantContacts redundant_;
  FixedStateSystem system_;
  Eigen::VectorXd reference_;
  States touching_;  // that each contact takes on where its gap closes
  TangentSolvers solvers_;
  int rigid_modes_ = 0;  // most of all tangents that are rigid modes
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_
