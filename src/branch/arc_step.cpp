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
constexpr double kOffCurve = 0.7;  // cosine between a chord and its tangent: of a located end, less exact

// What rounding does not leave of a point, the start of its step tells: the sign of a matrix that is singular to
// rounding at a regular point, and the sense of a load that hardly changes.
void KeepSigns(const CurvePoint& start, CurvePoint* end) {
  if (end->side == 0 && end->nullity == 0 && !end->is_crossing) end->side = start.side;
  if (end->is_limit)
    end->load_sense = -start.load_sense;
  else if (end->load_sense == 0)
    end->load_sense = start.load_sense;
}

// A second derivative at an end of the step by which the curve would turn round within a tenth of it, while the
// tangents at both ends agree, is rounding of a point next to a singular one. The one of the cubic that has the points
// and the tangents of both ends takes its place.
void DropRoundedSeconds(Step* step) {
  const Eigen::Index n = step->normal.size();
  CurvePoint &start = step->start, &end = step->end;
  const auto rounded = [&](const CurvePoint& at) { return at.second.head(n).norm() * step->length > kRounded; };
  const double speed = 1.0 / step->normal.dot(end.first.head(n));  // of arc length by the parameter
  const Eigen::VectorXd chord = 6.0 / step->length * (end.x - start.x);
  if (rounded(start)) start.second = (chord - 4.0 * start.first - 2.0 * speed * end.first) / step->length;
  if (!rounded(end)) return;
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

double Chord(const Step& step) { return (step.end.x - step.start.x).head(step.normal.size()).norm(); }

// Whether the end of the step is beside the curve, as where rounding moves points by more than the length of the step.
// cosine: smallest between the tangent at the start and the chord.
bool EndsBeside(const Step& step, double cosine) {
  const double chord = Chord(step);
  return chord > tolerances::kSameDirection && step.length < cosine * chord;
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
  const double rounding =
      arc->equations().ResidualUnit() * std::max(tolerances::kNoMove, tolerances::kLastDigits * start.x.norm());
  const Eigen::VectorXd straight = start.x + length * start.first;
  const Eigen::VectorXd bend = 0.5 * length * length * start.second;
  const auto error_of = [&](const Correction& correction) {
    return ErrorOfPrediction(arc->equations(), start, length, correction.first_step);
  };
  const auto good = [&](const Correction& correction) {
    if (!correction.converged) return false;
    const double noise = tolerances::kMargin * std::min(correction.steps.back(), tolerances::kStagnation);
    return error_of(correction) <= tolerance + std::max(rounding, std::min(noise, kCoarsePrediction * length));
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
  if (trial != nullptr) trial->verdict = "beside the curve";
  if (EndsBeside(result.step, limits.cosine)) return std::nullopt;
  DropRoundedSeconds(&result.step);
  result.tried = length;
  result.iterations = correction.iterations;
  result.contraction = correction.contraction;
  return result;
}

// Puts in place of an event one of the ends that lies between the start and the located point of the event, where both
// are as near as rounding. False: none does.
bool PassesAnEnd(const SmoothArc& arc, const CurvePoint& start, const CurvePoint& end, const StepEnds& ends,
                 StepEvent* event) {
  if (event->target) return false;
  const Eigen::Index s = arc.LoadFactor();
  if (ends.load_factor && (start.x[s] - *ends.load_factor) * (end.x[s] - *ends.load_factor) < 0.0) {
    *event = StepEvent{event->t};
    event->target = true;
    return true;
  }
  if (event->sample) return false;
  for (std::size_t i = 0; i < ends.functions.size(); ++i) {
    const ArcTarget& target = ends.functions[i];
    const double before = target.of(start.x), after = target.of(end.x);
    for (const double value : target.values)
      if (std::abs(before - value) > target.rounding && (before - value) * (after - value) < 0.0 &&
          target.sense * (after - before) >= 0.0) {
        *event = StepEvent{event->t};
        event->sample = {i, value};
        return true;
      }
  }
  return false;
}

// Whether the load factor, of which a limit point was located at `point`, goes on beyond it in its sense: its rate
// touches zero, as where the load is a cubic of the arc length.
bool LoadGoesOn(const SmoothArc& arc, const Step& step, const CurvePoint& point) {
  const Eigen::Index s = arc.LoadFactor();
  if (!(step.start.first[s] * step.end.first[s] > 0.0)) return false;
  const Quintic load = step.InterpolateLinear([s](const Eigen::VectorXd& x) { return x[s]; });
  const double t = step.normal.dot((point.x - step.start.x).head(step.normal.size()));
  const double third = Evaluate(Derivative(Derivative(Derivative(load))), t), second = point.second[s];
  // The extreme of the rate, by its parabola.
  return second * second <= 2.0 * tolerances::kRate * arc.equations().ResidualUnit() * std::abs(third);
}

// Whether the inequality that was to fail at `point` holds there, by more than what counts as zero at an event: the
// interpolation of the step has shown a zero that the curve does not have.
bool HoldsAt(const ArcEquations& equations, const StepEvent& event, const CurvePoint& point) {
  return event.Kind() == EventKind::kContactEvent && !event.crossing && !equations.IsOfRate(*event.fails) &&
         equations.Value(*event.fails, point.x) > tolerances::kActive * equations.UnitOf(*event.fails);
}

// Ends the step at the first event on it. The exact point of an event may show an earlier one. False: it is not found.
bool EndAtFirstEvent(SmoothArc* arc, const StepEnds& wanted, ArcStep* at) {
  const StepEnds* ends = &wanted;
  std::optional<StepEnds> fewer;  // of them
  at->event = FirstEvent(arc, at->step, *ends);
  if (at->event.Kind() == EventKind::kNone) return true;
  const Step whole = at->step;
  for (int attempt = 0; attempt < kLocatingAttempts; ++attempt) {
    std::optional<CurvePoint> point = Locate(arc, at->step, at->event, *ends);
    while (!point && at->event.sample) {
      // The function is known less well than the value asks for: the path goes on without that increment.
      if (!fewer) ends = &fewer.emplace(wanted);
      std::vector<double>& values = fewer->functions[at->event.sample->target].values;
      values.erase(std::find(values.begin(), values.end(), at->event.sample->value));
      at->event = FirstEvent(arc, at->step, *ends);
      if (at->event.Kind() == EventKind::kNone) return true;
      point = Locate(arc, at->step, at->event, *ends);
    }
    if (!point) return false;
    KeepSigns(at->step.start, &*point);
    if (at->event.singular) point->BeSingular();
    if (at->event.Kind() == EventKind::kLimitPoint && !at->event.crossing && LoadGoesOn(*arc, whole, *point)) {
      at->event.turns = false;
      at->event.near = true;
      point->is_limit = false;
      point->load_sense = at->step.start.load_sense;
    }
    if (HoldsAt(arc->equations(), at->event, *point)) {
      at->event.fails.reset();
      at->event.near = true;
    }
    if (PassesAnEnd(*arc, at->step.start, *point, *ends, &at->event)) continue;
    const StepEvent found = at->event;
    at->step = MakeStep(at->step.start, *point, arc->NumMotion());
    if (EndsBeside(at->step, kOffCurve)) return false;
    if (!(at->step.length > tolerances::kNoMove)) {
      at->step.length = 0.0;
      return true;
    }
    DropRoundedSeconds(&at->step);
    const StepEvent earlier = FirstEvent(arc, at->step, *ends);
    if (earlier.Kind() == EventKind::kNone || earlier.t >= at->step.length - tolerances::kNoMove) return true;
    // The value of a sample is rounding of a short step where it leads to this point again.
    const auto &before = found.sample, &again = earlier.sample;
    if (before && again && before->target == again->target && before->value == again->value) return true;
    at->event = earlier;
  }
  return false;
}

// Where the matrix is singular to rounding there are no second derivatives, and no event is found on a step that ends
// there. A longer one ends beyond. Nothing: none does.
std::optional<ArcStep> StepBeyond(SmoothArc* arc, const CurvePoint& start, double length, const StepLimits& limits,
                                  const StepEnds& ends) {
  for (const double factor : {2.0, 4.0, 8.0}) {
    if (factor * length > limits.largest) break;
    std::optional<ArcStep> step = TryStep(arc, start, factor * length, kCoarsePrediction, limits, nullptr);
    if (step && step->step.end.nullity == 0 && EndAtFirstEvent(arc, ends, &*step)) return step;
  }
  return std::nullopt;
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
    // Where there are no second derivatives the predictor is no better than the tangent. A long step might leap then.
    if (!step && start.nullity > 0 && tried <= tolerances::kNextToStart * limits.largest)
      step = TryStep(arc, start, tried, kCoarsePrediction, limits, trial);
    const bool ends_singular = step && start.nullity == 0 && step->step.end.nullity > 0;
    bool good = step && EndAtFirstEvent(arc, ends, &*step);
    if (ends_singular && !(good && step->event.Kind() != EventKind::kNone)) {
      std::optional<ArcStep> beyond = StepBeyond(arc, start, tried, limits, ends);
      good = good || beyond;
      if (beyond) step = std::move(beyond);
    }
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
