#include "contact_path/path/stability_monitor.h"

#include <cmath>
#include <limits>

namespace contact_path {
namespace {

// Where both count.
const Stability& Worse(const Stability& a, const Stability& b) {
  for (const Verdict worst : {Verdict::kUnstable, Verdict::kNotProved}) {
    if (a.verdict == worst) return a;
    if (b.verdict == worst) return b;
  }
  return a;
}

}  // namespace

void StabilityMonitor::Count(const PathPoint& point, const Eigen::MatrixXd& null_directions, const PathPoint* next) {
  problem_.Set(point, null_directions, next);
  arc_.dead = problem_.Under(INFINITY);
  arc_.controlled = problem_.Under(0.0);
  arc_.under_machine = machine_.IsDead() ? arc_.dead : problem_.Under(machine_.Compliance());
}

Stability StabilityMonitor::At(const PathPoint& point) {
  problem_.Set(point, {});
  return problem_.Under(machine_.Compliance());
}

void StabilityMonitor::Start(const PathPoint& point, const CurvePoint* ahead, const PathPoint* next) {
  Count(point, {}, next);
  known_ = true;
  Write(arc_, point.u, ahead);
}

void StabilityMonitor::Note(const PathPoint& point, const CurvePoint& at, const Eigen::MatrixXd& null_directions,
                            std::optional<Eigen::Index> falls) {
  // Where supports or obstacles move besides, or friction changes, f . u does not tell the work along the path.
  const bool loads_alone = model_.structure.Loads().Reference().isZero(0.0) ||
                           (model_.structure.PrescribedDofs().empty() && !IsDriven(model_.scene));
  if (falls && known_ && loads_alone && null_directions.cols() == 0 && problem_.IsSymmetric(point.modes) &&
      !problem_.TouchesWithoutForce(point))
    Follow(at, static_cast<int>(*falls));
  else
    Count(point, null_directions);
  known_ = null_directions.cols() == 0;
  Write(arc_, point.u, &at);
}

void StabilityMonitor::NoteEvent(const PathPoint& leaves, const CurvePoint& ahead, const PathPoint& next,
                                 Decides decides) {
  const Verdicts arrives = arc_;
  Count(leaves, {}, &next);
  known_ = true;
  Verdicts at = decides == Decides::kArrival ? arrives : arc_;
  if (decides == Decides::kBoth) {
    at.dead = Worse(arrives.dead, arc_.dead);
    at.controlled = Worse(arrives.controlled, arc_.controlled);
    at.under_machine = Worse(arrives.under_machine, arc_.under_machine);
  }
  Write(at, leaves.u, &ahead);
}

void StabilityMonitor::Follow(const CurvePoint& at, int falls) {
  const auto verdict = [](int directions) {
    return Stability{directions > 0 ? Verdict::kUnstable : Verdict::kStable, directions, {}};
  };
  // du . K du = (ds/dt) (f . du/dt) along the path: where it is negative, a machine holds one of the directions.
  const Eigen::Index nd = model_.structure.NumDofs();
  const double along = model_.structure.Loads().Reference().dot(at.first.head(nd));
  const bool held = falls > 0 && at.first[nd] * along < 0.0;
  arc_.dead = verdict(falls);
  if (held) arc_.dead.direction = at.first.head(nd).normalized();
  arc_.controlled = verdict(falls - (held ? 1 : 0));
  const bool by_machine = held && !machine_.IsDead() && along / at.first[nd] + machine_.Compliance() < 0.0;
  arc_.under_machine = by_machine ? arc_.controlled : arc_.dead;
}

double StabilityMonitor::CriticalStiffness(const Verdicts& of, const CurvePoint* at) const {
  const bool unstable = of.dead.verdict == Verdict::kUnstable;
  if (of.dead.verdict == Verdict::kStable) return 0.0;
  // Where contacts slide, a softer machine may hold what a rigid one does not.
  if (unstable && of.controlled.verdict == Verdict::kUnstable)
    return of.under_machine.verdict == Verdict::kStable ? -1.0 : std::numeric_limits<double>::infinity();
  if (unstable && of.controlled.verdict == Verdict::kStable && of.dead.directions == 1 && at != nullptr) {
    if (at->is_limit) return 0.0;
    const Eigen::Index nd = model_.structure.NumDofs();
    const double stiffness = -at->first[nd] / model_.structure.Loads().Reference().dot(at->first.head(nd));
    if (stiffness > 0.0) return stiffness;
  }
  return -1.0;  // not known
}

void StabilityMonitor::Write(const Verdicts& of, const Eigen::VectorXd& u, const CurvePoint* at) {
  noted_ = of;
  record_.stability = of.dead.verdict;
  record_.stability_controlled = (machine_.IsDead() ? of.controlled : of.under_machine).verdict;
  record_.unstable_directions = of.dead.directions;
  const double stiffness = CriticalStiffness(of, at);
  record_.critical_stiffness = stiffness > 0.0 ? stiffness * model_.SizeOfLoads().unit_of_stiffness : stiffness;
  record_.unstable_direction.clear();
  if (of.dead.verdict == Verdict::kUnstable && of.dead.direction.size() > 0)
    record_.unstable_direction = model_.ComponentsOf(u, of.dead.direction);
}

}  // namespace contact_path
