// Where the machine that loads the structure can go no further, and the equilibrium ceases to be stable.
#include "contact_path/path/branch_method.h"
#include "contact_path/tolerances.h"

namespace contact_path {

bool BranchMethod::LoadsOn() const { return SettingRate(current_.first) > 0.0; }

double BranchMethod::SettingRate(const Eigen::VectorXd& first) const {
  return options_.setting_sense * setting_row_.dot(first.head(setting_row_.size()));
}

bool BranchMethod::ShortenTo(const std::function<bool(const CurvePoint&)>& beyond, bool singular, BalancedStep* next) {
  Step& step = next->at.step;
  double before = 0.0, after = step.length;
  CurvePoint end = step.end, middle;
  while (after - before > tolerances::kLastDigits * step.length) {
    const double t = 0.5 * (before + after);
    if (!(t > before && t < after)) break;
    const Correction there = arc_.CorrectOnPlane(step.Point(t), step.normal);
    if (!there.converged) return false;
    if (singular) {
      // There the equations give no derivatives; the interpolation of the step does.
      middle = step.At(t);
      middle.x = there.x;
      middle.BeSingular();
      middle.is_limit = false;
      middle.is_crossing = true;
    } else if (!arc_.Derivatives(there.x, step.normal, &middle)) {
      return false;
    }
    if (beyond(middle)) {
      after = t;
      end = middle;
    } else {
      before = t;
    }
  }
  // An event that coincides with something else is the one to act on.
  const double width = tolerances::kShort * step.length;
  const bool at_event = next->at.event.kind != EventKind::kNone && step.length - after <= width;
  if (at_event || after <= width || !(after < step.length)) return false;
  step = MakeStep(step.start, end, arc_.NumMotion());
  next->at.event = StepEvent();
  Balance(next);
  return true;
}

void BranchMethod::NoteStability(const ArcStep& at, const AcceptedPoint& increment, bool inside) {
  const CurvePoint& end = at.step.end;
  const Eigen::Index nd = LoadFactor();
  Eigen::VectorXd null_direction;
  if (at.event.crossing) {
    const Eigen::VectorXd &along = at.event.crossing->along.first, &across = at.event.crossing->across.front().first;
    null_direction = (across.head(nd) * along[nd] - along.head(nd) * across[nd]).normalized();
  } else if (end.is_limit) {
    null_direction = end.first.head(nd).normalized();
  }
  if (inside) {
    stability_->Note(increment.point, arc_, end, StiffnessSign(end), null_direction);
    return;
  }
  PathPoint leaves = increment.point;
  leaves.states = arc_.system().states();
  leaves.patches = arc_.system().patches();
  int changed = 0;
  for (std::size_t i = 0; i < leaves.states.size(); ++i)
    changed += leaves.states[i] != increment.point.states[i] ? 1 : 0;
  StabilityMonitor::Decides decides = StabilityMonitor::Decides::kBoth;
  if (changed == 1 && at.event.kind == EventKind::kContactEvent && !KeepsPatch(at.event.constraint.inequality)) {
    const bool closes = at.event.constraint.inequality == Inequality::kGap || IsOfSlip(at.event.constraint.inequality);
    decides = closes ? StabilityMonitor::Decides::kArrival : StabilityMonitor::Decides::kDeparture;
  }
  stability_->NoteEvent(leaves, current_, decides);
}

bool BranchMethod::EndAtOnset(const PathPoint& from, BalancedStep* next, AcceptedPoint* increment) {
  const ArcStep& at = next->at;
  if (!(at.step.length > 0.0)) return false;
  bool found = false;
  // Where curves cross, the tangent is known less well, and the setting may turn at that point.
  const double rounding = at.step.end.is_crossing ? tolerances::kSameTangent * setting_row_.norm() : 0.0;
  if (!machine_.IsDead() && SettingRate(at.step.start.first) > 0.0 && SettingRate(at.step.end.first) < -rounding)
    found = ShortenTo([this](const CurvePoint& point) { return SettingRate(point.first) < 0.0; }, false, next);
  if (stability_) {
    const Verdict before = stability_->OnArc();
    NoteStability(at, *increment, true);
    const bool lost = before == Verdict::kStable && stability_->UnderMachine() == Verdict::kUnstable;
    if (!found && lost && !at.step.end.is_limit && !at.step.end.is_crossing)
      found = ShortenTo(
          [this](const CurvePoint& point) {
            return stability_->At(arc_.system().Unpack(point.x)) == Verdict::kUnstable;
          },
          !stability_->HasSlips(), next);
  }
  if (!found) return false;
  *increment = IncrementOf(next->at, from);
  increment->kind = IncrementKind::kOnset;
  if (stability_) NoteStability(next->at, *increment, true);
  return true;
}

void BranchMethod::NoteLimit(const ArcStep& at, const AcceptedPoint& increment, Advance* advance) const {
  if (!options_.ends_at_limit || !(SettingRate(at.step.start.first) > 0.0)) return;
  const Eigen::VectorXd along = current_.first.head(LoadFactor());
  const bool at_limit = machine_.IsDead() && increment.kind == IncrementKind::kSmoothLimit;
  advance->turns = at_limit || SettingRate(current_.first) < 0.0;
  if (advance->turns) {
    advance->moves_off = along;
    return;
  }
  // At a bifurcation of the curve on which the path arrives and goes on, not where it takes another one.
  const bool goes_on = increment.kind == IncrementKind::kRegular || increment.kind == IncrementKind::kOnset ||
                       (at.event.kind == EventKind::kBifurcation && increment.event.taken == 1);
  if (stability_ && goes_on && stability_->UnderMachine() == Verdict::kUnstable)
    advance->moves_off = stability_->Direction().size() > 0 ? stability_->Direction() : along;
}

}  // namespace contact_path
