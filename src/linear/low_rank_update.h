// Solutions of equations of which few differ from those that were factorised.
#ifndef CONTACT_PATH_SRC_LINEAR_LOW_RANK_UPDATE_H_
#define CONTACT_PATH_SRC_LINEAR_LOW_RANK_UPDATE_H_

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <utility>

namespace contact_path {

// A = A0 + E D, E the columns of 1 of the equations that differ. With Z = A0^-1 E and C = 1 + D Z, A^-1 = A0^-1 - Z
// C^-1 D A0^-1 and det A = det A0 det C (Sherman, Morrison & Woodbury).
class LowRankUpdate {
 public:
  using Differences = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  // A = A0.
  void Clear() { moved_.resize(0, 0); }
  // moved: Z, n x k; differences: D, k x n. False if they leave C too few digits.
  bool Set(Eigen::MatrixXd moved, const Differences& differences) {
    constexpr double kLeastCoupling = 1e-4;  // reciprocal condition of C, which takes four digits at most
    moved_ = std::move(moved);
    differences_ = differences;
    const Eigen::MatrixXd coupling = Eigen::MatrixXd::Identity(moved_.cols(), moved_.cols()) + differences_ * moved_;
    if (!coupling.allFinite()) return false;
    coupling_.compute(coupling);
    return coupling_.rcond() > kLeastCoupling;
  }

  bool IsEmpty() const { return moved_.cols() == 0; }
  // From X = A0^-1 B to A^-1 B.
  void Correct(Eigen::Ref<Eigen::MatrixXd> X) const {
    if (!IsEmpty()) X -= moved_ * coupling_.solve(differences_ * X);
  }
  // From b to c, A'^-1 b = A0'^-1 c.
  void PrepareTransposed(Eigen::VectorXd* b) const {
    if (!IsEmpty()) *b -= differences_.transpose() * coupling_.transpose().solve(moved_.transpose() * *b);
  }
  bool TurnsDeterminant() const { return !IsEmpty() && coupling_.determinant() < 0.0; }

 private:
  Eigen::MatrixXd moved_;
  Differences differences_;
  Eigen::PartialPivLU<Eigen::MatrixXd> coupling_;  // C
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_LOW_RANK_UPDATE_H_
