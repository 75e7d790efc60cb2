#include "contact_path/path/certified_method.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/path/diagnosis.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostCornersInPlace = 8;  // then the contacts chatter, and no direction is trusted

const char* Describe(ArcFailure failure) {
  switch (failure) {
    case ArcFailure::kNone: return "";
    case ArcFailure::kNotSolved: return "the equations of the contact states are not solved";
    case ArcFailure::kOther: return "the solution is far from where the path leads";
    case ArcFailure::kTurns: return "the path turns back although no contact is about to change its state";
    case ArcFailure::kFailsAtOnce: return "a contact would have to change its state at once";
    case ArcFailure::kNotLocated: return "the place where a contact changes its state is not found";
  }
  return "";
}

constexpr double kCoarsePrediction = 0.05;  // of the length
constexpr char kResiduals[] = "its residuals are too large";

std::string_view NameOf(ArcEnd kind) {
  switch (kind) {
    case ArcEnd::kNone: return "";
    case ArcEnd::kConstraint: return "corner";
    case ArcEnd::kLimitPoint: return "limit point";
    case ArcEnd::kTarget: return "target";
  }
  return "";
}

}  // namespace

CertifiedMethod::CertifiedMethod(const Model& model, const MpecOptions& options, std::function<bool()> cancelled)
    : model_(model),
      options_(options),
      cancelled_(std::move(cancelled)),
      departure_(model, {options.direction, false}, cancelled_),
      arc_(model.structure, model.contacts),
      step_length_(options.step),
      events_(options.events) {}

std::optional<EndReason> CertifiedMethod::Start(const PathPoint& from, EventRecord* branches, std::string* message) {
  departure_.NoteReactions(from);
  *message = HiddenSlip(model_, from);
  if (!message->empty()) return EndReason::kNumericalFailure;
  return departure_.Leave(from, departure_.StartArrival(), nullptr, &arc_, &current_, branches, message);
}

bool CertifiedMethod::Resume(const ResumePoint& at) {
  if (!(at.solve.next_step > 0.0)) return false;
  departure_.SetLargestReaction(at.largest_reaction);
  arc_.SetStates(at.point.states, at.point);
  if (!arc_.Derivatives(arc_.system().Pack(at.point), Chord(at.before, at.point), &current_)) return false;
  step_length_ = at.solve.next_step;
  return true;
}

AcceptedPoint CertifiedMethod::PointOf(const PathPoint& point, const Residuals& residuals) const {
  AcceptedPoint accepted;
  accepted.point = point;
  accepted.residuals = residuals;
  accepted.solve.method = Method::kMpec;
  accepted.solve.exact = true;
  accepted.solve.variables = static_cast<int>(arc_.system().NumUnknowns());
  accepted.solve.constraints = static_cast<int>(arc_.system().NumEquations());
  return accepted;
}

Advance CertifiedMethod::ChangeReactions(const PathPoint& from) {
  PathPoint point = *departure_.begin();
  departure_.begin().reset();
  point.states = arc_.system().states();
  Advance advance;
  AcceptedPoint accepted = PointOf(point, model_.Check(from, point));
  if (!(accepted.residuals.Largest() <= tolerances::kAcceptedExact)) {
    advance.message = "the reactions with which a branch begins are not in equilibrium";
    return advance;
  }
  accepted.solve.next_step = step_length_;
  advance.ended = false;
  advance.increments.push_back(std::move(accepted));
  return advance;
}

std::optional<CertifiedMethod::Certified> CertifiedMethod::Certify(const PathPoint& from, EndReason* reason,
                                                                   std::string* message) {
  Certified at;
  // Why the longest increment was refused: shorter ones fail for reasons that follow from it.
  std::string first;
  ArcLimits limits = options_.arc;
  for (at.tried = step_length_;; at.tried *= 0.5, ++at.rejected) {
    // Where no length meets the limits, as next to singular points, the predictor may be further off.
    if (at.tried < options_.smallest_step) {
      if (limits.prediction == kCoarsePrediction) break;
      limits.prediction = kCoarsePrediction;
      at.tried = step_length_;
    }
    if (cancelled_ && cancelled_()) {
      *reason = EndReason::kCancelled;
      *message = "the caller asked for it";
      return std::nullopt;
    }
    ArcFailure failure = ArcFailure::kNone;
    std::optional<ArcIncrement> increment =
        IncrementOnArc(&arc_, current_, at.tried, limits, options_.target, &failure);
    TrialStep trial = {at.tried, Describe(failure), {}, {}};
    if (increment) {
      at.increment = *std::move(increment);
      at.point = arc_.system().Unpack(at.increment.end.x);
      at.residuals = model_.Check(from, at.point);
      const bool accepted = at.residuals.Largest() <= tolerances::kAcceptedExact;
      trial.verdict = accepted ? "accepted" : kResiduals;
      trial.ends_at = NameOf(at.increment.kind);
      trial.numbers = {{"reached", Distance(from, at.point)},
                       {"stationarity", at.increment.stationarity},
                       {"newton_iterations", at.increment.corrections},
                       {"largest_residual", at.residuals.Largest()}};
      if (options_.on_trial) options_.on_trial(trial);
      if (accepted) return at;
    } else if (options_.on_trial) {
      options_.on_trial(trial);
    }
    if (first.empty()) first = trial.verdict;
  }
  *reason = EndReason::kStepTooSmall;
  *message = "no increment could be accepted, however short: " + first;
  return std::nullopt;
}

std::optional<EndReason> CertifiedMethod::LeaveCorner(const PathPoint& from, const Certified& at,
                                                      AcceptedPoint* accepted, std::string* message) {
  const double arrives = at.increment.end.first[LoadFactor()];
  Arrival arrival;
  arrival.direction = at.increment.end.first.head(arc_.NumMotion());
  arrival.load_sense = options_.direction;
  // The corner is where the path stood, and its rate may be rounding.
  const Constraint& constraint = at.increment.constraint;
  const double rate = arc_.system().Rate(constraint, at.increment.end.x, at.increment.end.first);
  const bool in_place = !(Distance(from, at.point) > tolerances::kNoMove);
  if (in_place && rate < 0.0 && rate >= -tolerances::kRate * arc_.system().UnitOf(constraint))
    arrival.failed = constraint;
  accepted->event.number = ++events_;
  const std::optional<EndReason> reason =
      departure_.Leave(at.point, arrival, nullptr, &arc_, &current_, &accepted->event, message);
  if (reason) return reason;
  const double leaves = current_.first[LoadFactor()];
  const bool turns = arrives * leaves < 0.0 && std::min(std::abs(arrives), std::abs(leaves)) > tolerances::kLevel;
  if (turns) accepted->kind = IncrementKind::kCornerLimit;
  return std::nullopt;
}

std::optional<int> CertifiedMethod::EndAtReturn(const PathPoint& from, Certified* at) {
  if (options_.returns == nullptr || from.states != at->point.states) return std::nullopt;
  const std::optional<ReturnDetector::Return> found = options_.returns->Find(from, at->point);
  if (!found) return std::nullopt;
  const Residuals residuals = model_.Check(from, found->point);
  if (!(residuals.Largest() <= tolerances::kAcceptedExact)) return std::nullopt;
  at->point = found->point;
  at->residuals = residuals;
  at->increment.kind = ArcEnd::kNone;
  return found->increment;
}

std::string CertifiedMethod::Remark() const {
  if (!departure_.other_reactions()) return {};
  return "where several contacts hold a node its reactions are not unique: the least ones were taken";
}

Advance CertifiedMethod::Next(const PathPoint& from) {
  if (departure_.begin()) return ChangeReactions(from);
  Advance advance;
  std::optional<Certified> at = Certify(from, &advance.reason, &advance.message);
  if (!at) return advance;
  const std::optional<int> returned = EndAtReturn(from, &*at);

  AcceptedPoint accepted = PointOf(at->point, at->residuals);
  const Step step = MakeStep(current_, at->increment.end, arc_.NumMotion());
  if (step.length > 0.0) {
    accepted.arc_length = step.ArcLength();
    accepted.work = WorkOfStep(model_, arc_.system(), step);
  }
  accepted.solve.rejected = at->rejected;
  departure_.NoteReactions(at->point);
  corners_in_place_ = accepted.arc_length > tolerances::kNoMove ? 0 : corners_in_place_ + 1;
  current_ = at->increment.end;
  step_length_ = std::min(options_.step, at->rejected > 0 ? 1.5 * at->tried : 2.0 * step_length_);
  accepted.solve.next_step = step_length_;

  std::optional<EndReason> reason;
  if (returned) {
    reason = EndReason::kClosedPath;
    advance.message = ClosedPathText(*returned);
  } else if (corners_in_place_ > kMostCornersInPlace) {
    reason = EndReason::kNumericalFailure;
    advance.message = "contacts change their states again and again in one place";
  } else if (at->increment.kind == ArcEnd::kLimitPoint) {
    accepted.kind = IncrementKind::kSmoothLimit;
  } else if (at->increment.kind == ArcEnd::kConstraint) {
    accepted.kind = IncrementKind::kContactEvent;
    reason = LeaveCorner(from, *at, &accepted, &advance.message);
  }
  advance.ended = reason.has_value();
  if (reason) advance.reason = *reason;
  advance.increments.push_back(std::move(accepted));
  return advance;
}

}  // namespace contact_path
