// Pieces of tendons with friction, their eyes, and what keeps their strains even: derivatives against differences.
#include "contact_path/law/tendon_span.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "contact_path/contact/tendon_eye.h"
#include "contact_path/structure/even_strain.h"
#include "support/derivative_checker.h"
#include "support/points.h"
#include "support/random.h"

namespace contact_path::tendon_span_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

VectorXd Scalar(double value) { return VectorXd::Constant(1, value); }

// Pieces between a node, a point of a body and one of another body, with what slides at one end and at both.
TEST(TendonSpan, DerivativesAreThoseOfDifferences) {
  const MovingFrame body = {{Coordinate{2}, Coordinate{3}}, {4}, Vector2d::Zero(), {0.3, 0.1}},
                    other = {{Coordinate{0}, Coordinate{-1, 0.4, 0.2}}, {1}, Vector2d::Zero(), {-0.2, 0.5}};
  const FixedPoint point = {body, {0.6, -0.2}}, node = PointOfNode(5, 6), to{other, {0.1, 0.9}};
  const Coordinate slid{7, 0.1}, onwards{8, -0.2};
  const TendonSpan before({MovingPlace::Between(node, point)}, {}, 1.3, 0.6, {}, slid),
      behind({MovingPlace::Between(point, to)}, {}, 1.3, 0.9, slid, onwards);
  const TendonEye eye(before, behind, slid, 0.3, {});
  // The same round a roller that the body turns, from a drum on the way before.
  const RolledSpan from_drum(0.1, -0.2, {0.5, 1.1}, 0.2), from_roller(-0.2, 0.0, {0.2, 0.9}, 0.1);
  const TendonSpan rolled_before({MovingPlace::Between(node, point), from_drum},
                                 {{{{-1, 0.1, 0.7}, -0.1}, {body.angle, -0.2}}}, 1.3, 0.6, {}, slid),
      rolled_behind({MovingPlace::Between(point, to), from_roller}, {{{body.angle, 0.2}, {}}}, 1.3, 0.9, slid, onwards);
  const TendonEye roller(rolled_before, rolled_behind, slid, 0.3, {-1.0, 2.4});
  VectorXd x(10);  // u, s
  x << 0.3, 0.4, 0.2, 1.1, -0.5, 0.9, 1.4, 0.17, -0.12, 0.3;
  Random random(3);
  for (const Law* const law :
       std::initializer_list<const Law*>{&before, &behind, &eye, &rolled_before, &rolled_behind, &roller}) {
    const LawDofs dofs = law->Dofs(0);
    const auto moved_to = [&](const VectorXd& q) {
      VectorXd moved = x;
      for (std::size_t k = 0; k < dofs.size(); ++k) moved[dofs[k]] = q[static_cast<Eigen::Index>(k)];
      moved[9] = q[q.size() - 1];
      return moved;
    };
    const auto at = [&](const VectorXd& q) {
      const VectorXd moved = moved_to(q);
      PortsAt ports;
      law->Evaluate(moved.head(9), moved[9], 0, {}, &ports);
      return ports;
    };
    const VectorXd q = LocalOf(dofs, x.head(9), x[9]), u = x.head(9);
    const PortReals forces = {0.7, law->NumPorts() > 1 ? -0.4 : 0.0};
    const LawVector v = random.Vector(q.size(), -1.0, 1.0), w = random.Vector(q.size(), -1.0, 1.0);
    for (std::size_t p = 0; p < law->NumPorts(); ++p) {
      EXPECT_TRUE(
          IsJacobian([&](const VectorXd& z) { return Scalar(at(z)[p].motion); }, q, at(q)[p].gradient.transpose()));
      EXPECT_TRUE(IsJacobian([&](const VectorXd& z) { return VectorXd(at(z)[p].gradient); }, q, at(q)[p].hessian));
    }
    const auto force = [&](const VectorXd& z) {
      VectorXd sum = VectorXd::Zero(q.size());
      const PortsAt ports = at(z);
      for (std::size_t p = 0; p < law->NumPorts(); ++p) sum += forces[p] * ports[p].factor * ports[p].gradient;
      return sum;
    };
    EXPECT_TRUE(IsJacobian(force, q, at(q).ForceChange(forces).transpose()));
    LawMatrix hessian;
    law->ForceHessian(u, x[9], 0, forces, v, &hessian);
    EXPECT_TRUE(IsJacobian([&](const VectorXd& z) { return VectorXd(at(z).ForceChange(forces) * v); }, q, hessian));
    const auto rate = [&](const VectorXd& h) { return VectorXd(at(q + h[0] * v).ForceChange(forces).transpose() * v); };
    EXPECT_TRUE(IsJacobian(rate, Scalar(0.0), law->SecondDirectional(u, x[9], 0, forces, v)));
    if (law->NumPorts() == 1) continue;
    const auto along = [&](double h) { return VectorXd(q + h * v + 0.5 * h * h * w); };
    const auto factor = [&](const VectorXd& h) { return Scalar(at(along(h[0]))[1].factor); };
    const auto factor_rate = [&](const VectorXd& h) {
      return Scalar(at(along(h[0]))[1].factor_gradient.dot(v + h[0] * w));
    };
    const Eigen::Vector3d jet = law->FactorAlong(1, u, x[9], 0, v, w);
    EXPECT_DOUBLE_EQ(jet[0], at(q)[1].factor);
    EXPECT_TRUE(IsJacobian(factor, Scalar(0.0), MatrixXd::Constant(1, 1, jet[1])));
    EXPECT_TRUE(IsJacobian(factor_rate, Scalar(0.0), MatrixXd::Constant(1, 1, jet[2])));
  }
}

// Stretched, a piece is a bar of what is between its ends, and works on what slides with T + T^2 / (2 EA).
TEST(TendonSpan, PullsAsABarOfWhatIsBetweenItsEnds) {
  const double EA = 2.0, rest = 0.8;
  const TendonSpan span({MovingPlace::Between(PointOfNode(0, 1), PointOfNode(2, 3))}, {}, EA, rest, {}, {4, 0.0});
  VectorXd u(5);
  u << 0.0, 0.0, 0.9, 0.0, 0.1;
  PortsAt at;
  span.Evaluate(u, 0.0, 0, {}, &at);
  const double force = -at[0].motion / span.Compliance(), tension = EA * (0.9 / 0.7 - 1.0);
  EXPECT_NEAR(force * at[0].gradient[2], -tension, 1e-14);
  EXPECT_NEAR(force * at[0].gradient[4], -(tension + 0.5 * tension * tension / EA), 1e-14);
  EXPECT_NEAR(0.5 * span.Compliance() * force * force, 0.5 * EA * 0.2 * 0.2 / 0.7, 1e-14);
}

TEST(EvenStrain, DerivativesAreThoseOfDifferences) {
  EvenStrain::Piece before{0.9, {{3, 0.2, -1.0}}, {0, 1}}, behind{1.1, {{3, 0.2, 1.0}, {4, -0.1, -1.0}}, {1, 2}};
  const EvenStrain element(0.7, before, behind, 5);
  Random random(5);
  VectorXd x(10);
  x << 0.0, 0.1, 0.8, -0.2, 1.7, 0.9, 0.3, 0.0, -0.15, 0.0;
  const VectorXd v = random.Vector(10, -1.0, 1.0);
  VectorXd force(10);
  MatrixXd tangent(10, 10), derivative(10, 10);
  element.Force(x, force);
  element.Tangent(x, tangent);
  element.TangentDerivative(x, v, derivative);
  EXPECT_TRUE(IsJacobian([&](const VectorXd& z) { return Scalar(element.Energy(z)); }, x, force.transpose()));
  const auto force_at = [&](const VectorXd& z) {
    VectorXd of(10);
    element.Force(z, of);
    return of;
  };
  EXPECT_TRUE(IsJacobian(force_at, x, tangent));
  const auto along = [&](const VectorXd& z) {
    MatrixXd of(10, 10);
    element.Tangent(z, of);
    return VectorXd(of * v);
  };
  EXPECT_TRUE(IsJacobian(along, x, derivative));
}

}  // namespace
}  // namespace contact_path::tendon_span_test
