#include "contact_path/law/slack_bar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

enum Limits { kForce, kSlackness };

constexpr int kTaut = NumberOf(BarState::kTaut), kSlack = NumberOf(BarState::kSlack);

}  // namespace

std::string_view ToString(BarState state) { return state == BarState::kTaut ? "taut" : "slack"; }

SlackBar::SlackBar(const std::array<End, 2>& ends, double EA, double rest_length, StrainMeasure strain, BarSense sense)
    : ends_(ends),
      rest_length_(rest_length),
      compliance_(rest_length / EA),
      sense_(sense == BarSense::kTension ? 1.0 : -1.0),
      strain_(strain) {
  Traits traits;
  // Degrees of freedom ascend.
  std::vector<std::array<int, 3>> moved;  // dof, end, axis
  for (int end = 0; end < 2; ++end)
    for (int axis = 0; axis < 2; ++axis)
      if (const int dof = ends.at(static_cast<std::size_t>(end)).dofs.at(static_cast<std::size_t>(axis)); dof >= 0)
        moved.push_back({dof, end, axis});
  std::sort(moved.begin(), moved.end());
  columns_ = Columns::Zero(2, static_cast<Eigen::Index>(moved.size()) + 1);
  for (const auto& [dof, end, axis] : moved) {
    columns_(axis, static_cast<Eigen::Index>(traits.dofs.size())) = end == 0 ? -1.0 : 1.0;
    traits.moves[0][traits.dofs.size()] = true;
    traits.dofs.push_back(dof);
  }
  traits.couples = traits.compliant = traits.curved = true;
  traits.force_unit = ForceUnitAbove(EA);
  // While the bar is slack: l0 de/dl is l / l0, 1 or l0 / l, and both ends move.
  const bool bounded =
      strain == StrainMeasure::kBiot || (strain == StrainMeasure::kGreenLagrange) == (sense == BarSense::kTension);
  traits.largest_reach_rate = bounded ? std::sqrt(2.0) : std::numeric_limits<double>::infinity();
  std::vector<StateRule> states(2);
  states[kTaut].ports[0] = {PortRule::Kind::kHeld, 0.0, compliance_};
  LimitRule bears;
  bears.id = kForce;
  bears.of = LimitRule::Of::kForces;
  bears.weights[0] = 1.0;
  bears.unit = traits.force_unit;
  bears.next = kSlack;
  states[kTaut].limits = {bears};
  states[kTaut].held = kTaut;
  LimitRule hangs;
  hangs.id = kSlackness;
  hangs.next = kTaut;
  states[kSlack].limits = {hangs};
  states[kSlack].held = kSlack;
  SetLaw(traits, std::move(states));
}

SlackBar::Strain SlackBar::StrainAt(double q) const {
  const double l0 = rest_length_;
  // A slack string may have no length, where strains have no derivatives.
  if (sense_ > 0.0) q = std::max(q, std::pow(tolerances::kSmallShare * l0, 2));
  const double l = std::sqrt(q);
  switch (strain_) {
    case StrainMeasure::kBiot: return {(l - l0) / l0, 0.5 / (l0 * l), -0.25 / (l0 * l * q), 0.375 / (l0 * l * q * q)};
    case StrainMeasure::kGreenLagrange: return {0.5 * (l - l0) * (l + l0) / (l0 * l0), 0.5 / (l0 * l0), 0.0, 0.0};
    case StrainMeasure::kLogarithmic: return {std::log(l / l0), 0.5 / q, -0.5 / (q * q), 1.0 / (q * q * q)};
  }
  return {};
}

Eigen::Vector2d SlackBar::Span(const Eigen::VectorXd& u) const {
  Eigen::Vector2d span = Eigen::Vector2d::Zero();
  for (std::size_t end = 0; end < ends_.size(); ++end)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto e = static_cast<Eigen::Index>(axis);
      const double x = ends_[end].dofs[axis] >= 0 ? u[ends_[end].dofs[axis]] : ends_[end].held[e];
      span[e] += end == 0 ? -x : x;
    }
  return span;
}

void SlackBar::Evaluate(const Eigen::VectorXd& u, double /*s*/, int /*piece*/, const PortReals& /*reference*/,
                        PortsAt* ports) const {
  const Eigen::Vector2d d = Span(u);
  const Strain e = StrainAt(d.squaredNorm());
  const double scale = -sense_ * rest_length_;
  ports->dofs = OwnDofs();
  PortAt& port = (*ports)[0];
  port.motion = scale * e.value;
  port.gradient = columns_.transpose() * (2.0 * scale * e.first * d);
  const Eigen::Matrix2d hessian =
      scale * (2.0 * e.first * Eigen::Matrix2d::Identity() + 4.0 * e.second * d * d.transpose());
  port.hessian = columns_.transpose() * hessian * columns_;
}

void SlackBar::ForceHessian(const Eigen::VectorXd& u, double /*s*/, int /*piece*/, const PortReals& forces,
                            const LawVector& weights, LawMatrix* hessian) const {
  const Eigen::Vector2d d = Span(u), v = columns_ * weights;
  const Strain e = StrainAt(d.squaredNorm());
  const double along = d.dot(v), scale = -forces[0] * sense_ * rest_length_;
  const Eigen::Matrix2d change =
      scale * (4.0 * e.second * (along * Eigen::Matrix2d::Identity() + v * d.transpose() + d * v.transpose()) +
               8.0 * e.third * along * d * d.transpose());
  *hessian = columns_.transpose() * change * columns_;
}

Modes SlackBar::ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                        const ActiveSetTolerance& tolerance) const {
  const double motion = Motion(0, u, s, 0, {});
  if (motion > tolerance.motion) return {{kSlack, 0}};
  // The motion shows the force of a soft bar.
  if (motion < -tolerance.motion || forces[0] > tolerance.force * ForceUnit()) return {{kTaut, 0}};
  return now.state == kTaut ? Modes{{kTaut, 0}, {kSlack, 0}} : Modes{{kSlack, 0}, {kTaut, 0}};
}

Mode SlackBar::Initial(const Eigen::VectorXd& u, double s) const {
  return {Motion(0, u, s, 0, {}) > tolerances::kActive ? kSlack : kTaut, 0};
}

std::vector<std::unique_ptr<const SlackBar>> BuildSlackBars(const Scene& scene, const SceneIndex& index,
                                                            const Structure& structure,
                                                            const std::vector<double>& reference) {
  std::vector<std::unique_ptr<const SlackBar>> bars;
  for (const std::size_t i : OneSidedBars(scene)) {
    const Bar& bar = scene.bars[i];
    std::array<SlackBar::End, 2> ends;
    std::array<Eigen::Vector2d, 2> start;
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t node = index.Node(bar.nodes[end]);
      const auto number = static_cast<int>(node);
      ends[end] = {{structure.Dof(number, 0), structure.Dof(number, 1)}, structure.StartPosition(number)};
      start[end] = {reference[2 * node], reference[2 * node + 1]};
    }
    const double rest_length = bar.rest_length > 0.0 ? bar.rest_length : (start[1] - start[0]).norm();
    bars.push_back(std::make_unique<const SlackBar>(ends, bar.EA, rest_length, bar.strain, bar.sense));
  }
  return bars;
}

}  // namespace contact_path
