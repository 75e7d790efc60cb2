#include "contact_path/branch/rate_complementarity.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contact_path/branch/complementarity.h"
#include "contact_path/equations/transitions.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Columns that are taken one after another, each unless it depends on those before.
class IndependentColumns {
 public:
  explicit IndependentColumns(Eigen::Index size) : used_(static_cast<std::size_t>(size), false) {}

  bool Take(Eigen::VectorXd column) {
    const double size = column.lpNorm<Eigen::Infinity>();
    for (std::size_t j = 0; j < factors_.size(); ++j) {
      const double value = column[rows_[j]];
      if (value != 0.0) column -= value * factors_[j];
    }
    Eigen::Index row = -1;
    double pivot = tolerances::kDependent * size;
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      if (used_[static_cast<std::size_t>(i)] || !(std::abs(column[i]) > pivot)) continue;
      pivot = std::abs(column[i]);
      row = i;
    }
    if (row < 0) return false;
    column /= column[row];
    for (const Eigen::Index before : rows_) column[before] = 0.0;
    factors_.push_back(column);
    rows_.push_back(row);
    used_[static_cast<std::size_t>(row)] = true;
    return true;
  }

 private:
  std::vector<bool> used_;  // rows
  std::vector<Eigen::Index> rows_;
  std::vector<Eigen::VectorXd> factors_;
};

}  // namespace

RateComplementarity::RateComplementarity(const ContactPairs& contacts, const RateProblem& rates,
                                         const std::vector<ContactModes>& options,
                                         const std::vector<int>& weakly_active)
    : contacts_(contacts), options_(options), weakly_active_(weakly_active) {
  if (rates.regular() && FindRoles()) Build(rates);
}

bool RateComplementarity::FindRoles() {
  for (const int i : weakly_active_) {
    const ContactPair& contact = *contacts_[static_cast<std::size_t>(i)];
    const ContactModes& modes = options_[static_cast<std::size_t>(i)];
    if (contact.HasTotalLaw()) return false;
    if (HasState(modes, ContactState::kOpen))
      roles_.push_back(contact.Frictional() ? Role::kRough : Role::kFrictionless);
    else if (HasState(modes, ContactState::kSlipPlus) == HasState(modes, ContactState::kSlipMinus))
      return false;  // no pair: a smooth contact where patches meet, or a cone as narrow as rounding
    else
      roles_.push_back(HasState(modes, ContactState::kSlipPlus) ? Role::kEdgePlus : Role::kEdgeMinus);
  }
  return true;
}

std::optional<std::vector<bool>> RateComplementarity::GivenMotions(const Eigen::MatrixXd& A) const {
  const Eigen::Index size = A.rows();
  IndependentColumns columns(size);
  std::vector<bool> given(static_cast<std::size_t>(size), true);
  // A force -A e, or a motion (1 - A) e, is what follows.
  const auto take = [&](Eigen::Index direction, bool motion_is_given) {
    Eigen::VectorXd column = -A.col(direction);
    if (!motion_is_given) column[direction] += 1.0;
    if (!columns.Take(std::move(column))) return false;
    given[static_cast<std::size_t>(direction)] = motion_is_given;
    return true;
  };
  // First what has to be: contacts at the edge of their cones stay closed, and at last smooth ones bear no tangential
  // force. A contact at a node that others hold stays closed by itself, and its reaction need not change. Where such a
  // motion is of a part that nothing holds, its force holds the part, and vanishes.
  std::array<std::vector<Eigen::Index>, 4> in_turn;
  for (std::size_t k = 0; k < roles_.size(); ++k) {
    in_turn[AtEdge(roles_[k]) ? 0 : 1].push_back(static_cast<Eigen::Index>(2 * k));
    in_turn[roles_[k] == Role::kFrictionless ? 3 : 2].push_back(static_cast<Eigen::Index>(2 * k + 1));
  }
  for (std::size_t turn = 0; turn < in_turn.size(); ++turn)
    for (const Eigen::Index direction : in_turn[turn])
      if (!take(direction, turn < 3) && !take(direction, turn == 3)) return std::nullopt;
  return given;
}

void RateComplementarity::Build(const RateProblem& rates) {
  const auto count = static_cast<Eigen::Index>(roles_.size()), size = 2 * count;
  // v = A (r + v) + b s': springs of stiffness 1 are part of the condensed problem.
  Eigen::MatrixXd A(size, size);
  Eigen::VectorXd b(size);
  for (Eigen::Index k = 0; k < count; ++k) {
    A.row(2 * k) = rates.GapRates().row(k).tail(size);
    A.row(2 * k + 1) = rates.SlipRates().row(k).tail(size);
    b[2 * k] = rates.GapRates()(k, 0);
    b[2 * k + 1] = rates.SlipRates()(k, 0);
  }
  const std::optional<std::vector<bool>> given = GivenMotions(A);
  if (!given) return;
  // What follows, y, from what is given, g: y = G g + h s'. y and g: by direction, a motion or a force.
  Eigen::MatrixXd follows = -A, given_columns = A;
  for (Eigen::Index d = 0; d < size; ++d) {
    if ((*given)[static_cast<std::size_t>(d)])
      given_columns(d, d) -= 1.0;
    else
      follows(d, d) += 1.0;
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(follows);
  if (!(lu.rcond() > tolerances::kSingularPivot)) return;
  Eigen::MatrixXd G = lu.solve(given_columns);
  Eigen::VectorXd h = lu.solve(b);

  for (Eigen::Index k = 0; k < count; ++k) {
    const Role role = roles_[static_cast<std::size_t>(k)];
    const bool normal = (*given)[static_cast<std::size_t>(2 * k)],
               tangential = (*given)[static_cast<std::size_t>(2 * k + 1)];
    if (!AtEdge(role)) pairs_.push_back({k, Inequality::kNormalReaction, normal});
    if (role == Role::kRough || role == Role::kEdgePlus) pairs_.push_back({k, Inequality::kConePlus, tangential});
    if (role == Role::kRough) pairs_.push_back({k, Inequality::kConeMinus, true});
    if (role == Role::kEdgeMinus) pairs_.push_back({k, Inequality::kConeMinus, tangential});
  }

  // The second variables of the pairs are Z z = D g + E y, so that g = (D + E G)^-1 (Z z - E h s').
  const auto num_pairs = static_cast<Eigen::Index>(pairs_.size());
  Eigen::MatrixXd D = Eigen::MatrixXd::Identity(size, size), Z = Eigen::MatrixXd::Zero(size, num_pairs);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(size);
  const auto friction = [&](const Pair& pair) {
    return contacts_[static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(pair.contact)])]->Friction();
  };
  for (Eigen::Index p = 0; p < num_pairs; ++p) {
    const Pair& pair = pairs_[static_cast<std::size_t>(p)];
    const Eigen::Index n = 2 * pair.contact, t = n + 1;
    const bool given_motion = (*given)[static_cast<std::size_t>(t)];
    if (pair.force == Inequality::kNormalReaction) {
      Z(n, p) = 1.0;
    } else if (given_motion || !pair.motion_is_second) {
      Z(t, p) = pair.Sense();  // of v_t, or of r_t + sense mu r_n; z-, where r_t is given, is no share of it
    }
    if (pair.motion_is_second || pair.force == Inequality::kNormalReaction) continue;
    const double ratio = pair.Sense() * friction(pair);
    if ((*given)[static_cast<std::size_t>(n)]) {
      D.row(t) += ratio * G.row(n);
      d[t] = -ratio * h[n];
    } else {
      D(t, n) = ratio;
    }
  }
  if (!D.isIdentity(0.0)) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> coupling(D);
    if (!(coupling.rcond() > tolerances::kSingularPivot)) return;
    Z = coupling.solve(Z);
    d = coupling.solve(d);
  }
  Eigen::MatrixXd Y = G * Z;
  h += G * d;

  // The first variables. Column: of z, then s'.
  const auto row_of = [&](Eigen::Index direction, bool motion) {
    Eigen::RowVectorXd row(num_pairs + 1);
    if ((*given)[static_cast<std::size_t>(direction)] == motion)
      row << Z.row(direction), d[direction];
    else
      row << Y.row(direction), h[direction];
    return row;
  };
  matrix_.resize(num_pairs, num_pairs);
  load_.resize(num_pairs);
  for (Eigen::Index p = 0; p < num_pairs; ++p) {
    const Pair& pair = pairs_[static_cast<std::size_t>(p)];
    const Eigen::Index n = 2 * pair.contact, t = n + 1;
    const bool motion = !pair.motion_is_second;
    Eigen::RowVectorXd row;
    if (pair.force == Inequality::kNormalReaction)
      row = row_of(n, motion);
    else
      row = pair.Sense() * row_of(t, motion);
    if (pair.force != Inequality::kNormalReaction && !motion) row += friction(pair) * row_of(n, false);
    matrix_.row(p) = row.head(num_pairs);
    load_[p] = row[num_pairs];
    // Of a contact that may slide either way, z+ is v_t and what it slides the other way.
    if (pair.force == Inequality::kConePlus && motion && roles_[static_cast<std::size_t>(pair.contact)] == Role::kRough)
      matrix_(p, p + 1) += 1.0;
  }
  if (!matrix_.allFinite() || !load_.allFinite()) return;
  Eigen::VectorXd scale(num_pairs);
  for (Eigen::Index p = 0; p < num_pairs; ++p) {
    const double largest = std::max(matrix_.row(p).lpNorm<Eigen::Infinity>(), matrix_.col(p).lpNorm<Eigen::Infinity>());
    const double size_of = std::max(std::abs(matrix_(p, p)), tolerances::kSingularPivot * largest);
    scale[p] = size_of > 0.0 ? 1.0 / std::sqrt(size_of) : 1.0;
  }
  matrix_ = scale.asDiagonal() * matrix_ * scale.asDiagonal();
  load_ = scale.cwiseProduct(load_);
  exists_ = true;
  unique_ = std::none_of(roles_.begin(), roles_.end(), [](Role role) { return role == Role::kRough; }) &&
            HasOneSolutionForEach(matrix_);
}

std::vector<RateSolution> RateComplementarity::Solve(double load_sense) const {
  std::vector<RateSolution> solutions;
  for (const ComplementaritySolution& solution : SolveComplementarity(matrix_, load_sense * load_)) {
    solutions.push_back({{}, !solution.degenerate.empty()});
    std::vector<ContactState>& states = solutions.back().states;
    for (const ContactModes& option : options_) states.push_back(option.front().state);
    for (std::size_t k = 0; k < roles_.size(); ++k)
      states[static_cast<std::size_t>(weakly_active_[k])] =
          roles_[k] == Role::kFrictionless ? ContactState::kClosed : ContactState::kStick;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const auto i = static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(pairs_[p].contact)]);
      const bool moves = solution.second[p] == pairs_[p].motion_is_second;
      // Motions both ways are those of no reaction: the first one stands for both.
      if (moves && states[i] != ContactState::kOpen && !Slips(states[i]))
        states[i] = NextMode(*contacts_[i], pairs_[p].force, {states[i], 0}).state;
    }
  }
  return solutions;
}

}  // namespace contact_path
