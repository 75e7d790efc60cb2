#include "contact_path/path/branch_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "contact_path/path/automatic_step.h"
#include "contact_path/path/diagnosis.h"

namespace contact_path {
namespace {

constexpr double kAccepted = 1e-9;       // residuals of an accepted row
constexpr double kNoMove = 1e-12;        // an event nearer than this to the last one happens in place
constexpr double kRounding = 1e-12;      // of a Newton step
constexpr int kMostEventsInPlace = 8;    // then the contacts chatter, and no way on is trusted
constexpr double kLevel = 1e-9;          // of a unit rate: the load neither rises nor falls
constexpr double kLevelSingular = 1e-6;  // where the rate is not exact
constexpr double kSameTangent = 1e-6;    // difference of unit tangents
constexpr double kAfterSingular = 0.05;  // of the step: derivatives at a singular point are not exact to second order
constexpr int kLocatingAttempts = 6;
constexpr double kNearBifurcation = 1e-6;  // of a step

// The rate of a quantity; where it is zero, how it changes next to there; 0 where both are.
double Trend(double rate, double change, double level) {
  if (std::abs(rate) > level) return rate;
  return std::abs(change) > level ? change : 0.0;
}

std::string NoWayOn(const WaysOn& on) {
  if (on.rigid_modes > 0)
    return "no admissible way on, and the structure is a mechanism here: nothing resists " +
           std::to_string(on.rigid_modes) + (on.rigid_modes == 1 ? " motion" : " motions") + "; is it supported?";
  if (!on.complete) return "no admissible way on was found among the combinations of contact states tried";
  return "no admissible way on: the quasi-static path ends here, only a dynamic jump leads further";
}

}  // namespace

std::string PlaceOf(const BranchChoice& choice) {
  return choice.event > 0 ? "event " + std::to_string(choice.event) : "row " + std::to_string(choice.row);
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
      piece_(model.structure, model.contacts),
      step_(options.step),
      rows_(options.rows),
      events_(options.events) {}

const BranchChoice* BranchMethod::ChoiceForEvent(int event) const {
  for (const BranchChoice& choice : options_.choices)
    if (choice.event == event && event > 0) return &choice;
  return nullptr;
}

const BranchChoice* BranchMethod::ChoiceForRow(int row) const {
  for (const BranchChoice& choice : options_.choices)
    if (choice.event == 0 && choice.row == row) return &choice;
  return nullptr;
}

bool BranchMethod::Leave(const PathPoint& point, const Way& way) {
  piece_.SetStates(way.states, point);
  const bool regular = piece_.Derivatives(piece_.system().Pack(point), way.direction, &current_) &&
                       (current_.first - way.first).norm() <= kSameTangent;
  if (regular) return true;
  // Another path crosses here, or the structure has rigid modes: the way itself tells where to go.
  current_.x = piece_.system().Pack(point);
  current_.first = way.first;
  current_.second = way.second;
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
  const AtLimit limit = AtLimit::For(largest_reaction_, point.s);
  const WaysOn on = FindWays(model_.structure, model_.contacts, point, arrival, limit, &mpec_, cancelled_);
  if (on.cancelled) {
    *message = "the caller asked for it";
    return EndReason::kCancelled;
  }
  record->concerned = on.concerned;
  record->complete = on.complete;
  for (const Way& way : on.ways) record->ways.push_back({way.states, way.load_rate, way.dissipation_rate, way.turn});
  if (on.ways.empty()) {
    *message = NoWayOn(on);
    return EndReason::kPathEnd;
  }
  std::size_t taken = 0;
  if (choice != nullptr) {
    taken = static_cast<std::size_t>(std::max(choice->way, 1) - 1);
    if (taken >= on.ways.size()) {
      *message = "branch_choices wants way " + std::to_string(choice->way) + " at " + PlaceOf(*choice) +
                 ": the number of ways there is " + std::to_string(on.ways.size());
      return EndReason::kNumericalFailure;
    }
  }
  if (on.ways[taken].loose) {
    *message = "the structure has come loose: it can move in several ways without any change of load and reactions";
    return EndReason::kPathEnd;
  }
  record->taken = static_cast<int>(taken);
  begin_ = on.ways[taken].begin;
  if (!Leave(begin_ ? *begin_ : point, on.ways[taken])) {
    *message = "the way on from an event could not be followed";
    return EndReason::kNumericalFailure;
  }
  return std::nullopt;
}

std::optional<Segment> BranchMethod::Step(double length) {
  const Eigen::VectorXd normal = current_.first.head(piece_.NumMotion());
  const double tolerance = options_.prediction * length;
  const Eigen::VectorXd straight = current_.x + length * current_.first;
  const Eigen::VectorXd bend = 0.5 * length * length * current_.second;
  const auto good = [&](const Correction& correction) {
    return correction.converged && correction.first_step <= tolerance + kRounding;
  };
  Correction correction = piece_.CorrectOnPlane(straight + bend, normal);
  // Next to a singular point the second derivatives are little but rounding.
  if (!good(correction) && bend.norm() > tolerance) correction = piece_.CorrectOnPlane(straight, normal);
  iterations_ = correction.iterations;
  contraction_ = correction.contraction;
  if (!good(correction)) return std::nullopt;
  CurvePoint end;
  if (!piece_.Derivatives(correction.x, normal, &end)) return std::nullopt;
  if (end.first.head(normal.size()).dot(normal) < options_.smallest_cosine) return std::nullopt;
  return MakeSegment(current_, end, piece_.NumMotion());
}

int BranchMethod::StiffnessSign(const CurvePoint& point) const {
  // By Cramer's rule from the rate of the load factor; the parity is that of the rows and columns of the reactions.
  const double rate = point.first[piece_.NumMotion() - 1];
  if (rate == 0.0) return 0;
  const Eigen::Index reactions = piece_.system().NumUnknowns() - piece_.NumMotion();
  return (rate > 0.0 ? 1 : -1) * point.determinant_sign * (reactions % 2 == 0 ? 1 : -1);
}

Work BranchMethod::WorkOf(const Segment& segment) const {
  // Gauss-Legendre with five points is exact for the products of a quintic and the derivative of another.
  constexpr std::array<double, 5> kPoints = {0.046910077030668, 0.23076534494715845, 0.5, 0.76923465505284155,
                                             0.953089922969332};
  constexpr std::array<double, 5> kWeights = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                              0.23931433524968324, 0.11846344252809454};
  const auto integrate = [&](const Quintic& force, const Quintic& position) {
    const Quintic rate = Derivative(position);
    double sum = 0.0;
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
      const double t = kPoints[i] * segment.length;
      sum += kWeights[i] * Evaluate(force, t) * Evaluate(rate, t);
    }
    return sum * segment.length;
  };
  const FixedStateSystem& system = piece_.system();
  const Eigen::Index nd = system.NumDofs();
  Work work;
  for (const std::size_t i : system.Touching()) {
    const Limit normal = {static_cast<int>(i), Inequality::kNormalReaction};
    const Limit slip = {static_cast<int>(i), Inequality::kSlip};
    if (!Slips(system.states()[i])) continue;
    const auto interpolate = [&](const Limit& of) {
      return segment.Interpolate([&](const Eigen::VectorXd& x) { return system.Value(of, x); },
                                 [&](const Eigen::VectorXd& dx) { return system.Rate(of, dx); });
    };
    work.friction += std::max(0.0, model_.contacts[i].friction * integrate(interpolate(normal), interpolate(slip)));
  }
  const auto load = [&](const Eigen::VectorXd& x) { return x[nd]; };
  const auto along = [&](const Eigen::VectorXd& x) { return model_.structure.ReferenceLoad().dot(x.head(nd)); };
  work.loads = integrate(segment.Interpolate(load, load), segment.Interpolate(along, along)) +
               model_.structure.ConstantLoad().dot((segment.end.x - segment.start.x).head(nd));
  const auto driving = [&](const Eigen::VectorXd& x) { return system.DrivingForce(x); };
  work.loads += integrate(segment.Interpolate(driving, driving), segment.Interpolate(load, load));
  const double unit = model_.scaling.force * model_.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

std::vector<double> BranchMethod::CrossingPath(const Segment& segment) {
  // A little before the bifurcation, where the equations are regular.
  const CurvePoint near = segment.At((1.0 - kNearBifurcation) * segment.length);
  const Eigen::VectorXd direction = piece_.CrossingDirection(near.x, near.first.head(piece_.NumMotion()));
  std::vector<double> components(2 * model_.scene.nodes.size(), 0.0);
  for (std::size_t i = 0; i < components.size(); ++i)
    if (const int dof = model_.structure.Dof(static_cast<int>(i / 2), static_cast<int>(i % 2)); dof >= 0)
      components[i] = direction[dof];
  return components;
}

std::optional<EndReason> BranchMethod::Start(const PathPoint& from, EventRecord* ways, std::string* message) {
  NoteReactions(from);
  return PassEvent(from, StartArrival(), ChoiceForRow(rows_), ways, message);
}

bool BranchMethod::Resume(const PathPoint& before, const PathPoint& from, const SolveRecord& record) {
  NoteReactions(before);
  NoteReactions(from);
  piece_.SetStates(from.states, from);
  Eigen::VectorXd towards(piece_.NumMotion());
  towards << from.u - before.u, from.s - before.s;
  if (!(record.next_step > 0.0) || !piece_.Derivatives(piece_.system().Pack(from), towards, &current_)) return false;
  step_ = record.next_step;
  at_start_ = false;
  return true;
}

Advance BranchMethod::ChangeReactions(const PathPoint& from) {
  AcceptedPoint row;
  row.point = *begin_;
  row.point.states = piece_.system().states();
  begin_.reset();
  row.residuals = model_.Check(from, row.point);
  row.solve.method = Method::kBranch;
  row.solve.exact = true;
  row.solve.variables = static_cast<int>(piece_.system().NumUnknowns());
  row.solve.constraints = static_cast<int>(piece_.system().NumEquations());
  row.solve.next_step = step_;
  Advance advance;
  if (ChoiceForRow(rows_ + 1) != nullptr) {
    advance.message = "branch_choices wants a way at row " + std::to_string(rows_ + 1) +
                      ": only reactions change there, and the ways part in the row before";
    return advance;
  }
  if (!(row.residuals.Largest() <= kAccepted)) {
    advance.message = "the reactions with which a way on begins are not in equilibrium";
    return advance;
  }
  ++rows_;
  advance.ended = false;
  advance.rows.push_back(std::move(row));
  return advance;
}

Advance BranchMethod::Next(const PathPoint& from) {
  if (begin_) return ChangeReactions(from);
  Advance advance;
  const int factorisations_before = piece_.factorisations();
  int rejected = 0;
  std::optional<Segment> segment;
  Watched watched;
  double length = step_;
  for (;; ++rejected) {
    if (length < options_.smallest_step) {
      advance.reason = EndReason::kStepTooSmall;
      advance.message = "no increment could be accepted, however short: Newton's method does not stay on the branch";
      const std::string bar = CollapsedBar(model_.scene, model_.InSceneUnits(from).positions);
      if (!bar.empty()) advance.message += "; " + bar;
      return advance;
    }
    segment = Step(length);
    if (!segment) {
      length *= 0.5;
      continue;
    }
    watched = Watch(&piece_, *segment, options_.target);
    // Locate what happens first; the exact point may show something earlier.
    bool located = watched.happening == Happening::kNone;
    for (int attempt = 0; attempt < kLocatingAttempts && !located; ++attempt) {
      const std::optional<CurvePoint> point = Locate(&piece_, *segment, watched, options_.target);
      if (!point) break;
      Segment part = MakeSegment(segment->start, *point, piece_.NumMotion());
      if (!(part.length > kNoMove)) {
        part.length = 0.0;
        segment = part;
        located = true;
        break;
      }
      const Watched earlier = Watch(&piece_, part, options_.target);
      const bool first = earlier.happening == Happening::kNone || earlier.t >= part.length - kNoMove;
      segment = part;
      if (first)
        located = true;
      else
        watched = earlier;
    }
    if (located) break;
    length *= 0.5;
  }

  AcceptedPoint row;
  row.point = piece_.system().Unpack(segment->end.x);
  row.residuals = model_.Check(from, row.point);
  row.solve.method = Method::kBranch;
  row.solve.exact = true;
  row.solve.variables = static_cast<int>(piece_.system().NumUnknowns());
  row.solve.constraints = static_cast<int>(piece_.system().NumEquations());
  row.solve.rejected = rejected;
  row.solve.deficiency = static_cast<int>(segment->end.deficiency);
  row.solve.determinant_sign = segment->end.determinant_sign;
  row.solve.stiffness_sign = StiffnessSign(segment->end);
  row.solve.iterations = iterations_;
  row.solve.contraction = contraction_;
  if (!(row.residuals.Largest() <= kAccepted)) {
    advance.message = "the residuals of the next point are too large";
    return advance;
  }
  NoteReactions(row.point);
  const bool moved = segment->length > 0.0;
  if (moved) {
    row.arc_length = segment->ArcLength();
    row.work = WorkOf(*segment);
    events_in_place_ = 0;
    at_start_ = false;
  } else if (++events_in_place_ > kMostEventsInPlace) {
    advance.message = "contacts change their states again and again in one place";
    return advance;
  }
  const CurvePoint end = segment->end;
  const double load_rate = end.first[piece_.NumMotion() - 1];
  current_ = end;
  advance.ended = false;
  ++rows_;

  const BranchChoice* forced = ChoiceForRow(rows_);
  if (watched.happening == Happening::kEvent || forced != nullptr) {
    Arrival arrival;
    arrival.direction = end.first.head(piece_.NumMotion());
    arrival.singular = watched.singular;
    if (at_start_) arrival = StartArrival();
    if (watched.happening == Happening::kEvent) row.event.number = ++events_;
    const BranchChoice* choice = forced != nullptr ? forced : ChoiceForEvent(events_);
    if (const std::optional<EndReason> reason = PassEvent(row.point, arrival, choice, &row.event, &advance.message)) {
      advance.ended = true;
      advance.reason = *reason;
      row.kind = RowKind::kContactEvent;
    } else {
      const Eigen::Index s = piece_.NumMotion() - 1;
      // Which way the load was going and goes on: by the second derivative where the first is zero.
      const double leaving = current_.first[s];
      const double level = watched.singular ? kLevelSingular : kLevel;
      const double before = Trend(load_rate, -end.second[s], level), after = Trend(leaving, current_.second[s], level);
      row.kind = before * after < 0.0 ? RowKind::kCornerLimit : RowKind::kContactEvent;
    }
  } else if (watched.happening == Happening::kLimitPoint) {
    row.kind = RowKind::kSmoothLimit;
  } else if (watched.happening == Happening::kBifurcation) {
    row.kind = RowKind::kBifurcation;
    row.event.null_vector = CrossingPath(*segment);
  }
  // The next step: as long as wanted unless this one had to be shortened.
  step_ = std::min(options_.step, rejected > 0 ? 1.5 * length : 2.0 * step_);
  if (watched.singular) step_ *= kAfterSingular;
  row.solve.next_step = step_;
  row.solve.factorisations = piece_.factorisations() - factorisations_before;
  advance.rows.push_back(std::move(row));
  return advance;
}

}  // namespace contact_path
