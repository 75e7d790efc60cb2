#include "contact_path/branch/complementarity.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kPivotsPerVariable = 20;
constexpr double kUneven = 16.0;
constexpr double kTie = 1e-9;  // of the largest entry of q: q is changed by less, each entry by another share

// basic = T nonbasic + right, and the exchange of a basic variable with another one.
class Tableau {
 public:
  // Columns of T: z, then the covering variable. Variables: w_i is i, z_i is n + i, the covering one 2 n.
  Tableau(const Eigen::MatrixXd& M, Eigen::VectorXd q, const Eigen::VectorXd& cover) : n_(M.rows()), t_(n_, n_ + 1) {
    t_ << M, cover;
    right_ = std::move(q);
    for (Eigen::Index i = 0; i < n_; ++i) {
      basic_.push_back(i);
      nonbasic_.push_back(n_ + i);
    }
    nonbasic_.push_back(2 * n_);
  }

  void Exchange(Eigen::Index row, Eigen::Index column) {
    const double pivot = t_(row, column);
    // nonbasic[column] = (basic[row] - others) / pivot.
    Eigen::RowVectorXd line = -t_.row(row) / pivot;
    line[column] = 1.0 / pivot;
    const double value = -right_[row] / pivot;
    const Eigen::VectorXd entering = t_.col(column);
    t_.col(column).setZero();
    t_.noalias() += entering * line;
    right_ += value * entering;
    t_.row(row) = line;
    right_[row] = value;
    std::swap(basic_[static_cast<std::size_t>(row)], nonbasic_[static_cast<std::size_t>(column)]);
  }

  // The row whose basic variable is the first to be zero as the nonbasic one grows; -1: none is.
  Eigen::Index FirstBlocked(Eigen::Index column) const {
    const double level = tolerances::kSingularPivot * t_.col(column).cwiseAbs().maxCoeff();
    Eigen::Index first = -1;
    double smallest = 0.0;
    for (Eigen::Index row = 0; row < n_; ++row) {
      if (!(t_(row, column) < -level)) continue;
      const double ratio = right_[row] / -t_(row, column);
      // The covering variable leaves where it can: the method is then at its end.
      const bool covering = basic_[static_cast<std::size_t>(row)] == 2 * n_;
      if (first < 0 || ratio < smallest || (ratio == smallest && covering)) {
        first = row;
        smallest = ratio;
      }
    }
    return first;
  }

  Eigen::Index ColumnOf(Eigen::Index variable) const {
    Eigen::Index column = 0;
    while (nonbasic_[static_cast<std::size_t>(column)] != variable) ++column;
    return column;
  }

  Eigen::Index Basic(Eigen::Index row) const { return basic_[static_cast<std::size_t>(row)]; }
  const Eigen::VectorXd& Values() const { return right_; }

 private:
  Eigen::Index n_;
  Eigen::MatrixXd t_;
  Eigen::VectorXd right_;
  std::vector<Eigen::Index> basic_, nonbasic_;
};

// By Lemke's method with the covering vector `cover` > 0: which z are basic. Nothing where it ends on a ray, or the
// pivots are lost in rounding.
std::optional<ComplementaritySolution> SolveByLemke(const Eigen::MatrixXd& M, const Eigen::VectorXd& q,
                                                    const Eigen::VectorXd& cover) {
  const Eigen::Index n = M.rows();
  Eigen::VectorXd changed = q;
  const double size = q.lpNorm<Eigen::Infinity>();
  // Shares that are no multiples of each other.
  for (Eigen::Index i = 0; i < n; ++i) {
    const double share = std::sqrt(2.0) * static_cast<double>(i + 1);
    changed[i] += kTie * size * (0.5 + 0.5 * (share - std::floor(share)));
  }
  std::vector<bool> basic(static_cast<std::size_t>(n), false);
  if (changed.minCoeff() >= 0.0) return basic;
  Tableau tableau(M, changed, cover);
  Eigen::Index worst = 0;
  changed.cwiseQuotient(cover).minCoeff(&worst);
  tableau.Exchange(worst, n);
  Eigen::Index left = worst;  // variable that has just left the basis
  for (Eigen::Index pivot = 0; pivot < kPivotsPerVariable * n; ++pivot) {
    const Eigen::Index column = tableau.ColumnOf(left < n ? left + n : left - n);
    const Eigen::Index row = tableau.FirstBlocked(column);
    if (row < 0) return std::nullopt;
    left = tableau.Basic(row);
    tableau.Exchange(row, column);
    if (!tableau.Values().allFinite()) return std::nullopt;
    if (left != 2 * n) continue;
    for (Eigen::Index i = 0; i < n; ++i)
      if (tableau.Basic(i) >= n) basic[static_cast<std::size_t>(tableau.Basic(i) - n)] = true;
    return basic;
  }
  return std::nullopt;
}

// Whether no basic variable of this basis is negative: otherwise the pivots were lost in rounding.
bool Holds(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const ComplementaritySolution& second) {
  const Eigen::Index n = M.rows();
  // z of the pairs in `second`, w of the others: M_zz z = -q, w - M_wz z = q.
  Eigen::MatrixXd equations = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index p = 0; p < n; ++p)
    if (second[static_cast<std::size_t>(p)]) equations.col(p) = -M.col(p);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(equations);
  const Eigen::VectorXd values = lu.solve(q);
  // q is known to the tolerance of rates.
  const double error = (tolerances::kRate + tolerances::kLastDigits / lu.rcond()) *
                       std::max(values.lpNorm<Eigen::Infinity>(), q.lpNorm<Eigen::Infinity>());
  return values.minCoeff() >= -error;
}

}  // namespace

std::vector<ComplementaritySolution> SolveComplementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  const Eigen::Index n = M.rows();
  std::vector<ComplementaritySolution> solutions;
  const auto note = [&](const std::optional<ComplementaritySolution>& second) {
    if (second && Holds(M, q, *second) && std::find(solutions.begin(), solutions.end(), *second) == solutions.end())
      solutions.push_back(*second);
  };
  note(SolveByLemke(M, q, Eigen::VectorXd::Ones(n)));
  if (HasOneSolutionForEach(M)) return solutions;
  // Other ways lead to other solutions, where there are several: the variables covered in other shares, and the two of
  // each pair exchanged, z = M^-1 w - M^-1 q.
  Eigen::VectorXd uneven(n);
  for (Eigen::Index p = 0; p < n; ++p) uneven[p] = p % 2 == 0 ? 1.0 : kUneven;
  note(SolveByLemke(M, q, uneven));
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(M);
  if (!(lu.rcond() > tolerances::kSingularPivot)) return solutions;
  std::optional<ComplementaritySolution> first = SolveByLemke(lu.inverse(), -lu.solve(q), Eigen::VectorXd::Ones(n));
  if (first) first->flip();
  note(first);
  return solutions;
}

bool HasOneSolutionForEach(const Eigen::MatrixXd& M) {
  if (M.rows() == 0) return true;
  const Eigen::LLT<Eigen::MatrixXd> factors(0.5 * (M + M.transpose()));
  return factors.info() == Eigen::Success && factors.rcond() > tolerances::kDependent;
}

}  // namespace contact_path
