#include "contact_path/branch/smooth_arc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_path/branch/plane_tangents.h"
#include "contact_path/equations/second_form.h"
#include "contact_path/iterations.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/linear/linearised_equations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostLowerings = 3;
constexpr double kSlow = 0.1;  // ratio of two steps beyond which that of another point is not

}  // namespace

void SmoothArc::Begin(bool rests) {
  at_hand_ = false;
  origin_.resize(0);
  rests_ = rests;
  held_.reset();
}

Eigen::VectorXd SmoothArc::RowOf(const Eigen::VectorXd& motion) const {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(equations_.NumUnknowns());
  row.head(motion.size()) = motion;
  return row;
}

bool SmoothArc::Derivatives(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, CurvePoint* point) {
  const Eigen::Index n = NumMotion();
  const Eigen::SparseMatrix<double>& transposed = equations_.TransposedJacobian(x);
  if (!Factorize(x, transposed, RowOf(towards))) return false;
  at_hand_ = solver_.Nullity() == 0;
  point->x = of_ = x;
  point->first = solver_.Solve(Eigen::VectorXd::Zero(equations_.NumEquations()), 1.0);
  const LinearisedEquations linearised(transposed);
  if (solver_.Nullity() == 0 || held_.value_or(false)) {
    linearised.Refine(solver_, &point->first);
    // A share of the free motions that `towards` has would grow from step to step.
    if (held_.value_or(false)) point->first -= factors_.free * (factors_.free.transpose() * point->first);
  } else {
    // Where nothing solves the equations, a solution of some of them has come out.
    const bool solved = linearised.Hold(point->first, tolerances::kSameTangent) &&
                        std::abs(point->first.head(n).dot(towards) - 1.0) <= tolerances::kSameTangent;
    if (!solved) return false;
    if (solver_.Nullity() == 1) ChooseInPlane(x, towards, &point->first);
  }
  const double norm = point->first.head(n).norm();
  if (!std::isfinite(norm) || norm == 0.0) return false;
  point->first /= norm;
  point->second = solver_.Solve(-equations_.SecondDerivative(x, point->first), 0.0);
  if (held_.value_or(false)) point->second -= factors_.free * (factors_.free.transpose() * point->second);
  HoldLimitPoint(x, &point->second);
  point->second -= point->first.head(n).dot(point->second.head(n)) * point->first;
  point->nullity = solver_.Nullity();
  point->determinant_sign = point->side = solver_.DeterminantSign();
  point->is_limit = point->is_crossing = false;
  const double rate = point->first[n - 1];
  // A small component of a vector of n + 1 entries.
  const double small = tolerances::kSmallShare / std::sqrt(static_cast<double>(n));
  point->load_error = std::abs(rate) > small ? 0.0 : ErrorOfRate(Eigen::VectorXd::Unit(x.size(), n - 1), *point);
  point->load_sense = Measured{rate, point->load_error}.Sign();
  return point->second.allFinite();
}

void SmoothArc::ChooseInPlane(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, Eigen::VectorXd* first) {
  Eigen::MatrixXd plane(first->size(), 2);
  plane << first->normalized(), solver_.NullSpace().col(0);
  const PlaneTangents tangents =
      TangentsInPlane(&equations_, x, plane, solver_.LeftNullSpace().topRows(equations_.NumEquations()));
  double largest = 0.0;
  for (const Eigen::VectorXd& direction : tangents.directions) {
    const double along = direction.head(towards.size()).dot(towards);
    if (std::abs(along) <= largest) continue;
    largest = std::abs(along);
    *first = direction / along;
  }
  if (tangents.determined) return;
  // What rounding leaves of a motion without stiffness in a direction makes the next equations regular.
  auto motion = first->head(NumMotion());
  const double least = tolerances::kDependent * motion.lpNorm<Eigen::Infinity>();
  motion = (motion.array().abs() > least).select(motion, 0.0).eval();
  if (!(equations_.ResidualUnit() > 1.0)) return;
  // A free motion changes neither load nor reactions. What rounding leaves of it in the tangent would grow from step to
  // step.
  const Eigen::Index dofs = LoadFactor();
  const Eigen::VectorXd forces = plane.col(0).tail(plane.rows() - dofs),
                        others = plane.col(1).tail(plane.rows() - dofs);
  // Where the tangent changes them no more, as at a limit point without reactions, nothing tells it from a free motion:
  // the nearest one stays.
  const double rounding = tolerances::kDependent * equations_.ResidualUnit();
  if (!(forces.norm() > rounding)) return;
  Eigen::VectorXd free = forces.norm() * plane.col(1);
  free -= forces.dot(others) / forces.norm() * plane.col(0);
  free.normalize();
  *first -= free.dot(*first) * free;
}

void SmoothArc::HoldLimitPoint(const Eigen::VectorXd& x, Eigen::VectorXd* change) {
  const double size = change->norm();
  if (!rests_ || solver_.Nullity() != 1 || !(size > 0.0)) return;
  const Eigen::VectorXd null_vector = solver_.NullSpace().col(0), unit = *change / size;
  const Eigen::VectorXd psi = solver_.LeftNullSpace().col(0).head(equations_.NumEquations()).normalized();
  const SecondForm form(&equations_, x);
  const double bend = psi.dot(form(null_vector));
  *change -= size * psi.dot(form(null_vector, unit)) / bend * null_vector;
}

Correction SmoothArc::Correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value) {
  return Correct(guess, row, value, at_hand_ && solver_.ReplaceRow(row));
}

Correction SmoothArc::Correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value, bool at_hand) {
  if (at_hand) {
    Correction correction = Newton(guess, row, value, true);
    if (correction.converged) return correction;
  }
  return Newton(guess, row, value, false);
}

Correction SmoothArc::CorrectOnto(const Limit& limit, const Eigen::VectorXd& guess) {
  // The inequality as the last equation, linearised anew where it is curved.
  Eigen::VectorXd from = guess;
  Correction correction;
  for (int round = 0; round < kMostCorrections; ++round) {
    const Eigen::VectorXd row = equations_.Gradient(limit, from);
    correction = Correct(from, row, row.dot(from) - equations_.Value(limit, from));
    if (!correction.converged) break;
    const double scale = 1.0 + correction.x.norm();
    if (std::abs(equations_.Value(limit, correction.x)) <= tolerances::kResidual * scale) break;
    from = correction.x;
  }
  return correction;
}

Correction SmoothArc::Newton(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value, bool at_hand) {
  Correction result;
  result.x = guess;
  ExtrapolateStrains(guess);
  Eigen::VectorXd before;  // of the last step, where strains are mixed
  const auto next = [&](const Eigen::VectorXd& x, bool refresh, Eigen::VectorXd* step) {
    equations_.Residual(x, &residual_);
    if (!residual_.allFinite()) return false;
    if (equations_.Mixed() && before.size() > 0) {
      strains_from_ = before;
      strains_to_ = x.head(NumMotion());
    }
    if (equations_.Mixed()) before = x.head(NumMotion());
    const auto jacobian = [&]() -> const Eigen::SparseMatrix<double>& {
      return equations_.Mixed() ? equations_.MixedJacobian(x, strains_from_, strains_to_)
                                : equations_.TransposedJacobian(x);
    };
    if (refresh && !Factorize(x, jacobian(), row)) return false;
    residual_ = -residual_;
    solver_.Solve(residual_, value - row.dot(x), step);
    HoldLimitPoint(x, step);
    return true;
  };
  NewtonLimits limits;
  limits.unit = equations_.ResidualUnit();
  if (at_hand) limits.stagnation = tolerances::kUnitComponent;
  if (at_hand) limits.slowest = kSlow;
  const auto norm = [&](const Eigen::VectorXd& step) {
    if (result.first_step.size() == 0) result.first_step = step;
    // Forces that small compliances alone tell wander though the equations are solved.
    const bool solved = equations_.Gives() && residual_.lpNorm<Eigen::Infinity>() <=
                                                  tolerances::kRounding * (1.0 + result.x.lpNorm<Eigen::Infinity>());
    return solved ? std::min(equations_.Norm(step), step.head(NumMotion()).norm()) : equations_.Norm(step);
  };
  NewtonCourse course = NewtonLoop(limits, !at_hand, next, norm, &result.x, &step_);
  result.iterations = course.iterations;
  result.steps = std::move(course.steps);
  if (result.steps.size() > 1) result.contraction = result.steps[1] / result.steps[0];
  if (!course.at_rounding) return result;
  LowerResidual(row, value, &result.x);
  equations_.Residual(result.x, &residual_);
  const double scale = 1.0 + result.x.norm();
  result.converged =
      equations_.Hold(result.x, residual_) && std::abs(row.dot(result.x) - value) <= tolerances::kResidual * scale;
  return result;
}

void SmoothArc::LowerResidual(const Eigen::VectorXd& row, double value, Eigen::VectorXd* x) {
  equations_.Residual(*x, &residual_);
  double largest = residual_.lpNorm<Eigen::Infinity>();
  const double zero = tolerances::kRounding * (1.0 + x->lpNorm<Eigen::Infinity>());
  reaction_error_ = 0.0;
  for (int i = 0; i < kMostLowerings && largest > zero; ++i) {
    residual_ = -residual_;
    solver_.Solve(residual_, value - row.dot(*x), &step_);
    HoldLimitPoint(*x, &step_);
    const Eigen::VectorXd next = *x + step_;
    equations_.Residual(next, &residual_);
    const double lowered = residual_.lpNorm<Eigen::Infinity>();
    reaction_error_ = step_.tail(x->size() - NumMotion()).lpNorm<Eigen::Infinity>();
    if (!(lowered <= 0.5 * largest)) return;
    *x = next;
    largest = lowered;
  }
}

void SmoothArc::SetOut(const CurvePoint& at) {
  if (!equations_.Mixed()) return;
  origin_ = at.x.head(NumMotion());
  tangent_at_origin_ = at.first.head(NumMotion());
}

void SmoothArc::ExtrapolateStrains(const Eigen::VectorXd& guess) {
  if (!equations_.Mixed()) return;
  strains_from_ = strains_to_ = guess.head(NumMotion());
  if (origin_.size() == 0) return;
  strains_to_ = origin_ + tangent_at_origin_.dot(strains_from_ - origin_) * tangent_at_origin_;
  strains_from_ = origin_;
}

bool SmoothArc::Factorize(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed,
                          const Eigen::VectorXd& row) {
  ++factorisations_;
  at_hand_ = false;
  of_.resize(0);
  // Along an arc the same motions stay free as a rule.
  const Factorised::Kind kind =
      factors_.Make(&equations_, x, transposed, row, tolerances::kSingularPivot, held_.value_or(true));
  held_ = kind == Factorised::Kind::kHeld && factors_.tangent.size() > 0;
  return *held_ || kind == Factorised::Kind::kRegular || solver_.Factorize(transposed, row, equations_.InFrame());
}

Correction SmoothArc::CorrectOnPlane(const Eigen::VectorXd& guess, const Eigen::VectorXd& normal) {
  const Eigen::VectorXd row = RowOf(normal);
  if (at_hand_) solver_.ReplaceRow(row);  // otherwise that of the last tangent is near
  return Correct(guess, row, row.dot(guess), at_hand_);
}

double SmoothArc::ErrorOfRate(const Eigen::VectorXd& gradient, const CurvePoint& at) {
  const double unknown = tolerances::kRate * equations_.ResidualUnit();
  if (!solver_.HasLu()) return unknown;
  const Eigen::VectorXd rounding = equations_.Rounding(at.x);
  const Eigen::VectorXd shares = solver_.SolveTransposed(gradient).head(rounding.size());
  const double of_equations = shares.cwiseAbs().dot(rounding);
  // The tangent of a point beside the curve is another one.
  const Eigen::VectorXd moved = solver_.Solve(rounding.cwiseProduct(shares.cwiseSign()), 0.0);
  double of_point = 0.0;
  if (moved.allFinite()) {
    of_point = std::abs(shares.dot(SecondForm(&equations_, at.x)(at.first, moved)));
  }
  const double error = tolerances::kUnitComponent * gradient.lpNorm<Eigen::Infinity>() + of_equations + of_point;
  return std::isfinite(error) ? error : unknown;
}

std::optional<Eigen::Index> SmoothArc::NegativeEigenvalues(const Eigen::VectorXd& x) const {
  if (!at_hand_ || of_.size() != x.size() || of_ != x) return std::nullopt;
  return solver_.NegativeEigenvalues(NumMotion() - 1);
}

double SmoothArc::MovedByRounding(const Eigen::VectorXd& x, const Eigen::VectorXd& normal) {
  if (!Factorize(x, equations_.TransposedJacobian(x), RowOf(normal)) || !solver_.HasLu())
    return std::numeric_limits<double>::infinity();
  // Signs of the rounding that move the point far: those of the left singular vector, by one inverse iteration.
  const Eigen::VectorXd rounding = equations_.Rounding(x);
  const Eigen::VectorXd moved = solver_.Solve(GenericVector(rounding.size()), 0.0);
  const Eigen::VectorXd signs = solver_.SolveTransposed(moved).head(rounding.size()).cwiseSign();
  return solver_.Solve(rounding.cwiseProduct(signs), 0.0).head(normal.size()).norm();
}

std::optional<Crossing> SmoothArc::FindCrossing(const Eigen::VectorXd& guess, const Eigen::VectorXd& tangent,
                                                Eigen::Index k) {
  std::optional<Crossing> crossing = contact_path::FindCrossing(&equations_, guess, tangent, k);
  if (crossing) factorisations_ += crossing->factorisations;
  return crossing;
}

}  // namespace contact_path
