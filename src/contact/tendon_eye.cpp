#include "contact_path/contact/tendon_eye.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <unsupported/Eigen/AutoDiff>

#include "structure/span_numbers.h"

namespace contact_path {
namespace {

constexpr double kStraight = 1e-3;  // [rad]

LawDofs AllDofs(const TendonSpan& before, const TendonSpan& behind) {
  std::set<int> dofs;
  for (const LawDofs& of : {before.Dofs(0), behind.Dofs(0)}) dofs.insert(of.begin(), of.end());
  LawDofs all;
  for (const int dof : dofs) all.push_back(dof);
  return all;
}

}  // namespace

TendonEye::TendonEye(const TendonSpan& before, const TendonSpan& behind, const Coordinate& slid, double friction,
                     const Roller& roller)
    : before_(before),
      behind_(behind),
      slid_(slid),
      friction_(friction),
      roller_(roller),
      compliance_(std::min(before.Compliance(), behind.Compliance())) {
  Traits traits;
  traits.dofs = AllDofs(before, behind);
  traits.couples = traits.compliant = traits.elastic = traits.curved = true;
  traits.largest_ratio = 1.0;
  traits.force_unit = before.ForceUnit();
  traits.largest_reach_rate = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k <= traits.dofs.size(); ++k) {
    traits.moves[kNormal][k] = true;
    traits.moves[kTangent][k] = k < traits.dofs.size() && traits.dofs[k] == slid.dof;
  }
  SurfaceTraits of_eye;
  of_eye.compliance = compliance_;
  of_eye.tangent_gives = false;
  SetContact(traits, of_eye);
}

Eigen::Index TendonEye::SlidEntry() const {
  return std::find(OwnDofs().begin(), OwnDofs().end(), slid_.dof) - OwnDofs().begin();
}

TendonEye::Place TendonEye::At(const Eigen::VectorXd& u, double s) const {
  // By (dx1, dy1, w1, a1, dx2, dy2, w2, a2) of the spans: from node to node, what is wound by drums and the arcs at the
  // start, the length at rest.
  constexpr int kLocals = 8;
  using Gradient = Eigen::Matrix<double, kLocals, 1>;
  using Once = Eigen::AutoDiffScalar<Gradient>;
  using Twice = Eigen::AutoDiffScalar<Eigen::Matrix<Once, kLocals, 1>>;
  using std::atan2;
  using std::exp;
  using std::log;
  using std::tanh;
  const TendonSpan::State before = before_.At(u, s), behind = behind_.At(u, s);
  const Gradient values =
      (Gradient() << before.span.x, before.wound, before.rest, behind.span.x, behind.wound, behind.rest).finished();
  std::array<Twice, kLocals> z;
  for (int k = 0; k < kLocals; ++k) {
    Once once(values[k], kLocals, k);
    z[static_cast<std::size_t>(k)] = Twice(once, kLocals, k);
  }
  const SpanNumbers<Twice> in(before_.Rolled(), z[0], z[1]), out(behind_.Rolled(), z[4], z[5]);
  const auto tension = [&](const SpanNumbers<Twice>& of, std::size_t first) -> Twice {
    return before_.EA() * (Twice(of.length + z[first + 2]) / z[first + 3] - 1.0);
  };
  const Twice sum = tension(in, 0) + tension(out, 4);
  Twice turn;
  if (roller_.sense == 0.0)
    turn = atan2(Twice(in.x * out.y - in.y * out.x), Twice(in.x * out.x + in.y * out.y));
  else
    turn = Twice(out.turned - in.turned) * roller_.sense + roller_.wrapped;
  if (turn.value().value() < 0.0) turn = -turn;
  const Twice rounded = turn + log(Twice(exp(Twice(turn * (-2.0 / kStraight))) + 1.0)) * kStraight;
  const Twice share = tanh(Twice(rounded * (0.5 * friction_))) * (sum * (0.5 / before_.EA()) + 1.0);
  const LawDofs& dofs = OwnDofs();
  const auto size = static_cast<Eigen::Index>(dofs.size()) + 1;
  Eigen::Matrix<double, kLocals, Eigen::Dynamic, 0, kLocals, kMostLawDofs + 1> by_q(kLocals, size);
  Eigen::Index row = 0;
  for (const auto& [span, at] : {std::pair(&before_, &before), std::pair(&behind_, &behind)}) {
    for (const Eigen::Index axis : {0, 1})
      by_q.row(row++) = Spread(LawVector(at->span.first.row(axis).transpose()), span->Span().Dofs(), dofs).transpose();
    by_q.row(row++) = span->WoundGradient(dofs).transpose();
    by_q.row(row++) = span->RestGradient(dofs).transpose();
  }
  const auto function_of = [&](const Twice& of) {
    Gradient gradient;
    Eigen::Matrix<double, kLocals, kLocals> hessian;
    for (int i = 0; i < kLocals; ++i) {
      gradient[i] = of.derivatives()[i].value();
      hessian.row(i) = of.derivatives()[i].derivatives().transpose();
    }
    Function function{of.value().value(), by_q.transpose() * gradient, by_q.transpose() * hessian * by_q};
    function.hessian += Spread(before.span.Second(gradient.head<2>()), before_.Span().Dofs(), dofs);
    function.hessian += Spread(behind.span.Second(gradient.segment<2>(4)), behind_.Span().Dofs(), dofs);
    return function;
  };
  return {function_of(sum), function_of(share)};
}

void TendonEye::Evaluate(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& reference,
                         PortsAt* ports) const {
  const Place at = At(u, s);
  const auto size = static_cast<Eigen::Index>(OwnDofs().size()) + 1;
  ports->dofs = OwnDofs();
  PortAt &sum = (*ports)[kNormal], &slid = (*ports)[kTangent];
  sum.motion = -compliance_ * at.sum.value;
  sum.gradient = -compliance_ * at.sum.gradient;
  sum.hessian = -compliance_ * at.sum.hessian;
  sum.factor = 0.0;
  slid.motion = u[slid_.dof] - slid_.held - reference[kTangent];
  slid.gradient = LawVector::Unit(size, SlidEntry());
  slid.hessian = LawMatrix::Zero(size, size);
  slid.factor = at.share.value;
  slid.factor_gradient = at.share.gradient;
}

double TendonEye::Gap(const Eigen::VectorXd& u, double s, int /*piece*/) const {
  const TendonSpan::State before = before_.At(u, s), behind = behind_.At(u, s);
  return -compliance_ * before_.EA() * (before.length / before.rest - 1.0 + behind.length / behind.rest - 1.0);
}

double TendonEye::GapOnRecord(const Eigen::VectorXd& u, double s, int /*piece*/) const {
  const TendonSpan::State before = before_.At(u, s), behind = behind_.At(u, s);
  return std::max(0.0, before.rest - before.length + behind.rest - behind.length);
}

void TendonEye::ForceHessian(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& forces,
                             const LawVector& weights, LawMatrix* hessian) const {
  *hessian = (weights[SlidEntry()] * forces[kTangent]) * At(u, s).share.hessian;
}

LawVector TendonEye::SecondDirectional(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& forces,
                                       const LawVector& direction) const {
  LawVector second = LawVector::Zero(direction.size());
  second[SlidEntry()] = forces[kTangent] * direction.dot(At(u, s).share.hessian * direction);
  return second;
}

Eigen::Vector3d TendonEye::FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int /*piece*/,
                                       const LawVector& first, const LawVector& second) const {
  if (port == kNormal) return Eigen::Vector3d::Zero();
  const Function share = At(u, s).share;
  return {share.value, share.gradient.dot(first), first.dot(share.hessian * first) + share.gradient.dot(second)};
}

double TendonEye::Travel(std::size_t port, const Eigen::VectorXd& u, double s, int /*piece*/, const Eigen::VectorXd& du,
                         double ds, int /*piece_after*/) const {
  if (port == kNormal) return 0.0;
  return 0.5 * (At(u, s).share.value + At(u + du, s + ds).share.value) * du[slid_.dof];
}

double TendonEye::OnRecord(const Eigen::VectorXd& u, double s, double force) const {
  const Place at = At(u, s);
  return force * at.share.value / (1.0 + 0.5 * at.sum.value / before_.EA());
}

double TendonEye::FromRecord(const Eigen::VectorXd& u, double s, double reaction) const {
  const Place at = At(u, s);
  return reaction * (1.0 + 0.5 * at.sum.value / before_.EA()) / at.share.value;
}

}  // namespace contact_path
