#include "contact_path/branch/rate_complementarity.h"

#include <Eigen/LU>
#include <algorithm>
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

bool Has(const ContactModes& modes, ContactState state) {
  return std::any_of(modes.begin(), modes.end(), [state](const ContactMode& mode) { return mode.state == state; });
}

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
    if (Has(modes, ContactState::kOpen))
      roles_.push_back(contact.Frictional() ? Role::kRough : Role::kFrictionless);
    else if (!contact.Frictional())
      return false;  // it bears a force where patches meet: one state, and no pair
    else if (Has(modes, ContactState::kSlipPlus))
      roles_.push_back(Role::kEdgePlus);
    else
      roles_.push_back(Role::kEdgeMinus);
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
  const auto at_edge = [](Role role) { return role == Role::kEdgePlus || role == Role::kEdgeMinus; };
  // First what has to be: contacts at the edge of their cones stay closed, and smooth ones bear no tangential force. A
  // contact at a node that others hold stays closed by itself, and its reaction need not change.
  // Where such a motion is of a part that nothing holds, its force holds the part, and vanishes.
  for (std::size_t k = 0; k < roles_.size(); ++k)
    if (at_edge(roles_[k]) && !take(static_cast<Eigen::Index>(2 * k), true) &&
        !take(static_cast<Eigen::Index>(2 * k), false))
      return std::nullopt;
  for (const bool normal : {true, false})
    for (std::size_t k = 0; k < roles_.size(); ++k) {
      const auto direction = static_cast<Eigen::Index>(2 * k + (normal ? 0 : 1));
      if (normal && at_edge(roles_[k])) continue;
      if (!normal && roles_[k] == Role::kFrictionless) continue;
      if (!take(direction, true) && !take(direction, false)) return std::nullopt;
    }
  for (std::size_t k = 0; k < roles_.size(); ++k) {
    const auto direction = static_cast<Eigen::Index>(2 * k + 1);
    if (roles_[k] == Role::kFrictionless && !take(direction, false) && !take(direction, true)) return std::nullopt;
  }
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

  // g = Q z + C y, z: the second variables of the pairs.
  const auto is_given = [&](Eigen::Index d) { return (*given)[static_cast<std::size_t>(d)]; };
  for (Eigen::Index k = 0; k < count; ++k) {
    const Role role = roles_[static_cast<std::size_t>(k)];
    const Eigen::Index n = 2 * k, t = n + 1;
    if (role == Role::kFrictionless || role == Role::kRough)
      pairs_.push_back({k, Inequality::kNormalReaction, is_given(n)});
    if (role == Role::kRough) {
      pairs_.push_back({k, Inequality::kConePlus, is_given(t)});
      pairs_.push_back({k, Inequality::kConeMinus, true});
    }
    if (role == Role::kEdgePlus) pairs_.push_back({k, Inequality::kConePlus, is_given(t)});
    if (role == Role::kEdgeMinus) pairs_.push_back({k, Inequality::kConeMinus, is_given(t)});
  }
  const auto num_pairs = static_cast<Eigen::Index>(pairs_.size());
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(size, num_pairs), C = Eigen::MatrixXd::Zero(size, size);
  std::vector<Eigen::Index> normal_pair(static_cast<std::size_t>(count), -1);
  bool coupled = false;
  for (Eigen::Index p = 0; p < num_pairs; ++p) {
    const Pair& pair = pairs_[static_cast<std::size_t>(p)];
    const Eigen::Index n = 2 * pair.contact, t = n + 1;
    if (pair.force == Inequality::kNormalReaction) {
      Q(n, p) = 1.0;
      normal_pair[static_cast<std::size_t>(pair.contact)] = p;
      continue;
    }
    const double sense = pair.force == Inequality::kConePlus ? 1.0 : -1.0;
    if (is_given(t)) {
      Q(t, p) = sense;  // v_t
      continue;
    }
    if (pair.motion_is_second) continue;  // z-, which is no share of the force
    // r_t = sense (w - mu r_n)
    const double friction =
        contacts_[static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(pair.contact)])]->Friction();
    Q(t, p) = sense;
    if (is_given(n)) {
      C(t, n) = -sense * friction;  // r_n follows
      coupled = true;
    } else if (const Eigen::Index normal = normal_pair[static_cast<std::size_t>(pair.contact)]; normal >= 0) {
      Q(t, normal) = -sense * friction;
    }
  }
  Eigen::MatrixXd Y = G * Q;
  if (coupled) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> coupling(Eigen::MatrixXd::Identity(size, size) - G * C);
    if (!(coupling.rcond() > tolerances::kSingularPivot)) return;
    Y = coupling.solve(Y);
    h = coupling.solve(h);
  }
  Eigen::MatrixXd g = Q;
  Eigen::VectorXd g_load = Eigen::VectorXd::Zero(size);
  if (coupled) {
    g += C * Y;
    g_load = C * h;
  }

  // The first variables.
  matrix_.resize(num_pairs, num_pairs);
  load_.resize(num_pairs);
  for (Eigen::Index p = 0; p < num_pairs; ++p) {
    const Pair& pair = pairs_[static_cast<std::size_t>(p)];
    const Eigen::Index n = 2 * pair.contact, t = n + 1;
    if (pair.force == Inequality::kNormalReaction) {
      matrix_.row(p) = Y.row(n);
      load_[p] = h[n];
      continue;
    }
    const double sense = pair.force == Inequality::kConePlus ? 1.0 : -1.0;
    const double friction =
        contacts_[static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(pair.contact)])]->Friction();
    const Eigen::RowVectorXd rn = is_given(n) ? Y.row(n) : g.row(n);
    const double rn_load = is_given(n) ? h[n] : g_load[n];
    if (pair.motion_is_second) {
      // w = mu r_n + sense r_t
      const Eigen::RowVectorXd rt = is_given(t) ? Y.row(t) : g.row(t);
      matrix_.row(p) = friction * rn + sense * rt;
      load_[p] = friction * rn_load + sense * (is_given(t) ? h[t] : g_load[t]);
    } else {
      // z = sense v_t, and of a contact that may slide either way what it slides the other way.
      matrix_.row(p) = sense * Y.row(t);
      load_[p] = sense * h[t];
      if (roles_[static_cast<std::size_t>(pair.contact)] == Role::kRough) matrix_(p, p + 1) += 1.0;
    }
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
  for (const ComplementaritySolution& solution : SolveComplementarity(matrix_, load_sense * load_).list) {
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
