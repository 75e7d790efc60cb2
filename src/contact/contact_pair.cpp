#include "contact_path/contact/contact_pair.h"

#include <cmath>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

LimitRule OfMotion(ContactLimit limit, LimitRule::Of of, std::size_t port, double sign, ContactState next) {
  LimitRule rule;
  rule.id = NumberOf(limit);
  rule.of = of;
  rule.port = port;
  rule.sign = sign;
  rule.next = NumberOf(next);
  return rule;
}

LimitRule OfForces(ContactLimit limit, const PortReals& weights, double unit, ContactState next) {
  LimitRule rule;
  rule.id = NumberOf(limit);
  rule.of = LimitRule::Of::kForces;
  rule.weights = weights;
  rule.unit = unit;
  rule.next = NumberOf(next);
  return rule;
}

constexpr double kCoordinate = 1e-15;  // known to so much, scaled

}  // namespace

double ContactPair::ForceUnitOf(double compliance) {
  return std::exp2(std::ceil(std::log2(kCoordinate / (compliance * tolerances::kActive))));
}

void ContactPair::SetContact(Traits traits, const SurfaceTraits& surface_traits) {
  surface_traits_ = surface_traits;
  traits.num_ports = 2;
  traits.holonomic = surface_traits.slip_origin.has_value();
  const double mu = traits.largest_ratio;
  // NormalForceUnit() is of these traits.
  SetLaw(traits, {});
  const double unit = ForceUnit();
  const PortRule held = {PortRule::Kind::kHeld, 0.0, surface_traits.compliance};
  const double along = surface_traits.tangent_gives ? surface_traits.compliance : 0.0;
  const LimitRule bears = OfForces(ContactLimit::kNormalReaction, {1.0, 0.0}, NormalForceUnit(), ContactState::kOpen);
  std::vector<StateRule> states(5);
  const auto set = [&](ContactState state, std::initializer_list<PortRule> ports, std::vector<LimitRule> limits) {
    StateRule& rule = states[static_cast<std::size_t>(state)];
    std::copy(ports.begin(), ports.end(), rule.ports.begin());
    rule.limits = std::move(limits);
    if (PatchesEnd() && (state != ContactState::kStick || surface_traits_.rolls))
      for (const bool begin : {true, false})
        rule.limits.push_back(OfMotion(begin ? ContactLimit::kPatchBegin : ContactLimit::kPatchEnd,
                                       LimitRule::Of::kPiece, FootPort(), begin ? 1.0 : -1.0, state));
    rule.held = NumberOf(Slips(state) ? ContactState::kStick : state);
    rule.symmetric = !Slips(state) && (state != ContactState::kStick || (!traits.holonomic && !traits.curved));
  };
  set(ContactState::kStick, {held, {PortRule::Kind::kHeld, 0.0, along}},
      {bears, OfForces(ContactLimit::kConePlus, {mu, 1.0}, unit, ContactState::kSlipPlus),
       OfForces(ContactLimit::kConeMinus, {mu, -1.0}, unit, ContactState::kSlipMinus)});
  for (const double sense : {1.0, -1.0}) {
    LimitRule slides = OfMotion(traits.holonomic ? ContactLimit::kTotalSlip : ContactLimit::kSlip,
                                traits.holonomic ? LimitRule::Of::kMotion : LimitRule::Of::kMotionRate, kTangent, sense,
                                ContactState::kStick);
    if (slides.OfRate()) slides.compliance = along;
    set(sense > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus,
        {held, {PortRule::Kind::kFollows, -sense * mu, 0.0}}, {bears, slides});
  }
  set(ContactState::kClosed, {held}, {bears});
  set(ContactState::kOpen, {},
      {OfMotion(ContactLimit::kGap, LimitRule::Of::kMotion, kNormal, 1.0,
                mu > 0.0 ? ContactState::kStick : ContactState::kClosed)});
  SetLaw(traits, std::move(states));
}

void ContactPair::AddLimits(const Mode& mode, int law, std::vector<Limit>* limits) const {
  if (StateOf(mode) == ContactState::kOpen) {
    // Past the ends of an open surface there is nothing to touch.
    if (mode.piece == kNearestPatch || HasPatch(mode.piece)) limits->push_back({law, NumberOf(ContactLimit::kGap)});
    return;
  }
  for (const LimitRule& rule : In(mode).limits)
    if (!rule.OfPiece()) limits->push_back({law, rule.id});
  if (StateOf(mode) != ContactState::kStick || surface_traits_.rolls) AddPatchEnds(mode, law, limits);
}

void ContactPair::AddPatchEnds(const Mode& mode, int law, std::vector<Limit>* limits) const {
  if (!PatchesEnd() || mode.piece == kNearestPatch) return;
  const XiRange range = RangeOf(mode.piece);
  if (std::isfinite(range.begin)) limits->push_back({law, NumberOf(ContactLimit::kPatchBegin)});
  if (std::isfinite(range.end)) limits->push_back({law, NumberOf(ContactLimit::kPatchEnd)});
}

double ContactPair::BoundOf(const Mode& mode, int id) const {
  const XiRange range = RangeOf(mode.piece);
  return id == NumberOf(ContactLimit::kPatchBegin) ? range.begin : range.end;
}

Mode ContactPair::Next(const Mode& mode, int id) const {
  Mode next = Law::Next(mode, id);
  if (id == NumberOf(ContactLimit::kPatchBegin)) --next.piece;
  if (id == NumberOf(ContactLimit::kPatchEnd)) ++next.piece;
  return next;
}

Mode ContactPair::NextAt(const Eigen::VectorXd& u, double s, const Mode& mode, int id) const {
  Mode next = Next(mode, id);
  if (id == NumberOf(ContactLimit::kGap)) next.piece = PatchOfTouching(PatchAt(u, s));
  if (Rule(mode.state, id).OfPiece() && !HasPatch(next.piece)) next.state = NumberOf(ContactState::kOpen);
  if (StateOf(next) == ContactState::kOpen) next.piece = HasPatches() ? kNearestPatch : mode.piece;
  return next;
}

bool ContactPair::Exists(const Mode& mode) const {
  return StateOf(mode) == ContactState::kOpen || !HasPatches() || HasPatch(mode.piece);
}

Mode ContactPair::Initial(const Eigen::VectorXd& u, double s) const {
  const int patch = HasPatches() ? PatchAt(u, s) : 0;
  const ContactState rest = Frictional() ? ContactState::kStick : ContactState::kClosed;
  if (Gap(u, s, patch) > tolerances::kTouching) return {NumberOf(ContactState::kOpen), patch};
  return {NumberOf(rest), PatchOfTouching(patch)};
}

Mode ContactPair::InState(const Eigen::VectorXd& u, double s, int state) const {
  const int patch = HasPatches() ? PatchAt(u, s) : 0;
  return {state, state == NumberOf(ContactState::kOpen) ? patch : PatchOfTouching(patch)};
}

Mode ContactPair::AtStart(const Eigen::VectorXd& u, double s, const Mode& mode) const {
  if (StateOf(mode) == ContactState::kOpen) return {mode.state, HasPatches() ? PatchAt(u, s) : mode.piece};
  return {mode.state, Seamless() ? PatchAfter(u, s, mode.piece) : mode.piece};
}

Mode ContactPair::OfPoint(const Mode& mode) const {
  return {mode.state, HasPatches() && StateOf(mode) == ContactState::kOpen ? kNearestPatch : mode.piece};
}

bool ContactPair::Passed(const Eigen::VectorXd& u, double s, const Mode& mode) const {
  if (!PatchesEnd()) return false;
  const int patch = PatchAt(u, s);
  if (patch == mode.piece) return false;
  const bool behind = Gap(u, s, patch) < -tolerances::kResidual;
  // In reach, a node from in front that is away from the surface, or the other way, may have gone through it.
  if (mode.piece == kNearestPatch) return behind;
  if (IsAway(patch)) return HasPatch(mode.piece);
  if (IsAway(mode.piece)) return HasPatch(patch) && !behind;
  return behind;
}

std::vector<ContactState> ContactPair::StatesAt(const Eigen::VectorXd& u, double s, int patch, ContactState now,
                                                double rn, double rt, const ActiveSetTolerance& tolerance) const {
  if (Gap(u, s, patch) > tolerance.motion) return {ContactState::kOpen};
  const double force = tolerance.ForceOf(ForceUnit());
  const bool loaded = rn > tolerance.ForceOf(NormalForceUnit());
  const double slipped = Slipped(u, s, patch);
  std::vector<ContactState> options;
  if (!Frictional()) {
    options = {ContactState::kClosed};
  } else if (std::abs(slipped) > tolerance.motion) {
    options = {slipped > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus};
  } else if (!loaded) {
    options = {ContactState::kStick, ContactState::kSlipPlus, ContactState::kSlipMinus};
  } else {
    options = {ContactState::kStick};
    if (Friction() * rn + rt <= force) options.push_back(ContactState::kSlipPlus);
    if (Friction() * rn - rt <= force) options.push_back(ContactState::kSlipMinus);
  }
  if (!loaded) options.push_back(ContactState::kOpen);
  const auto natural = std::find(options.begin(), options.end(), now);
  if (natural != options.end()) std::rotate(options.begin(), natural, natural + 1);
  return options;
}

Modes ContactPair::ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                           const ActiveSetTolerance& tolerance) const {
  const int patch = KnownPatch(u, s, now.piece);
  int before = patch, after = patch;  // where slip leads
  if (PatchesEnd()) {
    const double xi = FootXi(u, s, patch);
    const XiRange range = RangeOf(patch);
    if (xi <= range.begin + tolerance.motion) --before;
    if (xi >= range.end - tolerance.motion) ++after;
  }
  Modes modes;
  for (const ContactState state : StatesAt(u, s, patch, StateOf(now), forces[kNormal], forces[kTangent], tolerance)) {
    std::vector<int> patches = {patch};
    const bool either_way = surface_traits_.rolls ? state != ContactState::kOpen
                                                  : state == ContactState::kClosed || (Holonomic() && Slips(state));
    if (either_way) {
      if (before != patch) patches.push_back(before);
      if (after != patch) patches.push_back(after);
    } else if (state == ContactState::kSlipPlus) {
      patches = {after};
    } else if (state == ContactState::kSlipMinus) {
      patches = {before};
    }
    for (const int on : patches)
      if (const Mode mode{NumberOf(state), on}; Exists(mode)) modes.push_back(mode);
  }
  return modes;
}

std::vector<Ray> ContactPair::Rays(const Eigen::VectorXd& u, double s, int patch,
                                   const ActiveSetTolerance& tolerance) const {
  const double mu = Friction();
  const auto edge = [](double slip) { return Ray{{1.0, slip}, {0.5, 0.5 / slip}}; };
  // Edges that are parallel to rounding are one.
  if (!(mu > tolerances::kDependent)) return {{{1.0}, {1.0}}};
  // By the total law of friction, a contact that has slipped has one edge.
  const double slipped = Slipped(u, s, patch);
  if (std::abs(slipped) > tolerance.motion) return {edge(slipped > 0.0 ? -mu : mu)};
  return {edge(mu), edge(-mu)};
}

int ContactPair::PatchOfTouching(int patch) const {
  if (!HasPatches() || HasPatch(patch)) return patch;
  return HasPatch(patch + 1) ? patch + 1 : patch - 1;
}

double ContactPair::Motion(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                           const PortReals& reference) const {
  return port == kNormal ? Gap(u, s, patch) - reference[kNormal] : Law::Motion(port, u, s, patch, reference);
}

double ContactPair::SlipReference(const Eigen::VectorXd& u, double s, int patch) const {
  if (!Holonomic()) return Xi(u, s, patch);
  const double origin = *surface_traits_.slip_origin, round = surface_traits_.round;
  if (!(round > 0.0)) return origin;
  return origin + round * std::round((Xi(u, s, patch) - origin) / round);
}

double ContactPair::Slipped(const Eigen::VectorXd& u, double s, int patch) const {
  return Holonomic() ? Xi(u, s, patch) - SlipReference(u, s, patch) : 0.0;
}

Laws LawsOf(const ContactPairs& contacts) {
  Laws laws;
  for (const auto& contact : contacts) laws.Add(contact.get());
  return laws;
}

}  // namespace contact_path
