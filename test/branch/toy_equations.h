// Equations of a few unknowns, to look at the engine without a scene.
#ifndef CONTACT_PATH_TEST_BRANCH_TOY_EQUATIONS_H_
#define CONTACT_PATH_TEST_BRANCH_TOY_EQUATIONS_H_

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "contact_path/equations/arc_equations.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// A number with its first two derivatives along a direction.
struct Along {
  double value = 0.0, first = 0.0, second = 0.0;
  Along(double v = 0.0, double f = 0.0, double s = 0.0) : value(v), first(f), second(s) {}  // NOLINT: converts
};
inline Along operator+(const Along& a, const Along& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}
inline Along operator-(const Along& a, const Along& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}
inline Along operator*(const Along& a, const Along& b) {
  return {a.value * b.value, a.value * b.first + a.first * b.value,
          a.value * b.second + 2.0 * a.first * b.first + a.second * b.value};
}

// F(x) = 0 and limits; all unknowns are the motion, the last of them is the load factor.
class ToyEquations : public ArcEquations {
 public:
  using Unknowns = std::vector<Along>;
  struct Watched {
    std::function<Along(const Unknowns&)> of;
    bool of_rate = false;
    bool near = false;  // an increment is wanted at its zero, and nothing fails
    double seen_below = std::numeric_limits<double>::infinity();  // a step that starts at more does not know of it
  };

  ToyEquations(Eigen::Index unknowns, std::function<Unknowns(const Unknowns&)> F, std::vector<Watched> limits = {})
      : unknowns_(unknowns), F_(std::move(F)), limits_(std::move(limits)) {}

  Eigen::Index NumUnknowns() const override { return unknowns_; }
  Eigen::Index NumEquations() const override { return unknowns_ - 1; }
  Eigen::Index NumMotion() const override { return unknowns_; }
  void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const override {
    *residual = Column(F_(At(x, Eigen::VectorXd::Zero(unknowns_))), &Along::value);
  }
  Eigen::VectorXd Rounding(const Eigen::VectorXd& x) const override {
    return Eigen::VectorXd::Constant(NumEquations(), std::numeric_limits<double>::epsilon() * (1.0 + x.norm()));
  }
  const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x) override {
    Eigen::MatrixXd transposed(unknowns_, NumEquations());
    for (Eigen::Index i = 0; i < unknowns_; ++i)
      transposed.row(i) = Column(F_(At(x, Eigen::VectorXd::Unit(unknowns_, i))), &Along::first).transpose();
    transposed_ = transposed.sparseView(0.0, -1.0);  // a full pattern
    return transposed_;
  }
  Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) override {
    return Column(F_(At(x, dx)), &Along::second);
  }

  std::vector<Limit> LimitsInReach(const Eigen::VectorXd& x, double /*reach*/, std::vector<Limit>* near) override {
    near->clear();
    unseen_.clear();
    std::vector<Limit> all;
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const Limit limit = {static_cast<int>(i), 0};
      (Value(limit, x) > limits_[i].seen_below ? &unseen_ : limits_[i].near ? near : &all)->push_back(limit);
    }
    return all;
  }
  bool BeyondReach(const Eigen::VectorXd& x) const override {
    return std::any_of(unseen_.begin(), unseen_.end(), [&](const Limit& limit) { return Value(limit, x) < 0.0; });
  }
  bool IsOfRate(const Limit& limit) const override { return Of(limit).of_rate; }
  double Value(const Limit& limit, const Eigen::VectorXd& x) const override {
    return Of(limit).of(At(x, Eigen::VectorXd::Zero(unknowns_))).value;
  }
  Eigen::VectorXd Gradient(const Limit& limit, const Eigen::VectorXd& x) const override {
    Eigen::VectorXd gradient(unknowns_);
    for (Eigen::Index i = 0; i < unknowns_; ++i)
      gradient[i] = Of(limit).of(At(x, Eigen::VectorXd::Unit(unknowns_, i))).first;
    return gradient;
  }
  Jet ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& second) const override {
    const Along along = Of(limit).of(At(x, first));
    return {along.value, along.first, along.second + Gradient(limit, x).dot(second)};
  }
  double RoundingOf(const Limit& /*limit*/, double /*of_forces*/) const override { return tolerances::kResidual; }
  bool Hold(const Eigen::VectorXd& /*x*/, const Eigen::VectorXd& residual) const override {
    return residual.lpNorm<Eigen::Infinity>() <= tolerances::kResidual;
  }

 private:
  static Unknowns At(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
    Unknowns at;
    for (Eigen::Index i = 0; i < x.size(); ++i) at.emplace_back(x[i], dx[i]);
    return at;
  }
  static Eigen::VectorXd Column(const Unknowns& values, double Along::*part) {
    Eigen::VectorXd column(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) column[static_cast<Eigen::Index>(i)] = values[i].*part;
    return column;
  }
  const Watched& Of(const Limit& limit) const { return limits_[static_cast<std::size_t>(limit.law)]; }

  const Eigen::Index unknowns_;
  const std::function<Unknowns(const Unknowns&)> F_;
  const std::vector<Watched> limits_;
  std::vector<Limit> unseen_;
  Eigen::SparseMatrix<double> transposed_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_BRANCH_TOY_EQUATIONS_H_
