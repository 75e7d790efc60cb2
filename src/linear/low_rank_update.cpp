#include "linear/low_rank_update.h"

#include <utility>

namespace contact_path {
namespace {

constexpr double kLeastCoupling = 1e-4;  // reciprocal condition of C, which takes four digits at most

}  // namespace

void LowRankUpdate::Clear() { moved_.resize(0, 0); }

bool LowRankUpdate::Set(Eigen::MatrixXd moved, const Differences& differences) {
  moved_ = std::move(moved);
  differences_ = differences;
  const Eigen::MatrixXd coupling = Eigen::MatrixXd::Identity(moved_.cols(), moved_.cols()) + differences_ * moved_;
  if (!coupling.allFinite()) return false;
  coupling_.compute(coupling);
  return coupling_.rcond() > kLeastCoupling;
}

void LowRankUpdate::Correct(Eigen::Ref<Eigen::MatrixXd> X) const {
  if (!IsEmpty()) X -= moved_ * coupling_.solve(differences_ * X);
}

void LowRankUpdate::PrepareTransposed(Eigen::VectorXd* b) const {
  if (!IsEmpty()) *b -= differences_.transpose() * coupling_.transpose().solve(moved_.transpose() * *b);
}

}  // namespace contact_path
