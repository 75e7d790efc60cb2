#include "contact_path/verify/verify_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "contact_path/path/increment_lists.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/verify/verify_events.h"
#include "verify/recorded_forces.h"
#include "verify/recorded_state.h"
#include "verify/scaled_motion.h"
#include "verify/trapezoid_work.h"
#include "verify/verified_contacts.h"

namespace contact_path {
namespace {

constexpr double kExact = 1e-9;        // of an exact increment: all that should be zero, scaled
constexpr double kRegularised = 1e-5;  // of a regularised increment
constexpr double kRecorded = 1e-11;    // what was recorded, against what is computed anew: rounding, scaled
constexpr double kRoundings = 64.0;    // of a coordinate
constexpr double kSlack = 1e-3;        // of what the energy balance may be off by: for one increment
constexpr double kChord = 1e-9;        // relative: arc length against chord
constexpr double kInPlace = 1e-7;      // of L: forces that are exact to kExact leave the place of soft parts open by it
constexpr double kEnergy = 1e-2;       // of the work done: energies are quadratures
constexpr double kEnergyNotLocated = 3e-2;  // the same where increments may cut corners
constexpr double kAtTarget = 1e-9;          // relative, of the load factor
constexpr double kTurn = 1e-9;              // of the load factor: a smaller change is none
constexpr double kPullShare = 0.02;         // of the largest reaction before: a contact that pulls with more is wrong
constexpr double kPreloaded = 1e-10;        // of the forces there: to this contacts are known at the end of a preload
constexpr double kLongestArc = 1.05;        // of its chord: increments turn by less than 60 degrees

// The same at a bifurcation: where paths cross, equilibrium holds to rounding at a distance of its root from both.
constexpr double kTurnCrossing = 1e-7;
// At an event of a contact that may be next to a singular point.
constexpr double kTurnAtEvent = 1e-8;

bool AtTarget(double target, double load_factor) {
  return std::abs(load_factor - target) <= kAtTarget * std::abs(target);
}

// The increments of one stage.
class Verifier {
 public:
  // increments: all that were recorded; those from `first` up to `last`, not included, are of the stage.
  // index: of the scene of the request; of_program: the scales of the program.
  Verifier(const TraceRequest& request, const SceneIndex& index, const Scaling& of_program, std::size_t stage,
           const std::vector<Increment>& increments, std::size_t first, std::size_t last, Verification* result)
      : index_(index),
        scene_(StageScene(request, index, stage)),
        configuration_(StageConfiguration(request, index, stage)),
        stage_(request.program.empty() ? 0 : static_cast<int>(stage) + 1),
        target_(request.program.empty() ? std::nullopt : std::optional(request.program[stage].Target())),
        full_state_every_(std::max(request.options.full_state_every, 1)),
        located_(request.options.LocatesEvents()),
        lists_(request, index),
        increments_(increments),
        first_(first),
        last_(last),
        scaling_(StageScales(request, index, stage, of_program)),
        check_(scene_, configuration_, scaling_),
        result_(*result) {
    double farthest = 0.0;
    for (const double coordinate : configuration_.start) farthest = std::max(farthest, std::abs(coordinate));
    // What moves takes nodes along, and lengths of arc are of the load factor, too.
    double load = 0.0;
    for (std::size_t i = first_; i < last_; ++i)
      if (std::isfinite(increments_[i].load_factor)) load = std::max(load, std::abs(increments_[i].load_factor));
    for (const SupportMotion& motion : scene_.support_motions) farthest += load * std::hypot(motion.dx, motion.dy);
    for (const ObstacleMotion& motion : scene_.obstacle_motions) farthest += load * std::hypot(motion.dx, motion.dy);
    for (const Obstacle& obstacle : scene_.obstacles) {
      farthest = std::max({farthest, std::abs(obstacle.px), std::abs(obstacle.py), obstacle.radius});
      for (const double number : obstacle.points) farthest = std::max(farthest, std::abs(number));
    }
    rounding_ = kRecorded + kRoundings * std::numeric_limits<double>::epsilon() *
                                (farthest / scaling_.length + load / scaling_.load_factor);
    rates_.resize(2 * scene_.nodes.size());
    turn_rates_.resize(scene_.nodes.size());
    for (const SupportMotion& motion : scene_.support_motions) {
      rates_[2 * index_.Node(motion.node)] = motion.dx;
      rates_[2 * index_.Node(motion.node) + 1] = motion.dy;
      turn_rates_[index_.Node(motion.node)] = motion.rotation;
    }
    stiffest_ = check_.LargestStiffness() * scaling_.length / scaling_.force;
    contacts_ = VerifiedContacts(scene_, index_, check_, configuration_, scaling_, rates_, load);
  }

  void Run(const std::function<void()>& before_each) {
    for (increment_ = first_; increment_ < last_; ++increment_) {
      if (before_each) before_each();
      const Increment& increment = Current();
      ++result_.increments;
      ++result_.kinds[increment.kind];
      CheckPlace(increment);
      if (!lists_.Fit(increment)) {
        Report("the numbers of positions, rotations, contacts and forces are not those of the scene");
        continue;
      }
      if (!AllFinite(increment)) {
        Report("a number is not finite");
        before_.reset();
        earlier_.reset();
        continue;
      }
      if (increment_ > first_) CheckProgress(increments_[increment_ - 1], increment);
      if (!increment.positions.empty()) {
        CheckState(increment);
        earlier_ = before_;
        before_ = increment_;
      } else if (increment.kind != IncrementKind::kRegular || increment.index % full_state_every_ == 0) {
        Report("has no state, though full_state_every = ", full_state_every_, " wants it");
      }
      CheckEvent(increment);
      CheckLimit();
    }
    CheckEnergy();
  }

  // Force of the stiffest node for a motion of L, over F.
  double Stiffest() const { return stiffest_; }

 private:
  const Increment& Current() const { return increments_[increment_]; }

  template <typename... Parts>
  void Report(const Parts&... parts) {
    if (result_.findings.size() >= static_cast<std::size_t>(kMostFindings)) return;
    std::ostringstream text;
    text.precision(6);
    (text << ... << parts);
    result_.findings.push_back({static_cast<int>(increment_), text.str()});
  }

  // What should be zero, or less.
  void Bound(const std::string& what, double value, double tolerance) {
    if (!(value <= tolerance)) Report(what, ": ", value, " > ", tolerance);
  }

  static bool AllFinite(const Increment& increment) {
    bool finite = std::isfinite(increment.load_factor) && std::isfinite(increment.arc_length) &&
                  std::isfinite(increment.dissipation) && std::isfinite(increment.strain_energy) &&
                  std::isfinite(increment.external_work);
    for (const std::vector<Resultant>* const forces : {&increment.supports, &increment.boundaries})
      for (const Resultant& of : *forces)
        finite = finite && std::isfinite(of.rx) && std::isfinite(of.ry) && std::isfinite(of.rm);
    for (const std::vector<double>* const values : {&increment.positions, &increment.rotations})
      for (const double value : *values) finite = finite && std::isfinite(value);
    for (const ContactRecord& contact : increment.contacts)
      finite = finite && std::isfinite(contact.gap) && std::isfinite(contact.rn) && std::isfinite(contact.rt);
    return finite;
  }

  void CheckPlace(const Increment& increment) {
    if (increment.index != static_cast<int>(increment_))
      Report("has the index ", increment.index, ": increments are missing or out of order");
    if ((increment.kind == IncrementKind::kStart) != (increment_ == first_))
      Report("is of the kind ", ToString(increment.kind));
    if (increment.stage != stage_) Report("is of stage ", increment.stage, ", but stands in stage ", stage_);
    if (increment_ != first_) return;
    if (increment.load_factor != 0.0 || increment.positions.empty())
      Report("is no start: the load factor is 0 there, and the state is recorded");
    if (increment_ == 0 && increment.arc_length != 0.0) Report("is no start: the arc length is 0 there");
    if (increment_ > 0 && AllFinite(increment)) CheckHandOver(increments_[increment_ - 1], increment);
  }

  // A stage begins where the one before has ended.
  void CheckHandOver(const Increment& last, const Increment& increment) {
    if (increment.arc_length != last.arc_length || increment.dissipation != last.dissipation ||
        increment.external_work != last.external_work)
      Report("arc length, dissipation and work do not go on from the last increment of the stage before");
    if (!SameSizes(last, increment)) return;
    double motion = 0.0;
    for (const double component : ScaledMotion(last, increment, scaling_.length))
      motion = std::max(motion, std::abs(component));
    bool same = true;
    for (std::size_t i = 0; i < increment.contacts.size(); ++i)
      same = same && last.contacts[i].state == increment.contacts[i].state;
    Bound("positions differ from those at the end of the stage before", motion, rounding_);
    BoundReactionChange("reactions differ from those at the end of the stage before", last, increment, motion);
    if (!same) Report("contact states differ from those at the end of the stage before");
  }

  void CheckProgress(const Increment& before, const Increment& increment) {
    if (target_ && !AtTarget(*target_, increment.load_factor) && !AtTarget(*target_, before.load_factor) &&
        (before.load_factor - *target_) * (increment.load_factor - *target_) < 0.0)
      Report("goes past the target of its stage, ", *target_);
    if (increment.arc_length < before.arc_length)
      Report("arc length falls from ", before.arc_length, " to ", increment.arc_length);
    const double energy = scaling_.force * scaling_.length;
    if (!configuration_.HasTotalLaw())
      Bound("dissipation falls", (before.dissipation - increment.dissipation) / energy, kRecorded);
    const double given_back = std::max(0.0, before.dissipation - increment.dissipation);  // by the total law
    result_.work += (std::abs(increment.external_work - before.external_work) + given_back) / energy;
    const EventRecord& event = before.event;
    if (event.taken < 0 || event.taken > static_cast<int>(event.branches.size()))
      Report("the branch taken from the increment before, ", event.taken, ", is none of its ", event.branches.size());
  }

  // What method branch records where branches part. From the last increment of a stage no branch is taken.
  void CheckEvent(const Increment& increment) {
    if (increment.solve.method != Method::kBranch || increment_ == first_ || increment_ + 1 == last_) return;
    const bool event = increment.kind == IncrementKind::kContactEvent || increment.kind == IncrementKind::kCornerLimit;
    if (event && increment.event.branches.empty()) Report("an event without branches");
    // Where a choice names an increment, its branches are on record, too.
    const bool numbered = increment.event.number != 0 && !increment.event.branches.empty();
    if (numbered && !event && increment.kind != IncrementKind::kBifurcation) Report("branches, but no event");
    if (event && increment.event.taken == 0) Report("an event where no branch is taken");
    // At a smooth limit point another path may cross too.
    const bool crosses = !increment.event.null_vector.empty();
    if (increment.kind == IncrementKind::kBifurcation && !crosses)
      Report("a bifurcation without the direction of the crossing path");
    if (crosses && increment.kind != IncrementKind::kBifurcation && increment.kind != IncrementKind::kSmoothLimit)
      Report("the direction of a crossing path, but neither a bifurcation nor a limit point");
  }

  // Whether what happened since the last full increment is one arc of the path.
  bool OnePiece() const { return increment_ == first_ || before_ == increment_ - 1 || located_; }

  void CheckState(const Increment& increment) {
    ++result_.full_increments;
    if (increment.solve.exact) ++result_.exact_increments;
    CheckPull(increment);
    if (located_ && !increment.solve.exact) Report("an increment that ends at events and is not exact");
    const double tolerance = increment.solve.exact ? kExact : kRegularised;
    const Increment& before = before_ ? increments_[*before_] : increment;
    const CheckedState from = StateOf(before), to = StateOf(increment);
    const Residuals residuals = check_.Check(from, to);
    Bound("equilibrium residual", residuals.equilibrium, tolerance);
    Bound("penetration", residuals.penetration, tolerance);
    Bound("tensile_reaction", residuals.tensile_reaction, tolerance);
    Bound("gap and reaction are both positive", residuals.complementarity, tolerance);
    Bound("reaction outside of the friction cone", residuals.cone, tolerance);
    if (OnePiece()) Bound("friction law", residuals.friction_law, tolerance);
    Keep(residuals, increment.solve.exact ? &result_.exact : &result_.regularised);
    CheckRecorded(increment, residuals);
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Node& node = scene_.nodes[i];
      const auto off = [&](std::size_t k) {
        return std::abs(increment.positions[k] - configuration_.start[k] - rates_[k] * increment.load_factor) /
                   scaling_.length >
               rounding_;
      };
      if ((node.fixed_x && off(2 * i)) || (node.fixed_y && off(2 * i + 1)))
        Report("support ", node.name, " is not where it has to be");
      if (node.fixed_rotation && !(std::abs(increment.rotations[i] - configuration_.start_rotations[i] -
                                            turn_rates_[i] * increment.load_factor) <= rounding_))
        Report("support ", node.name, " is not turned as it has to be");
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) CheckContact(increment.contacts[i], from, to, i, tolerance);
    if (increment.solve.exact) CheckSoftContacts(increment, tolerance);
    if (before_) CheckPiece(before, increment);
    if (before_) CheckWork(before, increment);
  }

  // Equilibrium across the surfaces and the laws of reactions where F is no measure of them.
  void CheckSoftContacts(const Increment& increment, double tolerance) {
    if (std::all_of(contacts_.begin(), contacts_.end(),
                    [](const VerifiedContact& contact) { return contact.unit == 1.0; }))
      return;
    const CheckedState state = StateOf(increment);
    const std::vector<double> unbalance = check_.Unbalance(state);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (contacts_[i].unit == 1.0) continue;
      const VerifiedContact& at = contacts_[i];
      const Node& node = scene_.nodes[at.node];
      const double unit = contacts_[i].unit * scaling_.force;
      const double rn = increment.contacts[i].rn / unit, rt = increment.contacts[i].rt / unit;
      const std::array<double, 2> normal = check_.Normal(i, state);
      const double fx = node.fixed_x ? 0.0 : normal[0] * unbalance[2 * at.node];
      const double fy = node.fixed_y ? 0.0 : normal[1] * unbalance[2 * at.node + 1];
      Bound("equilibrium residual across " + at.name + ", of the forces there", std::abs(fx + fy) / unit, tolerance);
      Bound("tensile reaction of " + at.name + ", of the forces there", -rn, tolerance);
      Bound("gap and reaction of " + at.name + " are both positive",
            std::min(increment.contacts[i].gap / scaling_.length, rn), tolerance);
      Bound("reaction of " + at.name + " outside of the friction cone, of the forces there",
            std::abs(rt) - at.friction * rn, tolerance);
    }
  }

  // Where reactions are so small that the residuals above cannot tell: against what contacts have pushed with.
  void CheckPull(const Increment& increment) {
    for (std::size_t i = 0; i < increment.contacts.size(); ++i)
      result_.largest_reaction =
          std::max(result_.largest_reaction, increment.contacts[i].rn / (contacts_[i].unit * scaling_.force));
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      // Where another path crosses, a point is known to less than rounding.
      double rounding = increment.event.null_vector.empty() ? contacts_[i].closing : kExact;
      // What contacts have pushed with in a preload is not recorded.
      if (increment_ == 0) rounding = std::max(rounding, kPreloaded);
      const double most = std::max(rounding, kPullShare * result_.largest_reaction);
      const double pull = -increment.contacts[i].rn / (contacts_[i].unit * scaling_.force);
      if (pull > most)
        Report(contacts_[i].name, " pulls with ", pull, " of the forces there, where contacts push with at most ",
               result_.largest_reaction);
    }
  }

  static void Keep(const Residuals& residuals, Residuals* largest) {
    for (double Residuals::*const field :
         {&Residuals::equilibrium, &Residuals::penetration, &Residuals::tensile_reaction, &Residuals::complementarity,
          &Residuals::cone, &Residuals::friction_law, &Residuals::support})
      largest->*field = std::max(largest->*field, residuals.*field);
  }

  void CheckRecorded(const Increment& increment, const Residuals& residuals) {
    const auto same = [&](const char* what, double recorded, double anew, double rounding = 0.0) {
      if (!(std::abs(recorded - anew) <= rounding_ * (1.0 + std::abs(anew)) + rounding))
        Report(what, " is recorded as ", recorded, ", but is ", anew);
    };
    same("equilibrium residual", increment.residuals.equilibrium, residuals.equilibrium);
    same("penetration residual", increment.residuals.penetration, residuals.penetration);
    same("tensile_reaction residual", increment.residuals.tensile_reaction, residuals.tensile_reaction);
    same("min form residual", increment.residuals.complementarity, residuals.complementarity);
    same("cone residual", increment.residuals.cone, residuals.cone);
    same("support residual", increment.residuals.support, residuals.support);
    // Depends on the increment before, which may have been left out.
    if (increment_ == first_ || before_ == increment_ - 1)
      same("friction law residual", increment.residuals.friction_law, residuals.friction_law);
    const double unit = scaling_.force * scaling_.length;
    same("scaled strain energy", increment.strain_energy / unit,
         check_.StrainEnergy(increment.positions, increment.rotations) / unit,
         std::numeric_limits<double>::epsilon() * stiffest_);
    // The normal of a sharp corner is known less well than the place of the node.
    const std::string wrong = ForcesContradicted(increment, check_.Forces(StateOf(increment)), scaling_, kExact,
                                                 kRoundingOfParts * stiffest_);
    if (!wrong.empty()) Report(wrong);
    if (increment.sections.empty() && increment.stresses.empty() && increment.pressures.empty()) return;
    const std::string answer = AnswersContradicted(increment, check_.Answers(StateOf(increment)), scaling_, kExact,
                                                   kRoundingOfParts * stiffest_, kRoundingOfParts * scaling_.length);
    if (!answer.empty()) Report(answer);
  }

  // What the law of friction is about. 0 where that is not known.
  double SlipOf(std::size_t contact, const CheckedState& from, const CheckedState& to) const {
    if (configuration_.HasTotalLaw() && contacts_[contact].friction > 0.0) return check_.TotalSlip(contact, to);
    return OnePiece() ? check_.Slip(contact, from, to) : 0.0;
  }

  void CheckContact(const ContactRecord& contact, const CheckedState& from, const CheckedState& to, std::size_t i,
                    double tolerance) {
    const VerifiedContact& at = contacts_[i];
    const double gap = check_.Gap(i, to) / scaling_.length;
    const double past_end = check_.GapPastEnd(i, to) / scaling_.length, recorded = contact.gap / scaling_.length;
    Bound("recorded gap of " + at.name + " less the true one",
          std::min(std::abs(recorded - gap), std::abs(recorded - past_end)), rounding_);
    const double slip = SlipOf(i, from, to) / scaling_.length;
    // Where a point is repeated, as of a node between two discs, its place is known to no more.
    const bool repeated = before_ && !(Current().arc_length > increments_[*before_].arc_length);
    const double slip_tolerance = repeated ? std::max(tolerance, kInPlace) : tolerance;
    const ContactNumbers numbers = {gap, slip, contact.rn / scaling_.force, contact.rt / scaling_.force};
    if (!StateHolds(contact.state, at, numbers, {tolerance, slip_tolerance}))
      Report(at.name, " is recorded as ", NameOf(contact.state), ", but is not");
  }

  // The arc of the path between two full increments.
  void CheckPiece(const Increment& before, const Increment& increment) {
    const double load = std::abs(increment.load_factor - before.load_factor) / scaling_.load_factor;
    double square = 0.0;
    for (const double component : ScaledMotion(before, increment, scaling_.length)) square += component * component;
    const double motion = std::sqrt(square), chord = std::hypot(motion, load),
                 arc = increment.arc_length - before.arc_length;
    const double rounding = arc > 0.0 ? rounding_ : std::max(rounding_, kInPlace);
    if (arc < chord * (1.0 - kChord) - rounding) Report("arc length grows by ", arc, ", less than the chord ", chord);
    if (before_ == increment_ - 1 && arc > kLongestArc * chord + kInPlace)
      Report("arc length grows by ", arc, ", more than a curve with the chord ", chord, " would");

    // Reactions may change at rest where a branch begins, and nowhere else.
    if (before_ == increment_ - 1 && !(arc > 0.0) && before.event.branches.empty())
      BoundReactionChange("reactions change while nothing moves, and not at an event", before, increment, motion);
    if (!(arc > 0.0))
      Bound("the load factor changes though the arc length does not", load, std::max(rounding_, kExact));

    // States: where events are located, an increment ends where they change; otherwise an increment tells that they
    // have.
    bool changed = false;
    for (std::size_t i = 0; i < increment.contacts.size(); ++i)
      changed = changed || increment.contacts[i].state != before.contacts[i].state;
    const IncrementKind kind = located_ ? before.kind : increment.kind;
    if (changed && before_ != first_ && kind != IncrementKind::kContactEvent && kind != IncrementKind::kCornerLimit)
      Report("contact states change without an event");
    const EventRecord& event = before.event;
    if (event.taken < 1 || event.taken > static_cast<int>(event.branches.size()) || before_ != increment_ - 1) return;
    const std::vector<ContactState>& states = event.branches[static_cast<std::size_t>(event.taken) - 1].states;
    bool as_taken = states.size() == increment.contacts.size();
    for (std::size_t i = 0; as_taken && i < states.size(); ++i) as_taken = states[i] == increment.contacts[i].state;
    if (!as_taken) Report("contact states are not those of the branch taken from the increment before");
  }

  // Reactions of two increments in one place, which moved by rounding alone. Each has the rounding of the parts that
  // press on its contact.
  void BoundReactionChange(const std::string& what, const Increment& before, const Increment& increment, double moved) {
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      const ContactRecord &a = before.contacts[i], &b = increment.contacts[i];
      const double change = std::max(std::abs(a.rn - b.rn), std::abs(a.rt - b.rt)) / scaling_.force;
      Bound(what + " (" + contacts_[i].name + ")", change,
            rounding_ + 2.0 * contacts_[i].rounding * contacts_[i].unit + contacts_[i].of_parts * moved);
    }
  }

  void CheckWork(const Increment& before, const Increment& increment) {
    const TrapezoidWork work =
        WorkBetween({scene_, index_, check_, scaling_, contacts_, configuration_.HasTotalLaw(), located_},
                    earlier_ ? &increments_[*earlier_] : nullptr, before, increment);
    if (!located_) open_ += work.open_work + work.open_dissipation;
    if (!OnePiece()) return;  // trapezoids over several increments tell too little
    const double unit = scaling_.force * scaling_.length;
    const double slack = kEnergy * result_.work * kSlack + rounding_;
    const double work_off = std::abs((increment.external_work - before.external_work) / unit - work.work);
    if (!(work_off <= 2.0 * work.open_work + slack)) Report("work of the loads is off by ", work_off, " of F L");
    const double dissipation_off = std::abs((increment.dissipation - before.dissipation) / unit - work.dissipation);
    if (!(dissipation_off <= 2.0 * work.open_dissipation + slack))
      Report("dissipation is off by ", dissipation_off, " of F L");
  }

  // The load factor turns between the last three increments where a limit point is, and nowhere else.
  void CheckLimit() {
    if (increment_ < first_ + 2) return;
    const Increment &a = increments_[increment_ - 2], &b = increments_[increment_ - 1], &c = increments_[increment_];
    const double before = b.load_factor - a.load_factor, after = c.load_factor - b.load_factor;
    const double turn = b.kind == IncrementKind::kBifurcation    ? kTurnCrossing
                        : b.kind == IncrementKind::kContactEvent ? kTurnAtEvent
                                                                 : kTurn;
    const double level = turn * ResidualUnit(stiffest_) * scaling_.load_factor;
    // Where limit points are not located, the increment after tells.
    const Increment& located = located_ ? b : c;
    const bool limit = located.kind == IncrementKind::kSmoothLimit || located.kind == IncrementKind::kCornerLimit;
    if (before * after < 0.0 && std::min(std::abs(before), std::abs(after)) > level && !limit)
      Report("the load factor turns without a limit point");
    if (before * after > 0.0 && std::min(std::abs(before), std::abs(after)) > level && limit)
      Report("the load factor does not turn at the limit point");
  }

  void CheckEnergy() {
    const double unit = scaling_.force * scaling_.length;
    const Increment& start = increments_[first_];
    const double share = located_ ? kEnergy : kEnergyNotLocated;
    // Work of the reactions along the gaps that may be left, or penetrated, and of those that may be left at open gaps.
    double pressed = 0.0;
    for (increment_ = first_; increment_ < last_; ++increment_) {
      const Increment& increment = Current();
      double reactions = 0.0, left_open = 0.0;
      for (const ContactRecord& contact : increment.contacts) {
        reactions += std::abs(contact.rn);
        if (contact.gap > kExact * scaling_.length) left_open += std::hypot(contact.rn, contact.rt);
      }
      const double moved = increment.arc_length - start.arc_length;
      if (!located_) pressed = std::max(pressed, (kExact * reactions + left_open * moved) / scaling_.force);
      const double balance =
          (increment.external_work - start.external_work - (increment.strain_energy - start.strain_energy) -
           (increment.dissipation - start.dissipation)) /
          unit;
      const double forces = kRoundingOfParts * stiffest_;
      const double rounding = rounding_ * (1.0 + std::abs(increment.strain_energy) / unit) +
                              forces * (increment.arc_length - start.arc_length);
      if (!(std::abs(balance) <= share * result_.work + open_ + pressed + rounding)) {
        Report("energy balance: ", balance, " of F L, with ", result_.work, " of work done on the whole path");
        return;
      }
      result_.energy_balance = std::max(result_.energy_balance, std::abs(balance));
    }
  }

  const SceneIndex& index_;
  const Scene scene_;
  const Configuration configuration_;
  const int stage_;
  const std::optional<double> target_;  // of the stage; nothing without a program
  const int full_state_every_;
  const bool located_;  // increments end where contacts change their states
  const IncrementLists lists_;
  const std::vector<Increment>& increments_;
  const std::size_t first_, last_;
  const Scaling scaling_;
  const ResidualCheck check_;
  std::vector<VerifiedContact> contacts_;  // in the order of the scene
  std::vector<double> turn_rates_;         // of rotations, by node
  std::vector<double> rates_;              // of the fixed components, per unit of the load factor
  std::size_t increment_ = 0;              // being checked
  std::optional<std::size_t> before_;      // the last full increment
  std::optional<std::size_t> earlier_;     // the full increment before that
  double rounding_ = 0.0;                  // of what was recorded, scaled
  double stiffest_ = 0.0;                  // as Stiffest()
  double open_ = 0.0;                      // what trapezoids leave open of works and dissipations
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
    Verifier verifier(request, index, of_program, stage, increments, first, last, &result);
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
