#include "contact_path/branch/branches.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "contact_path/branch/branch_order.h"
#include "contact_path/branch/plane_tangents.h"
#include "contact_path/branch/rate_problem.h"
#include "contact_path/branch/reaction_redistribution.h"
#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/minimum_norm.h"
#include "contact_path/linear/singular_vectors.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kFewCombinations = 8.0;             // not worth condensing the rate problem for
constexpr double kMostCondensed = 5e7;               // numbers that may be held for that
constexpr std::size_t kMostCondensedContacts = 200;  // of more, dense equations take longer than the sparse ones of all
constexpr int kMostRestarts = 64;                    // contacts, one after another in another state, to pivot from
constexpr Eigen::Index kMostDofsForFurther = 300;    // beyond, further candidates are asked for if nothing else helps
constexpr double kMostCombinations = 4096.0;         // 4^6
constexpr double kMostIfNone = 65536.0;              // 4^8: tried before the path is said to end

using States = std::vector<ContactState>;

// The states that a contact can take on from `point`: one if it is not weakly_active. The natural one, as it was, comes
// first.
States Options(const ContactPair& contact, const PathPoint& point, std::size_t i, const ActiveSetTolerance& limit) {
  const auto k = static_cast<Eigen::Index>(i);
  const double gap = contact.Gap(point.u, point.s), rn = point.rn[k], rt = point.rt[k];
  if (gap > limit.gap) return {ContactState::kOpen};
  const bool loaded = rn > limit.force;
  States options;
  if (!contact.Frictional()) {
    options = {ContactState::kClosed};
  } else if (!loaded) {
    options = {ContactState::kStick, ContactState::kSlipPlus, ContactState::kSlipMinus};
  } else {
    options = {ContactState::kStick};
    if (contact.Friction() * rn + rt <= limit.force) options.push_back(ContactState::kSlipPlus);
    if (contact.Friction() * rn - rt <= limit.force) options.push_back(ContactState::kSlipMinus);
  }
  if (!loaded) options.push_back(ContactState::kOpen);
  const auto natural = std::find(options.begin(), options.end(), point.states[i]);
  if (natural != options.end()) std::rotate(options.begin(), natural, natural + 1);
  return options;
}

// Columns of `basis` without what lies in the span of the rows' null space: splits a null space by what moves.
// Returns the part of basis in which the rows `from`..`from + count` vanish (still = true) or its complement.
Eigen::MatrixXd Split(const Eigen::MatrixXd& basis, Eigen::Index from, Eigen::Index count, bool still) {
  if (basis.cols() == 0) return basis;
  const SingularVectors rows = RightSingularVectors(basis.middleRows(from, count));
  Eigen::Index rank = 0;
  while (rank < rows.values.size() && rows.values[rank] > tolerances::kRigid) ++rank;
  return still ? basis * rows.v.rightCols(basis.cols() - rank) : basis * rows.v.leftCols(rank);
}

// Of two unit vectors [rad].
double AngleTo(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

class Finder {
 public:
  Finder(const Structure& structure, const ContactPairs& contacts, const PathPoint& point, const Arrival& arrival,
         const ActiveSetTolerance& limit, const std::function<bool()>& cancelled)
      : contacts_(contacts),
        point_(point),
        arrival_(arrival),
        tolerance_(limit),
        cancelled_(cancelled),
        system_(structure, contacts),
        reference_(SurfaceCoordinates(contacts, point)) {}

  // Adds the branches with these states.
  void Try(const States& states, std::vector<Branch>* branches) {
    Eigen::VectorXd x;
    for (const Eigen::VectorXd& along : TangentsOf(states, &x)) {
      const Eigen::VectorXd second = Second(x, along);
      for (const double sign : {1.0, -1.0}) {
        const Eigen::VectorXd first = sign * along;
        if (Admissible(x, first, second)) Add(first, second, branches);
      }
    }
  }

  // Principal pivoting on the rate problem from these states: contacts whose rates are inadmissible change their state,
  // all at once at first, then only the first of them. Ends with admissible states, or gives up. sign: of the tangent,
  // relative to the direction of arrival. condensed: null, or the rate problem condensed.
  std::optional<States> Pivot(States states, double sign, const RateProblem* condensed) {
    return condensed != nullptr ? PivotCondensed(std::move(states), sign, *condensed)
                                : PivotWhole(std::move(states), sign);
  }

  // Whether the rates of these states are broken in both directions by far more than rounding, or the structure starts
  // as a mechanism with them.
  bool Excluded(const States& states, const RateProblem& condensed) const {
    const std::optional<CondensedRates> rates = condensed.Rates(states);
    if (!rates) return false;
    if (arrival_.is_start && std::abs(rates->load) <= tolerances::kUnitComponent) return true;
    return condensed.Broken(states, *rates, 1.0, tolerance_.force, tolerances::kExcludedRate, nullptr) &&
           condensed.Broken(states, *rates, -1.0, tolerance_.force, tolerances::kExcludedRate, nullptr);
  }

  int rigid_modes() const { return rigid_modes_; }

  // Once true, stays so.
  bool Cancelled() {
    was_cancelled_ = was_cancelled_ || (cancelled_ && cancelled_());
    return was_cancelled_;
  }

 private:
  static constexpr int kBlockPivots = 20;
  static constexpr int kSinglePivots = 200;

  Eigen::Index NumMotion() const { return system_.NumDofs() + 1; }

  // Whether its rate counts. The slip rate always does.
  bool IsActive(const Constraint& limit, const Eigen::VectorXd& x) const {
    if (limit.inequality == Inequality::kSlip) return true;
    return system_.Value(limit, x) <= (limit.inequality == Inequality::kGap ? tolerance_.gap : tolerance_.force);
  }

  // The state that a contact takes on where the rate of `limit` is negative.
  static ContactState Next(const Constraint& limit, const ContactPair& contact) {
    switch (limit.inequality) {
      case Inequality::kGap: return contact.Frictional() ? ContactState::kStick : ContactState::kClosed;
      case Inequality::kNormalReaction: return ContactState::kOpen;
      case Inequality::kConePlus: return ContactState::kSlipPlus;
      case Inequality::kConeMinus: return ContactState::kSlipMinus;
      case Inequality::kSlip: return ContactState::kStick;
    }
    return ContactState::kOpen;
  }

  std::optional<States> PivotWhole(States states, double sign) {
    for (int round = 0; round < kBlockPivots + kSinglePivots && !Cancelled(); ++round) {
      Eigen::VectorXd x;
      const std::vector<Eigen::VectorXd> tangents = TangentsOf(states, &x);
      if (tangents.empty()) return std::nullopt;
      const double along = tangents.front().head(NumMotion()).dot(arrival_.direction);
      const Eigen::VectorXd first = (along < 0.0 ? -sign : sign) * tangents.front();
      bool changed = false;
      for (const Constraint& limit : system_.Inequalities()) {
        if (!IsActive(limit, x)) continue;
        if (system_.Rate(limit, x, first) >= -tolerances::kRate) continue;
        ContactState& state = states[static_cast<std::size_t>(limit.contact)];
        state = Next(limit, *contacts_[static_cast<std::size_t>(limit.contact)]);
        changed = true;
        if (round >= kBlockPivots) break;
      }
      if (!changed) return states;
    }
    return std::nullopt;
  }

  std::optional<States> PivotCondensed(States states, double sign, const RateProblem& condensed) const {
    std::vector<Constraint> broken;
    for (int round = 0; round < kBlockPivots + kSinglePivots; ++round) {
      const std::optional<CondensedRates> rates = condensed.UniqueRates(states);
      if (!rates) return std::nullopt;
      broken.clear();
      condensed.Broken(states, *rates, rates->along < 0.0 ? -sign : sign, tolerance_.force, tolerances::kRate, &broken);
      if (broken.empty()) return states;
      if (round >= kBlockPivots) broken.resize(1);
      for (const Constraint& limit : broken) {
        const auto i = static_cast<std::size_t>(limit.contact);
        states[i] = Next(limit, *contacts_[i]);
      }
    }
    return std::nullopt;
  }

  // The tangents of the curves with these states, up to their sign; *x: the point.
  std::vector<Eigen::VectorXd> TangentsOf(const States& states, Eigen::VectorXd* x) {
    system_.SetStates(states, reference_);
    *x = system_.Pack(point_);
    mechanism_ = false;
    rests_ = false;
    regular_ = false;
    const Eigen::SparseMatrix<double>& transposed = system_.TransposedJacobian(*x);
    if (!arrival_.singular) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
      row.head(NumMotion()) = arrival_.direction;
      regular_ = lu_.FactorizeRegular(transposed, row, tolerances::kRegularPivot);
      if (regular_) {
        const Eigen::VectorXd tangent = lu_.Solve(Eigen::VectorXd::Zero(system_.NumEquations()), 1.0);
        return {tangent / tangent.head(NumMotion()).norm()};
      }
    }
    if (!solver_.Factorize(transposed,
                           arrival_.singular ? tolerances::kDependentColumnSingular : tolerances::kDependentColumn))
      return {};
    const NullSpaceParts parts = PartsOfNullSpace();
    const Eigen::MatrixXd& plane = arrival_.singular ? parts.moving : parts.proper;
    if (plane.cols() == 2 && (arrival_.singular || parts.rigid.cols() == 0)) {
      const PlaneTangents tangents = TangentsInPlane(&system_, *x, plane, solver_.LeftNullSpace());
      if (tangents.determined) {
        rests_ = !arrival_.singular;
        return tangents.directions;
      }
    }
    if (!arrival_.singular && parts.proper.cols() > 1 && TakesUpReactions(*x, parts.proper)) return {};
    const std::optional<Eigen::VectorXd> tangent = Tangent(parts);
    return tangent ? std::vector<Eigen::VectorXd>{*tangent} : std::vector<Eigen::VectorXd>{};
  }

  // How the unknowns bend along the tangent.
  Eigen::VectorXd Second(const Eigen::VectorXd& x, const Eigen::VectorXd& tangent) {
    const Eigen::VectorXd right = -system_.SecondDerivative(x, tangent);
    return regular_ ? lu_.Solve(right, 0.0) : solver_.Solve(right);
  }

  // The null vectors that move: rigid modes change neither the load factor nor a reaction, the proper ones do and have
  // no share of the rigid modes.
  struct NullSpaceParts {
    Eigen::MatrixXd moving, rigid, proper;
  };

  NullSpaceParts PartsOfNullSpace() const {
    const Eigen::MatrixXd null_space = solver_.NullSpace();
    const Eigen::Index motion = NumMotion(), forces = system_.NumUnknowns() - motion + 1;
    NullSpaceParts parts;
    if (null_space.cols() == 1) {
      parts.moving = parts.proper = null_space;
      return parts;
    }
    parts.moving = Split(null_space, 0, motion, false);
    parts.rigid = Split(parts.moving, motion - 1, forces, true);
    parts.proper = Split(parts.moving, motion - 1, forces, false);
    for (Eigen::Index k = 0; k < parts.rigid.cols(); ++k) {
      const Eigen::VectorXd mode = parts.rigid.col(k).head(motion).normalized();
      for (Eigen::Index j = 0; j < parts.proper.cols(); ++j) {
        Eigen::VectorXd column = parts.proper.col(j);
        column.head(motion) -= mode.dot(column.head(motion)) * mode;
        parts.proper.col(j) = column;
      }
    }
    return parts;
  }

  // Whether directions of a surface of solutions give a reaction to a contact that has none. In a guide without
  // clearance the wall that is not pressed has no reason to take up a reaction: the combination in which it is open has
  // the direction in which it does not.
  bool TakesUpReactions(const Eigen::VectorXd& x, const Eigen::MatrixXd& directions) const {
    for (const Constraint& constraint : system_.Inequalities())
      if (constraint.inequality == Inequality::kNormalReaction && IsActive(constraint, x))
        for (Eigen::Index k = 0; k < directions.cols(); ++k)
          if (std::abs(system_.Rate(constraint, x, directions.col(k))) > tolerances::kRate) return true;
    return false;
  }

  // The direction of the arc where the equations leave more than one. A mechanism has rigid modes only: with one of
  // them it moves in that direction; with more, the direction nearest to the arrival stands for all of them.
  std::optional<Eigen::VectorXd> Tangent(const NullSpaceParts& parts) {
    const Eigen::Index motion = NumMotion();
    const Eigen::MatrixXd& candidates = parts.proper.cols() > 0 ? parts.proper : parts.rigid;
    if (candidates.cols() == 0) return std::nullopt;
    mechanism_ = parts.proper.cols() == 0 && parts.rigid.cols() > 1;
    if (parts.proper.cols() == 0) rigid_modes_ = std::max(rigid_modes_, static_cast<int>(parts.rigid.cols()));
    Eigen::VectorXd tangent =
        candidates.cols() == 1 ? Eigen::VectorXd(candidates.col(0)) : NearestToArrival(candidates);
    const double norm = tangent.head(motion).norm();
    if (!(norm > tolerances::kRigid)) return std::nullopt;
    tangent /= norm;
    return tangent;
  }

  // Of the combinations of the columns: that whose motion is nearest to the direction of arrival.
  Eigen::VectorXd NearestToArrival(const Eigen::MatrixXd& candidates) const {
    const auto motions = candidates.topRows(NumMotion());
    const SingularVectors s = RightSingularVectors(motions);
    const Eigen::VectorXd along = s.v.transpose() * (motions.transpose() * arrival_.direction);
    return candidates * (s.v * along.cwiseQuotient(s.values.cwiseAbs2()));
  }

  bool Admissible(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second) const {
    const Eigen::Index n = NumMotion();
    if (arrival_.is_start && !SetsOut(first[n - 1], second[n - 1])) return false;
    if (!arrival_.is_start && IsReversed(first)) return false;
    for (const Constraint& limit : system_.Inequalities()) {
      if (!IsActive(limit, x)) continue;
      const Jet along = system_.ValueAlong(limit, x, first, second);
      const double rate = along.first, curvature = along.second;
      // A graze, located to the root of rounding only: the value is past its minimum before it counts as negative.
      const bool grazes = limit.inequality != Inequality::kSlip && rate < 0.0 && curvature > tolerances::kCurvature &&
                          rate * rate <= 2.0 * curvature * tolerances::kGraze;
      if (rate < -tolerances::kRate && !grazes) return false;
      if (rate <= tolerances::kRate && curvature < -tolerances::kCurvature) return false;
    }
    return true;
  }

  // Whether the load starts to change in the wanted sense. At a smooth limit point it rests, and its curvature tells.
  bool SetsOut(double load_rate, double load_curvature) const {
    const double sense = arrival_.direction[NumMotion() - 1];
    if (load_rate * sense > tolerances::kUnitComponent) return true;
    return std::abs(load_rate) <= tolerances::kRate && load_curvature * sense > tolerances::kCurvature;
  }

  bool IsReversed(const Eigen::VectorXd& first) const {
    return (first.head(NumMotion()) + arrival_.direction).norm() <
           (arrival_.singular ? tolerances::kReversedSingular : tolerances::kReversed);
  }

  // Contacts that slip by name but do not move.
  int IdleSlips(const Branch& branch) const {
    int idle = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (Slips(branch.states[i]) &&
          std::abs(contacts_[i]->SlipRate(point_.u, point_.s, branch.direction, branch.load_rate)) <= tolerances::kRate)
        ++idle;
    return idle;
  }

  void Add(const Eigen::VectorXd& first, const Eigen::VectorXd& second, std::vector<Branch>* branches) const {
    Branch branch;
    branch.states = system_.states();
    branch.mechanism = mechanism_;
    branch.singular = rests_;
    branch.rests = rests_ || first.head(NumMotion() - 1).norm() <= tolerances::kRate;
    branch.direction = first.head(NumMotion());
    branch.first = first;
    branch.second = second - first.head(NumMotion()).dot(second.head(NumMotion())) * first;
    branch.load_rate = first[NumMotion() - 1];
    branch.dissipation_rate = DissipationRate(contacts_, branch.states, point_, branch.direction);
    branch.turn = AngleTo(arrival_.direction, branch.direction);
    branch.deviation =
        arrival_.before ? std::min(branch.turn, AngleTo(*arrival_.before, branch.direction)) : branch.turn;
    for (Branch& other : *branches) {
      if ((other.direction - branch.direction).norm() >= tolerances::kSameDirection) continue;
      if (IdleSlips(branch) < IdleSlips(other)) other = std::move(branch);
      return;
    }
    branches->push_back(std::move(branch));
  }

  const ContactPairs& contacts_;
  const PathPoint& point_;
  const Arrival& arrival_;
  ActiveSetTolerance tolerance_;
  const std::function<bool()>& cancelled_;
  bool was_cancelled_ = false;
  FixedStateSystem system_;
  Eigen::VectorXd reference_;
  BorderedSolver lu_;         // where the equations are clearly regular
  MinimumNormSolver solver_;  // elsewhere
  bool regular_ = false;      // which of them the last tangent is of
  bool mechanism_ = false;    // of the last tangent
  bool rests_ = false;        // of the last tangents: see Branch::rests
  int rigid_modes_ = 0;       // most of all tangents that are rigid modes
};

// Every combination of the options: an odometer, the last contact turning fastest.
void TryAll(const std::vector<States>& options, const RateProblem* condensed, Finder* finder, BranchSet* result) {
  States states;
  for (const States& option : options) states.push_back(option.front());
  std::vector<std::size_t> digits(options.size(), 0);
  bool turned = true;
  while (turned && !finder->Cancelled()) {
    if (condensed == nullptr || !finder->Excluded(states, *condensed)) finder->Try(states, &result->branches);
    ++result->combinations;
    turned = false;
    for (std::size_t i = options.size(); i-- > 0 && !turned;) {
      digits[i] = (digits[i] + 1) % options[i].size();
      states[i] = options[i][digits[i]];
      turned = digits[i] != 0;
    }
  }
}

// Where there are too many combinations: principal pivoting from several first guesses, and the further candidates.
// Each result is tried like any other combination.
void TryLikely(const std::vector<States>& options, const PathPoint& point, const Arrival& arrival,
               const RateProblem* condensed, const FurtherStates& further, Finder* finder, BranchSet* result) {
  std::vector<States> guesses;
  for (const ContactState preferred : {ContactState::kOpen, ContactState::kStick, ContactState::kSlipPlus,
                                       ContactState::kSlipMinus, ContactState::kClosed}) {
    States guess;
    for (const States& option : options)
      guess.push_back(std::find(option.begin(), option.end(), preferred) != option.end() ? preferred : option.front());
    guesses.push_back(std::move(guess));
  }
  States natural;
  for (const States& option : options) natural.push_back(option.front());
  guesses.insert(guesses.begin(), natural);
  std::set<States> tried;
  const auto attempt = [&](const States& states) {
    if (finder->Cancelled() || !tried.insert(states).second) return;
    if (condensed == nullptr || !finder->Excluded(states, *condensed)) finder->Try(states, &result->branches);
    ++result->combinations;
  };
  const auto pivot_from = [&](const States& guess) {
    if (finder->Cancelled()) return;
    for (const double sign : {1.0, -1.0})
      if (const std::optional<States> states = finder->Pivot(guess, sign, condensed)) attempt(*states);
  };
  for (const States& guess : guesses) pivot_from(guess);
  // Next to what was found: one contact after another in another of its states.
  if (condensed != nullptr && result->weakly_active <= kMostRestarts) {
    for (const States& found : std::set<States>(tried))
      for (std::size_t i = 0; i < options.size(); ++i)
        for (const ContactState other : options[i]) {
          if (other == found[i]) continue;
          States guess = found;
          guess[i] = other;
          pivot_from(guess);
        }
  }
  if (!further || (point.u.size() > kMostDofsForFurther && !result->branches.empty())) return;
  for (const States& states : further(point, arrival.direction)) attempt(states);
}

// With the reactions of the point. In no order, and mirror branches are not told.
BranchSet BranchesWithReactions(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
                                const Arrival& arrival, const ActiveSetTolerance& limit, const FurtherStates& further,
                                const std::function<bool()>& cancelled) {
  BranchSet result;
  std::vector<States> options;
  States natural;
  std::vector<int> weakly_active;
  double combinations = 1.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    options.push_back(Options(*contacts[i], point, i, limit));
    natural.push_back(options[i].front());
    combinations *= static_cast<double>(options[i].size());
    if (options[i].size() > 1) weakly_active.push_back(static_cast<int>(i));
  }
  result.weakly_active = static_cast<int>(weakly_active.size());
  Finder finder(structure, contacts, point, arrival, limit, cancelled);
  // Where another path crosses, rates are not unique, and every combination is looked at as a whole.
  std::optional<RateProblem> problem;
  const double entries = static_cast<double>(point.u.size()) * static_cast<double>(2 * weakly_active.size() + 1);
  if (combinations > kFewCombinations && weakly_active.size() <= kMostCondensedContacts && !arrival.singular &&
      entries <= kMostCondensed)
    problem.emplace(structure, contacts, point, natural, weakly_active, arrival.direction);
  const RateProblem* condensed = problem && problem->regular() ? &*problem : nullptr;
  result.complete = combinations <= kMostCombinations;
  if (result.complete)
    TryAll(options, condensed, &finder, &result);
  else
    TryLikely(options, point, arrival, condensed, further, &finder, &result);
  if (result.branches.empty() && !result.complete && combinations <= kMostIfNone) {
    TryAll(options, condensed, &finder, &result);
    result.complete = true;
  }
  if (result.branches.empty() && condensed != nullptr) finder.Try(natural, &result.branches);  // for its rigid modes
  result.rigid_modes = finder.rigid_modes();
  result.cancelled = finder.Cancelled();
  return result;
}

bool GoesOn(const Branch& branch) { return std::cos(branch.deviation) > tolerances::kRate; }

// A branch that needs no change of reactions comes before one in the same direction that does.
void AddOthers(BranchSet&& others, const PathPoint& begin, BranchSet* result) {
  for (Branch& branch : others.branches) {
    const bool known = std::any_of(result->branches.begin(), result->branches.end(), [&](const Branch& other) {
      return (other.direction - branch.direction).norm() < tolerances::kSameDirection;
    });
    if (known) continue;
    branch.begin = begin;
    result->branches.push_back(std::move(branch));
  }
  result->weakly_active = std::max(result->weakly_active, others.weakly_active);
  result->complete = result->complete && others.complete;
  result->cancelled = result->cancelled || others.cancelled;
  result->combinations += others.combinations;
  result->rigid_modes = std::max(result->rigid_modes, others.rigid_modes);
}

}  // namespace

double DissipationRate(const ContactPairs& contacts, const std::vector<ContactState>& states, const PathPoint& point,
                       const Eigen::VectorXd& direction) {
  double rate = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (Slips(states[i]))
      rate -= point.rt[static_cast<Eigen::Index>(i)] *
              contacts[i]->SlipRate(point.u, point.s, direction, direction[direction.size() - 1]);
  return std::max(rate, 0.0);  // but for rounding
}

BranchSet FindBranches(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
                       const Arrival& arrival, const ActiveSetTolerance& limit, const FurtherStates& further,
                       const std::function<bool()>& cancelled) {
  BranchSet result = BranchesWithReactions(structure, contacts, point, arrival, limit, further, cancelled);
  if (!result.cancelled && std::none_of(result.branches.begin(), result.branches.end(), GoesOn)) {
    const ReactionRedistributions others = FindReactionRedistributions(contacts, point, limit);
    result.complete = result.complete && others.complete;
    for (const PathPoint& begin : others.points) {
      if (result.cancelled) break;
      AddOthers(BranchesWithReactions(structure, contacts, begin, arrival, limit, further, cancelled), begin, &result);
    }
  }
  SortBranches(point.states, arrival.load_sense, &result.branches);
  return result;
}

}  // namespace contact_path
