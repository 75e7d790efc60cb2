#include "contact_path/law/tendon_span.h"

#include <algorithm>
#include <cmath>

#include "contact_path/scene/tendon_route.h"
#include "contact_path/tolerances.h"

namespace contact_path {

TendonSpan::TendonSpan(const BarSpan& span, const Windings& windings, double EA, double rest_length,
                       const Coordinate& first, const Coordinate& second)
    : SlackBar(span, windings, EA, rest_length, DofsOf({span}, windings, {first, second})), slides_{first, second} {}

LawVector TendonSpan::RestGradient(const LawDofs& dofs) const {
  LawVector gradient = LawVector::Zero(static_cast<Eigen::Index>(dofs.size()) + 1);
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    if (dofs[k] == slides_[0].dof) gradient[static_cast<Eigen::Index>(k)] += 1.0;
    if (dofs[k] == slides_[1].dof) gradient[static_cast<Eigen::Index>(k)] -= 1.0;
  }
  return gradient;
}

TendonSpan::State TendonSpan::At(const Eigen::VectorXd& u, double s) const {
  State state{PlaceAt(Span(), u, s), RestLength(), {}, 0.0, Rolled().Arcs() + Wound(u, s)};
  if (slides_[0].dof >= 0) state.rest += u[slides_[0].dof] - slides_[0].held;
  if (slides_[1].dof >= 0) state.rest -= u[slides_[1].dof] - slides_[1].held;
  // Neither lengths of nothing nor what is left of nothing have derivatives.
  const double small = tolerances::kSmallShare * RestLength();
  state.rest = std::max(state.rest, small);
  const auto& [tangent, arcs] = Rolled().Of(state.span.x, small);
  const double free = tangent.norm();
  state.tangent = free < small ? Eigen::Vector2d(small / free * tangent) : tangent;
  state.length = std::max(free, small) + arcs + Wound(u, s);
  return state;
}

LawVector TendonSpan::LengthGradient(const State& at, const Eigen::Vector2d& direction) const {
  return Spread(LawVector(at.span.first.transpose() * direction), Span().Dofs(), OwnDofs()) + WoundGradient(OwnDofs());
}

void TendonSpan::Evaluate(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& /*reference*/,
                          PortsAt* ports) const {
  const State at = At(u, s);
  const double a = at.rest, l = at.length, free = at.tangent.norm(), root = std::sqrt(RestLength() / a);
  const LawDofs& dofs = OwnDofs();
  const Eigen::Vector2d n = at.tangent / free;
  const LawVector by_rest = RestGradient(dofs), along = LengthGradient(at, n);
  // g = root (a - l)
  const double g_a = 0.5 * root * (1.0 + l / a), g_la = 0.5 * root / a, g_aa = -0.25 * root / a * (1.0 + 3.0 * l / a);
  ports->dofs = dofs;
  PortAt& port = (*ports)[0];
  port.motion = root * (a - l);
  port.gradient = -root * along + g_a * by_rest;
  const Eigen::Matrix2d of_length = -root / free * (Eigen::Matrix2d::Identity() - n * n.transpose());
  port.hessian = Spread(at.span.Hessian(-root * n, of_length), Span().Dofs(), dofs);
  port.hessian +=
      g_la * (along * by_rest.transpose() + by_rest * along.transpose()) + g_aa * by_rest * by_rest.transpose();
}

void TendonSpan::ForceHessian(const Eigen::VectorXd& u, double s, int /*piece*/, const PortReals& forces,
                              const LawVector& weights, LawMatrix* hessian) const {
  const State at = At(u, s);
  const double a = at.rest, l = at.length, free = at.tangent.norm(), root = std::sqrt(RestLength() / a);
  const LawDofs &dofs = OwnDofs(), &of_span = Span().Dofs();
  const Eigen::Vector2d n = at.tangent / free;
  const LawVector by_rest = RestGradient(dofs), own = Gathered(weights, dofs, of_span), along = LengthGradient(at, n);
  const Eigen::Vector2d change_of_tangent = Rolled().TangentChange(at.tangent, at.span.first * own);
  const double v_a = by_rest.dot(weights), v_l = along.dot(weights), v_free = n.dot(change_of_tangent);
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - n * n.transpose();
  const Eigen::Vector2d turn = across * change_of_tangent / free;  // d/dh of n
  const double g_la = 0.5 * root / a, g_laa = -0.75 * root / (a * a),
               g_aaa = 0.375 * root / (a * a) * (1.0 + 5.0 * l / a);
  // d/dh of the Hessian by x: that of -root l at this length at rest, and by its change.
  const Eigen::Matrix2d change =
      root / free * (v_free / free * across + turn * n.transpose() + n * turn.transpose()) + g_la * v_a / free * across;
  *hessian = Spread(at.span.HessianChange(-root * n, -root / free * across, change, own), of_span, dofs) +
             Spread(at.span.Hessian(g_la * v_a * n, Eigen::Matrix2d::Zero()), of_span, dofs);
  const LawVector mixed =
      Spread(LawVector(g_la * (at.span.Hessian(n, across / free) * own)), of_span, dofs) + g_laa * v_a * along;
  *hessian += mixed * by_rest.transpose() + by_rest * mixed.transpose() +
              (g_laa * v_l + g_aaa * v_a) * by_rest * by_rest.transpose();
  *hessian *= forces[0];
}

TendonSpan MakeSpan(const Tendon& piece, const Scene& scene, const SceneIndex& index, const Structure& structure) {
  const auto slide = [&](const std::string& name) -> Coordinate {
    if (name.empty()) return {};
    const std::size_t node = index.Node(name);
    return {structure.Dof(static_cast<int>(node), 0), scene.nodes[node].x};
  };
  const std::vector<int> nodes = {static_cast<int>(index.Node(piece.nodes[0])),
                                  static_cast<int>(index.Node(piece.nodes[1]))};
  std::vector<Eigen::Vector2d> points;
  for (const int node : nodes) {
    const Node& at = scene.nodes[static_cast<std::size_t>(node)];
    points.emplace_back(at.x, at.y);
  }
  return {{MovingPlace::Between(structure.PointOf(nodes[0]), structure.PointOf(nodes[1])),
           RouteOf(piece, points).spans.front()},
          WindingsOf(piece, scene, index, structure),
          piece.EA,
          piece.rest_length,
          slide(piece.slides[0]),
          slide(piece.slides[1])};
}

}  // namespace contact_path
