#include "contact_path/branch/event_watch.h"

#include <cmath>

#include "contact_path/branch/polynomial.h"

namespace contact_path {
namespace {

constexpr double kZero = 1e-11;      // of scaled quantities on a step: rounding
constexpr double kFlat = 1e-9;       // of unit rates on a step: a load or a contact that moves slower rests
constexpr double kNearShare = 0.05;  // of the difference of quintic and cubic interpolation
constexpr double kRateZero = 1e-13;  // of a unit rate
constexpr double kReach = 2.0;       // of the length of a step: wider gaps stay open on it
constexpr int kNewtonIterations = 25;
constexpr double kCoincident = 1e-5;  // relative to the step: a bifurcation this near to something else is one with it
constexpr double kSlack = 1e-9;       // relative to the step: of the place of a located point
constexpr double kSameDerivative = 1e-2;  // of unit tangents: more is the mark of singular equations
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

// Where the determinant changes its sign.
double FindBifurcation(SmoothPiece* piece, const Segment& segment) {
  double before = 0.0, beyond = segment.length;
  for (int i = 0; i < kBisections && beyond - before > kBifurcationWidth * segment.length; ++i) {
    const double t = 0.5 * (before + beyond);
    const std::optional<CurvePoint> point = PointAt(piece, segment, t);
    if (!point || point->pivot_sign == 0) return t;  // singular to the last bit: this is it
    (point->pivot_sign == segment.start.determinant_sign ? before : beyond) = t;
  }
  return 0.5 * (before + beyond);
}

// Where the load factor first is `target` on (0, length]; nothing if it is not, or at the start.
std::optional<double> FirstAt(Quintic load, double target, double length) {
  load[0] -= target;
  if (load[0] == 0.0) return std::nullopt;
  if (load[0] < 0.0)
    for (double& coefficient : load) coefficient = -coefficient;
  return FirstNegative(load, length, 0.0);
}

std::optional<CurvePoint> LocateRegular(SmoothPiece* piece, const Segment& segment, const Watched& watched,
                                        double target);

}  // namespace

Watched Watch(SmoothPiece* piece, const Segment& segment, std::optional<double> target) {
  const FixedStateSystem& system = piece->system();
  Watched first;
  first.t = segment.length;
  const double width = kCoincident * segment.length;
  const auto consider = [&](Happening happening, double t, const Limit& limit) {
    // An event that coincides with something else is the one to act on.
    const double head_start = first.happening == Happening::kEvent && happening != Happening::kEvent ? width : 0.0;
    if (t + head_start > first.t || (t == first.t && first.happening != Happening::kNone)) return;
    first = {happening, t, limit, false};
  };
  // No node moves further than the arc length, and that is hardly longer than the step.
  for (const Limit& limit : system.InequalitiesInReach(segment.start.x, kReach * segment.length)) {
    const Quintic quintic = FunctionOf(system, segment, limit);
    const double zero = limit.inequality == Inequality::kSlip ? kFlat : kZero;
    if (const std::optional<double> t = FirstNegative(quintic, segment.length, zero)) {
      consider(Happening::kEvent, *t, limit);
      continue;
    }
    double where = 0.0;
    const double smallest = Minimum(quintic, segment.length, &where);
    const bool inside = where > 1e-3 * segment.length && where < 0.999 * segment.length;
    if (inside && smallest > zero && smallest < kNearShare * CubicDifference(quintic, segment.length))
      consider(Happening::kNearTouch, where, limit);
  }
  const Eigen::Index s = system.NumDofs();
  const auto load = [s](const Eigen::VectorXd& x) { return x[s]; };
  const Quintic load_factor = segment.Interpolate(load, load);
  const Quintic load_rate = Derivative(load_factor);
  Quintic reversed = load_rate;
  for (double& coefficient : reversed) coefficient = -coefficient;
  for (const Quintic& rate : {load_rate, reversed}) {
    const std::optional<double> t = FirstNegative(rate, segment.length, kFlat);
    if (t && *t > 0.0) consider(Happening::kLimitPoint, *t, {});
  }
  if (segment.start.determinant_sign * segment.end.determinant_sign < 0) {
    const double t = FindBifurcation(piece, segment);
    if (first.happening != Happening::kNone && std::abs(t - first.t) <= width)
      first.singular = true;
    else if (t < first.t)
      first = {Happening::kBifurcation, t, {}, true};
  }
  // Whatever lies behind the target, however near, is not of this path.
  if (target)
    if (const std::optional<double> t = FirstAt(load_factor, *target, segment.length); t && *t <= first.t)
      first = {Happening::kTarget, *t, {}, false};
  return first;
}

std::optional<CurvePoint> Locate(SmoothPiece* piece, const Segment& segment, const Watched& watched,
                                 std::optional<double> target) {
  if (watched.singular) {
    CurvePoint point = segment.At(watched.t);
    point.x = piece->CorrectSingular(point.x, segment.normal);
    point.determinant_sign = 0;
    return point;
  }
  std::optional<CurvePoint> point = LocateRegular(piece, segment, watched, target.value_or(0.0));
  if (!point) return std::nullopt;
  const double t = segment.normal.dot((point->x - segment.start.x).head(segment.normal.size()));
  const double slack = kSlack * segment.length;
  if (!(t >= -slack && t <= segment.length + slack)) return std::nullopt;
  return point;
}

namespace {

std::optional<CurvePoint> LocateRegular(SmoothPiece* piece, const Segment& segment, const Watched& watched,
                                        double target) {
  const FixedStateSystem& system = piece->system();
  switch (watched.happening) {
    case Happening::kNone: return segment.end;
    case Happening::kNearTouch: return PointAt(piece, segment, watched.t);
    case Happening::kBifurcation: return segment.At(watched.t);
    case Happening::kLimitPoint:
      return LocateRate(piece, segment, watched.t, [&](const Eigen::VectorXd& rate) { return rate[system.NumDofs()]; });
    case Happening::kTarget: {
      const Correction correction = piece->Correct(
          segment.Point(watched.t), Eigen::VectorXd::Unit(system.NumUnknowns(), system.NumDofs()), target);
      CurvePoint point;
      if (!correction.converged || !piece->Derivatives(correction.x, segment.normal, &point)) return std::nullopt;
      return point;
    }
    case Happening::kEvent: break;
  }
  if (watched.limit.inequality == Inequality::kSlip)
    return LocateRate(piece, segment, watched.t,
                      [&](const Eigen::VectorXd& rate) { return system.Rate(watched.limit, rate); });
  // The inequality as the last equation. Where it only grazes zero, that has no solution: then its minimum counts, or
  // else the point itself. At the event itself the equations may be singular: then derivatives are those of the step
  // that crossed it.
  const Eigen::VectorXd guess = segment.Point(watched.t);
  const Eigen::VectorXd row = system.Gradient(watched.limit);
  Correction correction = piece->Correct(guess, row, row.dot(guess) - system.Value(watched.limit, guess));
  const double reach = 0.1 * segment.length + 1e-9;
  if (!correction.converged || !((correction.x - guess).head(piece->NumMotion()).norm() <= reach)) {
    std::optional<CurvePoint> lowest = LocateRate(
        piece, segment, watched.t, [&](const Eigen::VectorXd& rate) { return system.Rate(watched.limit, rate); });
    if (lowest) return lowest;
    correction = piece->CorrectOnPlane(guess, segment.normal);
  }
  if (!correction.converged) return std::nullopt;
  const CurvePoint interpolated =
      segment.At(segment.normal.dot((correction.x - segment.start.x).head(segment.normal.size())));
  CurvePoint point;
  const bool regular = piece->Derivatives(correction.x, interpolated.first.head(segment.normal.size()), &point) &&
                       (point.first - interpolated.first).norm() <= kSameDerivative;
  if (!regular) point = interpolated;
  point.x = correction.x;
  return point;
}

}  // namespace
}  // namespace contact_path
