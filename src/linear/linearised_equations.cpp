#include "contact_path/linear/linearised_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostRefinements = 2;

}  // namespace

void LinearisedEquations::Evaluate(const Eigen::VectorXd& tangent, Eigen::VectorXd* residual,
                                   Eigen::VectorXd* rounding) const {
  residual->resize(transposed_.cols());
  rounding->resize(transposed_.cols());
  for (Eigen::Index equation = 0; equation < transposed_.cols(); ++equation) {
    double sum = 0.0, size = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed_, equation); it; ++it) {
      const double term = it.value() * tangent[it.row()];
      sum += term;
      size += std::abs(term);
    }
    (*residual)[equation] = sum;
    (*rounding)[equation] = std::numeric_limits<double>::epsilon() * size;
  }
}

bool LinearisedEquations::Hold(const Eigen::VectorXd& tangent, double share) const {
  const double size = tangent.lpNorm<Eigen::Infinity>();
  // By unknown, the largest entry of any equation: one that is nothing but rounding has no measure of its own.
  Eigen::VectorXd around = Eigen::VectorXd::Zero(transposed_.rows());
  for (Eigen::Index equation = 0; equation < transposed_.cols(); ++equation)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed_, equation); it; ++it)
      around[it.row()] = std::max(around[it.row()], std::abs(it.value()));
  for (Eigen::Index equation = 0; equation < transposed_.cols(); ++equation) {
    double sum = 0.0, largest = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed_, equation); it; ++it) {
      sum += it.value() * tangent[it.row()];
      largest = std::max({largest, std::abs(it.value()), tolerances::kFadingEquation * around[it.row()]});
    }
    if (!(std::abs(sum) <= share * largest * size)) return false;
  }
  return true;
}

void LinearisedEquations::Refine(const BorderedSolver& solver, Eigen::VectorXd* tangent) const {
  Eigen::VectorXd residual, rounding;
  for (int i = 0; i < kMostRefinements; ++i) {
    Evaluate(*tangent, &residual, &rounding);
    if ((residual.cwiseAbs().array() <= rounding.array()).all()) return;
    *tangent += solver.Solve(-residual, 0.0);
  }
}

double LinearisedEquations::ErrorOf(Eigen::Index i, const BorderedSolver& solver,
                                    const Eigen::VectorXd& tangent) const {
  Eigen::VectorXd residual, rounding;
  Evaluate(tangent, &residual, &rounding);
  const Eigen::VectorXd y = solver.SolveTransposed(Eigen::VectorXd::Unit(tangent.size(), i));
  return y.head(rounding.size()).cwiseAbs().dot(rounding + residual.cwiseAbs());
}

}  // namespace contact_path
