#include "contact_path/path/onset.h"

#include <algorithm>

#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kBisections = 4;  // after which a crossing is looked for anew

}  // namespace

std::optional<PathPoint> PointApart(const Model& model, const ModeArc& of, const Step& step, double t) {
  ModeArc arc(model.structure, model.laws);
  arc.SetModes(of.system().Unpack(step.start.x), of.Rests());
  const Correction found = arc.CorrectOnPlane(step.Point(t), step.normal);
  return found.converged ? std::optional(arc.system().Unpack(found.x)) : std::nullopt;
}

std::optional<CurvePoint> OnsetFinder::OnsetOn(const Step& step, double after, int falls,
                                               std::optional<Crossing>* crossing) {
  double before = 0.0;
  int held = 0;  // directions at `before`
  std::optional<CurvePoint> place;
  for (int i = 0;; ++i) {
    // Parts that buckle at one place: curves cross there.
    bool broken = false;
    if (i % kBisections == 0 && held >= 0 && falls > held && !limit_->monitor()->HasSlips())
      if (const auto found = CrossingOn(arc_, step, before, after, falls - held, &broken)) {
        place = PointOf(found->at, *arc_);
        place->BeSingular();
        *crossing = found->at;
        return place;
      }
    const double t = 0.5 * (before + after);
    if (!(t > before && t < after && after - before > tolerances::kLastDigits * step.length)) return place;
    const Correction there = arc_->CorrectOnPlane(step.Point(t), step.normal);
    if (!there.converged) return std::nullopt;
    // Where parts buckle the equations give no derivatives; the interpolation of the step does.
    CurvePoint middle = step.At(t);
    middle.x = there.x;
    if (limit_->monitor()->HasSlips() && !arc_->Derivatives(there.x, step.normal, &middle)) return std::nullopt;
    const Stability found = limit_->monitor()->At(arc_->system().Unpack(there.x));
    const bool gone = found.verdict == Verdict::kUnstable;
    (gone ? falls : held) = found.directions;
    if (gone) place = middle;
    (gone ? after : before) = t;
  }
}

Eigen::MatrixXd OnsetFinder::NullDirections(const ArcStep& at) const {
  const Eigen::Index nd = arc_->LoadFactor();
  if (!at.event.crossing)
    return at.step.end.is_limit ? Eigen::MatrixXd(at.step.end.first.head(nd).normalized()) : Eigen::MatrixXd();
  const Crossing& crossing = *at.event.crossing;
  // The last curve of several is that of all parts together.
  const std::size_t parts = std::max<std::size_t>(1, crossing.across.size() - 1);
  const Eigen::VectorXd& along = crossing.along.first;
  Eigen::MatrixXd directions(nd, static_cast<Eigen::Index>(parts));
  for (std::size_t j = 0; j < parts; ++j) {
    const Eigen::VectorXd& across = crossing.across[j].first;
    directions.col(static_cast<Eigen::Index>(j)) =
        (across.head(nd) * along[nd] - along.head(nd) * across[nd]).normalized();
  }
  return directions;
}

void OnsetFinder::Note(const CurvePoint& end, const PathPoint& point, const Eigen::MatrixXd& null_directions) {
  if (limit_->monitor() != nullptr)
    limit_->monitor()->Note(point, end, null_directions, arc_->NegativeEigenvalues(end.x));
}

void OnsetFinder::NoteBehind(const ArcStep& at, const PathPoint& point, const CurvePoint& current) {
  PathPoint leaves = point;
  leaves.modes = arc_->system().modes();
  int changed = 0;
  for (std::size_t i = 0; i < leaves.modes.size(); ++i)
    changed += leaves.modes[i].state != point.modes[i].state ? 1 : 0;
  StabilityMonitor::Decides decides = StabilityMonitor::Decides::kBoth;
  if (changed == 1 && at.event.Kind() == EventKind::kContactEvent) {
    const auto i = static_cast<std::size_t>(at.event.fails->law);
    const LimitRule& rule = model_.laws[i].Rule(point.modes[i].state, at.event.fails->id);
    // What a motion ends at is held from then on, and what a force ends at lets go.
    if (!rule.OfPiece())
      decides = rule.OfForces() ? StabilityMonitor::Decides::kDeparture : StabilityMonitor::Decides::kArrival;
  }
  limit_->monitor()->NoteEvent(leaves, current, arc_->system().Unpack(Ahead(current)), decides);
}

std::optional<Onset> OnsetFinder::Find(const ArcStep& at, const PathPoint& end) {
  if (!(at.step.length > 0.0)) return std::nullopt;
  std::optional<CurvePoint> place;
  std::optional<Crossing> crossing;
  // Where curves cross, the tangent is known less well, and the setting may turn at that point.
  const double rounding = at.step.end.is_crossing ? tolerances::kSameTangent : 0.0;
  const Eigen::Index n = arc_->NumMotion();
  if (!limit_->machine().IsDead() && limit_->parameter().Sense(at.step.start.first, n) > 0 &&
      limit_->parameter().Sense(at.step.end.first, n, rounding) < 0) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(arc_->system().NumUnknowns());
    row.head(n) = limit_->parameter().Gradient(n);
    place = LocateTurn(arc_, at.step, row);
  }
  if (limit_->monitor() != nullptr) {
    const bool held = limit_->monitor()->HeldOnArc();
    Note(at.step.end, end, NullDirections(at));
    // What is singular at the end itself, or touches without force there, does not count on the way there, and right
    // before it rounding decides.
    double last = at.step.length;
    Stability after = limit_->monitor()->UnderMachine();
    const bool singular = at.step.end.is_limit || at.step.end.is_crossing;
    if (!place && held && (singular || at.event.fails)) {
      last *= 1.0 - (singular ? tolerances::kSmallShare : tolerances::kNextToStart);
      const std::optional<PathPoint> before = PointApart(model_, *arc_, at.step, last);
      after = before ? limit_->monitor()->At(*before) : Stability();
    }
    if (!place && held && after.verdict == Verdict::kUnstable)
      place = OnsetOn(at.step, last, after.directions, &crossing);
  }
  if (!place) return std::nullopt;
  // An event that coincides with something else is the one to act on.
  const double t = at.step.normal.dot((place->x - at.step.start.x).head(at.step.normal.size()));
  const double width = tolerances::kShort * at.step.length;
  if (t <= width || (at.event.Kind() == EventKind::kNone ? t >= at.step.length : t >= at.step.length - width))
    return std::nullopt;
  return Onset{*std::move(place), std::move(crossing)};
}

}  // namespace contact_path
