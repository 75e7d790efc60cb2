#include "contact_path/path/stability_monitor.h"

#include <cmath>
#include <limits>

namespace contact_path {
namespace {

// Unknowns up to which a verdict on each increment is a small part of the time of a path.
constexpr Eigen::Index kSmallSystem = 150;

}  // namespace

void StabilityMonitor::Count(const PathPoint& point, const std::optional<ActiveSetTolerance>& weakly_active,
                             const Eigen::VectorXd& null_direction) {
  problem_.Set(point, weakly_active, null_direction);
  dead_ = problem_.Under(INFINITY);
  controlled_ = problem_.Under(0.0);
  under_device_ = device_.IsDead() ? dead_.verdict : problem_.Under(device_.Compliance()).verdict;
  is_direction_here_ = true;
}

Verdict StabilityMonitor::At(const PathPoint& point) {
  problem_.Set(point, std::nullopt, {});
  return problem_.Under(device_.Compliance()).verdict;
}

void StabilityMonitor::Start(const PathPoint& point, const ActiveSetTolerance& weakly_active) {
  Count(point, weakly_active, {});
  known_ = false;
  Write(nullptr);
}

void StabilityMonitor::Note(const PathPoint& point, const CurvePoint& at, int stiffness_sign,
                            const Eigen::VectorXd& null_direction) {
  const bool singular = null_direction.size() > 0;
  const bool small = model_.structure.NumDofs() <= kSmallSystem;
  const bool follows = known_ && !singular && dead_.directions >= 0 &&
                       (problem_.HasSlips() ? !small : stiffness_sign == (dead_.directions % 2 == 0 ? 1 : -1));
  if (follows)
    Follow(at);
  else
    Count(point, std::nullopt, null_direction);
  known_ = !singular;
  Write(&at);
}

void StabilityMonitor::NoteEvent(const PathPoint& arrives, const PathPoint& leaves,
                                 const ActiveSetTolerance& weakly_active, const CurvePoint& ahead) {
  Count(arrives, weakly_active, {});
  // On a kink of a surface the stiffness of each side is for disturbances to this side.
  if (arrives.patches != leaves.patches && dead_.verdict != Verdict::kUnstable) {
    const Stability dead = dead_, controlled = controlled_;
    const Verdict under_device = under_device_;
    PathPoint other = arrives;
    other.patches = leaves.patches;
    Count(other, weakly_active, {});
    if (dead_.verdict == Verdict::kStable) dead_ = dead;
    if (controlled_.verdict == Verdict::kStable) controlled_ = controlled;
    if (under_device_ == Verdict::kStable) under_device_ = under_device;
  }
  known_ = false;
  Write(&ahead);
}

void StabilityMonitor::Follow(const CurvePoint& at) {
  is_direction_here_ = false;
  if (problem_.HasSlips()) return;
  // du . K du = (ds/dt) (f . du/dt) along the path: where it is negative, a machine holds one of the directions.
  const Eigen::Index nd = model_.structure.NumDofs();
  const double energy = at.first[nd] * model_.structure.ReferenceLoad().dot(at.first.head(nd));
  const int held = energy < 0.0 ? 1 : 0;
  controlled_.directions = dead_.directions - held;
  controlled_.verdict = controlled_.directions > 0 ? Verdict::kUnstable : Verdict::kStable;
  if (device_.IsDead()) {
    under_device_ = dead_.verdict;
  } else {
    const double machine = model_.structure.ReferenceLoad().dot(at.first.head(nd)) / at.first[nd] + device_.Compliance();
    under_device_ = dead_.directions - (held == 1 && machine < 0.0 ? 1 : 0) > 0 ? Verdict::kUnstable : Verdict::kStable;
  }
  is_direction_here_ = held == 1;
  if (dead_.directions > 0 && held == 1) dead_.direction = at.first.head(nd).normalized();
}

double StabilityMonitor::CriticalStiffness(const CurvePoint* at) const {
  constexpr double kNone = std::numeric_limits<double>::infinity(), kNotKnown = -1.0;
  if (dead_.verdict == Verdict::kStable) return 0.0;
  if (dead_.verdict != Verdict::kUnstable) return kNotKnown;
  if (controlled_.verdict == Verdict::kUnstable) return kNone;
  if (controlled_.verdict != Verdict::kStable || dead_.directions != 1 || at == nullptr) return kNotKnown;
  const Eigen::Index nd = model_.structure.NumDofs();
  const double stiffness = -at->first[nd] / model_.structure.ReferenceLoad().dot(at->first.head(nd));
  return stiffness >= 0.0 ? std::abs(stiffness) : kNotKnown;  // none is -0
}

void StabilityMonitor::Write(const CurvePoint* at) {
  record_.stability = dead_.verdict;
  record_.stability_controlled = controlled_.verdict;
  record_.unstable_directions = dead_.directions;
  const double stiffness = CriticalStiffness(at);
  record_.critical_stiffness = stiffness > 0.0 ? stiffness * model_.UnitOfMachineStiffness() : stiffness;
  record_.unstable_direction.clear();
  if (dead_.verdict == Verdict::kUnstable && dead_.direction.size() > 0 && is_direction_here_)
    record_.unstable_direction = model_.ComponentsOf(dead_.direction);
}

}  // namespace contact_path
