#include "verify/checks.h"

#include <utility>

namespace contact_path {
namespace {

// Of what a quadratic adds to the trapezoid: error of Simpson's rule. With the third state at t, not at the middle, the
// third derivative adds kThird |t - 1/2| to this share.
constexpr double kShare = 0.1;
constexpr double kThird = 4.0;
constexpr double kEnergy = 1e-2;  // of the work done: steps keep their energy balance, and their arc length, to less

}  // namespace

IntegralChecks::Recorded::Recorded(const Increment& before, const Increment& increment, const VerifiedStage& stage)
    : arc(increment.arc_length - before.arc_length),
      work((increment.external_work - before.external_work) / stage.Energy()),
      dissipation((increment.dissipation - before.dissipation) / stage.Energy()),
      stored((increment.strain_energy - before.strain_energy) / stage.Energy()),
      rounding(stage.rounding + kRoundingOfParts * stage.stiffest * arc) {}

bool IntegralChecks::GoesOn(const Increment& before, const Increment& at, const Increment& after) const {
  const bool passes = at.kind == IncrementKind::kRegular || at.kind == IncrementKind::kSample ||
                      at.kind == IncrementKind::kOnset || at.kind == IncrementKind::kSmoothLimit;
  if (!passes || after.kind == IncrementKind::kJump || !at.event.branches.empty() || !at.event.null_vector.empty())
    return false;
  if (!(at.arc_length > before.arc_length && after.arc_length > at.arc_length)) return false;
  for (std::size_t i = 0; i < at.contacts.size(); ++i)
    if (after.contacts[i].state != at.contacts[i].state) return false;
  return after.bars == at.bars;
}

void IntegralChecks::Check(const Increment* earlier, const Increment& before, const Increment& increment,
                           const Increment* after, bool next) {
  const Recorded recorded(before, increment, stage_);
  const ThreeStates ends = {StateOf(before), StateOf(increment), {}};
  const std::vector<double> motion = ScaledMotion(ends[0], ends[1], stage_.scene, stage_.scaling);
  const double chord = std::sqrt(Product(motion, motion));
  if (!(recorded.arc > 0.0)) {
    findings_.Bound("nodes move though the arc length does not grow", chord, std::max(stage_.rounding, kSingular));
    findings_.Bound("the load factor changes though the arc length does not", std::abs(motion.back()),
                    std::max(stage_.rounding, kExact));
    Compare(recorded, {}, increment, 0.0);
    return;
  }
  if (recorded.arc < chord * (1.0 - kExact) - stage_.rounding)
    findings_.Report("arc length grows by ", recorded.arc, ", less than the chord ", chord);
  if (!stage_.located) {
    // The trapezoids themselves are recorded.
    Integrals trapezoids = Integrate(ends, increment);
    open_ += trapezoids.work.open + trapezoids.dissipation.open;
    trapezoids.work.open = trapezoids.dissipation.open = 0.0;
    if (next) Compare(recorded, trapezoids, increment, stage_.rounding);
    return;
  }
  // Each state that can be the third gives a rule: the inner state, or else those before and after.
  std::vector<CheckedState> thirds;
  const bool inner = !increment.inner.positions.empty();
  if (inner && next) thirds.push_back(StateOf(increment.inner));
  if (!inner && next && earlier != nullptr && GoesOn(*earlier, before, increment)) thirds.push_back(StateOf(*earlier));
  if (!inner && next && after != nullptr && GoesOn(before, increment, *after)) thirds.push_back(StateOf(*after));
  Integrals integrals;
  for (std::size_t i = 0; i < thirds.size(); ++i) {
    const Integrals by = Integrate({ends[0], ends[1], std::move(thirds[i])}, increment);
    integrals.arc.Take(by.arc, i == 0);
    integrals.work.Take(by.work, i == 0);
    integrals.dissipation.Take(by.dissipation, i == 0);
    if (inner && !(by.t > 0.0 && by.t < 1.0)) findings_.Report("the inner state is not inside of the increment");
  }
  const double imbalance = std::abs(recorded.work - recorded.stored - recorded.dissipation);
  if (!thirds.empty()) {
    ++result_.proved_integrals;
    // What parts store and give back between three states the driving forces there need not show.
    if (!inner && stage_.Driven() && imbalance < std::abs(recorded.work - integrals.work.value))
      integrals.work.value = recorded.stored + recorded.dissipation;
    // The recorded arc length is of an interpolation, which is rougher where longer steps were not accepted.
    Compare(recorded, integrals, increment,
            kSingular + recorded.rounding + (increment.solve.rejected > 0 ? kEnergy * recorded.arc : 0.0));
    return;
  }
  ++result_.open_integrals;
  // An increment turns by less than 60 degrees, and its energies balance.
  if (next && recorded.arc > std::acos(0.5) * chord + kSingular)
    findings_.Report("arc length grows by ", recorded.arc, ", more than a curve with the chord ", chord, " would");
  const double exchanged = std::abs(recorded.work) + std::abs(recorded.stored) + std::abs(recorded.dissipation);
  // Along the boundary a contact of a body does not give way while it slides.
  double given = 0.0;
  for (std::size_t i = 0; i < increment.contacts.size(); ++i)
    if (before.contacts[i].state != increment.contacts[i].state)
      given += stage_.check.Give(i) * std::pow(stage_.check.GivesTo(i, ends[1]), 2) / stage_.Energy();
  open_ += given;
  findings_.Bound("energies of the increment are out of balance, over F L", imbalance,
                  kEnergy * exchanged + given +
                      recorded.rounding * (1.0 + std::abs(increment.strain_energy) / stage_.Energy()) +
                      kRoundingOfParts * std::abs(increment.external_work) / stage_.Energy());
}

void IntegralChecks::CheckJump(const Increment& last, const Increment* before, const Increment& landing,
                               double machine_stiffness) {
  const Recorded recorded(last, landing, stage_);
  const double energy = stage_.Energy(), released = landing.jump.energy_released / energy;
  const double exchanged = std::abs(recorded.work) + std::abs(recorded.stored) + std::abs(recorded.dissipation);
  const double rounding = kExact * exchanged + recorded.rounding * (1.0 + std::abs(landing.strain_energy) / energy) +
                          kRoundingOfParts * std::abs(landing.external_work) / energy;
  findings_.Bound("energy released is not what the jump leaves, over F L",
                  std::abs(recorded.work - recorded.stored - recorded.dissipation - released), rounding);
  findings_.Bound("energy released is negative, over F L", -released, kRecorded);
  if (before == nullptr) return;
  const ThreeStates ends = {StateOf(*before), StateOf(landing), {}};
  const std::vector<double> motion = ScaledMotion(ends[0], ends[1], stage_.scene, stage_.scaling);
  const double chord = std::sqrt(Product(motion, motion));
  findings_.Bound("arc length of the jump less its chord", std::abs(recorded.arc - chord),
                  kExact * chord + stage_.rounding);
  double size = 0.0;
  for (const Load& of : stage_.scene.loads)
    if (!of.constant) size += std::hypot(of.fx, of.fy, of.moment / stage_.scaling.length);
  const double of_motion =
      (kExact * chord + recorded.rounding) * (1.0 + size * stage_.scaling.load_factor / stage_.scaling.force);
  const double dead = motion.back();
  if (machine_stiffness == 0.0 || size == 0.0)
    findings_.Bound("the load factor changes in a jump under dead loads", std::abs(dead), stage_.rounding);
  findings_.Bound("the setting of the machine changes in a jump, over L",
                  std::abs(landing.setting - last.setting) / stage_.scaling.length,
                  kExact * std::abs(last.setting) / stage_.scaling.length + of_motion);
  // Forces of moving supports and obstacles are not linear along the way.
  if (stage_.Driven() && dead != 0.0) return;
  const Integral work = Work(ends, ThreePoints(0.0));
  findings_.Bound("work of the loads over a jump is off, over F L", std::abs(recorded.work - work.value),
                  rounding + of_motion * work.force);
}

void IntegralChecks::CheckSetting(const Increment& before, const Increment& increment, double machine_stiffness) {
  const double size = stage_.driving.size;
  if (machine_stiffness == 0.0 || size == 0.0) {
    if (increment.setting != 0.0) findings_.Report("a setting, though no machine loads the structure");
    return;
  }
  double work = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < stage_.driving.by_node.size(); ++i) {
    const auto& [fx, fy, moment] = stage_.driving.by_node[i];
    work += fx * (increment.positions[2 * i] - before.positions[2 * i]) +
            fy * (increment.positions[2 * i + 1] - before.positions[2 * i + 1]);
    if (moment != 0.0) work += moment * (increment.rotations[i] - before.rotations[i]);
    moved = std::max({moved, std::abs(increment.positions[2 * i]), std::abs(increment.positions[2 * i + 1])});
  }
  const double given = (increment.load_factor - before.load_factor) * size / machine_stiffness;
  const double unit = stage_.driving.moments_alone ? 1.0 : stage_.scaling.length;
  findings_.Bound("the setting is not that of the machine, over L",
                  std::abs(increment.setting - before.setting - work / size - given) / unit,
                  kExact * (1.0 + (std::abs(increment.setting) + moved + std::abs(given)) / unit) *
                      std::sqrt(static_cast<double>(stage_.driving.by_node.size())));
}

void IntegralChecks::Compare(const Recorded& recorded, const Integrals& anew, const Increment& increment,
                             double rounding_of_arc) {
  const auto compare = [&](const char* what, double is, const Integral& be, double sum, double rounding) {
    const double off = std::abs(is - be.value),
                 open = be.open + rounding * (1.0 + be.force) + kRoundingOfParts * std::abs(sum);
    if (!(off <= open)) findings_.Report(what, " is off by ", off, ", known to ", open);
  };
  compare("arc length", recorded.arc, anew.arc, increment.arc_length, rounding_of_arc);
  compare("work of the loads, over F L,", recorded.work, anew.work, increment.external_work / stage_.Energy(),
          recorded.rounding);
  compare("dissipation, over F L,", recorded.dissipation, anew.dissipation, increment.dissipation / stage_.Energy(),
          recorded.rounding);
}

IntegralChecks::Integrals IntegralChecks::Integrate(const ThreeStates& states, const Increment& increment) const {
  const std::vector<double> chord = ScaledMotion(states[0], states[1], stage_.scene, stage_.scaling);
  const double square = Product(chord, chord), length = std::sqrt(square);
  Integrals integrals;
  integrals.arc.value = length;
  double ratio = 0.0;  // of the bend of the quadratic curve, which is across its chord, to the chord
  if (!states[2].positions.empty() && square > 0.0) {
    const std::vector<double> third = ScaledMotion(states[0], states[2], stage_.scene, stage_.scaling);
    const double t = integrals.t = Product(third, chord) / square;
    ratio = std::sqrt(std::max(0.0, Product(third, third) / square - t * t)) / std::abs(t * (1.0 - t));
  }
  const ThreePoints rule(integrals.t);
  integrals.work = Work(states, rule);
  integrals.dissipation = Dissipation(states, rule, increment);
  if (ratio > 0.0) integrals.arc.value *= 0.5 * (std::hypot(1.0, ratio) + std::asinh(ratio) / ratio);
  const double beside = std::abs(integrals.t - 0.5);
  integrals.arc.open = (1.0 + beside) * (integrals.arc.value - length);
  const double share = rule.HasThird() ? kShare + kThird * beside : 1.0;
  integrals.work.open *= share;
  integrals.dissipation.open *= share;
  return integrals;
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
    const ThreeValues motion = along([&](const CheckedState& state) {
      const double moment = of.moment != 0.0 ? of.moment * (state.rotations[node] - states[0].rotations[node]) : 0.0;
      return of.fx * (state.positions[2 * node] - states[0].positions[2 * node]) +
             of.fy * (state.positions[2 * node + 1] - states[0].positions[2 * node + 1]) + moment;
    });
    const double size = std::hypot(of.fx, of.fy, of.moment / stage_.scaling.length);
    work.Add(rule.Of(of.constant ? ThreeValues{1.0, 1.0, 1.0} : load, motion));
    work.force += size * (of.constant ? 1.0 : std::max(std::abs(load[0]), std::abs(load[1])));
  }
  if (stage_.Driven())
    work.Add(rule.Of(along([&](const CheckedState& state) { return stage_.check.DrivingForce(state); }), load));
  // What changes the friction of a contact that gives way works on what it stores.
  for (std::size_t i = 0; i < stage_.contacts.size(); ++i)
    if (const double give = stage_.check.Give(i);
        give > 0.0 && stage_.check.Friction(i, states[0]) != stage_.check.Friction(i, states[1]))
      work.open += give * std::abs(states[1].rt[i] * stage_.check.GivesTo(i, states[1]));
  return {work.value / stage_.Energy(), work.open / stage_.Energy(), work.force / stage_.scaling.force};
}

Integral IntegralChecks::Dissipation(const ThreeStates& states, const ThreePoints& rule,
                                     const Increment& increment) const {
  Integral dissipation;
  const bool total_law = stage_.configuration.HasTotalLaw();
  const double t = rule.t();
  for (std::size_t i = 0; i < stage_.contacts.size(); ++i) {
    const ContactState state = increment.contacts[i].state;
    if (!total_law && stage_.located && !Slips(state)) continue;
    const double sense = !total_law && state == ContactState::kSlipMinus ? -1.0 : 1.0;
    const auto slip_between = [&](std::size_t from, std::size_t to) {
      return sense * stage_.check.Slip(i, states[from], states[to]);
    };
    ThreeValues force{}, slip{0.0, slip_between(0, 1), 0.0};
    for (std::size_t k = 0; k < (rule.HasThird() ? 3 : 2); ++k)
      force[k] = total_law ? -states[k].rt[i] : stage_.check.SlidingForce(i, states[k]);
    double across = 0.0;
    if (rule.HasThird()) {
      // On a surface that deforms, slip is a mean of two lengths, with an error of third order.
      slip[2] = slip_between(0, 2);
      across = (slip[1] - slip[2] - slip_between(2, 1)) / (3.0 * t * (1.0 - t));
      slip[1] -= across;
      slip[2] -= across * t * t * t;
    }
    Integral of = rule.Of(force, slip);
    // What has slipped the other way is rounding, and gives nothing back.
    if (!total_law) of.value = Slips(state) ? std::max(stage_.located ? 0.0 : -of.value, of.value) : 0.0;
    of.open += std::abs(0.5 * (force[0] + force[1]) * across);
    of.force = std::max(std::abs(force[0]), std::abs(force[1]));
    // Where in an increment by Ipopt a slip has come to its end is not known.
    if (!total_law && !Slips(state)) of.open = of.force * std::abs(slip[1]);
    dissipation.Add(of);
  }
  return {dissipation.value / stage_.Energy(), dissipation.open / stage_.Energy(),
          dissipation.force / stage_.scaling.force};
}

void IntegralChecks::CheckEnergy(const Increment& start, const Increment& increment) {
  if (increment.kind == IncrementKind::kJump) released_ += increment.jump.energy_released / stage_.Energy();
  // What trapezoids leave open is known up to the last increment with a state.
  if (!balanced_ || (!stage_.located && increment.positions.empty())) return;
  const double unit = stage_.Energy();
  // Work of the reactions along the gaps that may be left, or penetrated, and of those that may be left at open gaps.
  double reactions = 0.0, left_open = 0.0;
  for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
    const ContactRecord& contact = increment.contacts[i];
    // What contacts that give way have stored may be lost where one begins to slide.
    if (increment.kind != IncrementKind::kRegular && stage_.check.Give(i) > 0.0)
      given_ += stage_.check.Give(i) *
                (contact.rn * contact.rn + std::pow(stage_.check.GivesTo(i, StateOf(increment)), 2)) / unit;
    reactions += std::abs(contact.rn);
    if (contact.gap > kExact * stage_.scaling.length) left_open += std::hypot(contact.rn, contact.rt);
  }
  const double moved = increment.arc_length - start.arc_length;
  if (!stage_.located) pressed_ = std::max(pressed_, (kExact * reactions + left_open * moved) / stage_.scaling.force);
  const double balance =
      (increment.external_work - start.external_work - (increment.strain_energy - start.strain_energy) -
       (increment.dissipation - start.dissipation)) /
          unit -
      released_;
  const double rounding =
      stage_.rounding * (1.0 + std::abs(increment.strain_energy) / unit) + kRoundingOfParts * stage_.stiffest * moved;
  result_.energy_balance = std::max(result_.energy_balance, std::abs(balance));
  balanced_ = std::abs(balance) <= kEnergy * result_.work + open_ + pressed_ + given_ + rounding;
  if (!balanced_)
    findings_.Report("energy balance: ", balance, " of F L, with ", result_.work, " of work done on the whole path");
}

}  // namespace contact_path
