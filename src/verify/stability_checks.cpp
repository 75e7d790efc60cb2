#include <algorithm>
#include <cmath>

#include "verify/checks.h"

namespace contact_path {

StabilityChecks::StabilityChecks(const VerifiedStage& stage, Findings* findings, Verification* result)
    : stage_(stage), findings_(*findings), result_(*result), differences_(stage) {}

void StabilityChecks::Check(const Increment& increment, double machine_stiffness) {
  const StabilityRecord& recorded = increment.stability;
  if (recorded.stability == Verdict::kNotAsked || recorded.stability == Verdict::kNotProved) return;
  ++result_.open_verdicts;
  const bool inside = increment.kind == IncrementKind::kRegular && increment.event.branches.empty();
  if (!inside || increment.positions.empty()) return;
  const std::optional<DisturbedIncrement> found = differences_.At(increment);
  if (!found) return;
  const FreeMotions dead(found->disturbed);
  const std::optional<Verdict> verdict = VerdictOf(found->disturbed, dead);
  if (!verdict) return;
  ++result_.proved_verdicts;
  --result_.open_verdicts;
  if (recorded.stability != *verdict)
    findings_.Report("is recorded as ", ToString(recorded.stability), ", but is ", ToString(*verdict));
  // Of what slides, some may let go.
  const bool slides = !found->disturbed.sliding.empty();
  const int directions = slides && *verdict != Verdict::kStable ? recorded.unstable_directions : dead.Falling();
  if (recorded.unstable_directions != directions)
    findings_.Report("unstable directions are recorded as ", recorded.unstable_directions, ", but are ", directions);
  if (!slides) CheckDirection(increment, *found, dead);
  CheckMachine(increment, *found, dead, machine_stiffness);
}

void StabilityChecks::CheckDirection(const Increment& increment, const DisturbedIncrement& found,
                                     const FreeMotions& dead) {
  const std::vector<double>& recorded = increment.stability.unstable_direction;
  // Rotations are not recorded: they follow.
  if (recorded.size() != increment.positions.size() || !increment.rotations.empty()) return;
  Eigen::VectorXd direction(found.load.size());
  for (Eigen::Index i = 0; i < direction.size(); ++i)
    direction[i] = recorded[found.components[static_cast<std::size_t>(i)]] / found.units[i];
  direction = dead.Of(direction);
  if (!(direction.dot(dead.Stiffness() * direction) < kSingular * dead.Largest() * direction.squaredNorm()))
    findings_.Report("the strain energy less the work of the loads does not fall along the unstable direction");
}

void StabilityChecks::CheckMachine(const Increment& increment, const DisturbedIncrement& found, const FreeMotions& dead,
                                   double machine_stiffness) {
  const StabilityRecord& recorded = increment.stability;
  const double size = found.load.norm();
  // Loads on what is held alone move nothing.
  if (stage_.Driven() || !(dead.Of(found.load).norm() > kSingular * size)) return;
  // The load factor is the reaction of a machine, which gives way; none for a prescribed displacement of the loads.
  const double unit = std::pow(stage_.driving.size, 2);
  Disturbed under = found.disturbed;
  const Eigen::Index last = under.give.size();
  under.held.conservativeResize(Eigen::NoChange, last + 1);
  under.held.col(last) = found.load / size;
  under.give.conservativeResize(last + 1);
  under.give[last] = machine_stiffness > 0.0 ? unit / machine_stiffness / (stage_.Energy() * size * size) : 0.0;
  const FreeMotions controlled(under);
  const std::optional<Verdict> held = VerdictOf(under, controlled);
  if (!held) return;
  if (recorded.stability_controlled != Verdict::kNotProved && recorded.stability_controlled != *held)
    findings_.Report("under the machine it is recorded as ", ToString(recorded.stability_controlled), ", but is ",
                     ToString(*held));
  if (!under.sliding.empty() || dead.Falling() != 1 || !(recorded.critical_stiffness > 0.0) ||
      std::isinf(recorded.critical_stiffness))
    return;
  const double by_force = dead.Compliance(found.load), critical = -1.0 / by_force;
  const Eigen::VectorXd by_load = dead.Stiffness().fullPivLu().solve(dead.Of(found.load));
  // Residuals of kExact leave the place open by their share of the softest direction, and the stiffness follows the
  // place.
  const double open =
      (dead.Off() + kExact + kExact / dead.Smallest()) * dead.Largest() * by_load.squaredNorm() * critical * critical;
  const double scale = unit / stage_.Energy();
  if (!(std::abs(recorded.critical_stiffness - critical * scale) <= open * scale))
    findings_.Report("the critical stiffness is recorded as ", recorded.critical_stiffness, ", but is ",
                     critical * scale);
}

}  // namespace contact_path
