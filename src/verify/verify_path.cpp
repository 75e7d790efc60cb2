#include "contact_path/verify/verify_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact_path/path/increment_lists.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/tolerances.h"
#include "verify/checks.h"
#include "verify/verified_stage.h"

namespace contact_path {
namespace {

bool AtTarget(double target, double load_factor) { return std::abs(load_factor - target) <= kExact * std::abs(target); }

template <typename State>
bool StateFinite(const State& state) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return finite(state.load_factor) && std::all_of(state.positions.begin(), state.positions.end(), finite) &&
         std::all_of(state.rotations.begin(), state.rotations.end(), finite) &&
         std::all_of(state.contacts.begin(), state.contacts.end(), [&](const ContactRecord& contact) {
           return finite(contact.gap) && finite(contact.rn) && finite(contact.rt);
         });
}

bool AllFinite(const Increment& increment) {
  bool finite = StateFinite(increment) && StateFinite(increment.inner);
  for (const double value : {increment.arc_length, increment.dissipation, increment.strain_energy,
                             increment.external_work, increment.jump.energy_released})
    finite = finite && std::isfinite(value);
  for (const std::vector<Resultant>* const forces :
       {&increment.supports, &increment.boundaries, &increment.pins, &increment.inner.pins})
    for (const Resultant& of : *forces)
      finite = finite && std::isfinite(of.rx) && std::isfinite(of.ry) && std::isfinite(of.rm);
  return finite;
}

bool SameStates(const Increment& a, const Increment& b) {
  return a.bars == b.bars &&
         std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
                    [](const ContactRecord& p, const ContactRecord& q) { return p.state == q.state; });
}

// Of the finite load factors.
double LargestLoad(const std::vector<Increment>& increments, std::size_t first, std::size_t last) {
  double load = 0.0;
  for (std::size_t i = first; i < last; ++i)
    if (std::isfinite(increments[i].load_factor)) load = std::max(load, std::abs(increments[i].load_factor));
  return load;
}

// The increments of one stage: their order, and what one says of the next.
class StageVerifier {
 public:
  // increments: all that were recorded; those from `first` up to `last`, not included, are of the stage.
  // index: of the scene of the request; of_program: the scales of the program.
  StageVerifier(const TraceRequest& request, const SceneIndex& index, const Scaling& of_program, std::size_t stage,
                const std::vector<Increment>& increments, std::size_t first, std::size_t last, Verification* result)
      : stage_(request, index, of_program, stage, LargestLoad(increments, first, last)),
        number_(request.program.empty() ? 0 : static_cast<int>(stage) + 1),
        target_(request.program.empty() ? std::nullopt : std::optional(request.program[stage].Target())),
        full_state_every_(std::max(request.options.full_state_every, 1)),
        options_(request.options),
        lists_(request, index),
        increments_(increments),
        first_(first),
        last_(last),
        findings_(&result->findings),
        points_(stage_, &findings_, result),
        integrals_(stage_, &findings_, result),
        stability_(stage_, &findings_, result),
        result_(*result) {}

  void Run(const std::function<void()>& before_each) {
    const Increment *before = nullptr, *earlier = nullptr;  // the last two with states
    for (At(first_); increment_ < last_; At(increment_ + 1)) {
      if (before_each) before_each();
      const Increment& increment = increments_[increment_];
      ++result_.increments;
      ++result_.kinds[increment.kind];
      CheckPlace(increment);
      if (!lists_.Fit(increment)) {
        findings_.Report("the numbers of positions, rotations, contacts and forces are not those of the scene");
        continue;
      }
      if (!AllFinite(increment)) {
        findings_.Report("a number is not finite");
        before = earlier = nullptr;
        continue;
      }
      if (increment_ > first_) CheckProgress(increments_[increment_ - 1], increment);
      if (increment_ > first_ && options_.at_limit == AtLimit::kJump && options_.branch_choices.empty())
        CheckMachine(increments_[increment_ - 1], increment);
      const bool jumps = increment.kind == IncrementKind::kJump;
      if (jumps) CheckJump(before, increment);
      if (!jumps && (increment.jump.energy_released != 0.0 || increment.jump.landing_robust))
        findings_.Report("energy is released, but there is no jump");
      if (!increment.positions.empty()) {
        points_.Check(jumps ? nullptr : before, increment);
        if (before != nullptr) integrals_.CheckSetting(*before, increment, options_.machine_stiffness);
        if (before != nullptr && !jumps) {
          const bool next = before == &increments_[increment_ - 1];
          CheckStates(*before, increment, next);
          integrals_.Check(earlier, *before, increment, After(), next);
        }
        earlier = before;
        before = &increment;
      } else if (increment.kind != IncrementKind::kRegular || increment.index % full_state_every_ == 0) {
        findings_.Report("has no state, though full_state_every = ", full_state_every_, " wants it");
      }
      stability_.Check(increment, options_.machine_stiffness);
      CheckEvent(increment);
      CheckLimit();
    }
    for (At(first_); increment_ < last_; At(increment_ + 1))
      integrals_.CheckEnergy(increments_[first_], increments_[increment_]);
  }

  // Force of the stiffest node for a motion of L, over F.
  double Stiffest() const { return stage_.stiffest; }

 private:
  void At(std::size_t increment) {
    increment_ = increment;
    findings_.SetIncrement(increment);
  }

  // before: the last increment that has its state; null: there is none.
  void CheckJump(const Increment* before, const Increment& landing) {
    if (options_.at_limit != AtLimit::kJump)
      findings_.Report("a jump, though at_limit is ", ToString(options_.at_limit));
    if (increment_ == first_) return;
    const Increment& last = increments_[increment_ - 1];
    integrals_.CheckJump(last, before == &last ? before : nullptr, landing, options_.machine_stiffness);
  }

  // The next increment that has its state, if that is sound; null: there is none.
  const Increment* After() const {
    for (std::size_t i = increment_ + 1; i < last_; ++i) {
      if (!lists_.Fit(increments_[i]) || !AllFinite(increments_[i])) return nullptr;
      if (!increments_[i].positions.empty()) return &increments_[i];
    }
    return nullptr;
  }

  void CheckPlace(const Increment& increment) {
    if (increment.index != static_cast<int>(increment_))
      findings_.Report("has the index ", increment.index, ": increments are missing or out of order");
    if ((increment.kind == IncrementKind::kStart) != (increment_ == first_))
      findings_.Report("is of the kind ", ToString(increment.kind));
    if (increment.stage != number_)
      findings_.Report("is of stage ", increment.stage, ", but stands in stage ", number_);
    if (increment_ != first_) return;
    if (increment.load_factor != 0.0 || increment.positions.empty())
      findings_.Report("is no start: the load factor is 0 there, and the state is recorded");
    if (increment_ == 0 && increment.arc_length != 0.0) findings_.Report("is no start: the arc length is 0 there");
    if (increment_ > 0 && AllFinite(increment)) CheckHandOver(increments_[increment_ - 1], increment);
  }

  // A stage begins where the one before has ended.
  void CheckHandOver(const Increment& last, const Increment& increment) {
    if (increment.arc_length != last.arc_length || increment.dissipation != last.dissipation ||
        increment.external_work != last.external_work)
      findings_.Report("arc length, dissipation and work do not go on from the last increment of the stage before");
    if (!SameSizes(last, increment)) return;
    // At load factors of two stages: of the nodes alone.
    double motion = 0.0;
    for (std::size_t i = 0; i < last.positions.size(); ++i)
      motion = std::max(motion, std::abs(increment.positions[i] - last.positions[i]) / stage_.scaling.length);
    for (std::size_t i = 0; i < last.rotations.size(); ++i)
      motion = std::max(motion, std::abs(increment.rotations[i] - last.rotations[i]));
    findings_.Bound("positions differ from those at the end of the stage before", motion, stage_.rounding);
    BoundReactionChange("reactions differ from those at the end of the stage before", last, increment, motion);
    if (!SameStates(last, increment)) findings_.Report("states differ from those at the end of the stage before");
  }

  void CheckProgress(const Increment& before, const Increment& increment) {
    if (target_ && increment.kind != IncrementKind::kJump && !AtTarget(*target_, increment.load_factor) &&
        !AtTarget(*target_, before.load_factor) &&
        (before.load_factor - *target_) * (increment.load_factor - *target_) < 0.0)
      findings_.Report("goes past the target of its stage, ", *target_);
    if (increment.arc_length < before.arc_length)
      findings_.Report("arc length falls from ", before.arc_length, " to ", increment.arc_length);
    const double energy = stage_.Energy();
    if (!stage_.configuration.HasTotalLaw())
      findings_.Bound("dissipation falls", (before.dissipation - increment.dissipation) / energy, kRecorded);
    const double given_back = std::max(0.0, before.dissipation - increment.dissipation);  // by the total law
    result_.work += (std::abs(increment.external_work - before.external_work) + given_back) / energy;
    const EventRecord& event = before.event;
    if (event.taken < 0 || event.taken > static_cast<int>(event.branches.size()))
      findings_.Report("the branch taken from the increment before, ", event.taken, ", is none of its ",
                       event.branches.size());
  }

  // What the machine does: the path parameter never goes back, and what is not stable under the machine is left by a
  // jump, or at a bifurcation.
  void CheckMachine(const Increment& before, const Increment& increment) {
    const double stiffness = options_.machine_stiffness;
    const bool loaded = std::any_of(stage_.scene.loads.begin(), stage_.scene.loads.end(),
                                    [](const Load& load) { return !load.constant; });
    const bool machine = stiffness > 0.0 && loaded;
    const double sense = (target_ ? *target_ : options_.Direction()) < 0.0 ? -1.0 : 1.0;
    const double change =
        sense * (machine ? increment.setting - before.setting : increment.load_factor - before.load_factor);
    const double unit = machine ? stage_.scaling.length : stage_.scaling.load_factor;
    findings_.Bound("the path parameter goes back", -change / unit,
                    kSingular * (1.0 + std::abs(machine ? increment.setting : increment.load_factor) / unit));
    // At an onset as at a bifurcation, a disturbance may set out too slowly to be followed.
    if (increment.kind == IncrementKind::kJump || before.kind == IncrementKind::kBifurcation ||
        before.kind == IncrementKind::kOnset || !(increment.arc_length > before.arc_length))
      return;
    if ((machine ? before.stability.stability_controlled : before.stability.stability) == Verdict::kUnstable)
      findings_.Report("is reached along a path from a point that is unstable under the machine");
  }

  // What method branch records where branches part. From the last increment of a stage no branch is taken.
  void CheckEvent(const Increment& increment) {
    if (increment.solve.method != Method::kBranch || increment_ == first_ || increment_ + 1 == last_) return;
    const bool event = increment.kind == IncrementKind::kContactEvent || increment.kind == IncrementKind::kCornerLimit;
    const bool jumps = increments_[increment_ + 1].kind == IncrementKind::kJump;
    if (event && !jumps && increment.event.branches.empty()) findings_.Report("an event without branches");
    // Where a choice names an increment, its branches are on record, too.
    const bool numbered = increment.event.number != 0 && !increment.event.branches.empty();
    if (numbered && !event && increment.event.null_vector.empty()) findings_.Report("branches, but no event");
    if (event && !jumps && increment.event.taken == 0) findings_.Report("an event where no branch is taken");
    // At a smooth limit point another path may cross too.
    const bool crosses = !increment.event.null_vector.empty();
    if (increment.kind == IncrementKind::kBifurcation && !crosses)
      findings_.Report("a bifurcation without the direction of the crossing path");
    if (crosses && increment.kind != IncrementKind::kBifurcation && increment.kind != IncrementKind::kSmoothLimit)
      findings_.Report("the direction of a crossing path, but neither a bifurcation nor a limit point");
  }

  // Contact states between two increments with states. next: the second is the next one.
  void CheckStates(const Increment& before, const Increment& increment, bool next) {
    // Reactions may change at rest where a branch begins, and nowhere else.
    if (next && !(increment.arc_length > before.arc_length) && before.event.branches.empty()) {
      const std::vector<double> motion = ScaledMotion(before, increment, stage_.scene, stage_.scaling);
      BoundReactionChange("reactions change while nothing moves, and not at an event", before, increment,
                          std::sqrt(Product(motion, motion)));
    }
    // Where events are located, an increment ends where states change; otherwise an increment tells that they have.
    const IncrementKind kind = stage_.located ? before.kind : increment.kind;
    if (!SameStates(before, increment) && before.kind != IncrementKind::kStart && before.kind != IncrementKind::kJump &&
        kind != IncrementKind::kContactEvent && kind != IncrementKind::kCornerLimit)
      findings_.Report("states change without an event");
    const EventRecord& event = before.event;
    if (event.taken < 1 || event.taken > static_cast<int>(event.branches.size()) || !next) return;
    const BranchRecord& taken = event.branches[static_cast<std::size_t>(event.taken) - 1];
    if (taken.bars != increment.bars)
      findings_.Report("states of bars are not those of the branch taken from the increment before");
    if (!std::equal(taken.states.begin(), taken.states.end(), increment.contacts.begin(), increment.contacts.end(),
                    [](ContactState state, const ContactRecord& contact) { return state == contact.state; }))
      findings_.Report("contact states are not those of the branch taken from the increment before");
  }

  // Reactions of two increments in one place, which moved by rounding alone. Each has the rounding of the parts that
  // press on its contact.
  void BoundReactionChange(const std::string& what, const Increment& before, const Increment& increment, double moved) {
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      const ContactRecord &a = before.contacts[i], &b = increment.contacts[i];
      const VerifiedContact& at = stage_.contacts[i];
      findings_.Bound(what + " (" + at.name + ")",
                      std::max(std::abs(a.rn - b.rn), std::abs(a.rt - b.rt)) / stage_.scaling.force,
                      stage_.rounding + 2.0 * at.rounding * at.unit + at.of_parts * (moved + tolerances::kLastDigits));
    }
  }

  // The load factor turns between the last three increments where a limit point is, and nowhere else.
  void CheckLimit() {
    if (increment_ < first_ + 2) return;
    const Increment &a = increments_[increment_ - 2], &b = increments_[increment_ - 1], &c = increments_[increment_];
    if (b.kind == IncrementKind::kJump || c.kind == IncrementKind::kJump) return;
    const double before = b.load_factor - a.load_factor, after = c.load_factor - b.load_factor;
    // A smaller change has no sense; a point next to a singular one is known to less.
    const bool regular = b.kind != IncrementKind::kBifurcation && b.kind != IncrementKind::kContactEvent;
    const double level = (regular ? kExact : kSingular) * ResidualUnit(stage_.stiffest) * stage_.scaling.load_factor;
    if (!(std::min(std::abs(before), std::abs(after)) > level)) return;
    // Where limit points are not located, the increment after tells.
    const IncrementKind kind = stage_.located ? b.kind : c.kind;
    const bool limit = kind == IncrementKind::kSmoothLimit || kind == IncrementKind::kCornerLimit;
    if (before * after < 0.0 && !limit) findings_.Report("the load factor turns without a limit point");
    if (before * after > 0.0 && limit) findings_.Report("the load factor does not turn at the limit point");
  }

  const VerifiedStage stage_;
  const int number_;                    // of the stage, from 1; 0: there is no program
  const std::optional<double> target_;  // of the stage; nothing without a program
  const int full_state_every_;
  const TraceOptions& options_;
  const IncrementLists lists_;
  const std::vector<Increment>& increments_;
  const std::size_t first_, last_;
  Findings findings_;
  PointChecks points_;
  IntegralChecks integrals_;
  StabilityChecks stability_;
  std::size_t increment_ = 0;  // being checked
  Verification& result_;
};

}  // namespace

Verification VerifyPath(const TraceRequest& request_given, const std::vector<Increment>& increments,
                        const std::function<void()>& before_each) {
  const ExpandedRequest expanded(request_given);
  const TraceRequest& request = expanded.Get();
  Verification result;
  if (increments.empty()) result.findings.push_back({0, "the record has no increments"});
  const SceneIndex index(request.scene);
  const Scaling of_program = ProgramScales(request, index);
  std::vector<double> stiffest;
  std::size_t stage = 0;
  for (std::size_t first = 0, last = 0; first < increments.size(); first = last, ++stage) {
    last = first + 1;
    while (last < increments.size() && increments[last].stage == increments[first].stage) ++last;
    if (stage >= NumStages(request)) {
      result.findings.push_back({static_cast<int>(first), "is of a stage that the request does not have"});
      break;
    }
    StageVerifier verifier(request, index, of_program, stage, increments, first, last, &result);
    verifier.Run(before_each);
    stiffest.push_back(verifier.Stiffest());
    if (last < increments.size() && !AtTarget(request, increments[last - 1]))
      result.findings.push_back({static_cast<int>(last - 1), "ends its stage, but not at its target"});
  }
  if (result.findings.empty()) VerifyEvents(request, increments, stiffest, &result.findings);
  return result;
}

bool AtTarget(const TraceRequest& request, const Increment& increment) {
  if (increment.stage < 1 || increment.stage > static_cast<int>(request.program.size())) return false;
  return AtTarget(request.program[static_cast<std::size_t>(increment.stage) - 1].Target(), increment.load_factor);
}

}  // namespace contact_path
