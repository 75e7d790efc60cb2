#include "verify/checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/tendon_route.h"

namespace contact_path {
namespace {

constexpr double kRegularised = 1e-5;  // residuals of a regularised increment
constexpr double kPullShare = 0.02;    // of the largest reaction before: a contact that pulls with more is wrong

// For a person: "slipping forwards".
const char* NameOf(ContactState state) {
  switch (state) {
    case ContactState::kOpen: return "open";
    case ContactState::kClosed: return "closed";
    case ContactState::kStick: return "sticking";
    case ContactState::kSlipPlus: return "slipping forwards";
    case ContactState::kSlipMinus: return "slipping backwards";
  }
  return "";
}

void Keep(const Residuals& residuals, Residuals* largest) {
  for (double Residuals::*const field : Residuals::kAll) largest->*field = std::max(largest->*field, residuals.*field);
}

}  // namespace

void PointChecks::Check(const Increment* before, const Increment& increment) {
  ++result_.full_increments;
  if (increment.solve.exact) ++result_.exact_increments;
  if (stage_.located && !increment.solve.exact) findings_.Report("an increment that ends at events and is not exact");
  const bool next = before == nullptr || before->index + 1 == increment.index;
  const Increment& from = before != nullptr ? *before : increment;
  const Residuals residuals = stage_.check.Check(StateOf(from), StateOf(increment));
  CheckState(from, increment, next || stage_.located, residuals);
  CheckRecorded(increment, residuals, next);
  if (!increment.inner.positions.empty()) CheckInner(from, increment);
}

void PointChecks::CheckInner(const Increment& before, const Increment& increment) {
  Increment at;
  at.index = increment.index;
  at.load_factor = increment.inner.load_factor;
  at.arc_length = increment.arc_length;
  at.positions = increment.inner.positions;
  at.rotations = increment.inner.rotations;
  at.contacts = increment.inner.contacts;
  at.pins = increment.inner.pins;
  at.bars = increment.bars;
  at.solve.exact = true;
  CheckState(before, at, true, stage_.check.Check(StateOf(before), StateOf(at)));
  for (std::size_t i = 0; i < at.contacts.size(); ++i)
    if (at.contacts[i].state != increment.contacts[i].state)
      findings_.Report(stage_.contacts[i].name, " has another state inside the increment");
}

void PointChecks::CheckState(const Increment& before, const Increment& at, bool in_one_piece,
                             const Residuals& residuals) {
  CheckPull(at);
  const double tolerance = at.solve.exact ? kExact : kRegularised;
  findings_.Bound("equilibrium residual", residuals.equilibrium, tolerance);
  findings_.Bound("penetration", residuals.penetration, tolerance);
  if (!at.pins.empty()) findings_.Bound("distance of the nodes of a pin", residuals.support, tolerance);
  findings_.Bound("tensile_reaction", residuals.tensile_reaction, tolerance);
  findings_.Bound("gap and reaction are both positive", residuals.complementarity, tolerance);
  findings_.Bound("reaction outside of the friction cone", residuals.cone, tolerance);
  if (in_one_piece) findings_.Bound("friction law", residuals.friction_law, tolerance);
  Keep(residuals, at.solve.exact ? &result_.exact : &result_.regularised);
  CheckSupports(at);
  // Where a point is repeated, as of a node between two discs, its place is known to no more.
  const bool repeated = &before != &at && !(at.arc_length > before.arc_length);
  const double tolerance_of_slip = repeated ? std::max(tolerance, kSingular) : tolerance;
  const CheckedState from = StateOf(before), to = StateOf(at);
  for (std::size_t i = 0; i < at.contacts.size(); ++i) {
    // What the law of friction is about; 0 where that is not known.
    double slip = 0.0;
    if (stage_.configuration.HasTotalLaw() && stage_.contacts[i].friction > 0.0)
      slip = stage_.check.TotalSlip(i, to);
    else if (in_one_piece)
      slip = stage_.check.Slip(i, from, to) +
             stage_.check.Give(i) * (stage_.check.GivesTo(i, to) - stage_.check.GivesTo(i, from));
    CheckContact(i, at.contacts[i], to, slip / stage_.scaling.length, tolerance, tolerance_of_slip);
  }
  if (at.solve.exact) CheckSoftContacts(at);
  CheckBars(at, tolerance);
}

void PointChecks::CheckBars(const Increment& at, double tolerance) {
  const std::vector<OneSidedBar> bars = OneSidedBars(stage_.scene);
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const OneSidedBar& bar = bars[k];
    std::vector<int> nodes;
    for (const std::string& name : *bar.nodes) nodes.push_back(static_cast<int>(stage_.index.Node(name)));
    const TendonRoute route =
        RouteOf(bar.tendon != nullptr ? *bar.tendon : Tendon(), PointsOf(nodes, stage_.configuration.reference));
    double rest = bar.rest_length > 0.0 ? bar.rest_length : route.length;
    std::array<double, 2> turned = {};
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      if (bar.tendon == nullptr) continue;
      if (const std::string& slide = bar.tendon->slides[end]; !slide.empty()) {
        const std::size_t node = stage_.index.Node(slide);
        rest += (end == 0 ? 1.0 : -1.0) * (at.positions[2 * node] - stage_.scene.nodes[node].x);
      }
      if (const std::string& body = BodyOfDrum(*bar.tendon, end, stage_.scene, stage_.index); !body.empty())
        turned[end] = at.rotations[stage_.index.Node(body)];
    }
    const double longer = (LengthOn(route, PointsOf(nodes, at.positions), turned) - rest) / stage_.scaling.length;
    const bool taut = at.bars[k] == BarState::kTaut;
    if ((bar.sense == BarSense::kTension) == taut ? longer < -tolerance : longer > tolerance)
      findings_.Report("bar ", bar.name, " is recorded as ", ToString(at.bars[k]), ", but is not");
  }
}

void PointChecks::CheckSupports(const Increment& at) {
  for (std::size_t i = 0; i < stage_.scene.nodes.size(); ++i) {
    const Node& node = stage_.scene.nodes[i];
    const auto off = [&](std::size_t k) {
      return std::abs(at.positions[k] - stage_.configuration.start[k] - stage_.rates[k] * at.load_factor) /
                 stage_.scaling.length >
             stage_.rounding;
    };
    if ((node.fixed_x && off(2 * i)) || (node.fixed_y && off(2 * i + 1)))
      findings_.Report("support ", node.name, " is not where it has to be");
    if (node.fixed_rotation && !(std::abs(at.rotations[i] - stage_.configuration.start_rotations[i] -
                                          stage_.turn_rates[i] * at.load_factor) <= stage_.rounding))
      findings_.Report("support ", node.name, " is not turned as it has to be");
  }
}

void PointChecks::CheckContact(std::size_t i, const ContactRecord& contact, const CheckedState& state, double slip,
                               double tolerance, double tolerance_of_slip) {
  const VerifiedContact& at = stage_.contacts[i];
  const double length = stage_.scaling.length, recorded = contact.gap / length;
  const double gap = stage_.check.Gap(i, state) / length, past_end = stage_.check.GapPastEnd(i, state) / length;
  findings_.Bound("recorded gap of " + at.name + " less the true one",
                  std::min(std::abs(recorded - gap), std::abs(recorded - past_end)), stage_.rounding);
  const double rn = contact.rn / stage_.scaling.force, rt = contact.rt / stage_.scaling.force;
  bool holds = contact.state == ContactState::kOpen
                   ? std::max(std::abs(rn), std::abs(rt)) <= tolerance
                   : std::abs(gap + stage_.check.Give(i) / length * contact.rn) <= tolerance;
  if (contact.state == ContactState::kClosed) holds = holds && std::abs(rt) <= tolerance && at.friction == 0.0;
  if (contact.state == ContactState::kStick) holds = holds && std::abs(slip) <= tolerance_of_slip;
  if (Slips(contact.state)) {
    const double sense = contact.state == ContactState::kSlipPlus ? 1.0 : -1.0,
                 bound = stage_.check.Friction(i, state) * rn;
    // A friction force that is rounding tells no sense of the slip.
    const bool rubs = bound > at.closing * at.unit;
    holds = holds && (!rubs || sense * slip >= -tolerance_of_slip) && std::abs(rt + sense * bound) <= tolerance;
  }
  if (!holds) findings_.Report(at.name, " is recorded as ", NameOf(contact.state), ", but is not");
}

void PointChecks::CheckRecorded(const Increment& increment, const Residuals& residuals, bool with_law) {
  const auto same = [&](const char* what, double recorded, double anew, double rounding = 0.0) {
    if (!(std::abs(recorded - anew) <= stage_.rounding * (1.0 + std::abs(anew)) + rounding))
      findings_.Report(what, " is recorded as ", recorded, ", but is ", anew);
  };
  same("equilibrium residual", increment.residuals.equilibrium, residuals.equilibrium);
  same("penetration residual", increment.residuals.penetration, residuals.penetration);
  same("tensile_reaction residual", increment.residuals.tensile_reaction, residuals.tensile_reaction);
  same("min form residual", increment.residuals.complementarity, residuals.complementarity);
  same("cone residual", increment.residuals.cone, residuals.cone);
  same("support residual", increment.residuals.support, residuals.support);
  if (with_law) same("friction law residual", increment.residuals.friction_law, residuals.friction_law);
  const CheckedState state = StateOf(increment);
  double given = 0.0;  // to contacts and pins that give way
  for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
    const ContactRecord& contact = increment.contacts[i];
    const double rt = contact.state == ContactState::kStick ? contact.rt : 0.0;
    given += 0.5 * stage_.check.Give(i) * (contact.rn * contact.rn + rt * stage_.check.GivesTo(i, state));
  }
  for (std::size_t i = 0; i < increment.pins.size(); ++i)
    given += 0.5 * stage_.check.GiveOfPin(i) * (std::pow(increment.pins[i].rx, 2) + std::pow(increment.pins[i].ry, 2));
  same("scaled strain energy", increment.strain_energy / stage_.Energy(),
       (stage_.check.StrainEnergy(increment.positions, increment.rotations) + given) / stage_.Energy(),
       std::numeric_limits<double>::epsilon() * stage_.stiffest);
  CheckForces(increment);
}

void PointChecks::CheckForces(const Increment& increment) {
  const CheckedState state = StateOf(increment);
  const double force = stage_.scaling.force, length = stage_.scaling.length, stress = force / (length * length);
  const double rounding = kRoundingOfParts * stage_.stiffest;
  bool found = false;  // one finding tells enough
  // part: what the number is of. off: of the unit, what rounding may leave. The normal of a sharp corner is known less
  // well than the place of the node.
  const auto same = [&](std::string_view name, const char* part, std::size_t i, double is, double be, double unit,
                        double off) {
    if (found || std::abs(is - be) / unit <= kExact * (1.0 + std::abs(be) / unit) + off) return;
    found = true;
    findings_.Report(name, " of ", part, " ", i + 1, " is recorded as ", is, ", but is ", be);
  };
  // All fields of a record; those from the place `moments` on are moments or energies.
  const auto same_record = [&](const char* part, std::size_t i, const auto& is, const auto& be, std::size_t moments,
                               double unit, double off) {
    std::size_t k = 0;
    ForEachField<std::decay_t<decltype(is)>>([&](const auto& field) {
      const bool is_moment = k >= moments;
      same(field.name, part, i, is.*field.member, be[k++], is_moment ? force * length : unit,
           is_moment ? std::max(rounding, off) : off);
    });
  };
  const CheckedForces forces = stage_.check.Forces(state);
  const double of_contacts = rounding + stage_.check.Uncertain(state) / force;
  for (std::size_t i = 0; i < forces.supports.size(); ++i)
    same_record("support", i, increment.supports[i], forces.supports[i], 2, force, of_contacts);
  for (std::size_t i = 0; i < forces.boundaries.size(); ++i)
    same_record("boundary", i, increment.boundaries[i], forces.boundaries[i], 2, force, of_contacts);
  for (std::size_t i = 0; i < increment.pins.size(); ++i) {
    const Pin& pin = stage_.scene.pins[i];
    const auto turn = [&](const std::string& node) {
      const Node& at = stage_.scene.nodes[stage_.index.Node(node)];
      return pin.stiffness > 0.0 ? increment.rotations[stage_.index.Node(TurnsWith(at))] : 0.0;
    };
    const double moment = pin.stiffness * (turn(pin.nodes[1]) - turn(pin.nodes[0]) - pin.angle);
    same("rm", "pin", i, increment.pins[i].rm, moment, force * length, rounding);
  }
  if (increment.sections.empty() && increment.stresses.empty() && increment.pressures.empty()) return;
  const CheckedAnswers anew = stage_.check.Answers(state);
  for (std::size_t i = 0; i < increment.sections.size(); ++i)
    same_record("section", i, increment.sections[i], anew.sections[i], 2, force, rounding);
  for (std::size_t i = 0; i < increment.stresses.size(); ++i)
    same_record("element", i, increment.stresses[i], anew.stresses[i], 5, stress,
                anew.stress_per_motion[i] * kRoundingOfParts * length / stress);
  std::vector<double> widths(increment.widths.size());
  for (std::size_t i = 0; i < increment.pressures.size(); ++i) {
    const ContactPressure& of = increment.pressures[i];
    const ContactRecord& contact = increment.contacts[i];
    const double be = anew.lengths[i], unit = force / (be > 0.0 ? be : length);
    same("length", "contact", i, of.length, be, length, rounding);
    same("pressure", "contact", i, of.pressure, be > 0.0 ? contact.rn / be : 0.0, unit, rounding);
    same("traction", "contact", i, of.traction, be > 0.0 ? contact.rt / be : 0.0, unit, rounding);
    if (contact.state != ContactState::kOpen && be > 0.0) widths[anew.boundaries[i]] += be;
  }
  for (std::size_t i = 0; i < widths.size(); ++i)
    same("width", "boundary", i, increment.widths[i], widths[i], length, rounding);
}

void PointChecks::CheckSoftContacts(const Increment& increment) {
  const CheckedState state = StateOf(increment);
  std::vector<double> unbalance;
  for (std::size_t i = 0; i < stage_.contacts.size(); ++i) {
    const VerifiedContact& at = stage_.contacts[i];
    if (at.unit == 1.0) continue;
    if (unbalance.empty()) unbalance = stage_.check.Unbalance(state);
    const Node& node = stage_.scene.nodes[at.node];
    const double unit = at.unit * stage_.scaling.force;
    const double rn = increment.contacts[i].rn / unit, rt = increment.contacts[i].rt / unit;
    const std::array<double, 2> normal = stage_.check.Normal(i, state);
    const double fx = node.fixed_x ? 0.0 : normal[0] * unbalance[2 * at.node];
    const double fy = node.fixed_y ? 0.0 : normal[1] * unbalance[2 * at.node + 1];
    findings_.Bound("equilibrium residual across " + at.name + ", of the forces there", std::abs(fx + fy) / unit,
                    kExact);
    findings_.Bound("tensile reaction of " + at.name + ", of the forces there", -rn, kExact);
    findings_.Bound("gap and reaction of " + at.name + " are both positive",
                    std::min(increment.contacts[i].gap / stage_.scaling.length, rn), kExact);
    findings_.Bound("reaction of " + at.name + " outside of the friction cone, of the forces there",
                    std::abs(rt) - stage_.check.Friction(i, state) * rn, kExact);
  }
}

void PointChecks::CheckPull(const Increment& at) {
  const auto push_of = [&](std::size_t i) {
    return at.contacts[i].rn / (stage_.contacts[i].unit * stage_.scaling.force);
  };
  for (std::size_t i = 0; i < at.contacts.size(); ++i)
    result_.largest_reaction = std::max(result_.largest_reaction, push_of(i));
  for (std::size_t i = 0; i < at.contacts.size(); ++i) {
    // Where another path crosses, a point is known to less than rounding; and what contacts have pushed with in a
    // preload is not recorded.
    const bool known = at.event.null_vector.empty() && at.index > 0;
    const double rounding = known ? stage_.contacts[i].closing : std::max(stage_.contacts[i].closing, kExact);
    const double most = std::max(rounding, kPullShare * result_.largest_reaction);
    if (-push_of(i) > most)
      findings_.Report(stage_.contacts[i].name, " pulls with ", -push_of(i),
                       " of the forces there, where contacts push with at most ", result_.largest_reaction);
  }
}

}  // namespace contact_path
