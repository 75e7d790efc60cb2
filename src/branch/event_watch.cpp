#include "contact_path/branch/event_watch.h"

#include <cmath>

#include "contact_path/branch/polynomial.h"

namespace contact_path {
namespace {

constexpr double kZero = 1e-11;          // of scaled quantities on a step: rounding
constexpr double kFlat = 1e-9;           // a load rate below this throughout a step is no limit point
constexpr double kNearShare = 0.05;      // of the difference of quintic and cubic interpolation
constexpr double kRateZero = 1e-13;      // of a unit rate
constexpr int kNewtonIterations = 25;
constexpr int kBisections = 60;
constexpr double kBifurcationWidth = 1e-10;  // relative to the step

// The function of an inequality that must stay >= 0: its value, or for slip its rate.
Quintic FunctionOf(const FixedStateSystem& system, const Segment& segment, const Limit& limit) {
  const Quintic value = segment.Interpolate([&](const Eigen::VectorXd& x) { return system.Value(limit, x); },
                                            [&](const Eigen::VectorXd& dx) { return system.Rate(limit, dx); });
  return limit.inequality == Inequality::kSlip ? Derivative(value) : value;
}

// By how much the cubic interpolation of the same ends differs from the quintic at the middle.
double CubicDifference(const Quintic& quintic, double length) {
  const Quintic derivative = Derivative(quintic);
  const double a = Evaluate(quintic, 0.0), b = Evaluate(quintic, length);
  const double da = Evaluate(derivative, 0.0), db = Evaluate(derivative, length);
  return std::abs(Evaluate(quintic, 0.5 * length) - (0.5 * (a + b) + 0.125 * length * (da - db)));
}

// The point of the curve on the plane through its interpolation at t.
std::optional<CurvePoint> PointAt(SmoothPiece* piece, const Segment& segment, double t) {
  const Correction correction = piece->CorrectOnPlane(segment.Point(t), segment.normal);
  CurvePoint point;
  if (!correction.converged || !piece->Derivatives(correction.x, segment.normal, &point)) return std::nullopt;
  return point;
}

// Zero of a rate that is linear in the first derivative, by Newton's method along the curve.
template <typename Rate>
std::optional<CurvePoint> LocateRate(SmoothPiece* piece, const Segment& segment, double t, Rate rate) {
  std::optional<CurvePoint> point = PointAt(piece, segment, t);
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; point && i < kNewtonIterations; ++i) {
    const double value = rate(point->first), slope = rate(point->second);
    if (std::abs(value) <= kRateZero || std::abs(value) >= 0.5 * previous) return point;
    previous = std::abs(value);
    const double move = -value / slope;
    if (!(std::abs(move) <= segment.length)) return std::nullopt;
    const Eigen::VectorXd guess = point->x + move * point->first + 0.5 * move * move * point->second;
    const Correction correction = piece->CorrectOnPlane(guess, segment.normal);
    if (!correction.converged || !piece->Derivatives(correction.x, segment.normal, &*point)) return std::nullopt;
  }
  return point;
}

CurvePoint LocateBifurcation(SmoothPiece* piece, const Segment& segment) {
  double before = 0.0, beyond = segment.length;
  for (int i = 0; i < kBisections && beyond - before > kBifurcationWidth * segment.length; ++i) {
    const double t = 0.5 * (before + beyond);
    const std::optional<CurvePoint> point = PointAt(piece, segment, t);
    if (!point || point->determinant_sign == 0) {  // singular to rounding: this is it
      before = beyond = t;
      break;
    }
    (point->determinant_sign == segment.start.determinant_sign ? before : beyond) = t;
  }
  // The equations are singular here: the interpolation is more exact than a correction.
  CurvePoint point = segment.At(0.5 * (before + beyond));
  point.determinant_sign = 0;
  return point;
}

}  // namespace

Watched Watch(const FixedStateSystem& system, const Segment& segment) {
  Watched first;
  first.t = segment.length;
  const auto consider = [&](Happening happening, double t, const Limit& limit) {
    if (t > first.t || (t == first.t && first.happening != Happening::kNone)) return;
    first = {happening, t, limit};
  };
  for (const Limit& limit : system.Inequalities()) {
    const Quintic quintic = FunctionOf(system, segment, limit);
    if (const std::optional<double> t = FirstNegative(quintic, segment.length, kZero)) {
      consider(Happening::kEvent, *t, limit);
      continue;
    }
    double where = 0.0;
    const double smallest = Minimum(quintic, segment.length, &where);
    const bool inside = where > 1e-3 * segment.length && where < 0.999 * segment.length;
    if (inside && smallest > kZero && smallest < kNearShare * CubicDifference(quintic, segment.length))
      consider(Happening::kNearTouch, where, limit);
  }
  const Eigen::Index s = system.NumDofs();
  const auto load = [s](const Eigen::VectorXd& x) { return x[s]; };
  const Quintic load_rate = Derivative(segment.Interpolate(load, load));
  Quintic reversed = load_rate;
  for (double& coefficient : reversed) coefficient = -coefficient;
  for (const Quintic& rate : {load_rate, reversed}) {
    const std::optional<double> t = FirstNegative(rate, segment.length, kFlat);
    if (t && *t > 0.0) consider(Happening::kLimitPoint, *t, {});
  }
  if (first.happening == Happening::kNone && segment.start.determinant_sign * segment.end.determinant_sign < 0)
    consider(Happening::kBifurcation, 0.5 * segment.length, {});
  return first;
}

std::optional<CurvePoint> Locate(SmoothPiece* piece, const Segment& segment, const Watched& watched) {
  const FixedStateSystem& system = piece->system();
  switch (watched.happening) {
    case Happening::kNone: return segment.end;
    case Happening::kNearTouch: return PointAt(piece, segment, watched.t);
    case Happening::kBifurcation: return LocateBifurcation(piece, segment);
    case Happening::kLimitPoint:
      return LocateRate(piece, segment, watched.t, [&](const Eigen::VectorXd& rate) { return rate[system.NumDofs()]; });
    case Happening::kEvent: break;
  }
  if (watched.limit.inequality == Inequality::kSlip)
    return LocateRate(piece, segment, watched.t,
                      [&](const Eigen::VectorXd& rate) { return system.Rate(watched.limit, rate); });
  // The inequality as the last equation. Where it only grazes zero, that has no solution: then the point itself is exact
  // enough. Derivatives are those of the step that crossed the event: at the event itself the equations may be singular.
  const Eigen::VectorXd guess = segment.Point(watched.t);
  const Eigen::VectorXd row = system.Gradient(watched.limit);
  Correction correction = piece->Correct(guess, row, row.dot(guess) - system.Value(watched.limit, guess));
  const double reach = 0.1 * segment.length + 1e-9;
  if (!correction.converged || !((correction.x - guess).head(piece->NumMotion()).norm() <= reach))
    correction = piece->CorrectOnPlane(guess, segment.normal);
  if (!correction.converged) return std::nullopt;
  CurvePoint point = segment.At(segment.normal.dot((correction.x - segment.start.x).head(segment.normal.size())));
  point.x = correction.x;
  return point;
}

}  // namespace contact_path
