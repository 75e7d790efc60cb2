#include "verify/integral_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "verify/scaled_motion.h"

namespace contact_path {
namespace {

// Of what a quadratic adds to the trapezoid: error of Simpson's rule. With the third state at t, not at the middle, the
// third derivative adds to the error in proportion to |t - 1/2|.
constexpr double kShare = 0.1;
constexpr double kEnergy = 1e-2;  // of the work done: steps of the path keep their energy balance to less

// Scaled, with the load factor last.
std::vector<double> MotionWithLoad(const CheckedState& from, const CheckedState& to, const Scaling& scaling) {
  std::vector<double> motion = ScaledMotion(from, to, scaling.length);
  motion.push_back((to.load_factor - from.load_factor) / scaling.load_factor);
  return motion;
}

double Product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

bool IntegralChecks::GoesOn(const Increment& before, const Increment& at, const Increment& after) const {
  const bool passes =
      at.kind == IncrementKind::kRegular || at.kind == IncrementKind::kSample || at.kind == IncrementKind::kSmoothLimit;
  if (!passes || !at.event.branches.empty() || !at.event.null_vector.empty()) return false;
  if (!(at.arc_length > before.arc_length && after.arc_length > at.arc_length)) return false;
  for (std::size_t i = 0; i < at.contacts.size(); ++i)
    if (after.contacts[i].state != at.contacts[i].state ||
        (!stage_.located && before.contacts[i].state != at.contacts[i].state))
      return false;
  return true;
}

void IntegralChecks::Check(const Increment* earlier, const Increment& before, const Increment& increment,
                           const Increment* after, bool in_one_piece) {
  ThreeStates states = {StateOf(before), StateOf(increment), {}};
  if (stage_.located && !increment.inner.positions.empty())
    states[2] = StateOf(increment.inner);
  else if (earlier != nullptr && GoesOn(*earlier, before, increment))
    states[2] = StateOf(*earlier);
  else if (after != nullptr && GoesOn(before, increment, *after))
    states[2] = StateOf(*after);
  const std::vector<double> chord = MotionWithLoad(states[0], states[1], stage_.scaling);
  const double square = Product(chord, chord), length = std::sqrt(square);
  const double arc = increment.arc_length - before.arc_length;
  const double rounding = stage_.rounding + kRoundingOfParts * stage_.stiffest * arc;
  const double work = (increment.external_work - before.external_work) / stage_.Energy();
  const double dissipation = (increment.dissipation - before.dissipation) / stage_.Energy();
  if (!(arc > 0.0)) {
    findings_.Bound("arc length does not grow, but the chord is", length, std::max(stage_.rounding, kSingular));
    findings_.Bound("the load factor changes though the arc length does not", std::abs(chord.back()),
                    std::max(stage_.rounding, kExact));
    findings_.Bound("work of the loads where nothing moves", std::abs(work), rounding);
    findings_.Bound("dissipation where nothing moves", std::abs(dissipation), rounding);
    return;
  }
  double t = 0.0, bend_square = 0.0;
  if (!states[2].positions.empty() && square > 0.0) {
    const std::vector<double> third = MotionWithLoad(states[0], states[2], stage_.scaling);
    t = Product(third, chord) / square;
    // The quadratic curve bends across its chord.
    const double across = t * (1.0 - t);
    bend_square = std::max(0.0, Product(third, third) - t * t * square) / (across * across);
  }
  const ThreePoints rule(t);
  const Integral w = Work(states, rule), d = Dissipation(states, rule, increment);
  const double error = kShare + std::abs(t - 0.5);
  const double ratio = length > 0.0 ? std::sqrt(bend_square) / length : 0.0;
  const double curve = ratio > 0.0 ? 0.5 * length * (std::hypot(1.0, ratio) + std::asinh(ratio) / ratio) : length;
  if (std::getenv("VERIFY_DEBUG") != nullptr)
    std::fprintf(stderr,
                 "DBG %d loc%d t=%.4g arc=%.3g | %.3g %.3g | work %.3g off %.3g bulge %.3g | diss %.3g off %.3g bulge "
                 "%.3g | round %.3g\n",
                 increment.index, stage_.located, t, arc, arc - curve, curve - length, work, std::abs(work - w.value),
                 w.bulge, dissipation, std::abs(dissipation - d.value), d.bulge, rounding);
  if (!stage_.located) return;
  if (!rule.HasThird()) {
    ++result_.open_integrals;
    return;
  }
  ++result_.proved_integrals;
  if (!(std::abs(arc - curve) <= error * (curve - length) + rounding))
    findings_.Report("arc length grows by ", arc, ", but the curve through recorded states is ", curve, " long");
  if (!(std::abs(work - w.value) <= error * w.bulge + rounding))
    findings_.Report("work of the loads is off by ", std::abs(work - w.value), " of F L");
  if (!(std::abs(dissipation - d.value) <= error * d.bulge + rounding))
    findings_.Report("dissipation is off by ", std::abs(dissipation - d.value), " of F L");
}

Integral IntegralChecks::Work(const ThreeStates& states, const ThreePoints& rule) const {
  Integral work;
  const auto along = [&](auto function) {
    ThreeValues values{};
    for (std::size_t k = 0; k < (rule.HasThird() ? 3 : 2); ++k) values[k] = function(states[k]);
    return values;
  };
  const ThreeValues load = along([](const CheckedState& state) { return state.load_factor; });
  for (const Load& of : stage_.scene.loads) {
    const std::size_t node = stage_.index.Node(of.node);
    const auto moved = [&](const std::vector<double>& of_nodes, const std::vector<double>& start, std::size_t k) {
      return of_nodes[k] - start[k];
    };
    const ThreeValues motion = along([&](const CheckedState& state) {
      return of.fx * moved(state.positions, states[0].positions, 2 * node) +
             of.fy * moved(state.positions, states[0].positions, 2 * node + 1) +
             (of.moment != 0.0 ? of.moment * moved(state.rotations, states[0].rotations, node) : 0.0);
    });
    work.Add(rule.Of(of.constant ? ThreeValues{1.0, 1.0, 1.0} : load, motion));
  }
  if (!stage_.scene.support_motions.empty() || !stage_.scene.obstacle_motions.empty())
    work.Add(rule.Of(along([&](const CheckedState& state) { return stage_.check.DrivingForce(state); }), load));
  return {work.value / stage_.Energy(), work.bulge / stage_.Energy()};
}

Integral IntegralChecks::Dissipation(const ThreeStates& states, const ThreePoints& rule,
                                     const Increment& increment) const {
  Integral dissipation;
  const bool total_law = stage_.configuration.HasTotalLaw();
  for (std::size_t i = 0; i < stage_.contacts.size(); ++i) {
    const ContactState state = increment.contacts[i].state;
    if (!total_law && !Slips(state)) continue;
    ThreeValues force{}, slip{};
    const double sense = !total_law && state == ContactState::kSlipMinus ? -1.0 : 1.0;
    for (std::size_t k = 0; k < (rule.HasThird() ? 3 : 2); ++k) {
      force[k] = total_law ? -states[k].rt[i] : stage_.contacts[i].friction * states[k].rn[i];
      slip[k] = k == 0 ? 0.0 : sense * stage_.check.Slip(i, states[0], states[k]);
    }
    dissipation.Add(rule.Of(force, slip));
  }
  return {dissipation.value / stage_.Energy(), dissipation.bulge / stage_.Energy()};
}

void IntegralChecks::CheckEnergy(const Increment& start, const Increment& increment) {
  if (!balanced_) return;
  const double unit = stage_.Energy();
  // Work of the reactions along the gaps that may be left, or penetrated, and of those that may be left at open gaps.
  double reactions = 0.0, left_open = 0.0;
  for (const ContactRecord& contact : increment.contacts) {
    reactions += std::abs(contact.rn);
    if (contact.gap > kExact * stage_.scaling.length) left_open += std::hypot(contact.rn, contact.rt);
  }
  const double moved = increment.arc_length - start.arc_length;
  if (!stage_.located) pressed_ = std::max(pressed_, (kExact * reactions + left_open * moved) / stage_.scaling.force);
  const double balance =
      (increment.external_work - start.external_work - (increment.strain_energy - start.strain_energy) -
       (increment.dissipation - start.dissipation)) /
      unit;
  const double rounding =
      stage_.rounding * (1.0 + std::abs(increment.strain_energy) / unit) + kRoundingOfParts * stage_.stiffest * moved;
  result_.energy_balance = std::max(result_.energy_balance, std::abs(balance));
  balanced_ = std::abs(balance) <= kEnergy * result_.work + open_ + pressed_ + rounding;
  if (!balanced_)
    findings_.Report("energy balance: ", balance, " of F L, with ", result_.work, " of work done on the whole path");
}

}  // namespace contact_path
