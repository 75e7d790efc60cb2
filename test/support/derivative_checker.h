// Compares a derivative that was worked out by hand with central differences of the function.
#ifndef CONTACT_PATH_TEST_SUPPORT_DERIVATIVE_CHECKER_H_
#define CONTACT_PATH_TEST_SUPPORT_DERIVATIVE_CHECKER_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>

namespace contact_path {

// Right derivatives of the core come out below 1e-10 (largest measured: 4e-11, third derivatives of the energy of an
// assembled structure); a single entry that is wrong by 1e-4 of itself stands out as long as it is no smaller than
// 1e-4 of the largest.
constexpr double kDerivativeTolerance = 1e-8;

// First difference step; entries of the argument are of the order of 1.
constexpr double kDifferenceStep = 0.02;

using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

// Where a derivative and the differences disagree most.
struct DerivativeComparison {
  double error = 0.0;  // |given - difference| over the largest entry of both matrices; infinite if not finite
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  double given = 0.0;
  double difference = 0.0;
};

// Jacobian of `function` at x, a row for each entry of the function: central differences with steps that are halved,
// extrapolated to step 0; of all extrapolations, entry by entry, the one that changed least is taken (Ridders 1982).
Eigen::MatrixXd DifferenceJacobian(const VectorFunction& function, const Eigen::VectorXd& x,
                                   double step = kDifferenceStep);

// `jacobian` against DifferenceJacobian().
DerivativeComparison CompareWithDifferences(const VectorFunction& function, const Eigen::VectorXd& x,
                                            const Eigen::MatrixXd& jacobian, double step = kDifferenceStep);

// The entries of a matrix, column by column.
inline Eigen::VectorXd Entries(const Eigen::MatrixXd& matrix) {
  return Eigen::Map<const Eigen::VectorXd>(matrix.data(), matrix.size());
}

// For EXPECT_TRUE: fails with the worst entry.
testing::AssertionResult IsJacobian(const VectorFunction& function, const Eigen::VectorXd& x,
                                    const Eigen::MatrixXd& jacobian, double tolerance = kDerivativeTolerance,
                                    double step = kDifferenceStep);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_DERIVATIVE_CHECKER_H_
