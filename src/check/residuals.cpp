// Written from the definitions and summed in long double, so that the check is more exact than the solver.
#include "contact_path/check/residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/prepared_scene.h"

namespace contact_path {
namespace {

using check::Real;
using check::Vector;

// Over L: a pin that has to give way by more holds its nodes together no more, as where supports pull them apart, and
// bodies that do are clamped.
constexpr Real kMostGiven = 1e-6L;

// The larger of the two. What is no finite double counts as infinite, so that NaN never passes as small.
double Worst(double worst, Real value) {
  if (!(value <= static_cast<Real>(std::numeric_limits<double>::max()))) return std::numeric_limits<double>::infinity();
  return std::max(worst, static_cast<double>(value));
}

bool AllFinite(const CheckedState& state) {
  bool finite = std::isfinite(state.load_factor);
  for (const auto* const values : {&state.positions, &state.rotations, &state.rn, &state.rt, &state.pins})
    for (const double value : *values) finite = finite && std::isfinite(value);
  return finite;
}

}  // namespace

ResidualCheck::ResidualCheck(const Scene& scene)
    : ResidualCheck(scene, Configuration::Of(scene), CharacteristicScales(scene)) {}
ResidualCheck::ResidualCheck(const Scene& scene, const Configuration& configuration, const Scaling& scaling)
    : prepared_(std::make_unique<Prepared>(scene, configuration, scaling)) {}
ResidualCheck::~ResidualCheck() = default;

double Residuals::Contact() const {
  double worst = 0.0;
  for (const double residual : {penetration, tensile_reaction, complementarity, cone, friction_law})
    worst = Worst(worst, residual);
  return worst;
}

double Residuals::Largest() const { return Worst(Worst(Contact(), equilibrium), support); }

Residuals ResidualCheck::Check(const CheckedState& before, const CheckedState& now) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(before);
  scene.RequireSizes(now);
  if (!AllFinite(before) || !AllFinite(now)) {
    Residuals infinite;
    for (double Residuals::*const residual : Residuals::kAll)
      infinite.*residual = std::numeric_limits<double>::infinity();
    return infinite;
  }

  const Scaling& scaling = scene.scaling;
  Residuals residuals;
  const std::vector<Real> unbalance = scene.Unbalance(now);
  const std::vector<double> values = check::ValuesOf(now.positions, now.rotations);
  const check::PlacedState from = scene.Placed(before), to = scene.Placed(now);
  const Real uncertain = Uncertain(now);
  for (std::size_t i = 0; i < unbalance.size(); ++i) {
    const bool is_position = i < scene.num_positions;
    const Real length = is_position ? 1.0L : static_cast<Real>(scaling.length);  // of a moment
    if (scene.free[i]) {
      const Real unit = scene.units[is_position ? i / 2 : i - scene.num_positions];
      const Real off = std::max(std::abs(unbalance[i]) - uncertain * length, 0.0L);
      residuals.equilibrium = Worst(residuals.equilibrium, off / (unit * length));
      continue;
    }
    const Real place = scene.start[i] + static_cast<Real>(now.load_factor) * scene.rates[i];
    residuals.support = Worst(residuals.support, std::abs(values[i] - place) * length / scaling.length);
  }
  const CheckedState settled = scene.attached->Settled(now);
  const std::vector<double> held = check::ValuesOf(settled.positions, settled.rotations);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Real off = std::abs(static_cast<Real>(values[i]) - held[i]);
    residuals.support = Worst(residuals.support, i < scene.num_positions ? off / scaling.length : off);
  }
  for (std::size_t k = 0; k < scene.pins.size(); ++k) {
    const Vector given = static_cast<Real>(GiveOfPin(k)) * Vector{now.pins[2 * k], now.pins[2 * k + 1]};
    Vector apart = Prepared::Apart(scene.pins[k], now.positions);
    if (check::Length(given) <= kMostGiven * scaling.length) apart += given;
    residuals.support = Worst(residuals.support, check::Length(apart) / scaling.length);
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const check::Contact& contact = *scene.contacts[i];
    const bool without_reaction = now.rn[i] == 0.0 && now.rt[i] == 0.0;
    if (without_reaction && contact.SurelyOpen(to)) continue;
    const Real give = contact.Gives() ? check::kGive / scaling.force : 0.0L;
    const Real given = give * now.rn[i];
    const Real gap = contact.Gap(to) / scaling.length + (given <= kMostGiven ? given : 0.0L);
    if (without_reaction) {  // then only a gap that is closed too far breaks a rule
      residuals.penetration = Worst(residuals.penetration, -gap);
      residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, 0.0L)));
      continue;
    }
    const Real slip =
        contact.LawfulSlip(from, to) / scaling.length +
        (give > 0.0L ? give * (contact.GivesTo(to, now.rt[i]) - contact.GivesTo(from, before.rt[i])) : 0.0L);
    const Real unit = scene.contact_units[i];
    const Real rn = now.rn[i] / unit, rt = now.rt[i] / unit;
    const Real friction = contact.FrictionIn(to), bound = friction * std::max(rn, 0.0L);
    residuals.equilibrium =
        Worst(residuals.equilibrium, contact.Imbalance(to, now.rn[i], now.rt[i], scaling.length) / unit);
    residuals.penetration = Worst(residuals.penetration, -gap);
    residuals.tensile_reaction = Worst(residuals.tensile_reaction, -rn);
    const Real reaction = rn < 0.0L ? rn : std::max(rn, std::abs(rt));
    residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, reaction)));
    residuals.cone = Worst(residuals.cone, std::abs(rt) - friction * rn);
    residuals.friction_law = Worst(residuals.friction_law, std::abs(rt - std::clamp(rt - slip, -bound, bound)));
  }
  return residuals;
}

std::vector<double> ResidualCheck::Unbalance(const CheckedState& state) const {
  prepared_->RequireSizes(state);
  const std::vector<Real> unbalance = prepared_->Unbalance(state);
  return {unbalance.begin(), unbalance.end()};
}

}  // namespace contact_path
