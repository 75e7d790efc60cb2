#include "contact_path/branch/crossing.h"

#include <cmath>

#include "contact_path/linear/minimum_norm.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kDifference = 1e-4;  // step of the central difference of F''; its error is of the order of the square

// Of the equations at a point.
Eigen::VectorXd Norms(FixedStateSystem* system, const Eigen::VectorXd& x) {
  const Eigen::SparseMatrix<double>& transposed = system->TransposedJacobian(x);
  Eigen::VectorXd norms(transposed.cols());
  for (Eigen::Index column = 0; column < norms.size(); ++column) norms[column] = transposed.col(column).norm();
  return norms;
}

// psi . F''(a, b).
class DerivativeForm {
 public:
  DerivativeForm(FixedStateSystem* system, const Eigen::VectorXd& x, const Eigen::VectorXd& psi)
      : system_(*system), x_(x), psi_(psi) {}

  double operator()(const Eigen::VectorXd& a) const { return psi_.dot(system_.SecondDerivative(x_, a)); }
  double operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    return 0.25 * ((*this)(a + b) - (*this)(a - b));
  }
  // psi . F'''(a, a, a).
  double Third(const Eigen::VectorXd& a) const {
    const Eigen::VectorXd beyond = system_.SecondDerivative(x_ + kDifference * a, a);
    return psi_.dot(beyond - system_.SecondDerivative(x_ - kDifference * a, a)) / (2.0 * kDifference);
  }

 private:
  FixedStateSystem& system_;
  const Eigen::VectorXd& x_;
  const Eigen::VectorXd& psi_;
};

// Makes the sense of a unit vector in (u, s) the same whatever it was.
void Orient(Eigen::Index motion, Eigen::VectorXd* direction) {
  double sense = (*direction)[motion - 1];
  if (std::abs(sense) <= tolerances::kLevel) {
    const double largest = direction->head(motion).cwiseAbs().maxCoeff();
    Eigen::Index i = 0;
    while (std::abs((*direction)[i]) < (1.0 - tolerances::kSameComponent) * largest) ++i;
    sense = (*direction)[i];
  }
  if (sense < 0.0) *direction = -*direction;
}

}  // namespace

std::optional<Crossing> FindCrossing(FixedStateSystem* system, const Eigen::VectorXd& before, const Eigen::VectorXd& x,
                                     const Eigen::VectorXd& tangent) {
  const Eigen::Index motion = system->NumDofs() + 1;
  MinimumNormSolver solver;
  const Eigen::VectorXd norms = Norms(system, before);
  if (!solver.Factorize(system->TransposedJacobian(x), tolerances::kDependentColumnSingular, norms))
    return std::nullopt;
  if (solver.Rank() != system->NumEquations() - 1 || solver.Rank() != system->NumUnknowns() - 2) return std::nullopt;
  const Eigen::MatrixXd plane = solver.NullSpace();
  const Eigen::Vector2d along = plane.transpose() * tangent;
  Eigen::VectorXd v = plane * Eigen::Vector2d(-along[1], along[0]).normalized();
  v -= v.head(motion).dot(tangent.head(motion)) * tangent;
  const double length = v.head(motion).norm();
  if (!(length > tolerances::kTransversal)) return std::nullopt;
  v /= length;

  const Eigen::VectorXd psi = solver.LeftNullSpace().col(0).normalized();
  const DerivativeForm form(system, x, psi);
  const double b = form(tangent, v), c = form(v);
  if (!(std::abs(b) > tolerances::kTransversal * std::hypot(b, c))) return std::nullopt;
  Crossing crossing;
  crossing.first = c * tangent - 2.0 * b * v;
  crossing.first /= crossing.first.head(motion).norm();
  Orient(motion, &crossing.first);

  // Up to a multiple of the null vector normal to first, which the third derivative decides.
  const Eigen::VectorXd& first = crossing.first;
  const auto without_first = [&](const Eigen::VectorXd& z) {
    return Eigen::VectorXd(z - z.head(motion).dot(first.head(motion)) * first);
  };
  crossing.second = without_first(solver.Solve(-system->SecondDerivative(x, first)));
  const Eigen::VectorXd across = without_first(tangent);
  crossing.second -= (form.Third(first) + 3.0 * form(first, crossing.second)) / (3.0 * form(first, across)) * across;
  if (!crossing.second.allFinite()) return std::nullopt;
  return crossing;
}

}  // namespace contact_path
