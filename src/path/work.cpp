#include "contact_path/path/work.h"

#include <algorithm>
#include <cmath>

#include "contact_path/branch/gauss_rule.h"

namespace contact_path {
namespace {

double DrivingForce(const Model& model, const PathPoint& point) {
  // With all forces of each law among the unknowns, whatever its state: those of a regularised point are not zero where
  // it is idle.
  FixedModeSystem system(model.structure, model.laws);
  Modes held = point.modes;
  for (std::size_t i = 0; i < held.size(); ++i) held[i].state = model.laws[i].AllHeld();
  system.SetModes(held);
  const Eigen::VectorXd x = system.Pack(point), still = Eigen::VectorXd::Zero(x.size());
  return system.DrivingForceAlong(x, still, still).value;
}

double FactorOf(const Law& law, std::size_t port, const PathPoint& point, std::size_t number) {
  PortsAt at;
  law.Evaluate(point.u, point.s, point.modes[number].piece, {}, &at);
  return at[port].factor;
}

}  // namespace

Work WorkOfIncrement(const Model& model, const PathPoint& from, const PathPoint& to) {
  const Eigen::VectorXd du = to.u - from.u;
  Work work;
  for (std::size_t i = 0; i < model.laws.size(); ++i) {
    const Law& law = model.laws[i];
    const StateRule& state = law.In(to.modes[i]);
    const Eigen::Index leading = model.laws.FirstPort(i);
    for (std::size_t p = 1; p < law.NumPorts(); ++p) {
      if (!state.ports[p].Follows() && !law.Holonomic()) continue;
      const Eigen::Index port = leading + static_cast<Eigen::Index>(p);
      const double travel = law.Travel(p, from.u, from.s, from.modes[i].piece, du, to.s - from.s, to.modes[i].piece);
      if (law.Holonomic()) {
        work.friction -= 0.5 * (from.forces[port] + to.forces[port]) * travel;
        continue;
      }
      // The factor is one of the motion where a surface stretches, and otherwise one of the force.
      const bool stretches = i < model.contacts.size() && model.contacts[i]->Deformable();
      const double first = stretches ? 1.0 : FactorOf(law, p, from, i),
                   last = stretches ? 1.0 : FactorOf(law, p, to, i);
      const double leads = (first * from.forces[leading] + last * to.forces[leading]) / (first + last);
      work.friction += std::abs(state.ports[p].ratio) * leads * std::abs(travel);
    }
  }
  const Structure& structure = model.structure;
  work.loads = structure.Loads().Work(from.s, to.s, du) +
               0.5 * (DrivingForce(model, from) + DrivingForce(model, to)) * (to.s - from.s);
  const double unit = model.scaling.force * model.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

Work WorkOfStep(const Model& model, const FixedModeSystem& system, const Step& step) {
  // Five points are exact for the products of a quintic and the derivative of another.
  const auto integrate = [&](const Quintic& force, const Quintic& position) {
    const Quintic rate = Derivative(position);
    double sum = 0.0;
    for (std::size_t i = 0; i < kGauss5.points.size(); ++i) {
      const double t = kGauss5.points[i] * step.length;
      sum += kGauss5.weights[i] * Evaluate(force, t) * Evaluate(rate, t);
    }
    return sum * step.length;
  };
  const Eigen::Index nd = system.NumDofs();
  Work work;
  for (const std::size_t i : system.Acting()) {
    const StateRule& state = model.laws[i].In(system.modes()[i]);
    for (std::size_t p = 1; state.slides && p < model.laws[i].NumPorts(); ++p) {
      if (!state.ports[p].Follows()) continue;
      const Quintic force = step.Interpolate([&](const CurvePoint& at) {
        return system.laws_in_modes().LeadingForceAlong(i, p, at.x, at.first, at.second);
      });
      const Quintic motion = step.Interpolate(
          [&](const CurvePoint& at) { return system.laws_in_modes().MotionAlong(i, p, at.x, at.first, at.second); });
      const double taken = -state.ports[p].ratio * integrate(force, motion);
      work.friction += model.laws[i].Holonomic() ? taken : std::max(0.0, taken);
      work.given_back += model.laws[i].Holonomic() ? 0.0 : std::max(0.0, -taken);
    }
  }
  const auto load = [&](const Eigen::VectorXd& x) { return x[nd]; };
  const auto along = [&](const Eigen::VectorXd& x) { return model.structure.Loads().Reference().dot(x.head(nd)); };
  work.loads = integrate(step.InterpolateLinear(load), step.InterpolateLinear(along)) +
               model.structure.Loads().Constant().dot((step.end.x - step.start.x).head(nd));
  const auto driving = [&](const CurvePoint& at) { return system.DrivingForceAlong(at.x, at.first, at.second); };
  work.loads += integrate(step.Interpolate(driving), step.InterpolateLinear(load));
  const double unit = model.scaling.force * model.scaling.length;
  work.friction *= unit;
  work.given_back *= unit;
  work.loads *= unit;
  return work;
}

}  // namespace contact_path
