// Contacts, strings and pins at places that bodies and obstacles move.
#include "contact_path/structure/place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "contact_path/contact/rigid_pair.h"
#include "contact_path/geometry/point_curves.h"
#include "contact_path/law/pin_joint.h"
#include "contact_path/law/slack_bar.h"
#include "support/derivative_checker.h"
#include "support/points.h"
#include "support/random.h"

namespace contact_path::moving_place_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Points of bodies seen by what is at rest, by an obstacle that moves, and by one that another body carries; strings
// and pins between all of them, and circles about them that roll.
TEST(MovingPlace, GivesLawsTheirDerivatives) {
  const MovingFrame body = {{Coordinate{2}, Coordinate{3}}, {4}, Vector2d::Zero(), {0.3, 0.1}},
                    other = {{Coordinate{0}, Coordinate{-1, 0.4, 0.2}}, {1}, Vector2d::Zero(), {-0.2, 0.5}};
  const FixedPoint point = {body, {0.6, -0.2}}, node = PointOfNode(5, 6);
  const std::shared_ptr<const Surface> spline = MakeSpline({{-2.0, 0.2}, {0.1, 0.4}, {0.8, 0.1}, {3.0, 0.5}}, false);
  const std::shared_ptr<const Surface> plane = std::make_shared<HalfPlane>(Vector2d(0.0, -1.0), Vector2d(0.3, 1.0));
  std::vector<std::unique_ptr<const Law>> laws;
  const std::shared_ptr<const Surface> beside =
                                           MakeSpline({{-2.0, 0.2}, {0.1, 0.4}, {0.8, 0.1}, {3.0, 0.5}}, false, 0.4),
                                       corners = MakePolyline({{-2.0, 0.2}, {0.1, 0.4}, {0.8, -0.1}}, false,
                                                              std::vector<double>(3, 0.2), 0.4);
  for (const std::shared_ptr<const Surface>& surface : {spline, plane, beside, corners})
    for (const MovingFrame& frame : {MovedFrame({0.0, 0.0}), MovedFrame({0.2, -0.1}, 0.7, {0.4, 0.3}), other})
      for (const FixedPoint& of : {point, node})
        for (const double radius : {0.0, 0.4})
          laws.push_back(std::make_unique<RigidPair>(surface, MovingPlace::SeenFrom(frame, of), 0.3, VectorXd(),
                                                     std::nullopt, 0.0, Rolling{radius, of.frame.angle, frame.angle}));
  const FixedPoint to{other, {0.1, 0.9}};
  const MovingPlace first = MovingPlace::Between(node, point), second = MovingPlace::Between(point, to),
                    third = MovingPlace::Between(to, node);
  // Round rollers, and wound on drums.
  const auto rolled = [](double rho_1, double rho_2) { return RolledSpan(rho_1, rho_2, {0.5, 1.1}, 0.2); };
  const Windings windings = {{{body.angle, -0.2}, {{-1, 0.1, 0.7}, 0.3}}};
  for (const std::vector<BarSpan>& spans :
       {std::vector<BarSpan>{{first}},
        {{second}},
        {{first}, {second}, {third}},
        {{first, rolled(0.2, -0.1)}},
        {{first, rolled(0.0, -0.1)}, {second, rolled(-0.1, 0.15)}, {third, rolled(0.15, 0.0)}}})
    for (const Windings& wound : {Windings(), windings})
      laws.push_back(std::make_unique<SlackBar>(spans, wound, 1.3, 0.4, StrainMeasure::kBiot, BarSense::kTension));
  for (const MovingPlace& apart : {first, second, third})
    laws.push_back(std::make_unique<PinJoint>(apart, Vector2d(0.2, -0.1), 0.0));
  Random random(3);
  VectorXd x(8);  // u, s
  x << 0.3, 0.4, 0.2, 1.1, -0.5, 0.9, 1.4, 0.3;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const Law& law = *laws[i];
    const auto* const pair = dynamic_cast<const ContactPair*>(&law);
    const std::size_t motions =
        pair != nullptr ? std::max<std::size_t>(law.NumPorts(), pair->FootPort() + 1) : law.NumPorts();
    const LawDofs dofs = law.Dofs(1);
    const auto at = [&](const VectorXd& q) {
      VectorXd moved = x;
      for (std::size_t k = 0; k < dofs.size(); ++k) moved[dofs[k]] = q[static_cast<Eigen::Index>(k)];
      moved[7] = q[q.size() - 1];
      PortsAt ports;
      law.Evaluate(moved.head(7), moved[7], 1, {}, &ports);
      return ports;
    };
    const VectorXd q = LocalOf(dofs, x.head(7), x[7]);
    const PortReals forces = {0.7, law.NumPorts() > 1 ? -0.4 : 0.0};
    const LawVector v = random.Vector(q.size(), -1.0, 1.0);
    MatrixXd change = MatrixXd::Zero(q.size(), q.size());
    for (std::size_t p = 0; p < motions; ++p) {
      SCOPED_TRACE(testing::Message() << "law " << i << ", port " << p);
      const auto motion = [&, p](const VectorXd& z) { return VectorXd::Constant(1, at(z)[p].motion); };
      const auto gradient = [&, p](const VectorXd& z) { return VectorXd(at(z)[p].gradient); };
      EXPECT_TRUE(IsJacobian(motion, q, at(q)[p].gradient.transpose()));
      if (!law.Curved()) continue;
      EXPECT_TRUE(IsJacobian(gradient, q, at(q)[p].hessian));
      for (Eigen::Index k = 0; k < q.size(); ++k)
        EXPECT_TRUE(law.Moves(p, static_cast<std::size_t>(k)) || at(q)[p].gradient[k] == 0.0);
    }
    if (!law.Curved()) continue;
    LawMatrix hessian;
    VectorXd u = x.head(7);
    law.ForceHessian(u, x[7], 1, forces, v, &hessian);
    const auto along = [&](const VectorXd& z) {
      VectorXd sum = VectorXd::Zero(q.size());
      for (std::size_t p = 0; p < law.NumPorts(); ++p) sum += forces[p] * at(z)[p].hessian * v;
      return sum;
    };
    EXPECT_TRUE(IsJacobian(along, q, hessian)) << "law " << i;
  }
}

}  // namespace
}  // namespace contact_path::moving_place_test
