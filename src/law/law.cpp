#include "contact_path/law/law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kPowersApart = 20;  // 2^20 is about 1e6: nearly all scenes have the unit 1

}  // namespace

double Law::Motion(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const PortReals& reference) const {
  PortsAt at;
  Evaluate(u, s, piece, reference, &at);
  return at[port].motion;
}

void Law::ForceHessian(const Eigen::VectorXd& /*u*/, double /*s*/, int piece, const PortReals& /*forces*/,
                       const LawVector& /*weights*/, LawMatrix* hessian) const {
  const auto size = static_cast<Eigen::Index>(Dofs(piece).size()) + 1;
  *hessian = LawMatrix::Zero(size, size);
}

LawVector Law::SecondDirectional(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces,
                                 const LawVector& direction) const {
  LawMatrix derivative;
  ForceHessian(u, s, piece, forces, direction, &derivative);
  return derivative * direction;
}

Eigen::Vector3d Law::FactorAlong(std::size_t /*port*/, const Eigen::VectorXd& /*u*/, double /*s*/, int /*piece*/,
                                 const LawVector& /*first*/, const LawVector& /*second*/) const {
  return Eigen::Vector3d::UnitX();
}

double Law::Travel(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const Eigen::VectorXd& du,
                   double ds, int piece_after) const {
  if (!Curved()) return TravelRate(port, u, s, piece, du, ds);
  PortReals reference{};
  reference[port] = Motion(port, u, s, piece, {});
  return Motion(port, u + du, s + ds, piece_after, reference);
}

double Law::TravelRate(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const Eigen::VectorXd& du,
                       double ds) const {
  PortsAt at;
  Evaluate(u, s, piece, {}, &at);
  return at[port].factor * at.Rate(at[port].gradient, du, ds);
}

int Law::AllHeld() const {
  const auto all = [this](const StateRule& state) {
    return std::all_of(state.ports.begin(), state.ports.begin() + static_cast<std::ptrdiff_t>(NumPorts()),
                       [](const PortRule& port) { return port.Holds(); });
  };
  return static_cast<int>(std::find_if(states_.begin(), states_.end(), all) - states_.begin());
}

bool Law::CanBeIdle() const {
  return std::any_of(states_.begin(), states_.end(), [](const StateRule& state) { return state.idle; });
}

PortReals Law::ReferenceOf(const Eigen::VectorXd& u, double s, const Mode& mode, const PortReals& forces) const {
  PortReals reference = ReferenceAt(u, s, mode.piece);
  if (!Compliant() || Elastic() || !CanBeIdle()) return reference;
  const StateRule& held = In(In(mode).held);
  if (const double compliance = held.ports[0].compliance; compliance != 0.0) {
    const double gap = Motion(0, u, s, mode.piece, {}) + compliance * forces[0];
    if (!In(mode).idle || gap <= tolerances::kActive) reference[0] = gap;
  }
  for (std::size_t p = 1; p < NumPorts(); ++p) reference[p] += held.ports[p].compliance * forces[p];
  return reference;
}

PortReals Law::CompliantForces(const Eigen::VectorXd& u, double s, const Mode& mode) const {
  PortReals forces{};
  if (!Elastic()) return forces;
  for (std::size_t p = 0; p < NumPorts(); ++p)
    if (const PortRule& port = In(mode).ports[p]; port.Holds() && port.compliance != 0.0)
      forces[p] = -Motion(p, u, s, mode.piece, {}) / port.compliance;
  return forces;
}

double Law::EnergyAt(const Eigen::VectorXd& u, double s, const Mode& mode, const PortReals& forces) const {
  PortReals stored = forces;
  if (Curved() && Compliant() && !Elastic() && forces != PortReals{}) {
    PortsAt at;
    Evaluate(u, s, mode.piece, {}, &at);
    for (std::size_t p = 0; p < NumPorts(); ++p) stored[p] *= std::sqrt(std::max(0.0, at[p].factor));
  }
  double energy = 0.0;
  for (std::size_t p = 0; p < NumPorts(); ++p) energy += 0.5 * In(mode).ports[p].compliance * stored[p] * stored[p];
  return energy;
}

void Law::AddLimits(const Mode& mode, int law, std::vector<Limit>* limits) const {
  for (const LimitRule& rule : In(mode).limits) limits->push_back({law, rule.id});
}

double ForceUnitAbove(double bound) {
  const double rounding = tolerances::kStiffForce * bound;
  if (rounding > 1.0 && std::isfinite(rounding))
    return std::ldexp(1.0, static_cast<int>(std::ceil(std::log2(rounding))));
  if (!(bound > 0.0) || !(bound < 1.0)) return 1.0;
  return std::ldexp(1.0, kPowersApart * static_cast<int>(std::ceil(std::log2(bound) / kPowersApart)));
}

void Law::SetLaw(const Traits& traits, std::vector<StateRule> states) {
  traits_ = traits;
  states_ = std::move(states);
  if (traits_.num_ports > kMostPorts) throw std::logic_error("law: there are too many ports");
  for (StateRule& state : states_) {
    for (const PortRule& port : state.ports) {
      state.idle = state.idle && port.kind == PortRule::Kind::kFree;
      state.slides = state.slides || port.Follows();
    }
    if (state.slides && !state.ports[0].Holds())
      throw std::logic_error("law: where a port follows, port 0 must be held");
    if (state.held < 0 || state.held >= NumStates()) throw std::logic_error("law: held must be a state");
    for (const LimitRule& limit : state.limits)
      if (state.Find(limit.id) != &limit || limit.next < 0 || limit.next >= NumStates())
        throw std::logic_error("law: a limit must have a number of its own in its state, and a state after it");
  }
  if (std::count_if(states_.begin(), states_.end(), [](const StateRule& state) { return state.idle; }) > 1)
    throw std::logic_error("law: only one state may have no forces");
  if (states_.size() > 1 && !CanBeIdle()) throw std::logic_error("law: one of several states must have no forces");
  if (!states_.empty() && !CanBeIdle() && !states_.front().limits.empty())
    throw std::logic_error("law: what always acts must have no limits");
  if (!std::is_sorted(traits_.dofs.begin(), traits_.dofs.end()))
    throw std::logic_error("law: degrees of freedom must ascend");
}

}  // namespace contact_path
