#include "contact_path/branch/arc_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kCoarsePrediction = 0.05;  // largest error of the predictor where no smaller one is met
constexpr int kLocatingAttempts = 6;
constexpr double kRounded = 10.0;  // turn along a step by a second derivative that is rounding
constexpr double kOffCurve = 0.7;  // cosine between the chord to a located end and the tangent at the start

// What a point does not tell, the start of its step does: the sign of a matrix that is singular, unless a crossing is
// located there, and the sense of a load that hardly changes.
void KeepSigns(const CurvePoint& start, CurvePoint* end) {
  if (end->side == 0 && !end->is_crossing) end->side = start.side;
  if (end->is_limit)
    end->load_sense = -start.load_sense;
  else if (end->load_sense == 0)
    end->load_sense = start.load_sense;
}

// A second derivative at the end of the step by which the curve would turn round within a tenth of it, while the
// tangents at both ends agree, is rounding of a point next to a singular one. The one of the cubic that has the points
// and the tangents of both ends takes its place.
void DropRoundedSecond(Step* step) {
  const Eigen::Index n = step->normal.size();
  const CurvePoint& start = step->start;
  CurvePoint& end = step->end;
  if (!(end.second.head(n).norm() * step->length > kRounded)) return;
  const double speed = 1.0 / step->normal.dot(end.first.head(n));  // of arc length by the parameter
  const Eigen::VectorXd chord = 6.0 / step->length * (end.x - start.x);
  const Eigen::VectorXd second = (2.0 * start.first + 4.0 * speed * end.first - chord) / step->length;
  end.second = (second - end.first.head(n).dot(second.head(n)) * end.first) / (speed * speed);
}

// Of a prediction at `length` from the start: a reaction's counts against its change along the step, where that is the
// larger one. What is pushed along a stiff axis has reactions that change by far more than the motion.
double ErrorOfPrediction(const ArcEquations& equations, const CurvePoint& start, double length,
                         const Eigen::VectorXd& step) {
  const Eigen::Index reactions = step.size() - equations.NumMotion();
  Eigen::VectorXd error = equations.Counted(step);
  error.tail(reactions).array() /=
      equations.Counted(start.first)
          .tail(reactions)
          .array()
          .abs()
          .max(0.5 * length * equations.Counted(start.second).tail(reactions).array().abs())
          .max(1.0);
  return error.norm();
}

// Whether the end of the step is beside the curve, as where rounding moves points by more than the length of the step.
bool EndsBeside(const Step& step) {
  const double chord = (step.end.x - step.start.x).head(step.normal.size()).norm();
  return chord > tolerances::kSameDirection && step.length < kOffCurve * chord;
}

std::string_view NameOf(EventKind kind) {
  switch (kind) {
    case EventKind::kNone: return "";
    case EventKind::kContactEvent: return "contact event";
    case EventKind::kLimitPoint: return "limit point";
    case EventKind::kBifurcation: return "bifurcation";
    case EventKind::kTarget: return "target";
    case EventKind::kSample: return "sample";
    case EventKind::kNearTouch: return "near touch";
    case EventKind::kTooLong: return "too long";
  }
  return "";
}

// A whole step with this length along the tangent; nothing where it has to be shorter. trial: null, or is told why.
std::optional<ArcStep> TryStep(SmoothArc* arc, const CurvePoint& start, double length, double prediction,
                               const StepLimits& limits, TrialStep* trial) {
  const Eigen::VectorXd normal = start.first.head(arc->NumMotion());
  const double tolerance = prediction * length;
  const Eigen::VectorXd straight = start.x + length * start.first;
  const Eigen::VectorXd bend = 0.5 * length * length * start.second;
  const auto error_of = [&](const Correction& correction) {
    return ErrorOfPrediction(arc->equations(), start, length, correction.first_step);
  };
  const auto good = [&](const Correction& correction) {
    if (!correction.converged) return false;
    const double noise = tolerances::kMargin * std::min(correction.steps.back(), tolerances::kStagnation);
    return error_of(correction) <= tolerance + std::min(noise, kCoarsePrediction * length);
  };
  Correction correction = arc->CorrectOnPlane(straight + bend, normal);
  // Next to a singular point the second derivatives are little but rounding.
  if (!good(correction) && arc->equations().Norm(bend) > tolerance) correction = arc->CorrectOnPlane(straight, normal);
  if (trial != nullptr) {
    trial->length = length;
    trial->numbers = {{"newton_iterations", correction.iterations},
                      {"contraction", correction.contraction},
                      {"predictor_error", error_of(correction) / length},
                      {"largest_predictor_error", prediction}};
    trial->verdict = correction.converged ? "predictor error" : "Newton's method does not converge";
  }
  if (!good(correction)) return std::nullopt;
  CurvePoint end;
  if (trial != nullptr) trial->verdict = "no tangent at the end";
  if (!arc->Derivatives(correction.x, normal, &end)) return std::nullopt;
  const double cosine = end.first.head(normal.size()).dot(normal);
  if (trial != nullptr) {
    trial->numbers.insert(trial->numbers.end(), {{"cosine", cosine}, {"smallest_cosine", limits.cosine}});
    trial->verdict = "turn";
  }
  if (cosine < limits.cosine) return std::nullopt;
  KeepSigns(start, &end);
  ArcStep result;
  result.step = MakeStep(start, end, arc->NumMotion());
  DropRoundedSecond(&result.step);
  result.tried = length;
  result.iterations = correction.iterations;
  result.contraction = correction.contraction;
  return result;
}

// Puts the target in place of an event whose located point is beyond it, where both are as near as rounding. False: it
// is not.
bool PassesTheTarget(const CurvePoint& start, const CurvePoint& end, Eigen::Index s, const StepEnds& ends,
                     StepEvent* event) {
  if (event->target || !ends.load_factor) return false;
  if (!((start.x[s] - *ends.load_factor) * (end.x[s] - *ends.load_factor) < 0.0)) return false;
  *event = StepEvent{event->t};
  event->target = true;
  return true;
}

// Whether the inequality that was to fail at `point` holds there, by more than what counts as zero at an event: the
// interpolation of the step has shown a zero that the curve does not have.
bool HoldsAt(const ArcEquations& equations, const StepEvent& event, const CurvePoint& point) {
  return event.Kind() == EventKind::kContactEvent && !event.crossing && !equations.IsOfRate(*event.fails) &&
         equations.Value(*event.fails, point.x) > tolerances::kActive * equations.UnitOf(*event.fails);
}

// Ends the step at the first event on it. The exact point of an event may show an earlier one. False: it is not found.
bool EndAtFirstEvent(SmoothArc* arc, const StepEnds& ends, ArcStep* at) {
  at->event = FirstEvent(arc, at->step, ends);
  if (at->event.Kind() == EventKind::kNone) return true;
  for (int attempt = 0; attempt < kLocatingAttempts; ++attempt) {
    std::optional<CurvePoint> point = Locate(arc, at->step, at->event, ends);
    if (!point) return false;
    KeepSigns(at->step.start, &*point);
    if (HoldsAt(arc->equations(), at->event, *point)) {
      at->event.fails.reset();
      at->event.near = true;
    }
    if (PassesTheTarget(at->step.start, *point, arc->LoadFactor(), ends, &at->event)) continue;
    at->step = MakeStep(at->step.start, *point, arc->NumMotion());
    if (EndsBeside(at->step)) return false;
    if (!(at->step.length > tolerances::kNoMove)) {
      at->step.length = 0.0;
      return true;
    }
    DropRoundedSecond(&at->step);
    // What fails at an end so near fails at the start, too; an interpolation in between is rounding.
    if (!(at->step.length > tolerances::kActive)) return true;
    const StepEvent earlier = FirstEvent(arc, at->step, ends);
    if (earlier.Kind() == EventKind::kNone || earlier.t >= at->step.length - tolerances::kNoMove) return true;
    at->event = earlier;
  }
  return false;
}

}  // namespace

std::optional<ArcStep> NextStep(SmoothArc* arc, const CurvePoint& start, double length, const StepLimits& limits,
                                const StepEnds& ends) {
  arc->SetOut(start);
  double tried = length, prediction = limits.prediction;
  TrialStep said;
  for (int rejected = 0;; ++rejected) {
    // Next to where another path crosses, or an imperfection has broken the crossing, points are less exact than the
    // predictor of a short step.
    if (tried < limits.smallest && prediction == limits.prediction) {
      prediction = kCoarsePrediction;
      tried = length;
    }
    if (tried < limits.smallest) return std::nullopt;
    TrialStep* const trial = limits.on_trial ? &said : nullptr;
    std::optional<ArcStep> step = TryStep(arc, start, tried, prediction, limits, trial);
    const bool good = step && EndAtFirstEvent(arc, ends, &*step);
    if (trial != nullptr) {
      if (good) {
        said.verdict = "accepted";
        said.ends_at = NameOf(step->event.Kind());
        said.numbers.emplace_back("reached", step->step.length);
      } else if (step) {
        said.verdict = "event not located";
      }
      limits.on_trial(said);
    }
    if (good) {
      step->rejected = rejected;
      return step;
    }
    tried *= 0.5;
  }
}

}  // namespace contact_path
