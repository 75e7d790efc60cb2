#include "contact_path/path/machine_limit.h"

#include <utility>

#include "contact_path/path/sentences.h"
#include "contact_path/stability/jump.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// The unstable direction in the sense that goes on as the path does.
Eigen::VectorXd Towards(const Eigen::VectorXd& along, const Eigen::VectorXd& direction) {
  return direction.dot(along) < 0.0 ? Eigen::VectorXd(-direction) : direction;
}

}  // namespace

MachineSetting::MachineSetting(const Model& model, double stiffness) {
  const Model::LoadSize loads = model.SizeOfLoads();
  if (!(stiffness > 0.0) || loads.norm == 0.0) return;
  machine_.stiffness = stiffness / loads.unit_of_stiffness;
  unit_ = loads.unit_of_displacement;
  row_ = machine_.Row(model.structure);
  row_ *= model.structure.Loads().Reference().norm() / (loads.norm * row_.head(model.structure.NumDofs()).norm());
}

PathParameter MachineSetting::Parameter(double sense) const {
  return row_.size() == 0 ? PathParameter(sense) : PathParameter(row_, sense);
}

double MachineSetting::At(const Eigen::VectorXd& u, double s) const {
  if (row_.size() == 0) return 0.0;
  return unit_ * (row_.head(u.size()).dot(u) + row_[u.size()] * s) - origin_;
}

MachineLimit::MachineLimit(const Model& model, const BranchOptions& options, std::function<bool()> cancelled)
    : model_(model),
      cancelled_(std::move(cancelled)),
      at_limit_(options.at_limit),
      landing_checks_(options.landing_checks),
      setting_(model, options.machine_stiffness),
      parameter_(setting_.Parameter(options.direction)),
      monitor_(options.stability ? std::make_unique<StabilityMonitor>(model, machine()) : nullptr) {}

void MachineLimit::NoteStart(const PathPoint& point, const ActiveSetTolerance& tolerance, std::optional<End>* end) {
  if (!IsUnstable() || (*end && (*end)->reason != EndReason::kPathEnd) || IsFollowed()) return;
  if (at_limit_ == AtLimit::kStop) {
    *end = End{EndReason::kAtLimit, {{sentences::kAtLimit}}};
    return;
  }
  const Eigen::VectorXd along = parameter_.Gradient(point.u.size() + 1).head(point.u.size());
  leaving_ =
      Leaving{Push(point, along, tolerance), *end ? Why::kTurns : Why::kUnstable, std::exchange(*end, std::nullopt)};
}

bool MachineLimit::Note(const Place& place, StabilityRecord* record, std::optional<End>* end) {
  if (IsFollowed()) return false;
  const bool none = *end && (*end)->reason == EndReason::kPathEnd;
  if (*end && !none) return false;
  const Eigen::Index nd = place.point.u.size(), flat = place.null_directions.cols();
  const bool turns = !none && parameter_.Sense(place.leaves.first, place.leaves.second, nd + 1, tolerances::kRate) < 0;
  const bool unstable = IsUnstable();
  // Where curves cross, directions without stiffness decide to a higher order: right behind, the machine tells.
  const bool decides_behind =
      place.crossing && !none && !turns && unstable && flat > 0 && monitor_->UnderMachine().directions <= flat;
  if (place.stable_ahead || (decides_behind && at_limit_ == AtLimit::kJump)) {
    Verdict& verdict = machine().IsDead() ? record->stability : record->stability_controlled;
    verdict = Verdict::kNotProved;
    if (machine().IsDead()) record->unstable_directions = -1;
    record->critical_stiffness = -1.0;
    return !place.stable_ahead;
  }
  if (at_limit_ == AtLimit::kStop) {
    // A structure that slides at a constant load, or that artificial stiffness alone holds, carries no more.
    const bool rests = !none && monitor_ && monitor_->UnderMachine().verdict == Verdict::kNotProved &&
                       (monitor_->UnderMachine().artificial ||
                        parameter_.Sense(place.leaves.first, place.leaves.second, nd + 1, tolerances::kRate) == 0);
    if (turns || rests || (unstable && !none)) *end = End{EndReason::kAtLimit, {{sentences::kAtLimit}}};
    return false;
  }
  if (!none && !turns && !unstable) {
    came_back_ = false;
    return false;
  }
  const bool at_event = none || place.contact_event;
  Eigen::VectorXd along = (none ? place.arrives : place.leaves).first.head(nd);
  const bool moves = along.norm() > tolerances::kRate;
  if (!moves) along = place.arrives.first.head(nd);
  if (flat > 0 && !turns)
    along = Towards(along, place.null_directions.col(0));
  else if (flat == 0 && !(turns && moves && !at_event))
    along = Push(place.point, along, place.tolerance);
  const Why why = !none && !turns ? Why::kUnstable : at_event ? Why::kAtEvent : Why::kTurns;
  leaving_ = Leaving{std::move(along), why, std::exchange(*end, std::nullopt)};
  return false;
}

Eigen::VectorXd MachineLimit::Push(const PathPoint& point, const Eigen::VectorXd& along,
                                   const ActiveSetTolerance& tolerance) const {
  PathPoint released = point;
  for (std::size_t i = 0; i < released.modes.size(); ++i) {
    const Law& law = model_.laws[i];
    const Modes modes = model_.laws.ModesAt(point, i, tolerance);
    int& state = released.modes[i].state;
    if (law.In(state).idle) continue;
    const auto idle = std::find_if(modes.begin(), modes.end(), [&](const Mode& mode) { return law.In(mode).idle; });
    const auto slides = std::find_if(modes.begin(), modes.end(), [&](const Mode& mode) { return law.In(mode).slides; });
    if (idle != modes.end())
      state = idle->state;
    else if (!law.In(state).slides && !law.Holonomic() && slides != modes.end())
      state = slides->state;
  }
  StabilityProblem problem(model_.structure, model_.laws);
  problem.Set(released, {});
  const Stability found = problem.Under(machine().Compliance());
  if (found.verdict != Verdict::kUnstable || found.direction.size() == 0) return along;
  return Towards(along, found.direction);
}

MachineLimit::Outcome MachineLimit::TakeJump(const PathPoint& from, int number) {
  using Kind = Outcome::Kind;
  Leaving leaving = *std::exchange(leaving_, std::nullopt);
  JumpResult jump = Jump(model_.structure, model_.laws, from, leaving.push, machine(), landing_checks_, cancelled_);
  if (jump.cancelled) return {Kind::kEnds, {}, End{EndReason::kCancelled, {{sentences::kCancelled}}}};
  if (jump.came_back) {
    const bool again = std::exchange(came_back_, true);
    if (!leaving.end) leaving.end = End{EndReason::kNoLanding, {{sentences::kNoJump, {}, number}}};
    if (again || leaving.why == Why::kTurns) return {Kind::kEnds, {}, std::move(leaving.end)};
    return {leaving.why == Why::kAtEvent ? Kind::kSetsOutAnew : Kind::kGoesOn, {}, std::move(leaving.end)};
  }
  if (!jump.landing)
    return {Kind::kEnds,
            {},
            End{EndReason::kNoLanding, {{sentences::kNoLanding, {}, number, jump.followed * model_.scaling.length}}}};
  came_back_ = false;
  AcceptedPoint landing;
  landing.kind = IncrementKind::kJump;
  landing.point = std::move(jump.landing->point);
  landing.arc_length = Distance(from, landing.point);
  const double unit = model_.scaling.force * model_.scaling.length;
  landing.work = {unit * jump.landing->dissipated, unit * jump.landing->loads};
  landing.jump = {unit * jump.landing->energy_released(), jump.robust};
  // Coulomb's law holds on the way, and not between its ends.
  landing.residuals = model_.Check(landing.point, landing.point);
  landing.solve.method = Method::kBranch;
  landing.solve.exact = true;
  if (!(landing.residuals.Largest() <= tolerances::kAccepted))
    return {Kind::kEnds, {}, End{EndReason::kNumericalFailure, {{sentences::kResiduals}}}};
  return {Kind::kLands, std::move(landing)};
}

void MachineLimit::NoteLanding(const PathPoint& from, const PathPoint& landing, const ActiveSetTolerance& tolerance,
                               std::optional<End>* end) {
  if (*end ? (*end)->reason != EndReason::kPathEnd : !IsUnstable()) return;
  leaving_ = Leaving{Push(landing, landing.u - from.u, tolerance), Why::kTurns, std::exchange(*end, std::nullopt)};
}

}  // namespace contact_path
