// Derivatives of fixed-mode systems against differences.
#ifndef CONTACT_PATH_TEST_SUPPORT_SYSTEM_DERIVATIVES_H_
#define CONTACT_PATH_TEST_SUPPORT_SYSTEM_DERIVATIVES_H_

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "contact_path/equations/fixed_mode_system.h"
#include "support/derivative_checker.h"

namespace contact_path {

// The Jacobian at x, and its change along dx.
inline void ExpectDerivativesMeetDifferences(FixedModeSystem* system, const Eigen::VectorXd& x,
                                             const Eigen::VectorXd& dx, double step = kDifferenceStep) {
  const auto residual = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd value;
    system->Residual(at, &value);
    return value;
  };
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd(system->TransposedJacobian(x)).transpose();
  EXPECT_TRUE(IsJacobian(residual, x, jacobian, kDerivativeTolerance, step));
  const auto rate = [&](const Eigen::VectorXd& h) {
    return Eigen::VectorXd(system->TransposedJacobian(x + h[0] * dx).transpose() * dx);
  };
  const Eigen::VectorXd second = system->SecondDerivative(x, dx);
  EXPECT_TRUE(IsJacobian(rate, Eigen::VectorXd::Zero(1), second, kDerivativeTolerance, step));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_SYSTEM_DERIVATIVES_H_
