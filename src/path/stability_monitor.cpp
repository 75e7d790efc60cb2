#include "contact_path/path/stability_monitor.h"

#include <cmath>
#include <limits>

#include "contact_path/linear/generic_vector.h"

namespace contact_path {
namespace {

// Free components up to which a verdict on each increment is a small part of the time of a path.
constexpr Eigen::Index kSmallSystem = 60;

// Where both count.
template <typename Value, typename VerdictOf>
const Value& Worse(const Value& a, const Value& b, VerdictOf verdict) {
  for (const Verdict worst : {Verdict::kUnstable, Verdict::kNotProved}) {
    if (verdict(a) == worst) return a;
    if (verdict(b) == worst) return b;
  }
  return a;
}

}  // namespace

void StabilityMonitor::Count(const PathPoint& point, const Eigen::MatrixXd& null_directions) {
  problem_.Set(point, null_directions);
  arc_.dead = problem_.Under(INFINITY);
  arc_.controlled = problem_.Under(0.0);
  arc_.under_machine = machine_.IsDead() ? arc_.dead.verdict : problem_.Under(machine_.Compliance()).verdict;
}

Verdict StabilityMonitor::At(const PathPoint& point) {
  problem_.Set(point, {});
  return problem_.Under(machine_.IsDead() ? INFINITY : machine_.Compliance()).verdict;
}

void StabilityMonitor::Start(const PathPoint& point, const CurvePoint* ahead) {
  Count(point, {});
  known_ = true;
  Write(arc_, ahead);
}

void StabilityMonitor::Note(const PathPoint& point, const SmoothArc& arc, const CurvePoint& at, int stiffness_sign,
                            const Eigen::MatrixXd& null_directions) {
  const bool singular = null_directions.cols() > 0;
  const bool small = model_.structure.NumDofs() <= kSmallSystem;
  // Where supports or obstacles move besides, f . u does not tell the work along the path.
  const bool loads_alone = model_.structure.ReferenceLoad().isZero(0.0) ||
                           (model_.structure.PrescribedDofs().empty() && model_.scene.obstacle_motions.empty());
  const bool follows =
      known_ && !small && !singular && loads_alone && arc_.dead.directions >= 0 &&
      (problem_.HasSlips() || (stiffness_sign == (arc_.dead.directions % 2 == 0 ? 1 : -1) && !OneMoreFalls(arc, at)));
  if (follows)
    Follow(at);
  else
    Count(point, null_directions);
  known_ = !singular;
  Write(arc_, &at);
}

bool StabilityMonitor::OneMoreFalls(const SmoothArc& arc, const CurvePoint& at) {
  if (arc_.controlled.directions != 0) return false;
  const Eigen::Index nd = model_.structure.NumDofs();
  if (softest_.size() != nd) softest_ = GenericVector(nd).normalized();
  const Eigen::VectorXd x = arc.MotionUnder(softest_);
  if (x.size() == 0) return false;
  const Eigen::VectorXd& f = model_.structure.ReferenceLoad();
  const double along = f.dot(at.first.head(nd));
  const double share = along != 0.0 ? f.dot(x.head(nd)) / along : x[nd] / at.first[nd];
  const Eigen::VectorXd motion = x.head(nd) - share * at.first.head(nd);
  const double norm = motion.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return false;
  const double energy = motion.dot(softest_);  // motion . K motion, as the loads do no work
  softest_ = motion / norm;
  return energy < 0.0;
}

void StabilityMonitor::NoteEvent(const PathPoint& leaves, const CurvePoint& ahead, Decides decides) {
  const Verdicts arrives = arc_;
  Count(leaves, {});
  known_ = true;
  Verdicts at = decides == Decides::kArrival ? arrives : arc_;
  if (decides == Decides::kBoth) {
    const auto verdict_of = [](const Stability& of) { return of.verdict; };
    at.dead = Worse(arrives.dead, arc_.dead, verdict_of);
    at.controlled = Worse(arrives.controlled, arc_.controlled, verdict_of);
    at.under_machine = Worse(arrives.under_machine, arc_.under_machine, [](Verdict of) { return of; });
  }
  Write(at, &ahead);
}

void StabilityMonitor::Follow(const CurvePoint& at) {
  arc_.dead.direction.resize(0);  // of another increment
  if (problem_.HasSlips()) return;
  // du . K du = (ds/dt) (f . du/dt) along the path: where it is negative, a machine holds one of the directions.
  const Eigen::Index nd = model_.structure.NumDofs();
  const double along = model_.structure.ReferenceLoad().dot(at.first.head(nd));
  const int held = at.first[nd] * along < 0.0 ? 1 : 0;
  arc_.controlled.directions = arc_.dead.directions - held;
  arc_.controlled.verdict = arc_.controlled.directions > 0 ? Verdict::kUnstable : Verdict::kStable;
  const bool by_machine = held == 1 && !machine_.IsDead() && along / at.first[nd] + machine_.Compliance() < 0.0;
  arc_.under_machine = arc_.dead.directions > (by_machine ? 1 : 0) ? Verdict::kUnstable : Verdict::kStable;
  if (arc_.dead.directions > 0 && held == 1) arc_.dead.direction = at.first.head(nd).normalized();
}

double StabilityMonitor::CriticalStiffness(const Verdicts& of, const CurvePoint* at) const {
  const bool unstable = of.dead.verdict == Verdict::kUnstable;
  if (of.dead.verdict == Verdict::kStable) return 0.0;
  if (unstable && of.controlled.verdict == Verdict::kUnstable) return std::numeric_limits<double>::infinity();
  if (unstable && of.controlled.verdict == Verdict::kStable && of.dead.directions == 1 && at != nullptr) {
    if (at->is_limit) return 0.0;
    const Eigen::Index nd = model_.structure.NumDofs();
    const double stiffness = -at->first[nd] / model_.structure.ReferenceLoad().dot(at->first.head(nd));
    if (stiffness > 0.0) return stiffness;
  }
  return -1.0;  // not known
}

void StabilityMonitor::Write(const Verdicts& of, const CurvePoint* at) {
  noted_ = of;
  record_.stability = of.dead.verdict;
  record_.stability_controlled = of.controlled.verdict;
  record_.unstable_directions = of.dead.directions;
  const double stiffness = CriticalStiffness(of, at);
  record_.critical_stiffness = stiffness > 0.0 ? stiffness * model_.SizeOfLoads().unit_of_stiffness : stiffness;
  record_.unstable_direction.clear();
  if (of.dead.verdict == Verdict::kUnstable && of.dead.direction.size() > 0)
    record_.unstable_direction = model_.ComponentsOf(of.dead.direction);
}

}  // namespace contact_path
