#include "contact_path/path/branch_method.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/branch/gauss_rule.h"
#include "contact_path/mpec/short_increment.h"
#include "contact_path/path/automatic_step.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostEventsInPlace = 8;              // then the contacts chatter, and no branch is trusted
constexpr double kPredictionAfterSingular = 0.05;  // largest error of the predictor there, where no smaller one is met
constexpr double kAfterSingular = 0.05;  // of the step: derivatives at a singular point are not exact to second order
constexpr int kLocatingAttempts = 6;

// The rate of a quantity; where it is zero, how it changes next to there; 0 where both are.
double Trend(double rate, double change, double level) {
  if (std::abs(rate) > level) return rate;
  return std::abs(change) > level ? change : 0.0;
}

std::string NoBranch(const BranchSet& on) {
  if (on.rigid_modes > 0)
    return "no admissible branch, and the structure is a mechanism here: nothing resists " +
           std::to_string(on.rigid_modes) + (on.rigid_modes == 1 ? " motion" : " motions");
  if (!on.complete) return "no admissible branch was found among the combinations of contact states tried";
  return "no admissible branch: the quasi-static path ends here, only a dynamic jump leads further";
}

}  // namespace

std::string PlaceOf(const BranchChoice& choice) {
  return choice.event > 0 ? "event " + std::to_string(choice.event) : "increment " + std::to_string(choice.increment);
}

BranchOptions BranchOptions::For(const TraceOptions& options, Eigen::Index num_dofs) {
  BranchOptions result;
  switch (options.accuracy) {
    case Accuracy::kFast:
      result.step = 0.05;
      result.prediction = 1e-2;
      result.smallest_cosine = 0.9;
      break;
    case Accuracy::kBalanced: break;
    case Accuracy::kAccurate:
      result.step = 0.005;
      result.prediction = 1e-4;
      result.smallest_cosine = 0.998;
      break;
  }
  result.step = options.step > 0.0 ? options.step : result.step * AutomaticStepGrowth(num_dofs);
  result.smallest_step = std::min(result.smallest_step, 1e-3 * result.step);
  result.direction = options.Direction();
  result.choices = options.branch_choices;
  return result;
}

BranchMethod::BranchMethod(const Model& model, const BranchOptions& options, std::function<bool()> cancelled)
    : model_(model),
      options_(options),
      cancelled_(std::move(cancelled)),
      ipopt_(cancelled_),
      mpec_(model.structure, model.contacts, &ipopt_),
      arc_(model.structure, model.contacts),
      step_length_(options.step),
      increments_(options.increments),
      events_(options.events) {}

const BranchChoice* BranchMethod::ChoiceForEvent(int event) const {
  for (const BranchChoice& choice : options_.choices)
    if (choice.event == event && event > 0) return &choice;
  return nullptr;
}

const BranchChoice* BranchMethod::ChoiceForIncrement(int increment) const {
  for (const BranchChoice& choice : options_.choices)
    if (choice.event == 0 && choice.increment == increment) return &choice;
  return nullptr;
}

bool BranchMethod::Leave(const PathPoint& point, const Branch& branch) {
  arc_.SetStates(branch.states, point, branch.singular);
  const bool regular = arc_.Derivatives(arc_.system().Pack(point), branch.direction, &current_) &&
                       (current_.first - branch.first).norm() <= tolerances::kSameTangent;
  if (regular) return true;
  // Another path crosses here, or the structure has rigid modes: the branch itself tells where to go.
  current_.x = arc_.system().Pack(point);
  current_.first = branch.first;
  current_.second = branch.second;
  current_.determinant_sign = 0;
  return current_.second.allFinite();
}

void BranchMethod::NoteReactions(const PathPoint& point) {
  if (point.rn.size() == 0) return;
  largest_reaction_ = std::max({largest_reaction_, point.rn.maxCoeff(), point.rt.lpNorm<Eigen::Infinity>()});
}

Arrival BranchMethod::StartArrival() const {
  Arrival arrival;
  arrival.is_start = true;
  arrival.direction = Eigen::VectorXd::Unit(model_.structure.NumDofs() + 1, model_.structure.NumDofs());
  arrival.direction *= options_.direction;
  return arrival;
}

std::optional<EndReason> BranchMethod::PassEvent(const PathPoint& point, const Arrival& arrival,
                                                 const BranchChoice* choice, EventRecord* record,
                                                 std::string* message) {
  const ActiveSetTolerance limit = ActiveSetTolerance::For(largest_reaction_, point.s);
  const BranchSet on = FindBranches(
      model_.structure, model_.contacts, point, arrival, limit,
      [this](const PathPoint& at, const Eigen::VectorXd& along) { return StatesOfShortIncrements(at, along, &mpec_); },
      cancelled_);
  if (on.cancelled) {
    *message = "the caller asked for it";
    return EndReason::kCancelled;
  }
  record->weakly_active = on.weakly_active;
  record->complete = on.complete;
  for (const Branch& branch : on.branches)
    record->branches.push_back({branch.states, branch.load_rate, branch.dissipation_rate, branch.turn});
  if (on.branches.empty()) {
    *message = NoBranch(on);
    return EndReason::kPathEnd;
  }
  std::size_t taken = options_.keep_loading ? BestThatLoads(on.branches) : 0;
  if (choice != nullptr) {
    taken = static_cast<std::size_t>(std::max(choice->branch, 1) - 1);
    if (taken >= on.branches.size()) {
      *message = "branch_choices wants branch " + std::to_string(choice->branch) + " at " + PlaceOf(*choice) +
                 ": the number of branches there is " + std::to_string(on.branches.size());
      return EndReason::kNoSuchBranch;
    }
  }
  if (on.branches[taken].mechanism) {
    *message =
        "the structure has become a mechanism: it can move in several directions without any change of load and "
        "reactions";
    return EndReason::kPathEnd;
  }
  record->taken = static_cast<int>(taken) + 1;
  if (!on.branches[taken].rests)
    moved_.reset();
  else if (!moved_ && !arrival.is_start)
    moved_ = arrival.direction;
  begin_ = on.branches[taken].begin;
  if (!Leave(begin_ ? *begin_ : point, on.branches[taken])) {
    *message = "the branch from an event could not be followed";
    return EndReason::kNumericalFailure;
  }
  return std::nullopt;
}

std::size_t BranchMethod::BestThatLoads(const std::vector<Branch>& branches) const {
  const auto loads = [&](const Branch& branch) { return branch.load_rate * options_.direction > tolerances::kLevel; };
  if (branches.front().load_rate * options_.direction >= -tolerances::kLevel) return 0;
  const auto best = std::find_if(branches.begin(), branches.end(), loads);
  return best == branches.end() ? 0 : static_cast<std::size_t>(best - branches.begin());
}

std::optional<Step> BranchMethod::TryStep(double length, double prediction) {
  const Eigen::VectorXd normal = current_.first.head(arc_.NumMotion());
  const double tolerance = prediction * length;
  const Eigen::VectorXd straight = current_.x + length * current_.first;
  const Eigen::VectorXd bend = 0.5 * length * length * current_.second;
  const auto good = [&](const Correction& correction) {
    return correction.converged && correction.first_step <= tolerance + tolerances::kPredictor;
  };
  Correction correction = arc_.CorrectOnPlane(straight + bend, normal);
  // Next to a singular point the second derivatives are little but rounding.
  if (!good(correction) && bend.norm() > tolerance) correction = arc_.CorrectOnPlane(straight, normal);
  iterations_ = correction.iterations;
  contraction_ = correction.contraction;
  if (!good(correction)) return std::nullopt;
  CurvePoint end;
  if (!arc_.Derivatives(correction.x, normal, &end)) return std::nullopt;
  if (end.first.head(normal.size()).dot(normal) < options_.smallest_cosine) return std::nullopt;
  return MakeStep(current_, end, arc_.NumMotion());
}

int BranchMethod::StiffnessSign(const CurvePoint& point) const {
  // By Cramer's rule from the rate of the load factor; the parity is that of the rows and columns of the reactions.
  const double rate = point.first[arc_.NumMotion() - 1];
  if (rate == 0.0) return 0;
  const Eigen::Index reactions = arc_.system().NumUnknowns() - arc_.NumMotion();
  return (rate > 0.0 ? 1 : -1) * point.determinant_sign * (reactions % 2 == 0 ? 1 : -1);
}

Work BranchMethod::WorkOf(const Step& step) const {
  // Five points are exact for the products of a quintic and the derivative of another.
  const auto integrate = [&](const Quintic& force, const Quintic& position) {
    const Quintic rate = Derivative(position);
    double sum = 0.0;
    for (std::size_t i = 0; i < kGauss5.points.size(); ++i) {
      const double t = kGauss5.points[i] * step.length;
      sum += kGauss5.weights[i] * Evaluate(force, t) * Evaluate(rate, t);
    }
    return sum * step.length;
  };
  const FixedStateSystem& system = arc_.system();
  const Eigen::Index nd = system.NumDofs();
  Work work;
  for (const std::size_t i : system.Touching()) {
    const Constraint normal = {static_cast<int>(i), Inequality::kNormalReaction};
    const Constraint slip = {static_cast<int>(i), Inequality::kSlip};
    if (!Slips(system.states()[i])) continue;
    const auto interpolate = [&](const Constraint& of) {
      return step.Interpolate([&](const CurvePoint& at) { return system.ValueAlong(of, at.x, at.first, at.second); });
    };
    work.friction += std::max(0.0, model_.contacts[i]->Friction() * integrate(interpolate(normal), interpolate(slip)));
  }
  const auto load = [&](const Eigen::VectorXd& x) { return x[nd]; };
  const auto along = [&](const Eigen::VectorXd& x) { return model_.structure.ReferenceLoad().dot(x.head(nd)); };
  work.loads = integrate(step.InterpolateLinear(load), step.InterpolateLinear(along)) +
               model_.structure.ConstantLoad().dot((step.end.x - step.start.x).head(nd));
  const auto driving = [&](const CurvePoint& at) { return system.DrivingForceAlong(at.x, at.first, at.second); };
  work.loads += integrate(step.Interpolate(driving), step.InterpolateLinear(load));
  const double unit = model_.scaling.force * model_.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

std::vector<double> BranchMethod::CrossingPath(const Step& step) {
  // A little before the bifurcation, where the equations are regular.
  const CurvePoint near = step.At((1.0 - tolerances::kBeforeBifurcation) * step.length);
  const Eigen::VectorXd direction = arc_.CrossingDirection(near.x, near.first.head(arc_.NumMotion()));
  std::vector<double> components(model_.configuration.start.size(), 0.0);
  for (const DofMap::Component& of : model_.structure.Dofs().Components())
    if (of.field == Field::kPosition && of.dof >= 0)
      components[static_cast<std::size_t>(kPositionComponents * of.node + of.component)] = direction[of.dof];
  return components;
}

std::optional<EndReason> BranchMethod::Start(const PathPoint& from, EventRecord* branches, std::string* message) {
  NoteReactions(from);
  return PassEvent(from, StartArrival(), ChoiceForIncrement(increments_), branches, message);
}

bool BranchMethod::Resume(const PathPoint& before, const PathPoint& from, const SolveRecord& record) {
  NoteReactions(before);
  NoteReactions(from);
  arc_.SetStates(from.states, from);
  Eigen::VectorXd towards(arc_.NumMotion());
  towards << from.u - before.u, from.s - before.s;
  if (!(record.next_step > 0.0) || !arc_.Derivatives(arc_.system().Pack(from), towards, &current_)) return false;
  step_length_ = record.next_step;
  at_start_ = false;
  return true;
}

bool BranchMethod::TurnsLoad(const CurvePoint& arrival, double level) const {
  // By the second derivative where the first is zero.
  const Eigen::Index s = arc_.NumMotion() - 1;
  return Trend(arrival.first[s], -arrival.second[s], level) * Trend(current_.first[s], current_.second[s], level) < 0.0;
}

BranchRecord BranchMethod::RecordOf(const Eigen::VectorXd& first) const {
  const Eigen::Index s = arc_.NumMotion() - 1;
  const PathPoint point = arc_.system().Unpack(current_.x);
  BranchRecord record;
  record.states = arc_.system().states();
  record.load_rate = first[s];
  record.turn = std::acos(std::clamp(first.head(s + 1).dot(current_.first.head(s + 1)), -1.0, 1.0));
  for (std::size_t i = 0; i < record.states.size(); ++i)
    if (Slips(record.states[i]))
      record.dissipation_rate -=
          point.rt[static_cast<Eigen::Index>(i)] * model_.contacts[i]->SlipRate(point.u, point.s, first, first[s]);
  record.dissipation_rate = std::max(record.dissipation_rate, 0.0);  // but for rounding
  return record;
}

std::optional<EndReason> BranchMethod::PassBifurcation(const Eigen::VectorXd& before, const BranchChoice* choice,
                                                       EventRecord* record, std::string* message) {
  std::vector<Eigen::VectorXd> directions = {current_.first};
  const std::optional<Crossing> crossing = arc_.FindCrossing(before, current_.x, current_.first);
  const std::vector<Constraint> constraints = arc_.system().Inequalities();
  // Where a contact slides, not both directions need be admissible.
  const auto slips = [&](const Eigen::VectorXd& first) {
    return std::all_of(constraints.begin(), constraints.end(), [&](const Constraint& constraint) {
      return constraint.inequality != Inequality::kSlip ||
             arc_.system().Rate(constraint, current_.x, first) >= -tolerances::kLevel;
    });
  };
  if (crossing)
    for (const double sense : {1.0, -1.0})
      if (const Eigen::VectorXd first = sense * crossing->first; slips(first)) directions.push_back(first);
  for (const Eigen::VectorXd& first : directions) record->branches.push_back(RecordOf(first));
  record->branches.front().turn = 0.0;  // but for rounding
  std::size_t taken = 0;
  if (choice != nullptr) {
    taken = static_cast<std::size_t>(std::max(choice->branch, 1) - 1);
    if (taken >= directions.size()) {
      *message = "branch_choices wants branch " + std::to_string(choice->branch) + " at " + PlaceOf(*choice) +
                 ": the number of branches there is " + std::to_string(directions.size());
      return EndReason::kNoSuchBranch;
    }
  }
  record->taken = static_cast<int>(taken) + 1;
  if (taken > 0) {
    current_.first = directions[taken];
    current_.second = crossing->second;
  }
  return std::nullopt;
}

Advance BranchMethod::ChangeReactions(const PathPoint& from) {
  AcceptedPoint increment;
  increment.point = *begin_;
  increment.point.states = arc_.system().states();
  begin_.reset();
  increment.residuals = model_.Check(from, increment.point);
  increment.solve.method = Method::kBranch;
  increment.solve.exact = true;
  increment.solve.variables = static_cast<int>(arc_.system().NumUnknowns());
  increment.solve.constraints = static_cast<int>(arc_.system().NumEquations());
  increment.solve.next_step = step_length_;
  Advance advance;
  if (ChoiceForIncrement(increments_ + 1) != nullptr) {
    advance.reason = EndReason::kNoSuchBranch;
    advance.message = "branch_choices wants a branch at increment " + std::to_string(increments_ + 1) +
                      ": only reactions change there, and the branches part in the increment before";
    return advance;
  }
  if (!(increment.residuals.Largest() <= tolerances::kAcceptedExact)) {
    advance.message = "the reactions with which a branch begins are not in equilibrium";
    return advance;
  }
  ++increments_;
  advance.ended = false;
  advance.increments.push_back(std::move(increment));
  return advance;
}

bool BranchMethod::HasChoicesAhead() const {
  return std::any_of(options_.choices.begin(), options_.choices.end(), [&](const BranchChoice& choice) {
    return choice.event > 0 ? choice.event > events_ : choice.increment > increments_;
  });
}

std::optional<int> BranchMethod::EndAtReturn(const PathPoint& from, Step* step) {
  if (options_.returns == nullptr || !(step->length > 0.0) || HasChoicesAhead()) return std::nullopt;
  const FixedStateSystem& system = arc_.system();
  const std::optional<ReturnDetector::Return> found = options_.returns->Find(from, system.Unpack(step->end.x));
  CurvePoint end;
  if (!found || !arc_.Derivatives(system.Pack(found->point), step->normal, &end)) return std::nullopt;
  *step = MakeStep(step->start, end, arc_.NumMotion());
  return found->increment;
}

Advance BranchMethod::Next(const PathPoint& from) {
  if (begin_) return ChangeReactions(from);
  Advance advance;
  const int factorisations_before = arc_.factorisations();
  int rejected = 0;
  std::optional<Step> step;
  StepEvent event;
  double length = step_length_, prediction = options_.prediction;
  for (;; ++rejected) {
    if (length < options_.smallest_step && after_singular_ && prediction == options_.prediction) {
      // The point at which another path crosses is as inexact as rounding of the forces, taken across both, may be.
      prediction = kPredictionAfterSingular;
      length = step_length_;
    }
    if (length < options_.smallest_step) {
      advance.reason = EndReason::kStepTooSmall;
      advance.message = "no increment could be accepted, however short: Newton's method does not stay on the branch";
      const std::string bar = CollapsedBar(model_.scene, model_.InSceneUnits(from).positions);
      if (!bar.empty()) advance.message += "; " + bar;
      return advance;
    }
    step = TryStep(length, prediction);
    if (!step) {
      length *= 0.5;
      continue;
    }
    event = FirstEvent(&arc_, *step, options_.target);
    // Locate what happens first; the exact point may show something earlier.
    bool located = event.kind == EventKind::kNone;
    for (int attempt = 0; attempt < kLocatingAttempts && !located; ++attempt) {
      const std::optional<CurvePoint> point = Locate(&arc_, *step, event, options_.target);
      if (!point) break;
      Step part = MakeStep(step->start, *point, arc_.NumMotion());
      if (!(part.length > tolerances::kNoMove)) {
        part.length = 0.0;
        step = part;
        located = true;
        break;
      }
      const StepEvent earlier = FirstEvent(&arc_, part, options_.target);
      const bool first = earlier.kind == EventKind::kNone || earlier.t >= part.length - tolerances::kNoMove;
      step = part;
      if (first)
        located = true;
      else
        event = earlier;
    }
    if (located) break;
    length *= 0.5;
  }

  const std::optional<int> returned = EndAtReturn(from, &*step);
  if (returned) event = StepEvent();

  AcceptedPoint increment;
  increment.point = arc_.system().Unpack(step->end.x);
  increment.residuals = model_.Check(from, increment.point);
  increment.solve.method = Method::kBranch;
  increment.solve.exact = true;
  increment.solve.variables = static_cast<int>(arc_.system().NumUnknowns());
  increment.solve.constraints = static_cast<int>(arc_.system().NumEquations());
  increment.solve.rejected = rejected;
  increment.solve.nullity = static_cast<int>(step->end.nullity);
  increment.solve.determinant_sign = step->end.determinant_sign;
  increment.solve.stiffness_sign = StiffnessSign(step->end);
  increment.solve.iterations = iterations_;
  increment.solve.contraction = contraction_;
  if (!(increment.residuals.Largest() <= tolerances::kAcceptedExact)) {
    advance.message = "the residuals of the next point are too large";
    return advance;
  }
  NoteReactions(increment.point);
  const bool moved = step->length > 0.0;
  if (moved) {
    increment.arc_length = step->ArcLength();
    increment.work = WorkOf(*step);
    events_in_place_ = 0;
    at_start_ = false;
  } else if (++events_in_place_ > kMostEventsInPlace) {
    advance.message = "contacts change their states again and again in one place";
    return advance;
  }
  const CurvePoint end = step->end;
  current_ = end;
  advance.ended = false;
  ++increments_;

  if (returned) {
    advance.ended = true;
    advance.reason = EndReason::kClosedPath;
    advance.message = ClosedPathText(*returned);
  }
  const BranchChoice* forced = ChoiceForIncrement(increments_);
  if (event.kind == EventKind::kBifurcation) {
    increment.kind = IncrementKind::kBifurcation;
    increment.event.null_vector = CrossingPath(*step);
    increment.event.number = ++events_;
    const BranchChoice* choice = forced != nullptr ? forced : ChoiceForEvent(events_);
    if (const std::optional<EndReason> reason =
            PassBifurcation(step->start.x, choice, &increment.event, &advance.message)) {
      advance.ended = true;
      advance.reason = *reason;
    } else if (increment.event.taken > 1 && TurnsLoad(end, tolerances::kLevelSingular)) {
      increment.kind = IncrementKind::kCornerLimit;
      increment.event.null_vector.clear();
    }
  } else if (event.kind == EventKind::kContactEvent || forced != nullptr) {
    Arrival arrival;
    arrival.direction = end.first.head(arc_.NumMotion());
    arrival.singular = event.singular;
    arrival.before = moved_;
    if (at_start_) arrival = StartArrival();
    arrival.load_sense = options_.direction;
    if (event.kind == EventKind::kContactEvent) increment.event.number = ++events_;
    const BranchChoice* choice = forced != nullptr ? forced : ChoiceForEvent(events_);
    if (const std::optional<EndReason> reason =
            PassEvent(increment.point, arrival, choice, &increment.event, &advance.message)) {
      advance.ended = true;
      advance.reason = *reason;
      increment.kind = IncrementKind::kContactEvent;
    } else {
      const bool turns = TurnsLoad(end, event.singular ? tolerances::kLevelSingular : tolerances::kLevel);
      increment.kind = turns ? IncrementKind::kCornerLimit : IncrementKind::kContactEvent;
    }
  } else if (event.kind == EventKind::kLimitPoint) {
    increment.kind = IncrementKind::kSmoothLimit;
    if (event.singular) increment.event.null_vector = CrossingPath(*step);
  }
  // The next step: as long as wanted unless this one had to be shortened.
  step_length_ = std::min(options_.step, rejected > 0 ? 1.5 * length : 2.0 * step_length_);
  after_singular_ = event.singular;
  if (after_singular_) step_length_ *= kAfterSingular;
  increment.solve.next_step = step_length_;
  increment.solve.factorisations = arc_.factorisations() - factorisations_before;
  advance.increments.push_back(std::move(increment));
  return advance;
}

}  // namespace contact_path
