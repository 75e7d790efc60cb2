// LU factors of a large Jacobian with one row added.
#ifndef CONTACT_PATH_SRC_LINEAR_LARGE_FACTORS_H_
#define CONTACT_PATH_SRC_LINEAR_LARGE_FACTORS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "contact_path/linear/frame.h"
#include "linear/low_rank_update.h"
#include "linear/ordering.h"

namespace contact_path {

// M = [J; row]. A row of many entries would fill the factors, and one of few is another in each solver: a border with
// few entries, whose places stay, stands for it. N = [J; border], N v = (0, 1); the solution of M x = (b, last) is
// x = y + a v where N y = (b, 0) and row . x = last, and det M = det N (row . v). N is regular where J has full rank
// and the border is not orthogonal to its null vector.
// Where N differs in few equations from the matrix N0 of other factors of the frame, as where few laws have changed
// their states at one point, these serve.
class LargeFactors {
 public:
  void Free();
  // transposed: J', n x (n - 1); row: n entries. frame: of the system, or null. Everything is finite. False if M is
  // singular: a pivot below tolerances::kSingularPivot of the largest.
  bool Factorize(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row, const Frame* frame);
  // The factors of the same J with another row; false if they are singular, until the next row.
  bool ReplaceRow(const Eigen::VectorXd& row);

  // Of the pivots of N0, smallest over largest.
  double PivotRatio() const { return made_->factors.PivotRatio(); }
  int DeterminantSign() const;
  // Of J without its last unknown of the frame, as BorderedSolver has it. symmetric: its first equations.
  std::optional<Eigen::Index> NegativeEigenvalues(Eigen::Index symmetric) const;
  // In place: M x = (b, last) for each of so many columns of n entries.
  void Solve(double* x, Eigen::Index columns);
  // In place: M' y = c, c of the unknowns, y of the equations and of the row. M' = N' + (row - border) e', e of the
  // row: N' y = c - (row - border) y_e, y_e = (v . c) / (row . v).
  void SolveTransposed(double* y);

 private:
  void SetRow(const Eigen::VectorXd& row);
  bool SetValues(const Eigen::SparseMatrix<double>& transposed, const Frame& frame);
  // any_border: also with one that is nearly orthogonal to the null vector of J.
  bool FactorizeBordered(bool any_border);
  // By factors that solvers of the frame have; false if they do not serve.
  bool Update(const Frame& frame);
  bool IsRegular(bool any_border);
  // The update from N0 to N; false if it does not serve.
  bool TakeDifferences();

  Orderings own_orderings_;  // of systems without a frame
  std::shared_ptr<const Ordering> ordering_;
  std::shared_ptr<OrderedFactors> made_;  // of N0
  std::vector<int> changed_;              // equations in which N differs from N0
  LowRankUpdate update_;                  // of N0 to N
  std::vector<int> unknowns_, equations_;
  bool odd_ = false;
  Eigen::VectorXd values_;           // of J
  Eigen::VectorXd border_;           // at the places of the ordering
  Eigen::VectorXd row_, direction_;  // row, v: in the frame
  double along_ = 1.0;               // row . v
  Eigen::VectorXd right_, solution_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_LARGE_FACTORS_H_
