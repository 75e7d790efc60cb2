// Rates of a node on springs that slides over a disc, against its closed form.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/rate_problem.h"
#include "support/contact_points.h"
#include "support/curved_contacts.h"
#include "support/points.h"

namespace contact_path::curved_surface_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kExact = 1e-12;
constexpr double kFriction = 0.3;

// The disc has its centre at the origin and the radius 1; springs of stiffness 1.3 (x) and 0.8 (y) hold the node to
// (0.2, 0.3); the load is s (1, -0.2). On the disc at the angle a from its top, towards +x.
class NodeOnADisc : public testing::Test {
 protected:
  NodeOnADisc() : structure_(MakeScene()) {
    const MovingPlace motion(PointOfNode(0, 1));
    contacts_.push_back(
        std::make_unique<RigidPair>(std::make_shared<DiscOutside>(Vector2d::Zero(), 1.0), motion, kFriction));
    contacts_.push_back(
        std::make_unique<RigidPair>(std::make_shared<DiscOutside>(Vector2d(1.6, 0.9), 1.0), motion, 0.0));
  }
  static Scene MakeScene() {
    Scene scene;
    scene.nodes = {{"p", 0.2, 0.3}};
    scene.superelements = {{{"p"}, {1.3, 0.0, 0.0, 0.8}}};
    scene.loads = {{"p", 1.0, -0.2}};
    return scene;
  }
  // Equilibrium K (x - X) - s f = r_n n + r_t t with r_t = ratio r_n.
  PathPoint At(double angle, double ratio, ContactState state) const {
    const Vector2d n(std::sin(angle), std::cos(angle)), t(n.y(), -n.x());
    const Vector2d elastic(1.3 * (n.x() - 0.2), 0.8 * (n.y() - 0.3));
    Eigen::Matrix2d columns;
    columns << Vector2d(1.0, -0.2), n + ratio * t;
    const Vector2d solved = columns.inverse() * elastic;
    PathPoint point;
    point.u = n;
    point.s = solved[0];
    point.forces = Eigen::Vector4d(solved[1], ratio * solved[1], 0.0, 0.0);
    point.modes = ModesOf({state, ContactState::kOpen});
    return point;
  }
  // (u, s, r_n) of the slipping node.
  Eigen::Vector4d ClosedForm(double angle) const {
    const PathPoint point = At(angle, -kFriction, ContactState::kSlipPlus);
    return {point.u[0], point.u[1], point.s, point.forces[0]};
  }

  Structure structure_;
  ContactPairs contacts_;
};

// Condensed and whole, the rates at an event have the share of the curvature, which the reaction makes.
TEST_F(NodeOnADisc, RatesAtAnEventAreThoseOfTheClosedForm) {
  const double angle = -0.4, h = 1e-4;
  const PathPoint point = At(angle, -kFriction, ContactState::kStick);  // at the edge of its cone
  const Eigen::Vector4d rate = (ClosedForm(angle + h) - ClosedForm(angle - h)) / (2.0 * h);
  const VectorXd arrival = rate.head<3>().normalized();
  const Laws laws = LawsOf(contacts_);
  const RateProblem problem(structure_, laws, point, point.modes, {0}, arrival);
  ASSERT_TRUE(problem.regular());
  const std::optional<CondensedRates> rates =
      problem.Rates(StatesOf(ModesOf({ContactState::kSlipPlus, ContactState::kOpen})));
  ASSERT_TRUE(rates);
  const double sign = rates->motion[kTangent] < 0.0 ? -1.0 : 1.0, speed = rate.head<3>().norm();
  EXPECT_NEAR(sign * rates->load, rate[2] / speed, 1e-7);
  EXPECT_NEAR(sign * rates->motion[kTangent], 1.0 / speed, 1e-7);
  EXPECT_NEAR(sign * rates->force[kNormal], rate[3] / speed, 1e-7);
  EXPECT_NEAR(rates->motion[kNormal], 0.0, kExact);

  Arrival from;
  from.direction = arrival;
  const BranchSet set = FindBranches(structure_, laws, point, from, ActiveSetTolerance());
  ASSERT_FALSE(set.branches.empty());
  EXPECT_EQ(StateOf(set.branches[0].modes[0]), ContactState::kSlipPlus);
  EXPECT_LE((set.branches[0].direction - arrival).norm(), 1e-7);
  EXPECT_NEAR(set.branches[0].dissipation_rate, kFriction * point.forces[0] / speed, 1e-7);
}

}  // namespace
}  // namespace contact_path::curved_surface_test
