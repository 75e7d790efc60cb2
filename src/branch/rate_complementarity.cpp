#include "contact_path/branch/rate_complementarity.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contact_path/branch/complementarity.h"
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

// A^-1 B; nothing where A is singular. Rows and columns that are of other sizes, as those of ports that hardly give
// way, do not make it so.
std::optional<Eigen::MatrixXd> Solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A);
  if (lu.rcond() > tolerances::kSingularPivot) return lu.solve(B);
  const Eigen::VectorXd rows = A.rowwise().lpNorm<Eigen::Infinity>().cwiseInverse();
  const Eigen::VectorXd columns = (rows.asDiagonal() * A).colwise().lpNorm<Eigen::Infinity>().cwiseInverse();
  const Eigen::PartialPivLU<Eigen::MatrixXd> even(rows.asDiagonal() * A * columns.asDiagonal());
  if (!(even.rcond() > tolerances::kSingularPivot)) return std::nullopt;
  return columns.asDiagonal() * even.solve(rows.asDiagonal() * B);
}

}  // namespace

std::optional<std::vector<bool>> RateComplementarity::GivenMotions(const Eigen::MatrixXd& A) const {
  const Eigen::Index size = A.rows();
  IndependentColumns columns(size);
  std::vector<bool> given(static_cast<std::size_t>(size), true);
  // A force, or a motion, is what follows.
  const auto take = [&](Eigen::Index direction, bool motion_is_given) {
    const double compliance = compliance_[direction];
    Eigen::VectorXd column = -(1.0 - (motion_is_given ? compliance : 0.0)) * A.col(direction);
    if (!motion_is_given) column[direction] += 1.0;
    if (motion_is_given && compliance != 0.0) column[direction] -= compliance;
    if (!columns.Take(std::move(column))) return false;
    given[static_cast<std::size_t>(direction)] = motion_is_given;
    return true;
  };
  // First what has to be: motions that are held whatever happens, and at last forces that are none. A node that others
  // hold stays where it is by itself, and its forces need not change. Where such a motion is of a part that nothing
  // holds, its force holds the part, and vanishes.
  for (int turn = RatePairs::kHeld; turn <= RatePairs::kFree; ++turn)
    for (Eigen::Index direction = 0; direction < size; ++direction)
      if (pairs_.TurnOf(direction) == turn && !take(direction, turn != RatePairs::kFree) &&
          !take(direction, turn == RatePairs::kFree))
        return std::nullopt;
  return given;
}

RateComplementarity::RateComplementarity(const RatePairs& pairs, const RateProblem& rates)
    : pairs_(pairs), compliance_(pairs.Compliances().cwiseProduct(rates.Springs())) {
  const Eigen::Index size = rates.MotionRates().rows();
  // v = A (r + v) + b s', r over the stiffness of the spring of the port: the springs are part of the condensed
  // problem. With a compliance c, times that stiffness, the motion v stands for v + c r: v - A v - (A (1 - c) + c) r =
  // b s'.
  const Eigen::MatrixXd A = rates.MotionRates().rightCols(size);
  const Eigen::VectorXd b = rates.MotionRates().col(0);
  const std::optional<std::vector<bool>> given = GivenMotions(A);
  if (!given) return;
  // What follows, y, from what is given, g: y = G g + h s'. y and g: by direction, a motion or a force.
  Eigen::MatrixXd follows = -A, given_columns = A;
  for (Eigen::Index d = 0; d < size; ++d) {
    Eigen::MatrixXd& of_force = (*given)[static_cast<std::size_t>(d)] ? follows : given_columns;
    if (compliance_[d] != 0.0) {
      of_force.col(d) *= 1.0 - compliance_[d];
      of_force(d, d) += (*given)[static_cast<std::size_t>(d)] ? -compliance_[d] : compliance_[d];
    }
    if ((*given)[static_cast<std::size_t>(d)])
      given_columns(d, d) -= 1.0;
    else
      follows(d, d) += 1.0;
  }
  Eigen::MatrixXd right(size, size + 1);
  right << given_columns, b;
  const std::optional<Eigen::MatrixXd> solved = Solved(follows, right);
  if (!solved) return;
  const Eigen::MatrixXd G = solved->leftCols(size);
  Eigen::VectorXd h = solved->col(size);

  // Of two pairs of one port the second has its motion as a share of the port's.
  const std::vector<RatePairs::Pair>& all = pairs.pairs();
  for (std::size_t p = 0; p < all.size(); ++p)
    motion_is_second_.push_back((*given)[static_cast<std::size_t>(all[p].port)] || (p > 0 && all[p - 1].first_of_two));

  // The second variables of the pairs are Z z = D g + E y, so that g = (D + E G)^-1 (Z z - E h s').
  const auto num_pairs = static_cast<Eigen::Index>(all.size());
  Eigen::MatrixXd D = Eigen::MatrixXd::Identity(size, size), Z = Eigen::MatrixXd::Zero(size, num_pairs);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(size);
  for (Eigen::Index p = 0; p < num_pairs; ++p) {
    const RatePairs::Pair& pair = all[static_cast<std::size_t>(p)];
    const Eigen::Index t = pair.port, n = pair.other;
    // Of the motion, or of the force with those of other ports; the motion the other way, where the force is given, is
    // no share of it.
    if ((*given)[static_cast<std::size_t>(t)] || !motion_is_second_[static_cast<std::size_t>(p)]) Z(t, p) = pair.sign;
    if (motion_is_second_[static_cast<std::size_t>(p)] || n < 0) continue;
    const double ratio = pair.sign * pair.weight;
    if ((*given)[static_cast<std::size_t>(n)]) {
      D.row(t) += ratio * G.row(n);
      d[t] = -ratio * h[n];
    } else {
      D(t, n) = ratio;
    }
  }
  if (!D.isIdentity(0.0)) {
    Eigen::MatrixXd both(size, num_pairs + 1);
    both << Z, d;
    const std::optional<Eigen::MatrixXd> coupled = Solved(D, both);
    if (!coupled) return;
    Z = coupled->leftCols(num_pairs);
    d = coupled->col(num_pairs);
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
    const RatePairs::Pair& pair = all[static_cast<std::size_t>(p)];
    const bool motion = !motion_is_second_[static_cast<std::size_t>(p)];
    Eigen::RowVectorXd row = pair.sign * row_of(pair.port, motion);
    if (pair.other >= 0 && !motion) row += pair.weight * row_of(pair.other, false);
    matrix_.row(p) = row.head(num_pairs);
    load_[p] = row[num_pairs];
    // Of a port that may move either way, the motion one way is its motion and what it moves the other way.
    if (pair.first_of_two && motion) matrix_(p, p + 1) += 1.0;
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
  unique_ = !pairs_.BothWays() && HasOneSolutionForEach(matrix_);
}

std::vector<States> RateComplementarity::Solve(double load_sense) const {
  std::vector<States> solutions;
  for (const ComplementaritySolution& solution : SolveComplementarity(matrix_, load_sense * load_)) {
    // Motions both ways are those of no force: the first one stands for both.
    std::vector<bool> moves;
    for (std::size_t p = 0; p < motion_is_second_.size(); ++p) moves.push_back(solution[p] == motion_is_second_[p]);
    solutions.push_back(pairs_.StatesBeyond(moves));
  }
  return solutions;
}

}  // namespace contact_path
