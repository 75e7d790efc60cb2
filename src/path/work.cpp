#include "contact_path/path/work.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact_path/branch/gauss_rule.h"

namespace contact_path {
namespace {

double DrivingForce(const Model& model, const PathPoint& point) {
  // With both reactions of each contact among the unknowns, whatever its state: those of a regularised point are not
  // zero where it is open.
  FixedStateSystem system(model.structure, model.contacts);
  system.SetStates(std::vector<ContactState>(model.contacts.size(), ContactState::kStick),
                   Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.contacts.size())), point.patches);
  const Eigen::VectorXd x = system.Pack(point), still = Eigen::VectorXd::Zero(x.size());
  return system.DrivingForceAlong(x, still, still).value;
}

}  // namespace

Work WorkOfIncrement(const Model& model, const PathPoint& from, const PathPoint& to) {
  const Eigen::VectorXd du = to.u - from.u;
  Work work;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactPair& pair = *model.contacts[i];
    if (!Slips(to.states[i]) && !pair.HasTotalLaw()) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const double slip = pair.Slip(from.u, from.s, from.Patch(i), du, to.s - from.s, to.Patch(i));
    if (pair.HasTotalLaw())
      work.friction -= 0.5 * (from.rt[k] + to.rt[k]) * slip;
    else
      work.friction += pair.Friction() * (0.5 * (from.rn[k] + to.rn[k])) * std::abs(slip);
  }
  const Structure& structure = model.structure;
  work.loads = 0.5 * (from.s + to.s) * structure.ReferenceLoad().dot(du) + structure.ConstantLoad().dot(du) +
               0.5 * (DrivingForce(model, from) + DrivingForce(model, to)) * (to.s - from.s);
  const double unit = model.scaling.force * model.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

Work WorkOfStep(const Model& model, const FixedStateSystem& system, const Step& step) {
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
  for (const std::size_t i : system.Touching()) {
    if (!Slips(system.states()[i])) continue;
    const Quintic force =
        step.Interpolate([&](const CurvePoint& at) { return system.SlidingForceAlong(i, at.x, at.first, at.second); });
    const Quintic slip = step.Interpolate([&](const CurvePoint& at) {
      return system.ValueAlong({static_cast<int>(i), Inequality::kSlip}, at.x, at.first, at.second);
    });
    const ContactPair& pair = *model.contacts[i];
    const double friction = pair.Friction() * integrate(force, slip);
    work.friction += pair.HasTotalLaw() ? friction : std::max(0.0, friction);
  }
  const auto load = [&](const Eigen::VectorXd& x) { return x[nd]; };
  const auto along = [&](const Eigen::VectorXd& x) { return model.structure.ReferenceLoad().dot(x.head(nd)); };
  work.loads = integrate(step.InterpolateLinear(load), step.InterpolateLinear(along)) +
               model.structure.ConstantLoad().dot((step.end.x - step.start.x).head(nd));
  const auto driving = [&](const CurvePoint& at) { return system.DrivingForceAlong(at.x, at.first, at.second); };
  work.loads += integrate(step.Interpolate(driving), step.InterpolateLinear(load));
  const double unit = model.scaling.force * model.scaling.length;
  work.friction *= unit;
  work.loads *= unit;
  return work;
}

}  // namespace contact_path
