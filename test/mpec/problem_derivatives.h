// Derivatives of the problem of an increment against differences.
#ifndef CONTACT_PATH_TEST_MPEC_PROBLEM_DERIVATIVES_H_
#define CONTACT_PATH_TEST_MPEC_PROBLEM_DERIVATIVES_H_

#include <gtest/gtest.h>

#include "contact_path/mpec/increment_problem.h"
#include "support/contact_points.h"
#include "support/derivative_checker.h"
#include "support/random.h"

namespace contact_path {

constexpr double kRounding = 1e-14;  // of sums of a few terms of order 1

inline Eigen::MatrixXd JacobianOf(const IncrementProblem& problem, const Eigen::VectorXd& x) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(problem.NumConstraints(), problem.NumVariables());
  for (const auto& entry : problem.Jacobian(x)) jacobian(entry.row(), entry.col()) += entry.value();
  return jacobian;
}

inline Eigen::MatrixXd HessianOf(const IncrementProblem& problem, const Eigen::VectorXd& x, double factor,
                                 const Eigen::VectorXd& multipliers) {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(problem.NumVariables(), problem.NumVariables());
  for (const auto& entry : problem.Hessian(x, factor, multipliers)) {
    EXPECT_GE(entry.row(), entry.col());
    lower(entry.row(), entry.col()) += entry.value();
  }
  return lower.selfadjointView<Eigen::Lower>();
}

// At x, with these multipliers: Jacobian and Hessian, with and without the objective, are those of what they derive.
inline void ExpectDerivatives(const IncrementProblem& problem, const Eigen::VectorXd& x,
                              const Eigen::VectorXd& multipliers, double step = kDifferenceStep) {
  const auto constraints = [&](const Eigen::VectorXd& at) { return problem.Constraints(at); };
  EXPECT_TRUE(IsJacobian(constraints, x, JacobianOf(problem, x), kDerivativeTolerance, step));
  for (const double factor : {0.0, 0.8}) {
    const auto gradient = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd(factor * problem.Gradient(at) + JacobianOf(problem, at).transpose() * multipliers);
    };
    EXPECT_TRUE(IsJacobian(gradient, x, HessianOf(problem, x, factor, multipliers), kDerivativeTolerance, step));
  }
}

// A point near the start, where each contact has a reaction.
inline PathPoint PointNearStart(const Structure& structure, Eigen::Index contacts, double distance, double s,
                                Random* random) {
  PathPoint point;
  point.u = structure.Start() + random->Vector(structure.NumDofs(), -distance, distance);
  point.s = s;
  const Eigen::VectorXd rn = random->Vector(contacts, 0.1, 1.0);
  point.forces = ByPort(rn, random->Vector(contacts, -1.0, 1.0));
  point.modes.resize(static_cast<std::size_t>(contacts));
  return point;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_MPEC_PROBLEM_DERIVATIVES_H_
