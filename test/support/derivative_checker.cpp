#include "support/derivative_checker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace contact_path {
namespace {

constexpr int kLevels = 7;

Eigen::VectorXd CentralDifference(const VectorFunction& function, const Eigen::VectorXd& x, Eigen::Index j,
                                  double step) {
  Eigen::VectorXd forward = x, backward = x;
  forward[j] += step;
  backward[j] -= step;
  return (function(forward) - function(backward)) / (forward[j] - backward[j]);
}

}  // namespace

Eigen::MatrixXd DifferenceJacobian(const VectorFunction& function, const Eigen::VectorXd& x, double step) {
  const Eigen::Index rows = function(x).size();
  Eigen::MatrixXd jacobian(rows, x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    // previous[k]: the last level's extrapolation of order 2 (k + 1).
    std::array<Eigen::VectorXd, kLevels> previous, current;
    Eigen::VectorXd best(rows);
    Eigen::VectorXd smallest = Eigen::VectorXd::Constant(rows, std::numeric_limits<double>::infinity());
    for (int level = 0; level < kLevels; ++level) {
      current[0] = CentralDifference(function, x, j, std::ldexp(step, -level));
      if (level == 0) best = current[0];
      for (int k = 1; k <= level; ++k) {
        const auto order = static_cast<std::size_t>(k);
        const double factor = std::ldexp(1.0, 2 * k) - 1.0;
        current[order] = current[order - 1] + (current[order - 1] - previous[order - 1]) / factor;
        for (Eigen::Index i = 0; i < rows; ++i) {
          const double change = std::max(std::abs(current[order][i] - current[order - 1][i]),
                                         std::abs(current[order][i] - previous[order - 1][i]));
          if (change > smallest[i]) continue;
          smallest[i] = change;
          best[i] = current[order][i];
        }
      }
      previous = current;
    }
    jacobian.col(j) = best;
  }
  return jacobian;
}

DerivativeComparison CompareWithDifferences(const VectorFunction& function, const Eigen::VectorXd& x,
                                            const Eigen::MatrixXd& jacobian, double step) {
  const Eigen::MatrixXd differences = DifferenceJacobian(function, x, step);
  DerivativeComparison worst;
  if (jacobian.rows() != differences.rows() || jacobian.cols() != differences.cols()) {
    worst.error = std::numeric_limits<double>::infinity();
    return worst;
  }
  const double scale = std::max(jacobian.cwiseAbs().maxCoeff(), differences.cwiseAbs().maxCoeff());
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      const double off = std::abs(jacobian(i, j) - differences(i, j));
      double error = off == 0.0 ? 0.0 : off / scale;
      if (!std::isfinite(jacobian(i, j)) || !std::isfinite(differences(i, j)))
        error = std::numeric_limits<double>::infinity();
      if (error > worst.error) worst = {error, i, j, jacobian(i, j), differences(i, j)};
    }
  }
  return worst;
}

testing::AssertionResult IsJacobian(const VectorFunction& function, const Eigen::VectorXd& x,
                                    const Eigen::MatrixXd& jacobian, double tolerance, double step) {
  const DerivativeComparison worst = CompareWithDifferences(function, x, jacobian, step);
  if (worst.error <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "entry (" << worst.row << ", " << worst.column << ") of the " << jacobian.rows()
                                     << " x " << jacobian.cols() << " derivative is " << worst.given
                                     << ", differences give " << worst.difference << ": relative error " << worst.error
                                     << " > " << tolerance;
}

}  // namespace contact_path
