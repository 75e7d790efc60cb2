#include "contact_path/branch/crossing.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "contact_path/iterations.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kDifference = 1e-3;  // step of the differences of F'', whose error is of the order of its fourth power

// psi . F''(a, b) at x.
class DerivativeForm {
 public:
  DerivativeForm(FixedStateSystem* system, const Eigen::VectorXd& x, const Eigen::VectorXd& psi)
      : system_(*system), x_(x), psi_(psi) {}

  double operator()(const Eigen::VectorXd& a) const { return psi_.dot(system_.SecondDerivative(x_, a)); }
  double operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    const double size = b.norm() / a.norm();
    if (!(size > 0.0)) return 0.0;
    const Eigen::VectorXd scaled = b / size;
    return 0.25 * size * ((*this)(a + scaled) - (*this)(a - scaled));
  }
  // psi . F'''(a, a, a), by central differences and Richardson's extrapolation.
  double Third(const Eigen::VectorXd& a) const {
    const auto difference = [&](double step) {
      const Eigen::VectorXd beyond = system_.SecondDerivative(x_ + step * a, a);
      return psi_.dot(beyond - system_.SecondDerivative(x_ - step * a, a)) / (2.0 * step);
    };
    return (4.0 * difference(kDifference) - difference(2.0 * kDifference)) / 3.0;
  }

 private:
  FixedStateSystem& system_;
  const Eigen::VectorXd& x_;
  const Eigen::VectorXd& psi_;
};

// Makes the sense of a unit vector in (u, s) the same whatever it was.
void Orient(Eigen::Index motion, Eigen::VectorXd* direction) {
  double sense = (*direction)[motion - 1];
  if (std::abs(sense) <= tolerances::kRate) {
    const double largest = direction->head(motion).cwiseAbs().maxCoeff();
    Eigen::Index i = 0;
    while (std::abs((*direction)[i]) < (1.0 - tolerances::kSameTangent) * largest) ++i;
    sense = (*direction)[i];
  }
  if (sense < 0.0) *direction = -*direction;
}

// The equations with two rows and one column more, [J b; v' 0; t' 0].
class BorderedJacobian {
 public:
  BorderedJacobian(FixedStateSystem* system, const Eigen::VectorXd& t)
      : system_(*system), motion_(t.size()), unknowns_(system->NumUnknowns()), t_(Extended(t)) {}

  // Borders by one inverse iteration with the factors of [J; t'] at x.
  bool ChooseBorders(const Eigen::VectorXd& x) {
    BorderedSolver solver;
    const Eigen::VectorXd row = t_.head(unknowns_);
    if (!solver.Factorize(system_.TransposedJacobian(x), row, system_.InFrame()) || solver.Nullity() > 1) return false;
    if (!solver.HasLu()) {
      if (solver.Nullity() != 1 || solver.LeftNullSpace().cols() != 1) return false;
      SetBorders(solver.NullSpace().col(0), solver.LeftNullSpace().col(0));
    } else {
      SetBorders(solver.Solve(GenericVector(system_.NumEquations()), 0.0),
                 solver.SolveTransposed(GenericVector(unknowns_)));
    }
    return v_.allFinite() && b_.allFinite();
  }

  // Null vectors and left null vector at x, but for what g_t and g_v leave.
  bool Factorize(const Eigen::VectorXd& x) {
    const Eigen::SparseMatrix<double>& transposed = system_.TransposedJacobian(x);
    const Eigen::Index equations = transposed.cols();
    bordered_.resize(unknowns_ + 1, equations + 1);
    bordered_.reserve(transposed.nonZeros() + equations + motion_);
    for (Eigen::Index column = 0; column < equations; ++column) {
      bordered_.startVec(column);
      for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, column); it; ++it)
        bordered_.insertBack(it.row(), column) = it.value();
      bordered_.insertBack(unknowns_, column) = b_[column];
    }
    bordered_.startVec(equations);
    for (Eigen::Index i = 0; i < motion_; ++i) bordered_.insertBack(i, equations) = v_[i];
    bordered_.finalize();
    if (!solver_.FactorizeRegular(bordered_, t_)) return false;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(equations + 1);
    Split(solver_.Solve(none, 1.0), &along, &left_along);
    Split(solver_.Solve(Eigen::VectorXd::Unit(equations + 1, equations), 0.0), &across, &left_across);
    psi = solver_.SolveTransposed(Eigen::VectorXd::Unit(unknowns_ + 1, unknowns_)).head(equations);
    return along.allFinite() && across.allFinite() && psi.allFinite();
  }

  // J z + l b = right, across both borders.
  Eigen::VectorXd Solve(const Eigen::VectorXd& right, double* l) const {
    Eigen::VectorXd extended(right.size() + 1), z;
    extended << right, 0.0;
    Split(solver_.Solve(extended, 0.0), &z, l);
    return z;
  }

  // The null vectors found last become the borders.
  void UpdateBorders() { SetBorders(across, psi); }

  Eigen::VectorXd along, across;               // J along + left_along b = 0, ...
  double left_along = 0.0, left_across = 0.0;  // g_t, g_v
  Eigen::VectorXd psi;                         // psi . b = 1

 private:
  Eigen::VectorXd Extended(const Eigen::VectorXd& motion) const {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns_ + 1);
    row.head(motion_) = motion;
    return row;
  }
  void SetBorders(const Eigen::VectorXd& v, const Eigen::VectorXd& psi_found) {
    v_ = v.head(motion_).normalized();
    b_ = psi_found.head(system_.NumEquations()).normalized();
  }
  void Split(const Eigen::VectorXd& solution, Eigen::VectorXd* z, double* l) const {
    *z = solution.head(unknowns_);
    *l = solution[unknowns_];
  }

  FixedStateSystem& system_;
  const Eigen::Index motion_, unknowns_;
  const Eigen::VectorXd t_;
  Eigen::VectorXd v_, b_;
  Eigen::SparseMatrix<double> bordered_;  // transposed
  BorderedSolver solver_;
};

// Both tangents and second derivatives, from a factorised Jacobian at the crossing.
bool FindCurves(FixedStateSystem* system, const BorderedJacobian& at, const Eigen::VectorXd& tangent,
                Crossing* crossing) {
  const Eigen::Index motion = tangent.size();
  const DerivativeForm form(system, crossing->x, at.psi);
  const Eigen::VectorXd &t = at.along, &v = at.across;
  const double a = form(t), b = form(t, v), c = form(v);
  const double size = std::abs(a) + std::abs(b) + std::abs(c), discriminant = b * b - a * c;
  if (!(discriminant > tolerances::kDependent * size * size)) return false;
  const double q = -b - std::copysign(std::sqrt(discriminant), b);
  CurveDerivatives one, other;
  one.first = q * t + a * v;
  other.first = c * t + q * v;
  for (CurveDerivatives* curve : {&one, &other}) curve->first /= curve->first.head(motion).norm();
  const auto without = [&](const CurveDerivatives& curve, const Eigen::VectorXd& z) {
    return Eigen::VectorXd(z - z.head(motion).dot(curve.first.head(motion)) * curve.first);
  };
  const auto bend = [&](const CurveDerivatives& of, const CurveDerivatives& from) {
    double left = 0.0;
    const Eigen::VectorXd bent = without(of, at.Solve(-system->SecondDerivative(crossing->x, of.first), &left));
    const Eigen::VectorXd across = without(of, from.first);
    const double share = (form.Third(of.first) + 3.0 * form(of.first, bent)) / (3.0 * form(of.first, across));
    return Eigen::VectorXd(bent - share * across);
  };
  one.second = bend(one, other);
  other.second = bend(other, one);
  if (!one.second.allFinite() || !other.second.allFinite()) return false;
  crossing->along = std::move(one);
  crossing->across = std::move(other);
  crossing->NameCurves(tangent);
  return true;
}

}  // namespace

void Crossing::NameCurves(const Eigen::VectorXd& tangent) {
  const auto component = [&](const CurveDerivatives& curve) { return curve.first.head(tangent.size()).dot(tangent); };
  if (std::abs(component(across)) > std::abs(component(along))) std::swap(along, across);
  if (component(along) < 0.0) along.first = -along.first;
  Orient(tangent.size(), &across.first);
}

bool Crossing::IsPerfect() const { return std::abs(unfolding) <= error; }

std::optional<Crossing> FindCrossing(FixedStateSystem* system, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& tangent) {
  if (system->NumUnknowns() != system->NumEquations() + 1) return std::nullopt;
  BorderedJacobian at(system, tangent);
  if (!at.ChooseBorders(guess)) return std::nullopt;
  Crossing crossing;
  crossing.x = guess;
  Eigen::VectorXd residual;
  double previous = std::numeric_limits<double>::infinity();
  for (crossing.factorisations = 1; crossing.factorisations <= kMostCorrections;) {
    system->Residual(crossing.x, &residual);
    ++crossing.factorisations;
    if (!residual.allFinite() || !at.Factorize(crossing.x)) return std::nullopt;
    double left = 0.0;
    const Eigen::VectorXd back = at.Solve(-residual, &left);
    const DerivativeForm form(system, crossing.x, at.psi);
    const double mixed = form(at.along, at.across);
    Eigen::Matrix2d slope;
    slope << form(at.along), mixed, mixed, form(at.across);
    const Eigen::Vector2d value(at.left_along - form(at.along, back), at.left_across - form(at.across, back));
    const Eigen::Vector2d shares = slope.fullPivLu().solve(value);
    const Eigen::VectorXd step = back + shares[0] * at.along + shares[1] * at.across;
    crossing.x += step;
    const double norm = system->Norm(step), scale = 1.0 + crossing.x.norm();
    if (!std::isfinite(norm)) return std::nullopt;
    const bool stagnates = norm >= 0.5 * previous && norm <= tolerances::kStagnation * system->ResidualUnit() * scale;
    if (norm <= tolerances::kRounding * scale || stagnates) {
      system->Residual(crossing.x, &residual);
      const double length = at.psi.norm();
      crossing.unfolding = at.psi.dot(residual) / length;
      crossing.error = system->Rounding(crossing.x).dot(at.psi.cwiseAbs()) / length;
      if (!FindCurves(system, at, tangent, &crossing)) return std::nullopt;
      return crossing;
    }
    at.UpdateBorders();
    previous = norm;
  }
  return std::nullopt;
}

}  // namespace contact_path
