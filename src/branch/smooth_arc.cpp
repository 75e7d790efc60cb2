#include "contact_path/branch/smooth_arc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contact_path/branch/gauss_rule.h"
#include "contact_path/branch/plane_tangents.h"
#include "contact_path/iterations.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/linear/linearised_equations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostLowerings = 3;
constexpr double kSlow = 0.1;  // ratio of two steps beyond which that of another point is not

// The six quintic Hermite basis polynomials: value, first, second at the start, then at the end.
std::array<Quintic, 6> HermiteBasis(double length) {
  std::array<Quintic, 6> basis{};
  for (std::size_t i = 0; i < 6; ++i) {
    std::array<Jet, 2> ends{};
    Jet& jet = ends[i / 3];
    (i % 3 == 0 ? jet.value : i % 3 == 1 ? jet.first : jet.second) = 1.0;
    basis[i] = HermiteQuintic(ends[0], ends[1], length);
  }
  return basis;
}

// Derivatives at the end of a step by its parameter.
void EndDerivatives(const Step& step, Eigen::VectorXd* first, Eigen::VectorXd* second) {
  const Eigen::Index n = step.normal.size();
  const double c = step.normal.dot(step.end.first.head(n));
  const double bend = step.normal.dot(step.end.second.head(n));
  *first = step.end.first / c;
  *second = (step.end.second - *first * bend) / (c * c);
}

// Of the interpolation less its start, with these values of the basis polynomials, of which the first ones of start and
// end add up to 1. first, second: EndDerivatives().
Eigen::VectorXd Combination(const Step& step, const std::array<double, 6>& basis, const Eigen::VectorXd& first,
                            const Eigen::VectorXd& second) {
  return basis[1] * step.start.first + basis[2] * step.start.second + basis[3] * (step.end.x - step.start.x) +
         basis[4] * first + basis[5] * second;
}

}  // namespace

SmoothArc::SmoothArc(const Structure& structure, const ContactPairs& contacts)
    : structure_(structure), contacts_(contacts), system_(structure, contacts), tracker_(contacts), modes_(structure) {}

void SmoothArc::SetStates(const std::vector<ContactState>& states, const PathPoint& from, bool rests) {
  system_.SetStates(states, SlipReferences(contacts_, from), from.patches);
  at_hand_ = false;
  origin_.resize(0);
  rests_ = rests;
  held_.reset();
  NoteClosedGaps(from);
}

void SmoothArc::NoteClosedGaps(const PathPoint& from) {
  moved_forces_.clear();
  Eigen::VectorXd stiffness;
  for (const std::size_t i : system_.Touching()) {
    const double gap = contacts_[i]->Gap(from.u, from.s, from.Patch(i));
    if (!(gap > tolerances::kBroken)) continue;
    if (stiffness.size() == 0) {
      Eigen::SparseMatrix<double> tangent = structure_.TangentPattern();
      structure_.Tangent(from.u, &tangent);
      stiffness = tangent.diagonal().cwiseAbs();
    }
    double largest = 0.0;
    for (const int dof : contacts_[i]->Dofs(from.Patch(i))) largest = std::max(largest, stiffness[dof]);
    moved_forces_[static_cast<int>(i)] = (1.0 + contacts_[i]->Friction()) * largest * gap;
  }
}

double SmoothArc::RoundingOf(const Constraint& constraint) const {
  double rounding = tolerances::kBroken * system_.UnitOf(constraint);
  if (!IsMotion(constraint.inequality)) rounding = std::max(rounding, tolerances::kMargin * reaction_error_);
  const auto moved = moved_forces_.find(constraint.contact);
  return moved == moved_forces_.end() ? rounding : std::max(rounding, moved->second);
}

bool SmoothArc::Derivatives(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, CurvePoint* point) {
  const Eigen::Index n = NumMotion();
  Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
  row.head(n) = towards;
  const Eigen::SparseMatrix<double>& transposed = system_.TransposedJacobian(x);
  if (!Factorize(x, transposed, row, 0.0)) return false;
  at_hand_ = solver_.Nullity() == 0;
  point->x = x;
  point->first = solver_.Solve(Eigen::VectorXd::Zero(system_.NumEquations()), 1.0);
  const LinearisedEquations equations(transposed);
  if (solver_.Nullity() == 0 || held_.value_or(false)) {
    equations.Refine(solver_, &point->first);
    // A share of the free motions that `towards` has would grow from step to step.
    if (held_.value_or(false)) point->first -= free_ * (free_.transpose() * point->first);
  } else {
    // Where nothing solves the equations, a solution of some of them has come out.
    const bool solved = equations.Hold(point->first, tolerances::kSameTangent) &&
                        std::abs(point->first.head(n).dot(towards) - 1.0) <= tolerances::kSameTangent;
    if (!solved) return false;
    if (solver_.Nullity() == 1) ChooseInPlane(x, towards, &point->first);
  }
  const double norm = point->first.head(n).norm();
  if (!std::isfinite(norm) || norm == 0.0) return false;
  if (!(point->first.head(n).dot(towards) > tolerances::kUnitComponent * norm)) return false;
  point->first /= norm;
  point->second = solver_.Solve(-system_.SecondDerivative(x, point->first), 0.0);
  if (held_.value_or(false)) point->second -= free_ * (free_.transpose() * point->second);
  HoldLimitPoint(x, &point->second);
  point->second -= point->first.head(n).dot(point->second.head(n)) * point->first;
  point->nullity = solver_.Nullity();
  point->determinant_sign = point->side = solver_.DeterminantSign();
  point->is_limit = point->is_crossing = false;
  const double rate = point->first[n - 1];
  // A small component of a vector of n + 1 entries.
  const double small = tolerances::kSmallShare / std::sqrt(static_cast<double>(n));
  point->load_error = std::abs(rate) > small ? 0.0 : ErrorOfRate(Eigen::VectorXd::Unit(x.size(), n - 1), *point);
  point->load_sense = SignBeyond(rate, point->load_error);
  return point->second.allFinite();
}

void SmoothArc::ChooseInPlane(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, Eigen::VectorXd* first) {
  Eigen::MatrixXd plane(first->size(), 2);
  plane << first->normalized(), solver_.NullSpace().col(0);
  const PlaneTangents tangents =
      TangentsInPlane(&system_, x, plane, solver_.LeftNullSpace().topRows(system_.NumEquations()));
  double largest = 0.0;
  for (const Eigen::VectorXd& direction : tangents.directions) {
    const double along = direction.head(towards.size()).dot(towards);
    if (std::abs(along) <= largest) continue;
    largest = std::abs(along);
    *first = direction / along;
  }
  if (tangents.determined || !(system_.ResidualUnit() > 1.0)) return;
  // A free motion changes neither load nor reactions. What rounding leaves of it in the tangent would grow from step to
  // step.
  const Eigen::Index dofs = system_.NumDofs();
  const Eigen::VectorXd forces = plane.col(0).tail(plane.rows() - dofs),
                        others = plane.col(1).tail(plane.rows() - dofs);
  // Where the tangent changes them no more, as at a limit point without reactions, nothing tells it from a free motion:
  // the nearest one stays.
  const double rounding = tolerances::kDependent * system_.ResidualUnit();
  if (!(forces.norm() > rounding)) return;
  Eigen::VectorXd free = forces.norm() * plane.col(1);
  free -= forces.dot(others) / forces.norm() * plane.col(0);
  free.normalize();
  if (!(free.tail(plane.rows() - dofs).norm() <= rounding)) return;
  *first -= free.dot(*first) * free;
}

void SmoothArc::HoldLimitPoint(const Eigen::VectorXd& x, Eigen::VectorXd* change) {
  const double size = change->norm();
  if (!rests_ || solver_.Nullity() != 1 || !(size > 0.0)) return;
  const Eigen::VectorXd null_vector = solver_.NullSpace().col(0), unit = *change / size;
  const Eigen::VectorXd psi = solver_.LeftNullSpace().col(0).head(system_.NumEquations()).normalized();
  const auto form = [&](const Eigen::VectorXd& z) { return psi.dot(system_.SecondDerivative(x, z)); };
  const double bend = form(null_vector);
  if (std::abs(bend) < tolerances::kNoForm) return;
  const double mixed = 0.5 * (form(null_vector + unit) - bend - form(unit));
  *change -= size * mixed / bend * null_vector;
}

Correction SmoothArc::Correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value) {
  return Newton(guess, row, value, false);
}

Correction SmoothArc::CorrectOnto(const Constraint& constraint, const Eigen::VectorXd& guess) {
  // The inequality as the last equation, linearised anew where it is curved.
  Eigen::VectorXd from = guess;
  Correction correction;
  for (int round = 0; round < kMostCorrections; ++round) {
    const Eigen::VectorXd row = system_.Gradient(constraint, from);
    correction = Correct(from, row, row.dot(from) - system_.Value(constraint, from));
    if (!correction.converged) break;
    const double scale = 1.0 + correction.x.norm();
    if (std::abs(system_.Value(constraint, correction.x)) <= tolerances::kResidual * scale) break;
    from = correction.x;
  }
  return correction;
}

Correction SmoothArc::Newton(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value, bool at_hand) {
  Correction result;
  result.x = guess;
  result.steps.reserve(kMostCorrections);
  ExtrapolateStrains(guess);
  const auto factorize = [&] {
    if (!structure_.Mixed()) return Factorize(result.x, row);
    return Factorize(result.x, system_.MixedJacobian(result.x, strains_from_, strains_to_), row, 0.0);
  };
  bool factorise = !at_hand;
  double previous = std::numeric_limits<double>::infinity();
  for (; result.iterations < kMostCorrections; ++result.iterations) {
    system_.Residual(result.x, &residual_);
    if (!residual_.allFinite()) return result;
    if (factorise && !factorize()) return result;
    residual_ = -residual_;
    solver_.Solve(residual_, value - row.dot(result.x), &step_length_);
    HoldLimitPoint(result.x, &step_length_);
    const double norm = system_.Norm(step_length_), scale = 1.0 + result.x.norm();
    if (!std::isfinite(norm)) return result;
    if (structure_.Mixed()) strains_from_ = result.x.head(NumMotion());
    result.x += step_length_;
    if (structure_.Mixed()) strains_to_ = result.x.head(NumMotion());
    result.steps.push_back(norm);
    if (result.iterations == 0) result.first_step = norm;
    if (result.iterations == 1) result.contraction = norm / result.first_step;
    const double stagnation = at_hand ? tolerances::kUnitComponent : tolerances::kStagnation;
    const bool stagnates = norm >= 0.5 * previous && norm <= stagnation * system_.ResidualUnit() * scale;
    if (norm <= tolerances::kRounding * scale || stagnates) {
      LowerResidual(row, value, &result.x);
      result.converged =
          EquationsHold(result.x) && std::abs(row.dot(result.x) - value) <= tolerances::kResidual * scale;
      ++result.iterations;
      return result;
    }
    if (at_hand && norm > kSlow * previous) return result;
    factorise = !at_hand && norm > tolerances::kShort * scale;
    previous = norm;
  }
  return result;
}

void SmoothArc::LowerResidual(const Eigen::VectorXd& row, double value, Eigen::VectorXd* x) {
  system_.Residual(*x, &residual_);
  double largest = residual_.lpNorm<Eigen::Infinity>();
  const double zero = tolerances::kRounding * (1.0 + x->lpNorm<Eigen::Infinity>());
  reaction_error_ = 0.0;
  for (int i = 0; i < kMostLowerings && largest > zero; ++i) {
    residual_ = -residual_;
    solver_.Solve(residual_, value - row.dot(*x), &step_length_);
    HoldLimitPoint(*x, &step_length_);
    const Eigen::VectorXd next = *x + step_length_;
    system_.Residual(next, &residual_);
    const double lowered = residual_.lpNorm<Eigen::Infinity>();
    reaction_error_ = step_length_.tail(x->size() - NumMotion()).lpNorm<Eigen::Infinity>();
    if (!(lowered <= 0.5 * largest)) return;
    *x = next;
    largest = lowered;
  }
}

void SmoothArc::SetOut(const CurvePoint& at) {
  if (!structure_.Mixed()) return;
  origin_ = at.x.head(NumMotion());
  tangent_at_origin_ = at.first.head(NumMotion());
}

void SmoothArc::ExtrapolateStrains(const Eigen::VectorXd& guess) {
  if (!structure_.Mixed()) return;
  strains_from_ = strains_to_ = guess.head(NumMotion());
  if (origin_.size() == 0) return;
  strains_to_ = origin_ + tangent_at_origin_.dot(strains_from_ - origin_) * tangent_at_origin_;
  strains_from_ = origin_;
}

bool SmoothArc::Factorize(const Eigen::VectorXd& x, const Eigen::VectorXd& row, double rank_tolerance) {
  return Factorize(x, system_.TransposedJacobian(x), row, rank_tolerance);
}

bool SmoothArc::Factorize(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed,
                          const Eigen::VectorXd& row, double rank_tolerance) {
  ++factorisations_;
  at_hand_ = false;
  if (rests_ && rank_tolerance == 0.0) rank_tolerance = tolerances::kRootOfRounding;
  if (rank_tolerance == 0.0 && modes_.Possible()) {
    const auto hold = [&] {
      const Eigen::MatrixXd modes = modes_.At(x.head(system_.NumDofs()), transposed);
      Eigen::VectorXd tangent;
      held_ = modes.cols() > 0 && transposed.rows() == transposed.cols() + 1 &&
              solver_.FactorizeHeld(transposed, row, modes, system_.InFrame(), &tangent) && tangent.size() > 0;
      if (*held_) free_ = modes;
      return *held_;
    };
    // Along an arc the same motions stay free as a rule.
    if (held_.value_or(true) && hold()) return true;
    if (solver_.FactorizeRegular(transposed, row, tolerances::kSingularPivot, system_.InFrame()) || hold()) return true;
  }
  return solver_.Factorize(transposed, row, system_.InFrame(), rank_tolerance);
}

Correction SmoothArc::CorrectOnPlane(const Eigen::VectorXd& guess, const Eigen::VectorXd& normal) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
  row.head(normal.size()) = normal;
  if (at_hand_) {
    Correction correction = Newton(guess, row, row.dot(guess), true);
    if (correction.converged) return correction;
  }
  return Newton(guess, row, row.dot(guess), false);
}

double SmoothArc::ErrorOfRate(const Eigen::VectorXd& gradient, const CurvePoint& at) {
  const double unknown = tolerances::kRate * system_.ResidualUnit();
  if (!solver_.HasLu()) return unknown;
  const Eigen::VectorXd rounding = system_.Rounding(at.x);
  const Eigen::VectorXd shares = solver_.SolveTransposed(gradient).head(rounding.size());
  const double of_equations = shares.cwiseAbs().dot(rounding);
  // The tangent of a point beside the curve is another one.
  const Eigen::VectorXd moved = solver_.Solve(rounding.cwiseProduct(shares.cwiseSign()), 0.0);
  const double distance = moved.norm();
  double of_point = 0.0;
  if (distance > 0.0) {
    const Eigen::VectorXd across = moved / distance;
    of_point = 0.25 * distance *
               std::abs(shares.dot(system_.SecondDerivative(at.x, at.first + across) -
                                   system_.SecondDerivative(at.x, at.first - across)));
  }
  const double error = tolerances::kUnitComponent * gradient.lpNorm<Eigen::Infinity>() + of_equations + of_point;
  return std::isfinite(error) ? error : unknown;
}

Eigen::VectorXd SmoothArc::MotionUnder(const Eigen::VectorXd& forces) const {
  if (!at_hand_) return {};
  Eigen::VectorXd right = Eigen::VectorXd::Zero(system_.NumEquations());
  right.head(forces.size()) = forces;
  return solver_.Solve(right, 0.0);
}

double SmoothArc::MovedByRounding(const Eigen::VectorXd& x, const Eigen::VectorXd& normal) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
  row.head(normal.size()) = normal;
  if (!Factorize(x, row) || !solver_.HasLu()) return std::numeric_limits<double>::infinity();
  // Signs of the rounding that move the point far: those of the left singular vector, by one inverse iteration.
  const Eigen::VectorXd rounding = system_.Rounding(x);
  const Eigen::VectorXd moved = solver_.Solve(GenericVector(rounding.size()), 0.0);
  const Eigen::VectorXd signs = solver_.SolveTransposed(moved).head(rounding.size()).cwiseSign();
  return solver_.Solve(rounding.cwiseProduct(signs), 0.0).head(normal.size()).norm();
}

std::optional<Crossing> SmoothArc::FindCrossing(const Eigen::VectorXd& guess, const Eigen::VectorXd& tangent) {
  std::optional<Crossing> crossing = contact_path::FindCrossing(&system_, guess, tangent);
  if (crossing) factorisations_ += crossing->factorisations;
  return crossing;
}

bool SmoothArc::EquationsHold(const Eigen::VectorXd& x) {
  system_.Residual(x, &residual_);
  const double force = 1.0 + x.tail(x.size() - system_.NumDofs()).lpNorm<Eigen::Infinity>();
  const double place = 1.0 + x.head(NumMotion()).lpNorm<Eigen::Infinity>();
  return system_.Largest(residual_) <= tolerances::kResidual * force &&
         system_.LargestOfMotions(residual_) <= tolerances::kResidual * place;
}

Step MakeStep(const CurvePoint& start, const CurvePoint& end, Eigen::Index num_motion) {
  Step step{start, end, start.first.head(num_motion), 0.0};
  step.length = step.normal.dot((end.x - start.x).head(num_motion));
  return step;
}

Eigen::VectorXd Step::Point(double t) const {
  Eigen::VectorXd first, second;
  EndDerivatives(*this, &first, &second);
  const std::array<Quintic, 6> basis = HermiteBasis(length);
  std::array<double, 6> b{};
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = Evaluate(basis[i], t);
  return Combination(*this, b, first, second) + start.x;
}

CurvePoint Step::At(double t) const {
  Eigen::VectorXd first, second;
  EndDerivatives(*this, &first, &second);
  const std::array<Quintic, 6> basis = HermiteBasis(length);
  // Derivative of the given order by t.
  const auto combine = [&](int order) {
    std::array<double, 6> b{};
    for (std::size_t i = 0; i < 6; ++i) {
      Quintic polynomial = basis[i];
      for (int k = 0; k < order; ++k) polynomial = Derivative(polynomial);
      b[i] = Evaluate(polynomial, t);
    }
    return Combination(*this, b, first, second);
  };
  CurvePoint point = start;
  point.x = Point(t);
  point.is_limit = point.is_crossing = false;
  point.first = combine(1);
  point.second = combine(2);
  // From derivatives by t to derivatives by arc length.
  const Eigen::Index n = normal.size();
  const double speed = point.first.head(n).norm();
  point.first /= speed;
  point.second -= point.first.head(n).dot(point.second.head(n)) * point.first;
  point.second /= speed * speed;
  return point;
}

QuinticNodes::QuinticNodes(const Step& step) : length_(step.length) {
  points_.front() = step.start.x;
  points_.back() = step.end.x;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) points_[i] = step.Point(QuinticNode(i, length_));
}

double Step::ArcLength() const {
  const Eigen::Index n = normal.size();
  Eigen::VectorXd first, second;
  EndDerivatives(*this, &first, &second);
  const Eigen::VectorXd change = (end.x - start.x).head(n);
  const std::array<Quintic, 6> basis = HermiteBasis(length);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGauss4.points.size(); ++i) {
    std::array<double, 6> b{};
    for (std::size_t k = 0; k < 6; ++k) b[k] = Evaluate(Derivative(basis[k]), kGauss4.points[i] * length);
    sum += kGauss4.weights[i] * (b[1] * start.first.head(n) + b[2] * start.second.head(n) + b[3] * change +
                                 b[4] * first.head(n) + b[5] * second.head(n))
                                    .norm();
  }
  return sum * length;
}

}  // namespace contact_path
