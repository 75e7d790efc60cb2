// Where the machine that loads the structure can go no further on a stable path.
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/branch/bifurcation_branches.h"
#include "contact_path/path/branch_method.h"
#include "contact_path/path/sentences.h"
#include "contact_path/stability/jump.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kAhead = 0.1;  // of the wanted step: where a branch from a singular point shows whether it is stable

// The unstable direction in the sense that goes on as the path does.
Eigen::VectorXd Towards(const Eigen::VectorXd& along, const Eigen::VectorXd& direction) {
  return direction.dot(along) < 0.0 ? Eigen::VectorXd(-direction) : direction;
}

}  // namespace

std::optional<End> BranchMethod::SetOut(const PathPoint& from, StartRecord* found) {
  at_start_ = true;
  events_in_place_ = 0;
  stored_.reset();
  step_length_ = options_.step;
  departure_.Restart();
  std::optional<End> end = departure_.Leave(from, departure_.StartArrival(), options_.ChoiceAt(increments_, 0), &arc_,
                                            &current_, &found->branches);
  if (stability_) {
    PathPoint leaves = from;
    if (!end) leaves.states = arc_.system().states();
    if (!end) leaves.patches = arc_.system().patches();
    stability_->Start(leaves, end ? nullptr : &current_);
    found->stability = stability_->record();
  }
  return end;
}

std::size_t BranchMethod::StableBranch(const std::vector<Branch>& branches) {
  const Eigen::Index n = arc_.NumMotion();
  const double length = kAhead * options_.step;
  const auto leads_on = [&](const Branch& branch) {
    if (parameter_.Sense(branch.first, branch.second, n, tolerances::kRate) < 0) return false;
    const Eigen::VectorXd ahead = current_.x + length * branch.first + 0.5 * length * length * branch.second;
    const Correction there = arc_.CorrectOnPlane(ahead, branch.first.head(n));
    return there.converged && parameter_.Rate(there.x - current_.x, n) > 0.0 &&
           stability_->At(arc_.system().Unpack(there.x)).verdict == Verdict::kStable;
  };
  return static_cast<std::size_t>(std::find_if(branches.begin(), branches.end(), leads_on) - branches.begin());
}

void BranchMethod::NoteLimit(const ArcStep& at, const Facts& facts, AcceptedPoint* increment, Advance* advance) {
  if (options_.at_limit == AtLimit::kFollow) return;
  const bool none = advance->end && advance->end->reason == EndReason::kPathEnd;
  if (advance->end && !none) return;
  const Eigen::Index n = arc_.NumMotion();
  const bool turns = !none && parameter_.Sense(current_.first, current_.second, n, tolerances::kRate) < 0;
  const Stability under_machine = stability_ ? stability_->UnderMachine() : Stability();
  const bool unstable = under_machine.verdict == Verdict::kUnstable;
  const Eigen::MatrixXd null_directions = NullDirections(at);
  // Where curves cross, directions without stiffness decide to a higher order: right behind, the machine tells.
  const bool decides_behind = facts.bifurcation && !none && !turns && unstable && null_directions.cols() > 0 &&
                              under_machine.directions <= null_directions.cols();
  if (facts.stable_ahead || (decides_behind && options_.at_limit == AtLimit::kJump)) {
    Verdict& verdict = machine_.IsDead() ? increment->stability.stability : increment->stability.stability_controlled;
    if (machine_.IsDead() || std::isinf(machine_.stiffness)) verdict = Verdict::kNotProved;
    if (machine_.IsDead()) increment->stability.unstable_directions = -1;
    increment->stability.critical_stiffness = -1.0;
    if (!facts.stable_ahead) step_length_ = std::max(options_.smallest_step, tolerances::kNextToStart * step_length_);
    return;
  }
  if (options_.at_limit == AtLimit::kStop) {
    if (turns || (unstable && !none)) advance->end = End{EndReason::kAtLimit, {{sentences::kAtLimit}}};
    return;
  }
  if (!none && !turns && !unstable) {
    came_back_ = false;
    return;
  }
  const bool at_event = none || at.event.Kind() == EventKind::kContactEvent;
  Eigen::VectorXd along = (none ? at.step.end : current_).first.head(LoadFactor());
  const bool moves = along.norm() > tolerances::kRate;
  if (!moves) along = at.step.end.first.head(LoadFactor());
  if (null_directions.cols() > 0 && !turns)
    along = Towards(along, null_directions.col(0));
  else if (null_directions.cols() == 0 && !(turns && moves && !at_event))
    along = Push(increment->point, along);
  leaving_ = Leaving{std::move(along),
                     !none && !turns ? Limit::kUnstable
                     : at_event      ? Limit::kAtEvent
                                     : Limit::kTurns,
                     std::exchange(advance->end, std::nullopt)};
}

Eigen::VectorXd BranchMethod::Push(const PathPoint& point, const Eigen::VectorXd& along) const {
  const ActiveSetTolerance tolerance = departure_.ToleranceAt(point);
  PathPoint released = point;
  for (std::size_t i = 0; i < released.states.size(); ++i) {
    const ContactPair& pair = *model_.contacts[i];
    const auto k = static_cast<Eigen::Index>(i);
    ContactState& state = released.states[i];
    if (state == ContactState::kOpen) continue;
    const double cone = pair.Friction() * point.rn[k] - std::abs(point.rt[k]);
    if (point.rn[k] <= tolerance.force * pair.NormalForceUnit())
      state = ContactState::kOpen;
    else if (state == ContactState::kStick && !pair.HasTotalLaw() && cone <= tolerance.force * pair.ForceUnit())
      state = point.rt[k] < 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus;
  }
  StabilityProblem problem(model_.structure, model_.contacts);
  problem.Set(released, {});
  const Stability found = problem.Under(machine_.IsDead() ? INFINITY : machine_.Compliance());
  if (found.verdict != Verdict::kUnstable || found.direction.size() == 0) return along;
  return Towards(along, found.direction);
}

Advance BranchMethod::StartAnew(const PathPoint& from, End held) {
  StartRecord found;
  ++increments_;
  if (SetOut(from, &found)) return Ended(std::move(held));
  AcceptedPoint increment = IncrementAt(from, from);
  increment.kind = IncrementKind::kContactEvent;
  increment.event = std::move(found.branches);
  increment.event.number = ++events_;
  increment.stability = std::move(found.stability);
  Advance advance;
  advance.increments.push_back(std::move(increment));
  return advance;
}

Advance BranchMethod::TakeJump(const PathPoint& from, Leaving leaving) {
  JumpResult jump =
      Jump(model_.structure, model_.contacts, from, leaving.push, machine_, options_.landing_checks, cancelled_);
  if (jump.cancelled) return Ended({EndReason::kCancelled, {{sentences::kCancelled}}});
  if (jump.came_back) {
    End held = leaving.end ? *leaving.end : End{EndReason::kNoLanding, {{sentences::kNoJump, {}, increments_}}};
    if (std::exchange(came_back_, true) || leaving.limit == Limit::kTurns) return Ended(std::move(held));
    if (leaving.limit == Limit::kAtEvent) return StartAnew(from, std::move(held));
    // Where a disturbance sets out too slowly to be followed, it does so right behind.
    step_length_ = std::max(options_.smallest_step, tolerances::kNextToStart * options_.step);
    return {};
  }
  if (!jump.landing)
    return Ended(
        {EndReason::kNoLanding, {{sentences::kNoLanding, {}, increments_, jump.followed * model_.scaling.length}}});
  came_back_ = false;
  ++increments_;
  AcceptedPoint increment;
  increment.kind = IncrementKind::kJump;
  increment.point = std::move(jump.landing->point);
  increment.arc_length = Distance(from, increment.point);
  const double unit = model_.scaling.force * model_.scaling.length;
  increment.work = {unit * jump.landing->friction, unit * jump.landing->loads};
  increment.jump = {unit * jump.landing->energy_released(), jump.robust};
  // Coulomb's law holds on the way, and not between its ends.
  increment.residuals = model_.Check(increment.point, increment.point);
  if (!(increment.residuals.Largest() <= tolerances::kAccepted))
    return Ended({EndReason::kNumericalFailure, {{sentences::kResiduals}}});
  increment.solve.method = Method::kBranch;
  increment.solve.exact = true;
  StartRecord found;
  Advance advance;
  advance.end = SetOut(increment.point, &found);
  increment.event = std::move(found.branches);
  increment.stability = std::move(found.stability);
  const bool unstable = stability_ && stability_->UnderMachine().verdict == Verdict::kUnstable;
  if (advance.end ? advance.end->reason == EndReason::kPathEnd : unstable) {
    // It has landed where the next part is at its limit: it moves on the same way.
    leaving_ = Leaving{Push(increment.point, increment.point.u - from.u), Limit::kTurns,
                       std::exchange(advance.end, std::nullopt)};
  }
  advance.increments.push_back(std::move(increment));
  return advance;
}

}  // namespace contact_path
