// The branch method on a curved surface: a node on springs that slides over a disc, against its closed form.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <optional>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/event_functions.h"
#include "contact_path/branch/rate_problem.h"
#include "contact_path/branch/smooth_arc.h"
#include "support/curved_contacts.h"

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
    const NodeMotion motion = {{0, 1}, Vector2d::Zero(), Vector2d::Zero()};
    contacts_.push_back(
        std::make_unique<RigidPair>(std::make_shared<DiscOutside>(Vector2d::Zero(), 1.0), motion, kFriction));
    contacts_.push_back(
        std::make_unique<RigidPair>(std::make_shared<DiscOutside>(Vector2d(1.6, 0.9), 1.0), motion, 0.0));
  }
  static Scene MakeScene() {
    Scene scene;
    scene.nodes = {{"p", 0.2, 0.3, false, false}};
    scene.superelements = {{{"p"}, {1.3, 0.0, 0.0, 0.8}}};
    scene.loads = {{"p", 1.0, -0.2, false}};
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
    point.rn = Vector2d(solved[1], 0.0);
    point.rt = Vector2d(ratio * solved[1], 0.0);
    point.states = {state, ContactState::kOpen};
    return point;
  }
  // (u, s, r_n) of the slipping node.
  Eigen::Vector4d ClosedForm(double angle) const {
    const PathPoint point = At(angle, -kFriction, ContactState::kSlipPlus);
    return {point.u[0], point.u[1], point.s, point.rn[0]};
  }
  // Angle of a point of the closed form.
  static double AngleOf(const VectorXd& x) { return std::atan2(x[0], x[1]); }

  Structure structure_;
  ContactPairs contacts_;
};

TEST_F(NodeOnADisc, DerivativesAreThoseOfTheClosedForm) {
  const double angle = -0.4, h = 1e-4;
  const PathPoint point = At(angle, -kFriction, ContactState::kSlipPlus);
  SmoothArc arc(structure_, contacts_);
  arc.SetStates(point.states, point);
  const Eigen::Vector4d before = ClosedForm(angle - h), here = ClosedForm(angle), after = ClosedForm(angle + h);
  const Eigen::Vector4d rate = (after - before) / (2.0 * h), bend = (after - 2.0 * here + before) / (h * h);
  const double speed = rate.head<3>().norm();
  CurvePoint at;
  ASSERT_TRUE(arc.Derivatives(arc.system().Pack(point), rate.head<3>() / speed, &at));
  EXPECT_LE((at.first - rate / speed).norm(), 1e-6);
  Eigen::Vector4d second = bend / (speed * speed);
  second -= at.first.head<3>().dot(second.head<3>()) * at.first;
  EXPECT_LE((at.second - second).norm(), 1e-5);
}

TEST_F(NodeOnADisc, StepsStayOnTheClosedForm) {
  const PathPoint point = At(-0.4, -kFriction, ContactState::kSlipPlus);
  SmoothArc arc(structure_, contacts_);
  arc.SetStates(point.states, point);
  CurvePoint at;
  ASSERT_TRUE(arc.Derivatives(arc.system().Pack(point), ClosedForm(-0.3).head<3>() - ClosedForm(-0.4).head<3>(), &at));
  for (int i = 0; i < 10; ++i) {
    const VectorXd normal = at.first.head(3);
    const Correction correction = arc.CorrectOnPlane(at.x + 0.03 * at.first + 0.5 * 0.03 * 0.03 * at.second, normal);
    ASSERT_TRUE(correction.converged);
    ASSERT_TRUE(arc.Derivatives(correction.x, normal, &at));
    EXPECT_LE((at.x - ClosedForm(AngleOf(at.x))).norm(), kExact) << i;
  }
}

// The node comes to the second disc: where the distance to both centres is 1.
TEST_F(NodeOnADisc, TheNextDiscIsReachedExactly) {
  const double distance = std::hypot(1.6, 0.9);
  const double between = std::acos(0.5 * distance);
  const double touching = std::atan2(1.6, 0.9) - between;
  const PathPoint point = At(touching - 0.02, -kFriction, ContactState::kSlipPlus);
  SmoothArc arc(structure_, contacts_);
  arc.SetStates(point.states, point);
  CurvePoint start, end;
  const VectorXd towards = ClosedForm(touching).head<3>() - ClosedForm(touching - 0.02).head<3>();
  ASSERT_TRUE(arc.Derivatives(arc.system().Pack(point), towards, &start));
  const Correction correction = arc.CorrectOnPlane(start.x + 0.04 * start.first, start.first.head(3));
  ASSERT_TRUE(correction.converged && arc.Derivatives(correction.x, start.first.head(3), &end));
  const Step step = MakeStep(start, end, 3);
  const StepEvent event = FirstEvent(&arc, step);
  ASSERT_EQ(event.kind, EventKind::kContactEvent);
  EXPECT_EQ(event.constraint.inequality, Inequality::kGap);
  EXPECT_EQ(event.constraint.contact, 1);
  const std::optional<CurvePoint> located = Locate(&arc, step, event);
  ASSERT_TRUE(located);
  EXPECT_NEAR(AngleOf(located->x), touching, kExact);
  EXPECT_NEAR((located->x.head<2>() - Vector2d(1.6, 0.9)).norm(), 1.0, kExact);
}

// Condensed and whole, the rates at an event have the share of the curvature, which the reaction makes.
TEST_F(NodeOnADisc, RatesAtAnEventAreThoseOfTheClosedForm) {
  const double angle = -0.4, h = 1e-4;
  const PathPoint point = At(angle, -kFriction, ContactState::kStick);  // at the edge of its cone
  const Eigen::Vector4d rate = (ClosedForm(angle + h) - ClosedForm(angle - h)) / (2.0 * h);
  const VectorXd arrival = rate.head<3>().normalized();
  const RateProblem problem(structure_, contacts_, point, point.states, {0}, arrival);
  ASSERT_TRUE(problem.regular());
  const std::optional<CondensedRates> rates = problem.Rates({ContactState::kSlipPlus, ContactState::kOpen});
  ASSERT_TRUE(rates);
  const double sign = rates->slip[0] < 0.0 ? -1.0 : 1.0, speed = rate.head<3>().norm();
  EXPECT_NEAR(sign * rates->load, rate[2] / speed, 1e-7);
  EXPECT_NEAR(sign * rates->slip[0], 1.0 / speed, 1e-7);
  EXPECT_NEAR(sign * rates->rn[0], rate[3] / speed, 1e-7);
  EXPECT_NEAR(rates->gap[0], 0.0, kExact);

  Arrival from;
  from.direction = arrival;
  const BranchSet set = FindBranches(structure_, contacts_, point, from, ActiveSetTolerance());
  ASSERT_FALSE(set.branches.empty());
  EXPECT_EQ(set.branches[0].states[0], ContactState::kSlipPlus);
  EXPECT_LE((set.branches[0].direction - arrival).norm(), 1e-7);
  EXPECT_NEAR(set.branches[0].dissipation_rate, kFriction * point.rn[0] / speed, 1e-7);
}

}  // namespace
}  // namespace contact_path::curved_surface_test
