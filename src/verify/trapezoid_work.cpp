#include "verify/trapezoid_work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verify/scaled_motion.h"

namespace contact_path {
namespace {

constexpr double kBendOfForce = 0.25;  // of a force along an arc of length 1: what a trapezoid cannot know
constexpr double kSagitta = 0.125;     // of a circular arc, over its length and the angle by which it turns
// Times the forces of the parts: what presses on a contact whose friction resists the load, both of which grow.
constexpr double kWedged = 3.0;
// Times kBendOfForce, where no increment before tells how a motion bends.
constexpr double kSharper = 2.0;

// Of the fastest prescribed motion [length per unit of the load factor].
double LargestSpeed(const VerifiedStage& stage) {
  double speed = 0.0;
  for (const SupportMotion& motion : stage.scene.support_motions)
    speed = std::max(speed, std::hypot(motion.dx, motion.dy, motion.rotation * stage.scaling.length));
  for (const ObstacleMotion& motion : stage.scene.obstacle_motions)
    speed = std::max(speed, std::hypot(motion.dx, motion.dy, motion.turn * stage.scaling.length));
  return speed;
}

double SumOfReactions(const Increment& increment) {
  double reactions = 0.0;
  for (const ContactRecord& contact : increment.contacts) reactions += std::hypot(contact.rn, contact.rt);
  return reactions;
}

// A value that goes on at first as it changed on the increment before, which would be by `going_on` on the whole
// increment, and changes by `change`: a parabola. It is apart from its chord by at most a quarter of the distance
// between its tangent at one end and its chord, measured at the other end.
double OpenOfParabola(double going_on, double change) { return 0.25 * std::abs(going_on - change); }

// Reactions that change while the surfaces turn under their nodes [force]: the rule leaves a sixth of the product of
// two linear changes open, and no more than a quarter where they are not linear.
double OpenOfTurnedReactions(const VerifiedStage& stage, const Increment& before, const Increment& increment) {
  const CheckedState from = StateOf(before), to = StateOf(increment);
  double open = 0.0;
  for (std::size_t i = 0; i < stage.contacts.size(); ++i) {
    const double change = std::hypot(to.rn[i] - from.rn[i], to.rt[i] - from.rt[i]);
    if (change == 0.0) continue;
    const std::array<double, 2> was = stage.check.Normal(i, from), is = stage.check.Normal(i, to);
    open += 0.25 * change * std::hypot(is[0] - was[0], is[1] - was[1]);
  }
  return open;
}

// Between the motions of two increments, one after the other [rad]; 0 where one of them is at rest.
double TurnOf(const Increment& earlier, const Increment& before, const Increment& increment, double length) {
  const std::vector<double> a = ScaledMotion(earlier, before, length), b = ScaledMotion(before, increment, length);
  double product = 0.0, first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product += a[i] * b[i];
    first += a[i] * a[i];
    second += b[i] * b[i];
  }
  const double norms = std::sqrt(first * second);
  return norms > 0.0 ? std::acos(std::clamp(product / norms, -1.0, 1.0)) : 0.0;
}

}  // namespace

TrapezoidWork WorkBetween(const VerifiedStage& stage, const Increment* earlier, const Increment& before,
                          const Increment& increment) {
  const double unit = stage.scaling.force * stage.scaling.length;
  const CheckedState from_state = StateOf(before), to_state = StateOf(increment);
  double along = 0.0, work = 0.0, scaled_loads = 0.0;
  for (const Load& load : stage.scene.loads) {
    const std::size_t x = 2 * stage.index.Node(load.node), y = x + 1;
    double product = load.fx * (increment.positions[x] - before.positions[x]) +
                     load.fy * (increment.positions[y] - before.positions[y]);
    if (load.moment != 0.0) product += load.moment * (increment.rotations[x / 2] - before.rotations[x / 2]);
    (load.constant ? work : along) += product;
    if (!load.constant) scaled_loads += std::hypot(load.fx, load.fy, load.moment / stage.scaling.length);
  }
  work += 0.5 * (before.load_factor + increment.load_factor) * along;
  // A force may have its largest value inside the increment while both ends show equal values. Forces bend over the
  // length L: the share `bend` of a force is open.
  const double arc = increment.arc_length - before.arc_length;
  const double bend = kBendOfForce * arc * arc;
  // Nodes with loads may go forth and back inside the increment: `bend` times L of their motion is open, and what an
  // arc is beside its chord that turns as the last two motions do.
  const double load_change = std::abs(increment.load_factor - before.load_factor);
  double load_open = 0.5 * load_change;
  const double arc_before = earlier != nullptr ? before.arc_length - earlier->arc_length : 0.0;
  if (arc_before > 0.0) {
    const double going_on = (before.load_factor - earlier->load_factor) / arc_before * arc;
    load_open += OpenOfParabola(going_on, increment.load_factor - before.load_factor);
  }
  const double turn = arc_before > 0.0 ? TurnOf(*earlier, before, increment, stage.scaling.length) : 0.0;
  const double beside = std::max(bend, kSagitta * turn * arc);
  double open_work = (load_open * std::abs(along) + bend * std::abs(work) +
                      beside * load_change * scaled_loads * stage.scaling.length) /
                     unit;
  double against_parts = 0.0;  // of open_work: by prescribed motion, where no increment before tells of its force
  if (!stage.scene.support_motions.empty() || !stage.scene.obstacle_motions.empty()) {
    const double from = stage.check.DrivingForce(from_state), to = stage.check.DrivingForce(to_state);
    const double moved = increment.load_factor - before.load_factor;
    work += 0.5 * (from + to) * moved;
    // An obstacle that is dragged without friction may exert no force at either end of the increment, and inside it the
    // forces of a wavy surface.
    const double speed = LargestSpeed(stage);
    const double between = std::abs(from + to) + speed * (SumOfReactions(before) + SumOfReactions(increment));
    const double turned = speed * OpenOfTurnedReactions(stage, before, increment);
    open_work += (0.5 * std::abs(to - from) + bend * between + turned) * std::abs(moved) / unit;
    const double moved_before = earlier != nullptr ? before.load_factor - earlier->load_factor : 0.0;
    if (moved_before == 0.0) {
      // No increment before tells how the force changes. Parts whose strains are of second order in the motion exert
      // forces of that order.
      against_parts = bend * stage.scaling.length * stage.check.LargestStiffness() * speed * std::abs(moved) / unit;
    } else {
      const double going_on = (from - stage.check.DrivingForce(StateOf(*earlier))) / moved_before * moved;
      open_work += OpenOfParabola(going_on, to - from) * std::abs(moved) / unit;
    }
  }
  // The part of a reaction of the contact i that is open [force]. Where the contact begins to press inside the
  // increment, the reaction is 0 at the begin and may be next to nothing at the end: the forces of the parts there,
  // times `wedged`, bound it in between. They bound it, too, where no increment before tells how it changes.
  const auto open_force = [&](std::size_t i, double ContactRecord::*reaction, double wedged) {
    const double was = before.contacts[i].*reaction, change = increment.contacts[i].*reaction - was;
    double between = 1.0;
    if (was == 0.0)
      between = wedged * stage.contacts[i].of_parts;
    else if (arc_before == 0.0)
      between = stage.contacts[i].of_parts;
    const double largest = 2.0 * std::abs(was) + std::abs(change) + between * stage.scaling.force;
    const double going_on = arc_before > 0.0 ? (was - earlier->contacts[i].*reaction) / arc_before * arc : change;
    return 0.5 * std::abs(change) + bend * largest + OpenOfParabola(going_on, change);
  };
  double dissipation = 0.0, open_dissipation = 0.0;
  for (std::size_t i = 0; i < stage.contacts.size(); ++i) {
    const ContactState state = increment.contacts[i].state, was = before.contacts[i].state;
    const VerifiedContact& at = stage.contacts[i];
    const double forwards = stage.check.Slip(i, from_state, to_state), slip = std::abs(forwards);
    if (stage.total_law) {
      dissipation -= 0.5 * (before.contacts[i].rt + increment.contacts[i].rt) * forwards;
      // By this law a slip that turns round is no event. Where no increment before tells how the motion bends, it may
      // bend over half of L.
      const double forth_and_back = (arc_before > 0.0 ? 1.0 : kSharper) * bend * stage.scaling.length;
      const double most_slip = slip + forth_and_back;
      if (at.friction > 0.0) open_dissipation += open_force(i, &ContactRecord::rt, 1.0) * most_slip / unit;
      continue;
    }
    // Where within an increment by Ipopt it stopped to slip, or turned, is not known.
    if (!stage.located && Slips(was) && state != was)
      open_dissipation += at.friction * std::max(before.contacts[i].rn, increment.contacts[i].rn) * slip / unit;
    if (!Slips(state)) continue;
    // Where events are located, what has slipped the other way is rounding, and gives nothing back.
    const double sense = state == ContactState::kSlipPlus ? 1.0 : -1.0;
    const double along_state = stage.located ? std::max(0.0, sense * forwards) : slip;
    dissipation += 0.5 * at.friction * (before.contacts[i].rn + increment.contacts[i].rn) * along_state;
    open_dissipation += at.friction * open_force(i, &ContactRecord::rn, kWedged) * slip / unit;
  }
  // Parts take no more work than what they store and what contacts dissipate.
  const double stored = (std::abs(increment.strain_energy) + std::abs(before.strain_energy)) / unit;
  open_work += std::min(against_parts, stored + std::abs(dissipation) / unit + open_dissipation);
  return {work / unit, dissipation / unit, open_work, open_dissipation};
}

}  // namespace contact_path
