#include "contact_path/law/slack_bar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "contact_path/law/tendon_span.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/tendon_route.h"
#include "contact_path/tolerances.h"
#include "scene/input_bounds.h"

namespace contact_path {
namespace {

static_assert(kMostTendonUnknowns == kMostLawDofs);

enum Limits { kForce, kSlackness };

constexpr int kTaut = NumberOf(BarState::kTaut), kSlack = NumberOf(BarState::kSlack);

}  // namespace

std::string_view ToString(BarState state) { return state == BarState::kTaut ? "taut" : "slack"; }

SlackBar::SlackBar(std::vector<BarSpan> spans, const Windings& windings, double EA, double rest_length,
                   StrainMeasure strain, BarSense sense)
    : spans_(std::move(spans)),
      windings_(windings),
      rest_length_(rest_length),
      EA_(EA),
      sense_(sense == BarSense::kTension ? 1.0 : -1.0),
      strain_(strain) {
  Traits traits;
  traits.dofs = DofsOf(spans_, windings_, {});
  const auto moves = [&](int dof) {  // -1: the load factor
    traits.moves[0][static_cast<std::size_t>(std::find(traits.dofs.begin(), traits.dofs.end(), dof) -
                                             traits.dofs.begin())] = true;
  };
  bool affine = true;
  for (const auto& [span, rolled] : spans_) {
    affine = affine && span.Affine();
    for (std::size_t k = 0; k <= span.Dofs().size(); ++k)
      if (span.Moves(static_cast<Eigen::Index>(k))) moves(k == span.Dofs().size() ? -1 : span.Dofs()[k]);
  }
  for (const Winding& winding : windings_)
    if (winding.turn.Moves()) {
      affine = false;
      moves(winding.turn.dof);
    }
  // While the bar is slack: l0 de/dl is l / l0, 1 or l0 / l, and both ends move.
  const bool bounded = affine && (strain == StrainMeasure::kBiot ||
                                  (strain == StrainMeasure::kGreenLagrange) == (sense == BarSense::kTension));
  traits.largest_reach_rate =
      bounded ? std::sqrt(2.0) * static_cast<double>(spans_.size()) : std::numeric_limits<double>::infinity();
  SetBar(traits);
}

SlackBar::SlackBar(const BarSpan& span, const Windings& windings, double EA, double rest_length, const LawDofs& dofs)
    : spans_{span},
      windings_(windings),
      rest_length_(rest_length),
      EA_(EA),
      sense_(1.0),
      strain_(StrainMeasure::kBiot) {
  Traits traits;
  traits.dofs = dofs;
  for (std::size_t k = 0; k <= dofs.size(); ++k) traits.moves[0][k] = true;
  traits.largest_reach_rate = std::numeric_limits<double>::infinity();
  SetBar(traits);
}

LawDofs SlackBar::DofsOf(const std::vector<BarSpan>& spans, const Windings& windings,
                         const std::array<Coordinate, 2>& others) {
  std::set<int> dofs;
  for (const auto& [span, rolled] : spans) dofs.insert(span.Dofs().begin(), span.Dofs().end());
  for (const Coordinate& of : {others[0], others[1], windings[0].turn, windings[1].turn})
    if (of.dof >= 0) dofs.insert(of.dof);
  LawDofs sorted;
  for (const int dof : dofs) sorted.push_back(dof);
  return sorted;
}

void SlackBar::SetBar(Traits traits) {
  traits.couples = traits.compliant = traits.elastic = traits.curved = true;
  traits.force_unit = ForceUnitAbove(EA_);
  std::vector<StateRule> states(2);
  states[kTaut].ports[0] = {PortRule::Kind::kHeld, 0.0, rest_length_ / EA_};
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

double SlackBar::Least() const {
  // One span of a taut bar is as long as the bar; one of several may have any length.
  return (spans_.size() > 1 ? tolerances::kRootOfRounding : tolerances::kSmallShare) * rest_length_;
}

double SlackBar::Wound(const Eigen::VectorXd& u, double s) const {
  double wound = 0.0;
  for (const auto& [turn, by_turn] : windings_)
    wound += by_turn * (turn.dof >= 0 ? u[turn.dof] : turn.held + turn.rate * s);
  return wound;
}

LawVector SlackBar::WoundGradient(const LawDofs& dofs) const {
  const auto size = static_cast<Eigen::Index>(dofs.size());
  LawVector gradient = LawVector::Zero(size + 1);
  for (const auto& [turn, by_turn] : windings_)
    if (turn.dof < 0)
      gradient[size] += by_turn * turn.rate;
    else
      gradient[std::find(dofs.begin(), dofs.end(), turn.dof) - dofs.begin()] += by_turn;
  return gradient;
}

SlackBar::Strain SlackBar::StrainAt(double q) const {
  const double l0 = rest_length_;
  // A slack string may have no length, where strains have no derivatives.
  if (sense_ > 0.0) q = std::max(q, std::pow(Least(), 2));
  const double l = std::sqrt(q);
  switch (strain_) {
    case StrainMeasure::kBiot: return {(l - l0) / l0, 0.5 / (l0 * l), -0.25 / (l0 * l * q), 0.375 / (l0 * l * q * q)};
    case StrainMeasure::kGreenLagrange: return {0.5 * (l - l0) * (l + l0) / (l0 * l0), 0.5 / (l0 * l0), 0.0, 0.0};
    case StrainMeasure::kLogarithmic: return {std::log(l / l0), 0.5 / q, -0.5 / (q * q), 1.0 / (q * q * q)};
  }
  return {};
}

void SlackBar::Evaluate(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& /*reference*/,
                        PortsAt* ports) const {
  const double scale = -sense_ * rest_length_;
  ports->dofs = OwnDofs();
  PortAt& port = (*ports)[0];
  const auto size = static_cast<Eigen::Index>(OwnDofs().size()) + 1;
  port.gradient = LawVector::Zero(size);
  port.hessian = LawMatrix::Zero(size, size);
  double strain = static_cast<double>(spans_.size() - 1);  // l / l0 of each span less 1
  for (const auto& [of, rolled] : spans_) {
    const PlaceAt span(of, u, s);
    const auto& [d, arcs] = rolled.Of(span.x, Least());
    const Strain e = StrainAt(d.squaredNorm());
    strain += e.value + arcs / rest_length_;
    const Eigen::Vector2d gradient = 2.0 * scale * e.first * d;
    port.gradient += Spread(LawVector(span.first.transpose() * gradient), of.Dofs(), OwnDofs());
    port.hessian += Spread(span.Hessian(gradient, scale * (2.0 * e.first * Eigen::Matrix2d::Identity() +
                                                           4.0 * e.second * d * d.transpose())),
                           of.Dofs(), OwnDofs());
  }
  port.motion = scale * (strain + Wound(u, s) / rest_length_);
  port.gradient += scale / rest_length_ * WoundGradient(OwnDofs());
}

void SlackBar::ForceHessian(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& forces,
                            const LawVector& weights, LawMatrix* hessian) const {
  *hessian = LawMatrix::Zero(weights.size(), weights.size());
  for (const auto& [of, rolled] : spans_) {
    const PlaceAt span(of, u, s);
    const LawVector own = Gathered(weights, OwnDofs(), of.Dofs());
    const Eigen::Vector2d d = rolled.Of(span.x, Least()).tangent, v = rolled.TangentChange(d, span.first * own);
    const Strain e = StrainAt(d.squaredNorm());
    const double along = d.dot(v), scale = -forces[0] * sense_ * rest_length_;
    const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d change = scale * (4.0 * e.second * (along * unit + v * d.transpose() + d * v.transpose()) +
                                            8.0 * e.third * along * d * d.transpose());
    *hessian +=
        Spread(span.HessianChange(2.0 * scale * e.first * d,
                                  scale * (2.0 * e.first * unit + 4.0 * e.second * d * d.transpose()), change, own),
               of.Dofs(), OwnDofs());
  }
}

Modes SlackBar::ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                        const ActiveSetTolerance& tolerance) const {
  const double motion = Motion(0, u, s, 0, {});
  if (motion > tolerance.motion) return {{kSlack, 0}};
  // The motion shows the force of a soft bar.
  if (motion < -tolerance.motion || forces[0] > tolerance.ForceOf(ForceUnit())) return {{kTaut, 0}};
  return now.state == kTaut ? Modes{{kTaut, 0}, {kSlack, 0}} : Modes{{kSlack, 0}, {kTaut, 0}};
}

Mode SlackBar::Initial(const Eigen::VectorXd& u, double s) const {
  return {Motion(0, u, s, 0, {}) > tolerances::kActive ? kSlack : kTaut, 0};
}

Windings WindingsOf(const Tendon& tendon, const Scene& scene, const SceneIndex& index, const Structure& structure) {
  Windings windings;
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    const std::string& body = BodyOfDrum(tendon, end, scene, index);
    if (body.empty()) continue;
    const double rho = SignedRadius(tendon, end == 0 ? 0 : tendon.nodes.size() - 1);
    windings[end] = {structure.FrameOfBody(static_cast<int>(index.Node(body))).angle, end == 0 ? -rho : rho};
  }
  return windings;
}

std::vector<std::unique_ptr<const SlackBar>> BuildSlackBars(const Scene& scene, const SceneIndex& index,
                                                            const Structure& structure,
                                                            const std::vector<double>& reference) {
  std::vector<std::unique_ptr<const SlackBar>> bars;
  for (const OneSidedBar& bar : OneSidedBars(scene)) {
    if (bar.tendon != nullptr && bar.tendon->IsPiece()) {
      bars.push_back(std::make_unique<const TendonSpan>(MakeSpan(*bar.tendon, scene, index, structure)));
      continue;
    }
    std::vector<int> nodes;
    for (const std::string& name : *bar.nodes) nodes.push_back(static_cast<int>(index.Node(name)));
    const TendonRoute route = RouteOf(bar.tendon != nullptr ? *bar.tendon : Tendon(), PointsOf(nodes, reference));
    std::vector<BarSpan> spans;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      spans.push_back(
          {MovingPlace::Between(structure.PointOf(nodes[k]), structure.PointOf(nodes[k + 1])), route.spans[k]});
    bars.push_back(std::make_unique<const SlackBar>(
        std::move(spans), bar.tendon != nullptr ? WindingsOf(*bar.tendon, scene, index, structure) : Windings(), bar.EA,
        bar.rest_length > 0.0 ? bar.rest_length : route.length, bar.strain, bar.sense));
  }
  return bars;
}

}  // namespace contact_path
