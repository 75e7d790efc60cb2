#include "contact_path/branch/event_functions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "contact_path/branch/polynomial.h"
#include "contact_path/iterations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kNearShare = 0.05;      // of the difference of quintic and cubic interpolation
constexpr double kReach = 2.0;           // of the length of a step: wider gaps stay open on it
constexpr double kReachOfLocated = 0.1;  // of the length of a step: what is located beside its curve is of another one

// The function of an inequality that must stay >= 0: its value, or for slip its rate.
Quintic FunctionOf(const ArcEquations& equations, const Step& step, const Limit& constraint) {
  const Quintic value = step.Interpolate(
      [&](const CurvePoint& at) { return equations.ValueAlong(constraint, at.x, at.first, at.second); });
  return equations.IsOfRate(constraint) ? Derivative(value) : value;
}

// By how much the cubic interpolation of the same ends differs from the quintic at the middle.
double CubicDifference(const Quintic& quintic, double length) {
  const Quintic derivative = Derivative(quintic);
  const double a = Evaluate(quintic, 0.0), b = Evaluate(quintic, length);
  const double da = Evaluate(derivative, 0.0), db = Evaluate(derivative, length);
  return std::abs(Evaluate(quintic, 0.5 * length) - (0.5 * (a + b) + 0.125 * length * (da - db)));
}

// With the derivatives there; nothing where there are none.
std::optional<CurvePoint> PointOf(SmoothArc* arc, const Step& step, const Correction& correction) {
  CurvePoint point;
  if (!correction.converged || !arc->Derivatives(correction.x, step.normal, &point)) return std::nullopt;
  return point;
}

// The point of the curve on the plane through its interpolation at t.
std::optional<CurvePoint> PointAt(SmoothArc* arc, const Step& step, double t) {
  return PointOf(arc, step, arc->CorrectOnPlane(step.Point(t), step.normal));
}

// Zero of a rate, by Newton's method along the curve. along(point): the jet whose first derivative it is; gradient(x):
// of the quantity by the unknowns.
template <typename Along, typename Gradient>
std::optional<CurvePoint> LocateRate(SmoothArc* arc, const Step& step, double t, Along along, Gradient gradient) {
  std::optional<CurvePoint> point = PointAt(arc, step, t);
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; point && i < kMostIterations; ++i) {
    const Jet jet = along(*point);
    const double value = jet.first, slope = jet.second;
    if (std::abs(value) <= tolerances::kUnitComponent) return point;
    const double move = -value / slope;
    if (std::abs(value) >= 0.5 * previous)  // rounding, or there is no zero
      return std::abs(value) <= arc->ErrorOfRate(gradient(point->x), *point) ? point : std::nullopt;
    previous = std::abs(value);
    if (!(std::abs(move) <= step.length)) return std::nullopt;
    const Eigen::VectorXd guess = point->x + move * point->first + 0.5 * move * move * point->second;
    point = PointOf(arc, step, arc->CorrectOnPlane(guess, step.normal));
  }
  return point;
}

// Where row . x turns.
std::optional<CurvePoint> LocateTurnNear(SmoothArc* arc, const Step& step, double t, const Eigen::VectorXd& row) {
  return LocateRate(
      arc, step, t,
      [&](const CurvePoint& at) {
        return Jet{row.dot(at.x), row.dot(at.first), row.dot(at.second)};
      },
      [&](const Eigen::VectorXd&) { return row; });
}

}  // namespace

std::optional<LocatedCrossing> CrossingOn(SmoothArc* arc, const Step& step, double from, double to, Eigen::Index k,
                                          bool* broken) {
  const double reach = kReachOfLocated * step.length + tolerances::kSamePoint;
  for (const double share : {0.5, 0.1, 0.9}) {
    const CurvePoint guess = step.At(from + share * (to - from));
    std::optional<Crossing> found = arc->FindCrossing(guess.x, guess.first.head(step.normal.size()), k);
    if (!found) continue;
    const double t = step.normal.dot((found->x - step.start.x).head(step.normal.size()));
    const double inside = std::clamp(t, from, to);
    if (std::abs(t - inside) > tolerances::kNoMove ||
        (found->x - step.Point(inside)).head(step.normal.size()).norm() > reach)
      continue;
    *broken = *broken || !found->IsPerfect();
    if (!found->IsPerfect()) continue;
    found->NameCurves(step.At(inside).first.head(step.normal.size()));
    return LocatedCrossing{inside, *std::move(found)};
  }
  return std::nullopt;
}

namespace {

// Whether an inequality is zero where the curves cross.
bool IsZeroAt(const ArcEquations& equations, const Limit& constraint, const Crossing& crossing) {
  const Jet along = equations.ValueAlong(constraint, crossing.x, crossing.along.first, crossing.along.second);
  const double unit = equations.UnitOf(constraint);
  if (equations.IsOfRate(constraint)) return std::abs(along.first) <= tolerances::kRate * unit;
  return std::abs(along.value) <= tolerances::kActive * unit;
}

// Where the determinant has changed its sign on the step, or is zero at its end: puts the crossing in the place of the
// first event, or beside it where both coincide. False: no crossing explains the change of sign.
bool LookForCrossing(SmoothArc* arc, const Step& step, StepEvent* first) {
  ArcEquations& equations = arc->equations();
  bool broken = false;
  std::optional<LocatedCrossing> found = CrossingOn(arc, step, 0.0, step.length, 1, &broken);
  if (!found && !broken) found = CrossingOn(arc, step, 0.0, step.length, 0, &broken);
  if (!found) return false;
  const EventKind kind = first->Kind();
  const CurveDerivatives& along = found->at.along;
  const Eigen::Index s = arc->LoadFactor();
  const bool is_level = std::abs(along.first[s]) <= tolerances::kRate * equations.ResidualUnit();
  const bool turns = is_level && std::abs(along.second[s]) > tolerances::kRate;
  const bool coincides = (kind == EventKind::kContactEvent && IsZeroAt(equations, *first->fails, found->at)) ||
                         (kind == EventKind::kLimitPoint && is_level);
  if (!coincides && found->t > first->t) return true;
  if (!coincides) *first = StepEvent();
  first->t = found->t;
  first->turns = first->turns || (!coincides && turns);
  first->crossing = std::move(found->at);
  return true;
}

// Where the load turns first within the step. A rate that has not been told from zero before, since the step began or
// since the last turn, is not turned.
std::optional<double> FirstTurn(const Quintic& load_factor, const Step& step) {
  const Quintic rate = Derivative(load_factor);
  const double level = std::max({tolerances::kUnitComponent, step.start.load_error, step.end.load_error,
                                 tolerances::kRounding * (1.0 + std::abs(load_factor[0])) / step.length});
  // The largest rate between two places, by its sign: 0 where all of them are within the level.
  const auto sense_between = [&](double from, double to) {
    double largest = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
      const double value = Evaluate(rate, from + QuinticNode(i, 1.0) * (to - from));
      if (std::abs(value) > std::abs(largest)) largest = value;
    }
    return Measured{largest, level}.Sign();
  };
  int count = 0;
  const std::array<double, 5> roots = Roots(rate, step.length, &count);
  int before = step.start.load_sense;
  for (int i = 0; i <= count; ++i) {
    const double from = i == 0 ? 0.0 : roots[static_cast<std::size_t>(i) - 1];
    const double to = i < count ? roots[static_cast<std::size_t>(i)] : step.length;
    const int sense = sense_between(from, to);
    if (before * sense < 0) return from;
    if (sense != 0) before = sense;
  }
  // The step ends as the load is about to turn, and the next step would begin with a rate of zero.
  const bool ends_at_root = count > 0 && before != 0 && !step.end.is_limit;
  if (ends_at_root && before * Evaluate(rate, step.length) < 0.0) return roots[static_cast<std::size_t>(count) - 1];
  return std::nullopt;
}

// Where the load factor first is `target` on (0, length], which it is not at the start; nothing if it is not.
std::optional<double> FirstAt(Quintic load, double target, double length) {
  load[0] -= target;
  if (load[0] < 0.0)
    for (double& coefficient : load) coefficient = -coefficient;
  return FirstNegative(load, length, 0.0);
}

// Where the quintic comes to a value on (0, length], in the sense that is wanted; not at a start that has it to
// rounding. An end that has the value to rounding is
// where the quintic comes to it: the next step starts there, and does not come to it again.
std::optional<double> FirstAtValue(Quintic function, double value, double rounding, double sense, double length) {
  function[0] -= value;
  const Quintic off = function, slope = Derivative(function);
  const bool starts_there = std::abs(function[0]) <= rounding;
  if (starts_there) {
    for (std::size_t k = 0; k + 1 < function.size(); ++k) function[k] = function[k + 1];
    function.back() = 0.0;
  }
  int count = 0;
  const std::array<double, 5> roots = Roots(function, length, &count);
  for (int i = 0; i < count; ++i) {
    const double root = roots[static_cast<std::size_t>(i)];
    if (sense * Evaluate(slope, root) >= 0.0) return root;
  }
  const double at_end = Evaluate(off, length);
  if (!starts_there && std::abs(at_end) <= rounding && sense * (at_end - off[0]) >= 0.0) return length;
  return std::nullopt;
}

// Ends *first at the first value of a function before it.
void FindSample(const Step& step, const ArcTargets& functions, StepEvent* first) {
  if (functions.empty()) return;
  const QuinticNodes at(step);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const Quintic along = at.Interpolate([&](const Eigen::VectorXd& x) { return functions[i].of(x); });
    for (const double value : functions[i].values)
      if (const std::optional<double> t =
              FirstAtValue(along, value, functions[i].rounding, functions[i].sense, step.length);
          t && *t <= first->t) {
        *first = StepEvent{*t};
        first->sample = {i, value};
      }
  }
}

// The point near t where the function has the value, by Newton's method with the slope of its interpolation.
std::optional<CurvePoint> LocateSample(SmoothArc* arc, const Step& step, double t, const ArcTarget& target,
                                       double value) {
  ArcEquations& equations = arc->equations();
  const auto point_at = [&](const Eigen::VectorXd& x, double at) -> std::optional<CurvePoint> {
    CurvePoint point;
    if (!arc->Derivatives(x, step.normal, &point)) return std::nullopt;
    // Next to a singular point derivatives are less exact than their interpolation.
    const CurvePoint interpolated = step.At(at);
    if (equations.Norm(point.second - interpolated.second) * step.length > tolerances::kSmallShare)
      std::tie(point.first, point.second) = std::tie(interpolated.first, interpolated.second);
    return point;
  };
  // An unknown is set to the value, unless it turns there.
  if (target.unknown >= 0) {
    const Eigen::VectorXd guess = step.Point(t);
    const Correction correction = arc->Correct(guess, Eigen::VectorXd::Unit(guess.size(), target.unknown), value);
    const double reach = kReachOfLocated * step.length + tolerances::kSamePoint;
    if (correction.converged && (correction.x - guess).head(arc->NumMotion()).norm() <= reach)
      return point_at(correction.x, t);
  }
  const Quintic slope =
      Derivative(QuinticNodes(step).Interpolate([&](const Eigen::VectorXd& x) { return target.of(x); }));
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostIterations; ++i) {
    const Correction correction = arc->CorrectOnPlane(step.Point(t), step.normal);
    if (!correction.converged) return std::nullopt;
    const double off = target.of(correction.x) - value;
    // No nearer: rounding, or the function does not come to the value.
    if (off == 0.0 || !(std::abs(off) < 0.5 * previous)) {
      return std::abs(off) <= target.rounding ? point_at(correction.x, t) : std::nullopt;
    }
    previous = std::abs(off);
    t -= off / Evaluate(slope, t);
  }
  return std::nullopt;
}

std::optional<CurvePoint> LocateRegular(SmoothArc* arc, const Step& step, const StepEvent& event,
                                        const StepEnds& ends) {
  ArcEquations& equations = arc->equations();
  switch (event.Kind()) {
    case EventKind::kNone: return step.end;
    case EventKind::kTooLong: return std::nullopt;
    case EventKind::kNearTouch: return PointAt(arc, step, event.t);
    case EventKind::kBifurcation: return std::nullopt;
    case EventKind::kLimitPoint:
      return LocateTurnNear(arc, step, event.t, Eigen::VectorXd::Unit(equations.NumUnknowns(), arc->LoadFactor()));
    case EventKind::kTarget:
      return PointOf(
          arc, step,
          arc->Correct(step.Point(event.t), Eigen::VectorXd::Unit(equations.NumUnknowns(), arc->LoadFactor()),
                       ends.load_factor.value()));
    case EventKind::kSample:
      return LocateSample(arc, step, event.t, ends.functions[event.sample->target], event.sample->value);
    case EventKind::kContactEvent: break;
  }
  const auto along = [&](const CurvePoint& at) {
    return equations.ValueAlong(*event.fails, at.x, at.first, at.second);
  };
  const auto gradient = [&](const Eigen::VectorXd& x) { return equations.Gradient(*event.fails, x); };
  if (equations.IsOfRate(*event.fails)) return LocateRate(arc, step, event.t, along, gradient);
  // The inequality as the last equation. Where it only grazes zero, that has no solution: then its minimum counts, or
  // else the point itself. At the event itself the equations may be singular: then derivatives are those of the step
  // that crossed it.
  const Eigen::VectorXd guess = step.Point(event.t);
  Correction correction = arc->CorrectOnto(*event.fails, guess);
  const double reach = kReachOfLocated * step.length + tolerances::kSamePoint;
  if (!correction.converged || !((correction.x - guess).head(arc->NumMotion()).norm() <= reach)) {
    std::optional<CurvePoint> lowest = LocateRate(arc, step, event.t, along, gradient);
    if (lowest && along(*lowest).second > 0.0) return lowest;
    correction = arc->CorrectOnPlane(guess, step.normal);
  }
  if (!correction.converged) return std::nullopt;
  const CurvePoint interpolated = step.At(step.normal.dot((correction.x - step.start.x).head(step.normal.size())));
  CurvePoint point;
  const bool regular = arc->Derivatives(correction.x, interpolated.first.head(step.normal.size()), &point) &&
                       equations.Norm(point.first - interpolated.first) <= tolerances::kSmallShare;
  if (!regular) point = interpolated;
  point.x = correction.x;
  return point;
}

}  // namespace

EventKind StepEvent::Kind() const {
  if (too_long) return EventKind::kTooLong;
  if (target) return EventKind::kTarget;
  if (sample) return EventKind::kSample;
  if (fails) return EventKind::kContactEvent;
  if (turns) return EventKind::kLimitPoint;
  if (crossing) return EventKind::kBifurcation;
  return near ? EventKind::kNearTouch : EventKind::kNone;
}

StepEvent FirstEvent(SmoothArc* arc, const Step& step, const StepEnds& ends) {
  ArcEquations& equations = arc->equations();
  StepEvent first;
  first.t = step.length;
  const double width = tolerances::kShort * step.length;
  const auto consider = [&](StepEvent fact) {
    // A limit that fails next to something else is what to act on.
    const double head_start = first.fails && !fact.fails ? width : 0.0;
    if (fact.t + head_start > first.t || (fact.t == first.t && first.Kind() != EventKind::kNone)) return;
    first = std::move(fact);
  };
  const auto near_at = [](double t) {
    StepEvent fact{t};
    fact.near = true;
    return fact;
  };
  StepEvent too_long;
  too_long.too_long = true;
  const Quintic load_factor =
      step.InterpolateLinear([s = arc->LoadFactor()](const Eigen::VectorXd& x) { return x[s]; });
  std::optional<double> target;
  if (ends.load_factor) target = FirstAt(load_factor, *ends.load_factor, step.length);
  // No node moves further than the arc length, and that is hardly longer than the step.
  std::vector<Limit> open_ends;
  // Short steps tell rates by differences of values that rounding has its share in.
  const double zero_rate = std::max(tolerances::kRate, tolerances::kMargin * tolerances::kRounding / step.length);
  const std::vector<Limit> inequalities = equations.LimitsInReach(step.start.x, kReach * step.length, &open_ends);
  for (const Limit& end : open_ends) {
    Quintic beyond = FunctionOf(equations, step, end);
    beyond[0] += tolerances::kTouching;
    if (const std::optional<double> t = FirstNegative(beyond, step.length, 0.0)) consider(near_at(*t));
  }
  for (const Limit& constraint : inequalities) {
    const Quintic quintic = FunctionOf(equations, step, constraint);
    double zero = equations.IsOfRate(constraint) ? zero_rate : arc->RoundingOf(constraint);
    // What counts as zero where a branch sets out does not fail as it rises.
    const double below = equations.IsOfRate(constraint) ? 0.0 : -quintic[0];
    if (below > zero && below <= tolerances::kActive * equations.UnitOf(constraint) &&
        quintic[1] * step.length > tolerances::kSmallShare * below)
      zero = below;
    double where = 0.0;
    if (const std::optional<double> t = FirstNegative(quintic, step.length, zero)) {
      consider({*t, constraint});
      continue;
    }
    const double smallest = Minimum(quintic, step.length, &where);
    const bool inside =
        where > tolerances::kNextToStart * step.length && where < (1.0 - tolerances::kNextToStart) * step.length;
    if (inside && smallest > zero && smallest < kNearShare * CubicDifference(quintic, step.length))
      consider(near_at(where));
  }
  if (const std::optional<double> t = FirstTurn(load_factor, step)) consider({*t, {}, true});
  // A step may end on a crossing.
  const bool lands = step.start.nullity < step.end.nullity;
  const bool crosses = step.start.side * step.end.side < 0;
  if ((crosses || lands) && !LookForCrossing(arc, step, &first) && crosses) return too_long;
  // From wall to wall of one obstacle in one step: a shorter step sees the wall that is ahead.
  if (first.Kind() == EventKind::kNone && equations.BeyondReach(step.end.x)) return too_long;
  // Whatever lies behind the target, however near, is not of this path.
  FindSample(step, ends.functions, &first);
  if (target && *target <= first.t) {
    first = StepEvent{*target};
    first.target = true;
  }
  return first;
}

CurvePoint PointOf(const Crossing& crossing, const SmoothArc& arc) {
  CurvePoint point;
  point.x = crossing.x;
  point.load_error = tolerances::kRate * arc.equations().ResidualUnit();
  TakeCurve(crossing.along.first, crossing.along.second, arc.LoadFactor(), &point);
  point.is_crossing = true;
  return point;
}

std::optional<CurvePoint> LocateTurn(SmoothArc* arc, const Step& step, const Eigen::VectorXd& row) {
  const Quintic along = step.InterpolateLinear([&](const Eigen::VectorXd& x) { return row.dot(x); });
  int count = 0;
  const std::array<double, 5> roots = Roots(Derivative(along), step.length, &count);
  if (count == 0) return std::nullopt;
  return LocateTurnNear(arc, step, roots[0], row);
}

std::optional<CurvePoint> Locate(SmoothArc* arc, const Step& step, const StepEvent& event, const StepEnds& ends) {
  if (event.crossing) {
    CurvePoint point = PointOf(*event.crossing, *arc);
    point.is_limit = event.Kind() == EventKind::kLimitPoint;
    return point;
  }
  std::optional<CurvePoint> point = LocateRegular(arc, step, event, ends);
  if (!point) return std::nullopt;
  const double t = step.normal.dot((point->x - step.start.x).head(step.normal.size()));
  const double slack = tolerances::kSamePoint * step.length;
  if (!(t >= -slack && t <= step.length + slack)) return std::nullopt;
  if (event.Kind() != EventKind::kLimitPoint) return point;
  point->is_limit = true;
  return point;
}

}  // namespace contact_path
