// The complementarity problem of the rates in forces, with springs that hold what nothing else does.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contact_path/branch/complementarity.h"
#include "contact_path/branch/rate_complementarity.h"

namespace contact_path {

std::vector<States> RateComplementarity::SolveByForces(double load_sense, double share) const {
  const Eigen::Index size = compliance_.size();
  // v = A (r + (1 - share) v) + b s', r over the stiffness of the spring of the port; then over that of the stiffest.
  const Eigen::MatrixXd A = rates_.MotionRates().rightCols(size);
  const Eigen::PartialPivLU<Eigen::MatrixXd> held_by_springs(Eigen::MatrixXd::Identity(size, size) - (1.0 - share) * A);
  const Eigen::VectorXd over = rates_.Springs().maxCoeff() * rates_.Springs().cwiseInverse();
  const Eigen::MatrixXd S = held_by_springs.solve(Eigen::MatrixXd(A * over.asDiagonal())) +
                            Eigen::MatrixXd(compliance_.cwiseProduct(over).asDiagonal());
  const Eigen::VectorXd free = load_sense * held_by_springs.solve(rates_.MotionRates().col(0));

  // Variables: of each pair a force; of a port that may slip both ways the size of its slip, too. w = T (S r + free) +
  // L x with the forces r = F x + G y, y of what is held.
  const auto slips = std::count_if(pairs_.begin(), pairs_.end(), [](const Pair& pair) { return pair.first_of_two; });
  const auto count = static_cast<Eigen::Index>(pairs_.size());
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(size, count + slips), G = Eigen::MatrixXd::Identity(size, size), T, L;
  T.setZero(count + slips, size);
  L.setZero(count + slips, count + slips);
  std::vector<bool> held(static_cast<std::size_t>(size));
  std::vector<Eigen::Index> slip_of(pairs_.size(), -1), force_of(static_cast<std::size_t>(size), -1);
  for (std::size_t d = 0; d < held.size(); ++d) held[d] = turn_[d] == kHeld;
  Eigen::Index slip = count;
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto p = static_cast<std::size_t>(j);
    const Pair& pair = pairs_[p];
    const bool second = p > 0 && pairs_[p - 1].first_of_two, both_ways = pair.first_of_two || second;
    // Where it slips either way, the force against a slip; else w.
    F(pair.port, j) = T(j, pair.port) = both_ways ? -pair.sign : pair.sign;
    if (pair.other < 0) {
      force_of[static_cast<std::size_t>(pair.port)] = j;
    } else if (!both_ways) {
      G(pair.port, pair.other) = -pair.sign * pair.weight;
    } else {
      if (pair.first_of_two) {
        if (force_of[static_cast<std::size_t>(pair.other)] < 0) return {};
        L(slip, force_of[static_cast<std::size_t>(pair.other)]) = pair.weight;
      }
      slip_of[p] = slip;
      L(j, slip) = 1.0;
      L(slip, j) = -1.0;
      if (second) ++slip;
    }
  }
  std::vector<Eigen::Index> kept;
  for (Eigen::Index d = 0; d < size; ++d)
    if (held[static_cast<std::size_t>(d)]) kept.push_back(d);
  const Eigen::MatrixXd given = G(Eigen::all, kept);
  const Eigen::PartialPivLU<Eigen::MatrixXd> of_held((S * given)(kept, Eigen::all));
  const auto without_held = [&](const Eigen::MatrixXd& motions) -> Eigen::MatrixXd {
    if (kept.empty()) return motions;
    return motions - S * (given * of_held.solve(Eigen::MatrixXd(motions(kept, Eigen::all))));
  };
  Eigen::MatrixXd M = T * without_held(S * F) + L;
  Eigen::VectorXd q = T * without_held(free);
  Eigen::VectorXd scale(M.rows());
  for (Eigen::Index j = 0; j < count; ++j) {
    scale[j] = M(j, j) > 0.0 ? 1.0 / std::sqrt(M(j, j)) : 1.0;
    if (const Eigen::Index of = slip_of[static_cast<std::size_t>(j)]; of >= 0) scale[of] = 1.0 / scale[j];
  }
  M = scale.asDiagonal() * M * scale.asDiagonal();
  q = scale.cwiseProduct(q);
  if (!M.allFinite() || !q.allFinite()) return {};

  std::vector<States> found;
  for (const ComplementaritySolution& basic : SolveComplementarity(M, q)) {
    States& states = found.emplace_back(AtBase());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      int& state = states[static_cast<std::size_t>(weakly_active_[pairs_[p].law])];
      const bool beyond = slip_of[p] >= 0 ? basic[static_cast<std::size_t>(slip_of[p])] && basic[p] : !basic[p];
      if (beyond && state == base_[pairs_[p].law]) state = pairs_[p].next;
    }
  }
  return found;
}

}  // namespace contact_path
