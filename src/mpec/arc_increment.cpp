#include "contact_path/mpec/arc_increment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "contact_path/branch/test_functions.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kStationary = 1e-8;    // component along the curve, of the length: the increment is a minimiser
constexpr int kMostMinimisations = 8;   // each with the tangent of the one before
constexpr int kMostHalvings = 24;       // of an increment, until an inequality that is zero at its start is positive
constexpr int kMostEarlier = 6;         // events that the interpolation tells of, each before the one before
constexpr double kInside = 1.0 - 1e-6;  // of an increment: an event beyond is that at its end
constexpr int kMostRoots = 60;          // evaluations for a root

// What is >= 0 along the increment.
struct Guard {
  ArcEnd kind = ArcEnd::kConstraint;
  Constraint constraint;
  double unit = 1.0;   // of values
  double slack = 0.0;  // value down to which it holds, by rounding
  double at_start = 0.0;
};

class Increment {
 public:
  Increment(SmoothArc* arc, const CurvePoint& start, double length, const ArcLimits& limits,
            std::optional<double> target)
      : arc_(*arc),
        start_(start),
        length_(length),
        limits_(limits),
        target_(target),
        normal_(start.first.head(arc->NumMotion())) {}

  std::optional<ArcIncrement> Solve(ArcFailure* failure) {
    for (int earlier = 0; earlier <= kMostEarlier; ++earlier) {
      result_.kind = ArcEnd::kNone;
      std::optional<CurvePoint> end = Minimiser(failure);
      if (end) SetGuards();
      if (end && std::any_of(guards_.begin(), guards_.end(), [&](const Guard& guard) { return Fails(guard, *end); })) {
        end = FirstRoot(*std::move(end), failure);
      } else if (end) {
        const Guard* const zero = ZeroAt(*end);
        if (zero != nullptr) result_.kind = zero->kind;
        if (zero != nullptr) result_.constraint = zero->constraint;
      }
      if (!end) return std::nullopt;
      if (result_.kind == ArcEnd::kNone) {
        const Eigen::VectorXd motion = (end->x - start_.x).head(normal_.size());
        result_.stationarity = std::abs(end->first.head(normal_.size()).dot(motion - length_ * normal_)) / length_;
      }
      const std::optional<double> inside = EventInside(*end, failure);
      if (*failure != ArcFailure::kNone) return std::nullopt;
      if (!inside) {
        result_.end = *std::move(end);
        return std::move(result_);
      }
      length_ = *inside;
    }
    *failure = ArcFailure::kNotLocated;
    return std::nullopt;
  }

 private:
  Eigen::Index LoadFactor() const { return normal_.size() - 1; }

  // The point of the curve on the plane with this normal at `along` times the tangent.
  std::optional<CurvePoint> PointAt(double along, const Eigen::VectorXd& guess, const Eigen::VectorXd& normal) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(start_.x.size());
    row.head(normal.size()) = normal;
    const Eigen::VectorXd wanted = start_.x.head(normal.size()) + along * normal_;
    const Correction correction = arc_.Correct(guess, row, normal.dot(wanted));
    result_.corrections += correction.iterations;
    CurvePoint point;
    if (!correction.converged || !arc_.Derivatives(correction.x, normal, &point)) return std::nullopt;
    KeepSide(&point);
    return point;
  }
  // A matrix that is singular to rounding at a regular point has no sign of its own.
  void KeepSide(CurvePoint* point) const {
    if (point->side == 0 && point->nullity == 0) point->side = start_.side;
  }
  Eigen::VectorXd Predicted(double along) const {
    return start_.x + along * start_.first + 0.5 * along * along * start_.second;
  }

  std::optional<CurvePoint> Minimiser(ArcFailure* failure) {
    const Eigen::Index n = normal_.size();
    const Eigen::VectorXd bent = Predicted(length_);
    const Correction first = arc_.CorrectOnPlane(bent, normal_);
    result_.corrections += first.iterations;
    CurvePoint point;
    *failure = ArcFailure::kNotSolved;
    if (!first.converged || !arc_.Derivatives(first.x, normal_, &point)) return std::nullopt;
    KeepSide(&point);
    *failure = ArcFailure::kOther;
    const double rounding = arc_.system().ResidualUnit() *
                            std::max(tolerances::kPredictor, tolerances::kPredictorRounding * start_.x.norm());
    if ((point.x - bent).head(n).norm() > limits_.prediction * length_ + rounding) return std::nullopt;
    for (int i = 0; i < kMostMinimisations; ++i) {
      const Eigen::VectorXd tangent = point.first.head(n);
      const double off = tangent.dot((point.x - start_.x).head(n) - length_ * normal_);
      if (std::abs(off) <= kStationary * length_) break;
      const std::optional<CurvePoint> next = PointAt(length_, point.x - off * point.first, tangent);
      if (!next) {
        *failure = ArcFailure::kNotSolved;
        return std::nullopt;
      }
      point = *next;
    }
    *failure = ArcFailure::kTurns;
    const Eigen::VectorXd chord = (point.x - start_.x).head(n);
    const Eigen::VectorXd tangent = point.first.head(n);
    if (!(tangent.dot(normal_) >= limits_.cosine) || !(chord.dot(normal_) >= limits_.cosine * chord.norm()) ||
        !(chord.dot(tangent) >= limits_.cosine * chord.norm()) || chord.norm() > 2.0 * length_)
      return std::nullopt;
    *failure = ArcFailure::kNone;
    return point;
  }

  // What the values at the ends do not show, as a contact that closes and opens in between: where the interpolation of
  // the increment tells of an event before its end, or comes so near to one that only an increment there can tell.
  std::optional<double> EventInside(const CurvePoint& end, ArcFailure* failure) {
    const Step step = MakeStep(start_, end, normal_.size());
    if (!(step.length > tolerances::kNoMove)) return std::nullopt;
    const StepEvent event = FirstEvent(&arc_, step, target_);
    if (event.kind == EventKind::kTooLong) *failure = ArcFailure::kOther;
    const bool tells = event.kind == EventKind::kContactEvent || event.kind == EventKind::kNearTouch ||
                       event.kind == EventKind::kLimitPoint || event.kind == EventKind::kTarget;
    const auto reach = [&](const CurvePoint& at) {
      return event.kind == EventKind::kLimitPoint ? ReachOfExtreme(at.second[LoadFactor()]) : 0.0;
    };
    if (!tells || event.t <= tolerances::kNoMove + reach(start_) || event.t >= kInside * step.length - reach(end))
      return std::nullopt;
    return event.t;
  }

  void SetGuards() {
    guards_.clear();
    std::vector<Constraint> open_ends;
    for (const Constraint& constraint : arc_.InequalitiesInReach(start_.x, 2.0 * length_, &open_ends)) {
      Guard guard;
      guard.constraint = constraint;
      guard.unit = arc_.system().UnitOf(constraint);
      guard.slack =
          constraint.inequality == Inequality::kSlip ? tolerances::kRate * guard.unit : arc_.RoundingOf(constraint);
      guards_.push_back(guard);
    }
    // At a limit point the rate is as small as the place of the point is exact.
    const double rate = start_.first[LoadFactor()], bend = start_.second[LoadFactor()];
    if (std::abs(rate) > tolerances::kLevel + std::abs(bend) * ReachOfExtreme(bend))
      guards_.push_back({ArcEnd::kLimitPoint, {}, 1.0, 0.0, 0.0});
    if (target_ && start_.x[LoadFactor()] != *target_) guards_.push_back({ArcEnd::kTarget, {}, 1.0, 0.0, 0.0});
    for (Guard& guard : guards_) guard.at_start = Value(guard, start_);
  }

  double Value(const Guard& guard, const CurvePoint& at) const {
    const Eigen::Index s = LoadFactor();
    if (guard.kind == ArcEnd::kLimitPoint) return std::copysign(1.0, start_.first[s]) * at.first[s];
    if (guard.kind == ArcEnd::kTarget) return std::copysign(1.0, *target_ - start_.x[s]) * (*target_ - at.x[s]);
    const FixedStateSystem& system = arc_.system();
    return guard.constraint.inequality == Inequality::kSlip ? system.Rate(guard.constraint, at.x, at.first)
                                                            : system.Value(guard.constraint, at.x);
  }
  bool Fails(const Guard& guard, const CurvePoint& at) const { return Value(guard, at) < -guard.slack; }

  // A guard that was positive at the start, and is zero to rounding at the end; null: none.
  const Guard* ZeroAt(const CurvePoint& end) const {
    for (const Guard& guard : guards_)
      if (guard.at_start > guard.slack && std::abs(Value(guard, end)) <= guard.slack) return &guard;
    return nullptr;
  }

  // The least value of the guards that are armed, in their units, and whose it is.
  std::pair<double, std::size_t> Least(const std::vector<std::size_t>& armed, const CurvePoint& at) const {
    std::pair<double, std::size_t> least(std::numeric_limits<double>::infinity(), 0);
    for (const std::size_t i : armed) least = std::min(least, {Value(guards_[i], at) / guards_[i].unit, i});
    return least;
  }

  // The first point at which a guard that holds before is zero. end: of the whole increment.
  std::optional<CurvePoint> FirstRoot(CurvePoint end, ArcFailure* failure) {
    // A guard that is zero at the start is armed where it has become positive.
    double low = 0.0, high = normal_.dot((end.x - start_.x).head(normal_.size()));
    CurvePoint at_high = std::move(end);
    std::vector<std::size_t> armed;
    const auto arm = [&](const CurvePoint& at) {
      armed.clear();
      for (std::size_t i = 0; i < guards_.size(); ++i)
        if (guards_[i].at_start > guards_[i].slack || Value(guards_[i], at) > guards_[i].slack) armed.push_back(i);
    };
    const auto fails_at = [&](const CurvePoint& at) {
      return std::any_of(guards_.begin(), guards_.end(), [&](const Guard& guard) { return Fails(guard, at); });
    };
    arm(start_);
    CurvePoint at_low = start_;
    *failure = ArcFailure::kFailsAtOnce;
    const auto unarmed_fails = [&](const CurvePoint& at) {
      std::optional<std::size_t> failing;
      for (std::size_t i = 0; i < guards_.size() && !failing; ++i)
        if (!std::binary_search(armed.begin(), armed.end(), i) && Fails(guards_[i], at)) failing = i;
      return failing;
    };
    for (int halving = 0; unarmed_fails(at_high); ++halving) {
      if (halving == kMostHalvings) {
        // It is never positive: the start is the corner.
        const Guard& failing = guards_[*unarmed_fails(at_high)];
        result_.kind = failing.kind;
        result_.constraint = failing.constraint;
        *failure = ArcFailure::kNone;
        return start_;
      }
      const double middle = 0.5 * (low + high);
      const std::optional<CurvePoint> at = PointAt(middle, Predicted(middle), normal_);
      if (!at) return std::nullopt;
      if (fails_at(*at)) {
        high = middle;
        at_high = *at;
      } else {
        low = middle;
        at_low = *at;
        arm(at_low);
        if (unarmed_fails(at_high)) continue;
      }
    }
    if (armed.empty()) return std::nullopt;
    *failure = ArcFailure::kNotLocated;
    std::pair<double, std::size_t> below = Least(armed, at_high);
    if (!(below.first < 0.0)) return at_high;
    double value_low = Least(armed, at_low).first, value_high = below.first;
    int side = 0;
    for (int i = 0; i < kMostRoots && high - low > tolerances::kNoMove; ++i) {
      // Regula falsi, Illinois.
      double middle = high - value_high * (high - low) / (value_high - value_low);
      if (!(middle > low && middle < high)) middle = 0.5 * (low + high);
      const double share = (middle - low) / (high - low);
      std::optional<CurvePoint> at = PointAt(middle, (1.0 - share) * at_low.x + share * at_high.x, normal_);
      if (!at) at = PointAt(middle, Predicted(middle), normal_);
      if (!at) return std::nullopt;
      const std::pair<double, std::size_t> least = Least(armed, *at);
      if (least.first < 0.0) {
        high = middle;
        at_high = *at;
        value_high = least.first;
        below = least;
        if (side < 0) value_low *= 0.5;
        side = -1;
      } else {
        low = middle;
        at_low = *at;
        value_low = least.first;
        if (side > 0) value_high *= 0.5;
        side = 1;
      }
    }
    const Guard& guard = guards_[below.second];
    result_.kind = guard.kind;
    result_.constraint = guard.constraint;
    return Exactly(guard, at_low, at_high, failure);
  }

  // The exact point next to the root.
  std::optional<CurvePoint> Exactly(const Guard& guard, const CurvePoint& before, const CurvePoint& after,
                                    ArcFailure* failure) {
    const bool nearer = std::abs(Value(guard, before)) <= std::abs(Value(guard, after));
    const CurvePoint& near = nearer ? before : after;
    if (guard.kind == ArcEnd::kTarget) {
      const Correction at = arc_.Correct(near.x, Eigen::VectorXd::Unit(near.x.size(), LoadFactor()), *target_);
      CurvePoint point;
      if (!at.converged || !arc_.Derivatives(at.x, normal_, &point)) return std::nullopt;
      *failure = ArcFailure::kNone;
      return point;
    }
    *failure = ArcFailure::kNone;
    if (guard.kind == ArcEnd::kLimitPoint || guard.constraint.inequality == Inequality::kSlip) return near;
    const Correction at = arc_.CorrectOnto(guard.constraint, near.x);
    CurvePoint point;
    // A graze is no regular zero: the root is as exact as it can be found.
    if (!at.converged || (at.x - near.x).norm() > tolerances::kSameTangent || !arc_.Derivatives(at.x, normal_, &point))
      return near;
    return point;
  }

  SmoothArc& arc_;
  const CurvePoint& start_;
  double length_;
  const ArcLimits limits_;
  const std::optional<double> target_;
  const Eigen::VectorXd normal_;
  std::vector<Guard> guards_;
  ArcIncrement result_;
};

}  // namespace

std::optional<ArcIncrement> IncrementOnArc(SmoothArc* arc, const CurvePoint& start, double length,
                                           const ArcLimits& limits, std::optional<double> target, ArcFailure* failure) {
  arc->SetOut(start);
  return Increment(arc, start, length, limits, target).Solve(failure);
}

}  // namespace contact_path
