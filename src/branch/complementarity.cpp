#include "contact_path/branch/complementarity.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "contact_path/tolerances.h"
#include "linear/klu_factors.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kPivotsPerVariable = 10;
constexpr std::size_t kMostUpdates = 64;  // of factors, before they are made anew
constexpr double kUneven = 16.0;          // shares of the second covering vector

// The basic variables, one for each equation, and factors of their columns: those made last, and what has been
// exchanged since (product form of the inverse).
class Basis {
 public:
  // second: by pair, whether z is basic; otherwise w is.
  Basis(const Eigen::SparseMatrix<double>& columns, const ComplementaritySolution& second, Eigen::VectorXd right)
      : columns_(columns), pairs_(static_cast<Eigen::Index>(second.size())), right_(std::move(right)) {
    for (Eigen::Index i = 0; i < columns.rows() - pairs_; ++i) basic_.push_back(i);
    for (const bool z : second) {
      const auto w = static_cast<Eigen::Index>(basic_.size());
      basic_.push_back(z ? w + pairs_ : w);
    }
  }

  // False: they are singular.
  bool Factorize() {
    exchanged_.clear();
    ToOwnPlaces();
    Eigen::SparseMatrix<double> matrix(columns_.rows(), columns_.rows());
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < basic_.size(); ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator it(columns_, basic_[k]); it; ++it)
        entries.emplace_back(it.row(), k, it.value());
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!factors_.Factorize(&matrix, false)) return false;
    values_ = Solve(right_);
    return true;
  }

  // What each basic variable changes by, negative, with a variable outside.
  Eigen::VectorXd Column(Eigen::Index variable) { return Solve(columns_.col(variable)); }

  // The variable becomes basic in place of another one; column: its own. False: the factors were lost in rounding.
  bool Exchange(Eigen::Index place, Eigen::Index variable, const Eigen::VectorXd& column) {
    const double value = values_[place] / column[place];
    values_ -= value * column;
    values_[place] = value;
    basic_[static_cast<std::size_t>(place)] = variable;
    exchanged_.push_back({place, column});
    return exchanged_.size() < kMostUpdates || Factorize();
  }

  void SetRight(Eigen::VectorXd right) { right_ = std::move(right); }
  Eigen::Index Basic(Eigen::Index place) const { return basic_[static_cast<std::size_t>(place)]; }
  const Eigen::VectorXd& Values() const { return values_; }
  double PivotRatio() const { return factors_.PivotRatio(); }

 private:
  struct Exchanged {
    Eigen::Index place;
    Eigen::VectorXd column;
  };

  // Each variable to the place of its equation, so that the pattern is nearly symmetric and the factors are sparse.
  void ToOwnPlaces() {
    const Eigen::Index rows = columns_.rows();
    std::vector<Eigen::Index> sorted(basic_.size(), -1);
    for (const Eigen::Index variable : basic_)
      if (variable < rows + pairs_)
        sorted[static_cast<std::size_t>(variable < rows ? variable : variable - pairs_)] = variable;
    // The variable that covers has the place that is left.
    std::replace(sorted.begin(), sorted.end(), Eigen::Index{-1}, rows + pairs_);
    basic_ = std::move(sorted);
  }

  Eigen::VectorXd Solve(Eigen::VectorXd x) {
    factors_.Solve(x.data());
    for (const Exchanged& of : exchanged_) {
      const double value = x[of.place] / of.column[of.place];
      x -= value * of.column;
      x[of.place] = value;
    }
    return x;
  }

  const Eigen::SparseMatrix<double>& columns_;
  Eigen::Index pairs_;
  Eigen::VectorXd right_, values_;
  std::vector<Eigen::Index> basic_;
  KluFactors factors_;
  std::vector<Exchanged> exchanged_;
};

// The place of the basic variable that is the first to be zero as one with this column grows; -1: none is. Free ones
// may have any sign. last: variable; it leaves where it can.
Eigen::Index FirstBlocked(const Basis& basis, const Eigen::VectorXd& column, Eigen::Index num_free, Eigen::Index last) {
  double level = 0.0;
  for (Eigen::Index place = 0; place < column.size(); ++place)
    if (basis.Basic(place) >= num_free) level = std::max(level, std::abs(column[place]));
  level *= tolerances::kSingularPivot;
  Eigen::Index first = -1;
  double smallest = 0.0;
  for (Eigen::Index place = 0; place < column.size(); ++place) {
    if (basis.Basic(place) < num_free || !(column[place] > level)) continue;
    const double ratio = basis.Values()[place] / column[place];
    if (first < 0 || ratio < smallest || (ratio == smallest && basis.Basic(place) == last)) {
      first = place;
      smallest = ratio;
    }
  }
  return first;
}

// The sum of the columns of the basic variables of the pairs, with these weights.
Eigen::VectorXd SumOfBasic(const ComplementarityProblem& problem, const ComplementaritySolution& second,
                           const Eigen::VectorXd& weights) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(problem.equations.rows());
  for (Eigen::Index pair = 0; pair < problem.pairs; ++pair)
    sum += weights[pair] *
           problem.equations.col(second[static_cast<std::size_t>(pair)] ? problem.Second(pair) : problem.First(pair));
  return sum;
}

// The columns of the problem, and a last one.
Eigen::SparseMatrix<double> WithColumn(const ComplementarityProblem& problem, const Eigen::VectorXd& last) {
  Eigen::SparseMatrix<double> columns = problem.equations;
  columns.conservativeResize(columns.rows(), columns.cols() + 1);
  for (Eigen::Index row = 0; row < last.size(); ++row)
    if (last[row] != 0.0) columns.insert(row, columns.cols() - 1) = last[row];
  columns.makeCompressed();
  return columns;
}

// From where the covering variable takes the place of another one until it leaves. False: it does not.
bool PivotToEnd(Eigen::Index place, const ComplementarityProblem& problem, Basis* basis) {
  const Eigen::Index n = problem.pairs, covering = problem.Second(n);
  Eigen::Index entering = covering;
  for (Eigen::Index pivot = 0; pivot < kPivotsPerVariable * n; ++pivot) {
    const Eigen::VectorXd column = basis->Column(entering);
    if (pivot > 0) place = FirstBlocked(*basis, column, problem.NumFree(), covering);
    if (place < 0) return false;
    const Eigen::Index left = basis->Basic(place);
    if (!basis->Exchange(place, entering, column) || !basis->Values().allFinite()) return false;
    if (left == covering) return true;
    entering = left < problem.Second(0) ? left + n : left - n;
  }
  return false;
}

}  // namespace

std::optional<ComplementaritySolution> SolveByLemke(const ComplementarityProblem& problem, const Eigen::VectorXd& cover,
                                                    ComplementaritySolution start, Eigen::VectorXd* values) {
  const Eigen::Index n = problem.pairs, num_free = problem.NumFree(), covering = problem.Second(n);
  const double size = problem.right.lpNorm<Eigen::Infinity>();
  // Shares that are no multiples of each other.
  Eigen::VectorXd changes(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double share = std::sqrt(2.0) * static_cast<double>(i + 1);
    changes[i] = problem.changes[i] * (0.5 + 0.5 * (share - std::floor(share)));
  }
  ComplementaritySolution second = std::move(start);
  second.resize(static_cast<std::size_t>(n), false);
  const Eigen::SparseMatrix<double> columns = WithColumn(problem, -SumOfBasic(problem, second, cover));
  Basis basis(columns, second, problem.right + SumOfBasic(problem, second, changes));
  if (!basis.Factorize()) return std::nullopt;
  Eigen::Index worst = 0;
  if (n > 0 && basis.Values().tail(n).cwiseQuotient(cover).minCoeff(&worst) < 0.0 &&
      !PivotToEnd(num_free + worst, problem, &basis))
    return std::nullopt;
  // Without the changes: a variable below zero tells that the pivots were lost in rounding.
  basis.SetRight(problem.right);
  if (!basis.Factorize()) return std::nullopt;
  const double error = (tolerances::kRate + tolerances::kLastDigits / basis.PivotRatio()) *
                       std::max(basis.Values().lpNorm<Eigen::Infinity>(), size);
  for (Eigen::Index k = 0; k < columns.rows(); ++k) {
    const Eigen::Index variable = basis.Basic(k);
    if (variable == covering || (variable >= num_free && basis.Values()[k] < -error)) return std::nullopt;
    if (variable >= num_free)
      second[static_cast<std::size_t>((variable - num_free) % n)] = variable >= problem.Second(0);
  }
  if (values != nullptr) *values = basis.Values().tail(n);
  return second;
}

std::vector<ComplementaritySolution> SolveComplementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  const Eigen::Index n = M.rows();
  // w - M z = q, without free variables.
  Eigen::MatrixXd dense(n, 2 * n);
  dense << Eigen::MatrixXd::Identity(n, n), -M;
  ComplementarityProblem problem{dense.sparseView(), q, n,
                                 Eigen::VectorXd::Constant(n, kOfTies * q.lpNorm<Eigen::Infinity>())};
  std::vector<ComplementaritySolution> solutions;
  const auto note = [&](const std::optional<ComplementaritySolution>& second) {
    if (second && std::find(solutions.begin(), solutions.end(), *second) == solutions.end())
      solutions.push_back(*second);
  };
  note(SolveByLemke(problem, Eigen::VectorXd::Ones(n)));
  if (HasOneSolutionForEach(M)) return solutions;
  // Other ways lead to other solutions, where there are several: the variables covered in other shares, and the two of
  // each pair exchanged.
  Eigen::VectorXd uneven(n);
  for (Eigen::Index p = 0; p < n; ++p) uneven[p] = p % 2 == 0 ? 1.0 : kUneven;
  note(SolveByLemke(problem, uneven));
  dense << -M, Eigen::MatrixXd::Identity(n, n);
  problem.equations = dense.sparseView();
  std::optional<ComplementaritySolution> first = SolveByLemke(problem, Eigen::VectorXd::Ones(n));
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
