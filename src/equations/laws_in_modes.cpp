#include "contact_path/equations/laws_in_modes.h"

namespace contact_path {

LawsInModes::LawsInModes(const Laws& laws, Eigen::Index num_dofs) : laws_(laws), num_dofs_(num_dofs) {}

void LawsInModes::Set(const Modes& modes, const Eigen::VectorXd& references) {
  modes_ = modes;
  reference_ = references;
  unknown_.assign(static_cast<std::size_t>(laws_.NumPorts()), -1);
  num_unknowns_ = num_dofs_ + 1;
  acting_.clear();
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const StateRule& state = StateOf(i);
    if (state.idle) continue;
    acting_.push_back(i);
    for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p)
      if (state.ports[p].Holds()) unknown_[static_cast<std::size_t>(laws_.FirstPort(i)) + p] = num_unknowns_++;
  }
}

void LawsInModes::Start(std::size_t law, const Eigen::VectorXd& x) {
  modes_[law] = laws_[law].AtStart(x, x[num_dofs_], modes_[law]);
}

PortReals LawsInModes::ForcesOf(std::size_t law, const Eigen::VectorXd& x) const {
  const StateRule& state = StateOf(law);
  PortReals forces{};
  for (std::size_t p = 0; p < laws_[law].NumPorts(); ++p) {
    if (state.ports[p].Holds()) forces[p] = x[UnknownOf(law, p)];
    if (state.ports[p].Follows()) forces[p] = state.ports[p].ratio * forces[0];
  }
  return forces;
}

PortsAt LawsInModes::Evaluate(std::size_t law, const Eigen::VectorXd& x) const {
  PortsAt at;
  laws_[law].Evaluate(x, x[num_dofs_], modes_[law].piece, ReferencesOf(law), &at);
  return at;
}

double LawsInModes::ValueOf(const PortMotion& motion, const Eigen::VectorXd& x) const {
  return motion.offset + motion.sign * laws_[motion.law].Motion(motion.port, x, x[num_dofs_], modes_[motion.law].piece,
                                                                ReferencesOf(motion.law));
}

double LawsInModes::Bend(std::size_t port, const PortsAt& at, const Eigen::VectorXd& dx) const {
  const LawVector along = at.Local(dx, dx[num_dofs_]);
  return along.dot(at[port].hessian * along);
}

void LawsInModes::AddEnergy(const Eigen::VectorXd& x, double* energy) const {
  for (const std::size_t i : acting_) *energy += laws_[i].EnergyAt(x, x[num_dofs_], modes_[i], ForcesOf(i, x));
}

void LawsInModes::AddForces(const Eigen::VectorXd& x, double sign, Eigen::VectorXd* out) const {
  for (const std::size_t i : acting_) {
    const PortsAt at = Evaluate(i, x);
    const PortReals forces = ForcesOf(i, x);
    for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p)
      at.AddForce(at[p].gradient, sign * forces[p] * at[p].factor, out);
  }
}

void LawsInModes::Pack(const PathPoint& point, Eigen::VectorXd* x) const {
  x->head(num_dofs_) = point.u;
  (*x)[num_dofs_] = point.s;
  for (std::size_t port = 0; port < unknown_.size(); ++port)
    if (unknown_[port] >= 0) (*x)[unknown_[port]] = point.forces[static_cast<Eigen::Index>(port)];
}

PathPoint LawsInModes::Unpack(const Eigen::VectorXd& x) const {
  PathPoint point;
  point.u = x.head(num_dofs_);
  point.s = x[num_dofs_];
  point.forces = Eigen::VectorXd::Zero(laws_.NumPorts());
  for (const std::size_t i : acting_) laws_.Put(ForcesOf(i, x), i, &point.forces);
  point.modes.reserve(modes_.size());
  for (std::size_t i = 0; i < modes_.size(); ++i) point.modes.push_back(laws_[i].OfPoint(modes_[i]));
  return point;
}

Jet LawsInModes::MotionAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                             const Eigen::VectorXd& second) const {
  const PortsAt at = Evaluate(law, x);
  const LawVector& gradient = at[port].gradient;
  const Eigen::Index s = num_dofs_;
  Jet jet = {at[port].motion, at.Rate(gradient, first, first[s]), at.Rate(gradient, second, second[s])};
  if (laws_[law].Curved()) jet.second += Bend(port, at, first);
  return jet;
}

Jet LawsInModes::LeadingForceAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x,
                                   const Eigen::VectorXd& first, const Eigen::VectorXd& second) const {
  const Eigen::Index k = UnknownOf(law, 0), s = num_dofs_;
  const Law& of = laws_[law];
  const Jet force = {x[k], first[k], second[k]};
  if (!of.Curved()) return force;
  const PortsAt at = Evaluate(law, x);
  const Eigen::Vector3d c =
      of.FactorAlong(port, x, x[s], modes_[law].piece, at.Local(first, first[s]), at.Local(second, second[s]));
  return {force.value * c[0], force.first * c[0] + force.value * c[1],
          force.second * c[0] + 2.0 * force.first * c[1] + force.value * c[2]};
}

void LawsInModes::AddDrivingForce(std::size_t law, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                  const Eigen::VectorXd& second, Jet* force) const {
  const auto weighted = [](const PortReals& forces, const auto& of_port) {
    double sum = 0.0;
    for (std::size_t p = 0; p < forces.size(); ++p)
      if (forces[p] != 0.0) sum += forces[p] * of_port(p);
    return sum;
  };
  const PortReals forces = ForcesOf(law, x), rates = ForcesOf(law, first), changes = ForcesOf(law, second);
  // A law without a force may be where it cannot be evaluated.
  if (forces == PortReals{} && rates == PortReals{} && changes == PortReals{}) return;
  const Law& of = laws_[law];
  const PortsAt at = Evaluate(law, x);
  const auto last = static_cast<Eigen::Index>(at.dofs.size());
  const auto by_load = [&](std::size_t p) { return at[p].factor * at[p].gradient[last]; };
  force->value -= weighted(forces, by_load);
  force->first -= weighted(rates, by_load);
  force->second -= weighted(changes, by_load);
  if (!of.Curved()) return;
  const LawVector along = at.Local(first, first[num_dofs_]), bend = at.Local(second, second[num_dofs_]);
  const auto row = [&](const PortReals& of_forces) {
    LawVector sum = LawVector::Zero(last + 1);
    for (std::size_t p = 0; p < of.NumPorts(); ++p) {
      sum += (of_forces[p] * at[p].factor) * at[p].hessian.row(last).transpose();
      if (at[p].factor_gradient.size() > 0) sum += (of_forces[p] * at[p].gradient[last]) * at[p].factor_gradient;
    }
    return sum;
  };
  // Compliances are of factors that are linear in the load factor.
  for (std::size_t p = 0; p < of.NumPorts(); ++p) {
    const double compliance = StateOf(law).ports[p].compliance;
    if (compliance == 0.0 || at[p].factor_gradient.size() == 0) continue;
    const double stores = compliance * at[p].factor_gradient[last];
    force->value += 0.5 * stores * forces[p] * forces[p];
    force->first += stores * forces[p] * rates[p];
    force->second += stores * (rates[p] * rates[p] + forces[p] * changes[p]);
  }
  const LawVector of_forces = row(forces);
  force->first -= of_forces.dot(along);
  force->second -= 2.0 * row(rates).dot(along) + of_forces.dot(bend) +
                   of.SecondDirectional(x, x[num_dofs_], modes_[law].piece, forces, along)[last];
}

}  // namespace contact_path
