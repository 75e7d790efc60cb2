// What grows while a structure is loaded.
#ifndef CONTACT_PATH_BRANCH_PATH_PARAMETER_H_
#define CONTACT_PATH_BRANCH_PATH_PARAMETER_H_

#include <Eigen/Core>
#include <algorithm>

#include "contact_path/equations/measured.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// The load factor s, or the setting X of the machine that loads the structure, X = f . (u - u_0) / |f| + s |f| / K: a
// linear function of the motion (u, s) and no unknown, so that steps and arc lengths are the same for every K. Rates
// are by arc length, over the largest that a unit motion has: -1 to 1. Under a rigid machine, K infinite, s tells
// where the displacement of the load rests.
class PathParameter {
 public:
  // s, wanted to go in this sense, +-1.
  explicit PathParameter(double sense = 1.0) : sense_(sense) {}
  // gradient: of X by (u, s), of any length > 0; sense: in which X is wanted to go, +-1.
  PathParameter(const Eigen::VectorXd& gradient, double sense)
      : sense_(sense), gradient_(sense / gradient.norm() * gradient) {}

  // In the wanted sense. Of the first n entries of a vector, n = components of (u, s).
  double Rate(const Eigen::VectorXd& first, Eigen::Index n) const {
    return gradient_.size() == 0 ? sense_ * first[n - 1] : gradient_.dot(first.head(n));
  }
  // 1: it goes on, -1: it goes back, 0: it rests to first order. error: of the rate of the load factor; that of a
  // setting is at least kRate, since a displacement that rests has the sign of rounding.
  int Sense(const Eigen::VectorXd& first, Eigen::Index n, double error = tolerances::kRate) const {
    const int sign = Measured{Rate(first, n), IsLoadFactor() ? error : std::max(error, tolerances::kRate)}.Sign();
    return sign == 0 && IsRigid() ? Measured{sense_ * first[n - 1], error}.Sign() : sign;
  }
  // The same to second order.
  int Sense(const Eigen::VectorXd& first, const Eigen::VectorXd& second, Eigen::Index n, double error) const {
    const int sign = Sense(first, n, error);
    return sign == 0 ? Sense(second, n) : sign;
  }
  // Unit vector of the n components of (u, s), along which it goes on most.
  Eigen::VectorXd Gradient(Eigen::Index n) const {
    return gradient_.size() == 0 ? Eigen::VectorXd(sense_ * Eigen::VectorXd::Unit(n, n - 1)) : gradient_;
  }
  bool IsLoadFactor() const { return gradient_.size() == 0; }
  double WantedSense() const { return sense_; }

 private:
  bool IsRigid() const { return gradient_.size() > 0 && gradient_[gradient_.size() - 1] == 0.0; }

  double sense_;
  Eigen::VectorXd gradient_;  // unit vector; empty: of the load factor
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_PATH_PARAMETER_H_
